"""Text, pages in Markdown and tables, as HTML or ready for it."""

import re
from collections.abc import Sequence
from typing import Any

import pyarrow as pa
from markdown_it import MarkdownIt
from markdown_it.token import Token
from markupsafe import Markup, escape

from springblock.claims.page import anchor

#: The paper's symbols, which it prints with their indices below the line.
_SYMBOL = re.compile(r"\b(?:(n)_([ps][23]?)|(l)_([cpz])|(t)_(max|avg|det)|(μ)_([sd]))\b")
#: Line that opens or closes a part to be folded, the only HTML in a page of the study.
_FOLD = re.compile(r"<details><summary>([^<>]*)</summary>|</details>")
_SHORT, _LONG = 30, 80  #: characters of a cell that stay on one line, or need a wide one
_MANY = 20  #: chapters from which on the numbered ones are folded


def typeset(text: str) -> Markup:
    """Return text as HTML, escaped but for what sets its symbols."""

    def symbol(found: re.Match[str]) -> str:
        letter, index = filter(None, found.groups())
        return f"<var>{letter}<sub>{index}</sub></var>"

    return Markup(_SYMBOL.sub(symbol, str(escape(text))))


def rendered(name: str, markdown: str) -> tuple[str, Markup]:
    """Title of a page, its first heading or else its name, and the page as HTML.

    Headings, and links to them, are marked with its name. HTML is shown as text, but for <details>.
    """
    parser = MarkdownIt("commonmark", {"html": False}).enable("table")
    parser.add_render_rule("table_open", lambda *_: '<div class="table" tabindex="0"><table>\n')
    parser.add_render_rule("table_close", lambda *_: "</table>\n</div>")
    tokens = parser.parse(markdown)
    title = name
    if tokens and tokens[0].tag == "h1":
        title, tokens = tokens[1].content, tokens[3:]
    _mark(name, tokens)
    chapters = sum(token.type == "heading_open" and token.tag == "h2" for token in tokens)
    tokens = _folded(tokens) if chapters > _MANY else tokens
    _fold(tokens)
    return title, Markup(parser.renderer.render(tokens, parser.options, {}))


def _mark(name: str, tokens: Sequence[Token]) -> None:
    """Give headings anchors that are no other page's, keep short cells whole, and set symbols."""
    for i, token in enumerate(tokens):
        if token.type == "heading_open":
            token.attrSet("id", f"{name}-{anchor(tokens[i + 1].content)}")
        if token.type == "td_open":
            token.attrSet("class", _width(tokens[i + 1].content))
        for child in token.children or ():
            target = str(child.attrGet("href") or "")
            if target.startswith("#"):
                child.attrSet("href", f"#{name}-{target[1:]}")
            if child.type == "text":
                child.type, child.content = "html_inline", str(typeset(child.content))


def _fold(tokens: list[Token]) -> None:
    """Turn paragraphs that open or close a folded part into HTML."""
    for i, token in enumerate(tokens):
        found = _FOLD.fullmatch(token.content) if token.type == "inline" else None
        if found and tokens[i - 1].type == "paragraph_open":
            title = found[1]
            text = (
                "</details>" if title is None else f"<details><summary>{typeset(title)}</summary>"
            )
            tokens[i - 1 : i + 2] = [*_html(text), *_html(" "), *_html(" ")]


def _width(content: str) -> str:
    """How wide a cell is to be, as a class of the style sheet."""
    size = len(content)
    return "short" if size <= _SHORT else "long" if size > _LONG else "medium"


def _folded(tokens: Sequence[Token]) -> list[Token]:
    """Fold numbered chapters, each below its heading."""
    folded: list[Token] = []
    opened = False
    for i, token in enumerate(tokens):
        if token.tag == "h2" and token.type == "heading_open":
            folded += _html("</details>" * opened)
            opened = tokens[i + 1].content[:1].isdigit()
            folded += _html("<details><summary>" * opened)
        folded.append(token)
        if token.tag == "h2" and token.type == "heading_close":
            folded += _html("</summary>" * opened)
    return folded + _html("</details>" * opened)


def _html(text: str) -> list[Token]:
    return [Token("html_block", "", 0, content=text)] if text else []


def shown(name: str, table: pa.Table) -> dict[str, Any]:
    """Return what is the same in all rows of a table, as name = value unit, and the rest of it.

    Of columns that is name, unit, meaning and whether they hold numbers, which have six digits.
    """
    columns = {field.name: _column(field) for field in table.schema}
    values = {name: [_text(value) for value in table[name].to_pylist()] for name in columns}
    same = {name: texts[0] for name, texts in values.items() if len(set(texts)) == 1}
    if table.num_rows == 1:
        same = {}
    told = [
        f"{name} = {text} {columns[name]['unit']}".strip() for name, text in same.items() if text
    ]
    kept = [name for name in columns if name not in same]
    rows = list(zip(*(values[name] for name in kept), strict=True))
    return {"name": name, "same": told, "columns": [columns[key] for key in kept], "rows": rows}


def _column(field: pa.Field) -> dict[str, Any]:
    """What is said of a column; a unit of 1, as words have it, goes without saying."""
    says = {key.decode(): value.decode() for key, value in (field.metadata or {}).items()}
    is_number = pa.types.is_floating(field.type) or pa.types.is_integer(field.type)
    unit = says.get("unit", "1") if is_number else "1"
    said = {"name": field.name, "unit": "" if unit == "1" else unit, "is_number": is_number}
    return said | {"meaning": says.get("meaning", "")}


def _text(value: Any) -> str:
    if isinstance(value, float):
        return "" if value != value else f"{value:.6g}"
    return "" if value is None else str(value)
