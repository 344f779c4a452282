"""The page of questions beyond the paper, from its template."""

from pathlib import Path

from springblock.analysis.correlation import LAST
from springblock.beyond import friction, lattice, peaks, scatter
from springblock.beyond.question import Ensembles

#: A module per question, in the order of the page's sections.
QUESTIONS = {"lattice": lattice, "peaks": peaks, "friction": friction, "scatter": scatter}
_PAGE = Path(__file__).with_name("page.md")


def page(ensembles: Ensembles) -> str:
    """Write the page: the answers, then the method and the values of each."""
    answers, values = [], {}
    for i, (name, module) in enumerate(QUESTIONS.items(), 1):
        answer, *rest = [*module.answers(ensembles)] or [
            f"**Not answered**: this needs the {module.NEEDS}."
        ]
        answers.append(f"{i}. {answer}")
        values[name] = "\n\n".join(rest)
    text = _PAGE.read_text(encoding="utf-8")
    return text.format(answers="\n".join(answers), last=LAST, **values)
