"""Load peaks of a force curve: how deep it falls between them, and how far apart the main ones are.

Peaks of at least 0.9 of the largest force count. Their prominences are those of
`scipy.signal.peak_prominences`, but for the highest one, which is the most prominent wherever the
curve ends; every job would take a second to import it.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

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
    peak. `rank` selects another peak, in descending order of prominence.
    """
    found = np.sort(_peaks(curve)[1])
    return float(found[-rank]) / float(curve.max()) if len(found) >= rank else 0.0


def both_peaks(curve: Array) -> Peaks | None:
    """Find the two most prominent load peaks of a force curve, (n,).

    None unless the prominence of the second is `PROMINENT` or more.
    """
    peaks, prominences = _peaks(curve)
    order = np.argsort(prominences)[-2:]
    if len(order) < 2 or prominences[order[0]] < PROMINENT * curve.max():
        return None
    first, second = sorted(map(int, peaks[order]))
    return Peaks(first, first + int(np.argmin(curve[first:second])), second)


def width(curve: Array) -> int:
    """Return the intervals between the first and last force of `LOAD_PEAK` of the largest, (n,)."""
    under_load = np.flatnonzero(curve >= LOAD_PEAK * curve.max())
    return int(under_load[-1] - under_load[0])


def _peaks(curve: Array) -> tuple[NDArray[np.intp], Array]:
    """Return the indices of all load peaks and their prominences.

    A prominence is the height above the lowest force on the way to a higher one, or to an end, on
    the side where this is less. Of equal forces the first counts as higher.
    """
    levels = np.flatnonzero(np.diff(curve, prepend=np.nan))  # the first sample of each
    turns = np.flatnonzero(np.diff(np.sign(np.diff(curve[levels])), prepend=0.0, append=0.0))
    corners = levels[turns]  # and both ends
    heights = curve[corners]
    is_peak = np.diff(heights, prepend=np.inf) > 0.0
    is_peak[-1:] = False
    found = np.flatnonzero(is_peak & (heights >= LOAD_PEAK * curve.max()))
    ranked = [*zip(heights.tolist(), range(0, -len(heights), -1), strict=True)]
    before, after = _lowest(ranked), _lowest(ranked[::-1])[::-1]
    prominences = (heights - np.maximum(before, after))[found]
    prominences[np.flatnonzero(heights[found] == curve.max())[:1]] = curve.max()
    return corners[found], prominences


def _lowest(ranked: list[tuple[float, int]]) -> list[float]:
    """Return for each height the lowest one since the last that ranks higher, or the start."""
    lowest: list[float] = []
    higher: list[tuple[tuple[float, int], float]] = []
    for each in ranked:
        low = each[0]
        while higher and higher[-1][0] < each:
            low = min(low, higher.pop()[1])
        higher.append((each, low))
        lowest.append(low)
    return lowest
