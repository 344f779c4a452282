"""Load peaks of a force curve: how far apart the two main ones are, and how deep between them.

Peaks of at least 0.9 of the largest force count. The prominence of a peak is that of
`scipy.signal.peak_prominences`, for a curve that starts and ends below its peaks.
"""

from typing import NamedTuple

import numpy as np

from springblock.model.numbers import Array

LOAD_PEAK = 0.9  #: least force of a load peak, over the largest force
PROMINENT = 0.01  #: least prominence of a load peak over the largest force


class Peaks(NamedTuple):
    """Indices of the two most prominent load peaks of a force curve, and of the lowest between."""

    first: int
    valley: int
    second: int


def prominence(curve: Array, rank: int = 2) -> float:
    """Prominence of the second most prominent load peak of a curve, (n,), over the largest force.

    This is the drop of the force between two load peaks, from the lower of them; 0 for a single
    peak. `rank` selects another peak, in descending order of prominence: those of the third are
    the peaks on either side of the deepest valley.
    """
    highest = float(curve.max())
    parts, drop = [curve], 0.0
    for _ in range(rank - 1):
        drop, valley, part = max((*_deepest(part, highest), i) for i, part in enumerate(parts))
        here = parts.pop(part)
        parts += [here[: valley + 1], here[valley:]]
    return drop / highest


def both_peaks(curve: Array) -> Peaks | None:
    """Find the two most prominent load peaks of a force curve, (n,); None with fewer than two."""
    highest = float(curve.max())
    drop, valley = _deepest(curve, highest)
    if drop < PROMINENT * highest:
        return None
    first, second = int(np.argmax(curve[:valley])), valley + int(np.argmax(curve[valley:]))
    return Peaks(first, valley, second)


def width(curve: Array) -> int:
    """Return the samples from the first to the last force of a load peak, of a curve (n,)."""
    under_load = np.flatnonzero(curve >= LOAD_PEAK * curve.max())
    return int(under_load[-1] - under_load[0])


def _deepest(curve: Array, highest: float) -> tuple[float, int]:
    """Return depth and index of the deepest valley between two load peaks; zeros without one."""
    before, after = np.maximum.accumulate(curve), np.maximum.accumulate(curve[::-1])[::-1]
    banks = np.minimum(before, after)
    depths = np.where(banks >= LOAD_PEAK * highest, banks - curve, 0.0)
    valley = int(np.argmax(depths))
    return float(depths[valley]), valley
