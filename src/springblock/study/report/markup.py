"""Text, pages in Markdown and tables, as HTML or ready for it."""

import re
from collections.abc import Collection, Sequence
from typing import Any, NamedTuple

import pyarrow as pa
from markdown_it import MarkdownIt
from markdown_it.token import Token
from markupsafe import Markup, escape

from springblock.io.rows import anchor
from springblock.io.schemas import said

#: Symbols with an index, which the paper prints below the line; parts of paths have none.
_SYMBOL = re.compile(
    r"(?<![^\W\d])(mu|[A-Za-zμγσω])_(max|min|avg|det|int|[a-z][23]?|0)(?![a-zA-Z0-9_]|-\w)"
)
_ANCHOR = re.compile(r"&lt;a id=&#34;([\w-]+)&#34;&gt;&lt;/a&gt;")
_PAGE = re.compile(r"(?:docs/|\.\./)?(\w+)\.md")
_SHORT, _LONG = 30, 80  #: characters of a cell that stay on one line, or need a wide one


class Page(NamedTuple):
    """A page as HTML, with its title."""

    title: str
    body: Markup


def typeset(text: str) -> Markup:
    """Return text as HTML, all of it escaped, with symbols set and code marked."""
    parts = re.split("`([^`]+)`", str(escape(text)))
    codes = (f"<code>{part}</code>" if i % 2 else symbols(part) for i, part in enumerate(parts))
    return Markup("".join(codes))


def symbols(html: str) -> Markup:
    """Return HTML with the indices of its symbols below the line."""
    printed = _SYMBOL.sub(r"<var>\1<sub>\2</sub></var>", html)
    return Markup(printed.replace("<var>mu<", "<var>μ<"))


def rendered(name: str, markdown: str, pages: Collection[str] = ()) -> Page:
    """Read a page: its title is its first heading, or else its name.

    Headings, and links to them, are marked with its name; links to `pages`, and pictures that are
    among them, lead to these. HTML is shown as text, except the anchors of a glossary.
    """
    parser = MarkdownIt("commonmark", {"html": False}).enable("table")
    parser.add_render_rule("table_open", lambda *_: '<div class="table" tabindex="0"><table>\n')
    parser.add_render_rule("table_close", lambda *_: "</table>\n</div>")
    tokens = parser.parse(re.sub(r"\$+([^$]+)\$+", _formula, markdown))
    title = name
    if tokens and tokens[0].tag == "h1":
        title, tokens = tokens[1].content, tokens[3:]
    _mark(name, tokens, pages)
    html = parser.renderer.render(tokens, parser.options, {})
    return Page(title, Markup(_ANCHOR.sub(rf'<span id="{name}-\1"></span>', html)))


def _formula(found: re.Match[str]) -> str:
    """Write a formula of one line in plain characters."""
    return found[1].replace(r"\mu", "μ").replace("*", r"\*").strip()


def _mark(name: str, tokens: Sequence[Token], pages: Collection[str]) -> None:
    """Give headings anchors that are no other page's, keep short cells whole, and set symbols."""
    for i, token in enumerate(tokens):
        if token.type == "heading_open":
            token.attrSet("id", f"{name}-{anchor(tokens[i + 1].content)}")
        if token.type == "td_open":
            token.attrSet("class", _width(tokens[i + 1].content))
        if token.type == "th_open" and not tokens[i + 1].content:
            token.tag = tokens[i + 2].tag = "td"  # a column without a name has no heading
        for child in token.children or ():
            _link(name, child, pages)
            _picture(child, pages)
            if child.type == "text":
                child.type, child.content = "html_inline", str(symbols(str(escape(child.content))))


def _link(name: str, token: Token, pages: Collection[str]) -> None:
    """Turn links to headings and pages, and names of pages, into links within the report."""
    target, _, heading = str(token.attrGet("href") or "").partition("#")
    page = _PAGE.fullmatch(token.content if token.type == "code_inline" else target)
    if page and page[1] in pages:
        place = f"#{page[1]}-{heading}" if heading else f"#{page[1]}"
        if token.type == "link_open":
            token.attrSet("href", place)
        else:
            token.type, token.content = "html_inline", f'<a href="{place}">{page[1]}</a>'
    elif heading and not target:
        token.attrSet("href", f"#{name}-{heading}")
    elif page and token.type == "link_open":
        del token.attrs["href"]  # a page of the documentation that the report lacks


def _picture(token: Token, pages: Collection[str]) -> None:
    """Turn a picture beside the page into a link to the report's figure of its name, or words."""
    if token.type == "image":
        name, said = str(token.attrGet("src")).partition(".")[0], escape(token.content)
        token.type = "html_inline"
        token.content = f'<a href="#{name}">{said}</a>' if name in pages else str(said)


def _width(content: str) -> str:
    """How wide a cell is to be, as a class of the style sheet."""
    size = len(content)
    return "short" if size <= _SHORT else "long" if size > _LONG else "medium"


def shown(name: str, table: pa.Table) -> dict[str, Any]:
    """Return the rows of a table, to six digits, what is the same in all of them, and its columns.

    Columns have a name, a unit, a meaning, and whether they hold numbers.
    """
    same, columns, cells = [], [], []
    for field, column in zip(table.schema, table.columns, strict=True):
        texts = [_text(value) for value in column.to_pylist()]
        if len(texts) == 1 or len({*texts}) != 1:
            columns.append(_column(field))
            cells.append(texts)
        elif texts[0]:
            same.append((_column(field), texts[0]))
    rows = list(zip(*cells, strict=True))
    return {"name": name, "same": same, "columns": columns, "rows": rows}


def _column(field: pa.Field) -> dict[str, Any]:
    """Describe a column, without a unit of 1 and with none for text."""
    unit, meaning = said(field)
    is_number = pa.types.is_floating(field.type) or pa.types.is_integer(field.type)
    unit = unit if is_number and unit != "1" else ""
    return {"name": field.name, "unit": unit, "is_number": is_number, "meaning": meaning}


def _text(value: Any) -> str:
    if isinstance(value, float):
        return "" if value != value else f"{value:.6g}"
    return "" if value is None else str(value)
