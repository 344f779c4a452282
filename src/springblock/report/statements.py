"""Which of the paper's statements belong to which of its figures, and what became of them."""

from collections import Counter
from collections.abc import Sequence
from itertools import groupby
from typing import NamedTuple

from springblock.claims import CLAIMS
from springblock.claims.page import anchor, decided
from springblock.io.rows import Row

#: Verdicts in the order in which they are listed.
VERDICTS = ("reproduced", "depends on", "not reproduced", "not settled", "not tested")

_FIGURES = {claim.name: f"figure_{claim.figure}" for claim in CLAIMS}


class Statement(NamedTuple):
    """A statement of the paper, its verdict, and where the page of statements says more."""

    name: str
    section: str
    said: str
    verdict: str
    depends_on: str
    decided: str
    anchor: str


def statements(table: Sequence[Row]) -> list[Statement]:
    """Return the statements of the table `claims`, in its order."""
    parts = [list(group) for _, group in groupby(table, key=lambda row: row["claim"])]
    return [_statement(number, part) for number, part in enumerate(parts, 1)]


def of_figure(name: str, made: Sequence[Statement]) -> list[Statement]:
    """Return the statements that belong to a figure."""
    return [statement for statement in made if _FIGURES.get(statement.name) == name]


def counted(made: Sequence[Statement]) -> dict[str, int]:
    """Count verdicts, those that occur, in their order."""
    found = Counter(statement.verdict for statement in made)
    return {verdict: found[verdict] for verdict in VERDICTS if found[verdict]}


def _statement(number: int, part: Sequence[Row]) -> Statement:
    first = part[0]
    return Statement(
        name=first["claim"],
        section=first["section"],
        said=first["statement"],
        verdict=first["verdict"],
        depends_on=first["depends_on"].split(":")[0],
        decided=decided(part),
        anchor="claims-" + anchor(f"{number}. {first['claim']}"),
    )
