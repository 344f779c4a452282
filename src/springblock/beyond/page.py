"""The page of what goes beyond the paper, from its template."""

from pathlib import Path

from springblock.analysis.correlation import LAST
from springblock.beyond import clusters, friction, lattice, peaks, scatter, sliding, variance
from springblock.beyond.question import Ensembles

#: A module per question; the page has its answer at the place of the module's name.
QUESTIONS = {
    "lattice": lattice,
    "peaks": peaks,
    "friction": friction,
    "sliding": sliding,
    "clusters": clusters,
    "scatter": scatter,
    "variance": variance,
}
_PAGE = Path(__file__).with_name("page.md")


def page(ensembles: Ensembles) -> str:
    """Write the page: each question, its answer, and the numbers behind it."""
    answers = {}
    for name, module in QUESTIONS.items():
        conclusion, *rest = [*module.answers(ensembles)] or [
            f"**Not answered**: this needs the {module.NEEDS}."
        ]
        answers[name] = conclusion, "\n\n".join(rest)
    text = _PAGE.read_text(encoding="utf-8")
    return text.format(last=LAST, shuffles=clusters.SHUFFLES, far=variance.FAR, **answers)
