"""What a question is, and how its numbers are written."""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from springblock.analysis.statistics import Interval
from springblock.io.records import Record
from springblock.model.scene import Scene

_DIGITS = 5  #: after the point, at most

Ensembles = Mapping[Scene, Sequence[Record]]  #: realisations by scene


@dataclass(frozen=True)
class Question:
    """What is asked, how it is measured, and what answers it."""

    title: str
    method: str  #: in Markdown
    needs: str  #: what must have been simulated
    answers: Callable[[Ensembles], Iterator[str]]  #: sentences and tables, in Markdown


def by_scene(records: Sequence[Record]) -> dict[Scene, list[Record]]:
    """Realisations of each scene, in the order in which the scenes come.

    Those on surfaces that the paper could not have are left out.
    """
    found: dict[Scene, list[Record]] = {}
    for record in records:
        if record.scene.is_papers:
            found.setdefault(record.scene, []).append(record)
    return found


def has_pillars_alone(scene: Scene) -> bool:
    """Whether it has pillars without grooves, and slides along x."""
    return scene.lengths.keys() == {"n_p", "n_s"} and scene.direction == "x"


def is_even(scene: Scene, varied: Collection[str] = ()) -> bool:
    """Whether it has pillars alone, as far apart as wide, and no other constants of its own."""
    own = {name for name, _ in scene.varied}
    return has_pillars_alone(scene) and scene.n_p == scene.n_s and own <= {*varied}


def number(interval: Interval, unit: str = "", factor: float = 1.0) -> str:
    """Write a value with its 95 % interval, to the digits that the interval leaves."""
    value, low, high = (factor * float(each) for each in interval)
    if not np.isfinite([low, high]).all() or high == low:
        return f"{value:.3g} [no interval]{unit}"
    digits = min(max(0, 1 - int(np.floor(np.log10(high - low)))), _DIGITS)
    return f"{value:z.{digits}f} [{low:z.{digits}f}, {high:z.{digits}f}]{unit}"


def power(exponent: Interval) -> str:
    """Say what the exponent of a length means, by whether its interval holds 0, and holds 1."""
    none, whole = (exponent.low <= value <= exponent.high for value in (0.0, 1.0))
    if none and whole:
        return "unchanged or proportional, which is not settled"
    if none or whole:
        return "unchanged" if none else "proportional"
    if exponent.high < 0.0:
        return "the other way"
    return "in part" if exponent.low > 0.0 and exponent.high < 1.0 else "by another power"
