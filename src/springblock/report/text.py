"""The pages that a study writes, from Markdown to HTML."""

from collections.abc import Sequence
from typing import Any, NamedTuple

from markdown_it import MarkdownIt
from markdown_it.renderer import RendererHTML
from markdown_it.token import Token

from springblock.claims.page import anchor
from springblock.report.symbols import typeset

_SHORT, _LONG = 30, 80  #: characters of a cell that stay on one line, or need a wide one
_MANY = 20  #: chapters from which on the numbered ones are folded


class Page(NamedTuple):
    """A page of a study."""

    name: str
    title: str
    body: str  #: HTML, headings and links to them marked with the page's name


def rendered(name: str, markdown: str) -> Page:
    """Render a page, whose first heading is its title.

    What is HTML in it, is shown as it stands; tables get a box that they may scroll in.
    """
    parser = MarkdownIt("commonmark", {"html": False}).enable("table")
    parser.add_render_rule("table_open", _boxed)
    parser.add_render_rule("table_close", _unboxed)
    tokens = parser.parse(markdown)
    title = name
    if tokens and tokens[0].tag == "h1":
        title, tokens = tokens[1].content, tokens[3:]
    _mark(name, tokens)
    if sum(token.type == "heading_open" and token.tag == "h2" for token in tokens) > _MANY:
        tokens = _folded(tokens)
    return Page(name, title, parser.renderer.render(tokens, parser.options, {}))


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
    return [Token("html_block", "", 0, content=text)]


def _boxed(renderer: RendererHTML, tokens: Sequence[Token], i: int, options: Any, env: Any) -> str:
    return f'<div class="table" tabindex="0">{renderer.renderToken(tokens, i, options, env)}'


def _unboxed(
    renderer: RendererHTML, tokens: Sequence[Token], i: int, options: Any, env: Any
) -> str:
    return f"{renderer.renderToken(tokens, i, options, env)}</div>"
