"""The page of what goes beyond the paper."""

from collections.abc import Iterable

from springblock.beyond.question import Ensembles, Question

_PAGE = """# What goes beyond the paper

Written from all realisations of a study with the groups of `config/full.yaml`.
Lengths count blocks unless they have a unit; l is
the spacing of the lattice, l_z the thickness of the layer, 10 µm each in the paper. Numbers stand
with their 95 % intervals over realisations. Exponents, correlation lengths, minima, variances,
differences and shares of variance have bias-corrected and accelerated bootstrap intervals (BCa),
with 1000 resamples of every ensemble by itself; those of means and of c(r) are what
`docs/claims.md` says of means and of c(r). What begins in bold follows from the intervals beside
it, read one by one. Questions and methods took shape while results came in: these are findings for
others to test, not verdicts. Fewer than three realisations have no interval, fewer than ten no
correlation.

{sections}
"""


def page(questions: Iterable[Question], ensembles: Ensembles) -> str:
    """Write the page: each question, its answer, and the numbers behind it."""
    sections = [_section(i, each, ensembles) for i, each in enumerate(questions, 1)]
    return _PAGE.format(sections="\n\n".join(sections))


def _section(number: int, question: Question, ensembles: Ensembles) -> str:
    answers = list(question.answers(ensembles)) or [
        f"**Not answered**: this needs the {question.needs}."
    ]
    return "\n\n".join([f"## {number}. {question.title}", question.method, *answers])
