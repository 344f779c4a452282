"""Force and detachments of several ensembles over time: common to figures 6 and 9."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from springblock.figures.style import MICRO
from springblock.run import Array
from springblock.statistics import Curve, Interval, mean_interval

_BAND = 0.25  #: opacity of the intervals
_BIN = 2e-6  #: s, width of the bins of detachments
#: Bars over intervals.
BAR: dict[str, Any] = {"elinewidth": 0.8, "capsize": 1.8, "capthick": 0.8}
FORCE = r"friction force $F_\mathrm{fr}/F_n$"


def draw_force(ax: Axes, curve: Curve, color: Any, label: str) -> Array:
    """Draw the mean force with its interval; return the mean, (n,)."""
    force = mean_interval(curve.friction)
    ax.plot(MICRO * curve.time, force.mean, color=color, label=label)
    ax.fill_between(
        MICRO * curve.time, force.low, force.high, color=color, alpha=_BAND, linewidth=0.0
    )
    return force.mean


def draw_detachments(ax: Axes, curve: Curve, color: Any) -> None:
    """Draw the mean share of first detachments in each bin with its interval."""
    edges, shares = curve.binned(_BIN)
    share, low, high = mean_interval(shares)
    ax.stairs(share, MICRO * edges, baseline=None, color=color, linewidth=0.8)
    ax.fill_between(
        MICRO * edges,
        np.append(low, low[-1]),
        np.append(high, high[-1]),
        step="post",
        color=color,
        alpha=_BAND,
        linewidth=0.0,
    )
    width = MICRO * (edges[1] - edges[0])
    ax.set_ylabel(f"first detachments\n(% per {width:.3g} µs)")


def draw_point(ax: Axes, x: float, interval: Interval, color: Any, **look: Any) -> None:
    """Draw a mean at `x` with a bar over its interval."""
    mean, low, high = (float(value) for value in interval)
    ax.errorbar(
        [x], [mean], [[mean - low], [high - mean]], color=color, linestyle="none", **BAR, **look
    )
