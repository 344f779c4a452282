"""The page of questions beyond the paper, from its template."""

from pathlib import Path
from textwrap import fill

from springblock.analysis.correlation import LAST
from springblock.beyond import friction, lattice, peaks, scatter
from springblock.beyond.question import Ensembles

#: A module per question, in the order of the page's sections.
QUESTIONS = {"lattice": lattice, "peaks": peaks, "friction": friction, "scatter": scatter}
_PAGE = Path(__file__).with_name("page.md")
_WIDTH = 120  #: characters of a line


def page(ensembles: Ensembles) -> str:
    """Write the page: the answers, then the method and the values of each."""
    answers, values = [], {}
    for i, (name, module) in enumerate(QUESTIONS.items(), 1):
        answer, *rest = [*module.answers(ensembles)] or [
            f"**Not answered**: this needs the {module.NEEDS}."
        ]
        answers.append(_wrapped(f"{i}. {answer}", indent="   "))
        values[name] = "\n\n".join("\n".join(map(_wrapped, part.splitlines())) for part in rest)
    text = _PAGE.read_text(encoding="utf-8")
    return text.format(answers="\n".join(answers), last=LAST, **values)


def _wrapped(line: str, indent: str = "") -> str:
    """Break a line of Markdown, unless it is of a table; all but the first part are indented."""
    if line.startswith("|"):
        return line
    indent = indent or "  " * line.startswith("- ")
    return fill(line, _WIDTH, subsequent_indent=indent, break_on_hyphens=False)
