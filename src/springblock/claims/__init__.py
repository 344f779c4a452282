"""The statements of the paper that the study can test, each with its test.

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525. `statements.md` has the paper's
words, in quotation marks, and the name of the function that tests them. Its docstring is the
criterion: where the paper compares in words ("similar", "uniform", "the same"), it gives a
tolerance.
"""

from pathlib import Path

from springblock.claims import flat, grooves, load_peaks, pillars, sides, stress
from springblock.claims.rule import Claim

_CHAPTERS = stress, flat, pillars, sides, grooves, load_peaks
_TESTS = {name: test for chapter in _CHAPTERS for name, test in vars(chapter).items()}


def table_in(name: str) -> list[list[str]]:
    """Return the rows of a file of this folder that is a table in Markdown."""
    _, _, *lines = Path(__file__).with_name(name).read_text(encoding="utf-8").splitlines()
    return [line.strip("| ").split(" | ") for line in lines]


def _statement(words: str, test: str) -> str:
    return " ".join(f"{words} {_TESTS[test].__doc__ or ''}".split())


#: In the order of the page.
CLAIMS = [
    Claim(name, section, form, _statement(words, test), int(figure), _TESTS[test])
    for test, name, section, figure, form, words in table_in("statements.md")
]
