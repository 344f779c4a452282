"""Selection and comparison of ensembles for questions beyond the paper."""

from collections.abc import Collection, Iterable, Mapping, Sequence
from operator import itemgetter
from typing import Any, TypeVar

from springblock.analysis.correlation import Correlation, side_times
from springblock.analysis.statistics import Interval, independent_difference
from springblock.io.records import Record
from springblock.model.scene import Scene

#: Least number of realisations for a correlation: no resample consists of a single one.
FEWEST = 10
_DISTANCES = 3  #: least number for a fit of two unknowns
UNCHANGED = "does not change significantly"

T = TypeVar("T")
Ensembles = Mapping[Scene, Sequence[Record]]  #: realisations by scene


def grouped(items: Iterable[tuple[Any, Any, T]]) -> dict[Any, dict[Any, T]]:
    """Values by a first key, in order of appearance, and by a second key, in ascending order."""
    found: dict[Any, dict[Any, T]] = {}
    for first, second, value in items:
        found.setdefault(first, {})[second] = value
    return {first: dict(sorted(found[first].items(), key=itemgetter(0))) for first in found}


def on_one_side(items: Iterable[tuple[Any, Any, Any, T]]) -> dict[Any, dict[Any, T]]:
    """Values by kind and size, of items (side, kind, size, value), on the side with most kinds."""
    found = grouped(((side, kind), size, value) for side, kind, size, value in items)
    sides = grouped((side, kind, sizes) for (side, kind), sizes in found.items())
    return max(sides.values(), key=len, default={})


def has_pillars_alone(scene: Scene) -> bool:
    """Whether a scene has pillars without grooves, and slides along x."""
    return scene.lengths.keys() == {"n_p", "n_s"} and scene.direction == "x"


def is_even(scene: Scene, varied: Collection[str] = ()) -> bool:
    """Whether a scene has only pillars with n_s = n_p, and no constants but `varied`."""
    own = {name for name, _ in scene.varied}
    return has_pillars_alone(scene) and scene.n_p == scene.n_s and own <= {*varied}


def side_length(runs: Sequence[Record], most: int | None = None) -> Interval | None:
    """Decay length along the sides of pillars, blocks: of A exp(-r/l) from r = 1 to n_p/3.

    On larger pillars up to `most` blocks; None with too few realisations or on too short sides.
    """
    scene = runs[0].scene
    last = min(scene.n_p // 3, most or scene.n_p)
    if len(runs) < FEWEST or last < _DISTANCES:
        return None
    return Correlation(side_times(runs, scene.pattern, "x")).length(last).tail


def direction(first: Interval, last: Interval) -> str:
    """Write whether a value changes: the 95 % interval of the difference excludes zero."""
    apart = independent_difference(last, first)
    if apart.high < 0.0:
        return "decreases"
    return "increases" if apart.low > 0.0 else UNCHANGED
