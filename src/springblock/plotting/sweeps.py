"""Numbers with their intervals over what they vary with: beyond the paper and in any sweep."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import NullLocator

from springblock.analysis.statistics import Interval
from springblock.plotting.ensembles import BAR


def shades(values: Iterable[float]) -> dict[float, Any]:
    """A colour for each value, from dark for the smallest to light."""
    from seaborn import color_palette  # slow to load: it brings pandas and scipy

    ordered = sorted(set(values))
    return dict(zip(ordered, color_palette("viridis", len(ordered)), strict=True))


def draw_sweep(
    ax: Axes, places: Sequence[float], intervals: Sequence[Interval], color: Any, **look: Any
) -> None:
    """Draw values at `places` with bars over their intervals, and a line through them.

    A value without an interval has no bar.
    """
    mean, low, high = (np.array(part, dtype=float) for part in zip(*intervals, strict=True))
    bars = np.nan_to_num(np.array([mean - low, high - mean]).clip(0.0))
    ax.errorbar(places, mean, bars, color=color, **(BAR | {"linewidth": 0.8} | look))


def powers(ax: Axes, places: Sequence[float], label: str) -> None:
    """A logarithmic horizontal axis with a number at each place."""
    ax.set_xscale("log")
    ticks = sorted(set(places))
    ax.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    ax.xaxis.set_minor_locator(NullLocator())
    ax.margins(x=0.08)
    ax.set_xlabel(label)
