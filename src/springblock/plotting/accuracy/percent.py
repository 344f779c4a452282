"""Axes for biases in percent, of either sign and of many sizes."""

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.ticker import FixedLocator, SymmetricalLogLocator


def fit_percent(panels: Sequence[Axes], linear: float, ticks: Sequence[float]) -> None:
    """Make the axis that panels share linear up to ± `linear`, % and logarithmic beyond.

    Neither the intervals of fine steps nor the biases of the coarsest get lost on it.
    """
    low = min(-linear, *(ax.dataLim.y0 for ax in panels))
    high = max(linear, *(ax.dataLim.y1 for ax in panels))
    axis = panels[0].yaxis
    panels[0].set_yscale("symlog", linthresh=linear, linscale=1.0)
    axis.set_major_locator(FixedLocator(ticks))
    axis.set_minor_locator(SymmetricalLogLocator(base=10, linthresh=linear, subs=range(2, 10)))
    axis.set_major_formatter("{x:g}")
    panels[0].set_ylim(1.5 * low, 1.5 * high)
