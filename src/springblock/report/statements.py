"""Which of the paper's statements belong to which of its figures, and what became of them."""

from collections import Counter
from collections.abc import Sequence
from itertools import groupby
from typing import NamedTuple

from springblock.claims.page import anchor, decided
from springblock.io.rows import Row

#: Verdicts in the order in which they are listed.
VERDICTS = ("reproduced", "depends on", "not reproduced", "not settled", "not tested")

#: Statements by the figure that shows what they speak of.
OF_FIGURES = {
    "figure_1": (
        "A step of 1e-8 s suffices",
        "Damping removes oscillations",
        "Only the ratio of modulus and pressure matters",
    ),
    "figure_2": (
        "Velocity, pressure and scatter affect the number of fronts",
        "Fronts begin at t_max whatever the loading",
        "t_max is the onset of propagation on flat surfaces",
        "The main avalanche follows t_max on flat surfaces",
        "Force and detachments peak apart on flat surfaces",
        "t_max < t_avg on flat surfaces",
    ),
    "figure_3": (
        "Isolated precursors on flat surfaces",
        "Precursors are the weakest blocks",
        "Not every precursor starts a front",
        "Detachment times are uniform on flat surfaces",
        "Nucleation anywhere on flat surfaces",
    ),
    "figure_4": (
        "All pillars bear the same stress",
        "Edges across the sliding direction bear more",
        "All pillars are alike",
    ),
    "figure_5": (
        "Order of detachment on a pillar",
        "The order of detachment never changes",
        "Edges detach before the force maximum",
        "Precursors are a region around the edge of pillars",
        "Detachment waves start near the edge of pillars",
        "The centre of pillars detaches last",
    ),
    "figure_6": (
        "t_max > t_avg on pillars",
        "Pillars with n_p <= 3 behave like a flat surface",
        "More and earlier precursors on pillars",
        "Rounded force peak on pillars",
        "Lowest static friction at an intermediate n_p",
        "Sharper transition of very large pillars",
        "Precursors are negligible on very large pillars",
        "The most precursors where static friction is lowest",
        "The roundest force peak where static friction is lowest",
        "The longest transition where static friction is lowest",
    ),
    "figure_7": (
        "Static friction is lowest where n_p is about l_c",
        "c_x has a long range, c_y a short one",
        "Sides along the sliding direction detach in larger events",
        "Exponential decay of c_x",
        "Correlation length of about three blocks or more",
        "Correlation length grows with n_p",
        "One event can detach a whole side",
        "Correlations keep their shape on grooved pillars",
        "Grooves leave the correlation length unchanged",
        "Precursors are uncorrelated when sliding across grooves",
    ),
    "figure_8": (
        "Edges bear more before sliding across grooves",
        "Grooves make stress more uniform",
        "External edges bear more than those along grooves",
        "Order of detachment on a grooved pillar",
    ),
    "figure_9": (
        "Static friction is greater across grooves than along",
        "Two load peaks only along grooves",
        "The second load peak sets static friction",
        "A quiet phase between the load peaks",
        "The edges make the first load peak",
        "Edges and core are of equal size",
        "Without hierarchy one load peak",
        "Edges detach before the core of grooved pillars",
        "The effects remain with a further level",
        "The lengths control the interval between the load peaks",
        "The length of pillars changes static friction",
        "The core rests between the load peaks",
        "What has detached slips again between the load peaks",
    ),
}


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
    return [statement for statement in made if statement.name in OF_FIGURES.get(name, ())]


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
