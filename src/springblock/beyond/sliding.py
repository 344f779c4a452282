"""How far detachments are correlated along grooves, by the direction of sliding."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from springblock.analysis.correlation import LAST, Correlation, groove_times, side_times
from springblock.analysis.statistics import Interval
from springblock.beyond.question import Ensembles, change, grouped, number
from springblock.beyond.resampling import FEWEST, decay_length
from springblock.io.records import Record
from springblock.io.rows import listed, markdown_table
from springblock.model.direction import degrees
from springblock.simulation.run import Array

NEEDS = "groups grooves and angles"
_FAR = 3  #: blocks, the paper's lower bound of l_c
_EDGES = {"sides": "sides of pillars", "grooves": "edges of grooves"}


def by_angle(ensembles: Ensembles) -> dict[float, Sequence[Record]]:
    """Realisations by angle between sliding and grooves, of the pattern with most angles."""
    found = grouped(
        (replace(scene, direction="x"), degrees(scene.direction), runs)
        for scene, runs in ensembles.items()
        if scene.n_p and scene.n_p2 and not scene.n_p3 and not scene.varied
    )
    return max(found.values(), key=len, default={})


def edges(runs: Sequence[Record]) -> dict[str, Array]:
    """Detachment times along the "sides" of pillars and along the edges of their "grooves"."""
    pattern = runs[0].scene.pattern
    return {"sides": side_times(runs, pattern, "x"), "grooves": groove_times(runs, pattern)}


def at(times: Array, r: int) -> Interval:
    """c(r) at one distance with its 95 % interval."""
    return Interval(*(limit[r] for limit in Correlation(times).interval))


def answers(ensembles: Ensembles) -> Iterator[str]:
    """Sentences and a table in Markdown; none without what `NEEDS` names."""
    found = {at: runs for at, runs in by_angle(ensembles).items() if len(runs) >= FEWEST}
    if len(found) < 3:
        return
    header = ["edge", "angle", "c(1)", f"c({_FAR})", "decay length (blocks)", "realisations"]
    places = {angle: edges(runs) for angle, runs in found.items()}
    said, lines = [], []
    for edge in _EDGES:
        for angle, times in places.items():
            close, far = (number(at(times[edge], r)) for r in (1, _FAR))
            length = number(decay_length(times[edge], LAST))
            lines.append([_EDGES[edge], f"{angle:g}°", close, far, length, str(len(found[angle]))])
        first, last = (at(places[angle][edge], _FAR) for angle in (min(places), max(places)))
        said.append(f"{change(first, last)} along {_EDGES[edge]}")
    yield (
        "**When the sliding direction turns from along an edge to across it**, the correlation of "
        f"detachments {_FAR} blocks apart along the edge {listed(said)}."
    )
    yield markdown_table(header, lines)
