"""Pages in Markdown: people write the sentences, in `page.md` of a chapter; code fills in values.

A sentence that says more than its values stands behind a guard:

    {% guard lowest.place in (6, 7) %}
    Static friction is lowest on pillars of six or seven blocks: {{ friction | number }}.
    {% endguard %}

Where the condition does not hold, the page is not written, and the error names the sentence.
"""

from collections.abc import Callable
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined, nodes
from jinja2.ext import Extension
from jinja2.parser import Parser

from springblock.analysis.statistics import number
from springblock.io.rows import listed, markdown_table

_WORDS = 12  #: of a sentence, in an error


class Guard(Extension):
    """The tag `guard`, which refuses to write a sentence that the tables contradict."""

    tags = {"guard"}  # noqa: RUF012 - declared so by Jinja2

    def parse(self, parser: Parser) -> nodes.Node:
        """Read a condition and the text up to `endguard`."""
        line = next(parser.stream).lineno
        condition = parser.parse_expression()
        text = parser.parse_statements(("name:endguard",), drop_needle=True)
        where = nodes.Const(f"{parser.name}, line {line}")
        call = self.call_method("kept", [condition, where], lineno=line)
        return nodes.CallBlock(call, [], [], text, lineno=line)

    def kept(self, holds: bool, where: str, caller: Callable[[], str]) -> str:
        """Return the text of a guard whose condition holds."""
        text = caller()
        if not holds:
            shown = " ".join(text.split()[:_WORDS])
            raise ValueError(
                f"{where}: the tables contradict “{shown} ...”; change the sentence and its guard"
            )
        return text


PAGES = Environment(
    loader=FileSystemLoader(Path(__file__).parent),
    extensions=[Guard],
    undefined=StrictUndefined,
    trim_blocks=True,
    lstrip_blocks=True,
    keep_trailing_newline=True,
    autoescape=False,
)
PAGES.filters.update(number=number, listed=listed)
PAGES.globals.update(table=markdown_table)


def rendered(template: str, **values: object) -> str:
    """Write a page from its template and values.

    Raises
    ------
    ValueError
        If a guard does not hold.
    """
    return PAGES.get_template(template).render(values)
