"""Means of ensembles with their intervals, over what they vary with."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator
from numpy.typing import ArrayLike

from springblock.analysis.statistics import mean_interval
from springblock.plotting import style
from springblock.plotting.style import GREY, MICRO, Look
from springblock.simulation.run import Array, Run

Samples = dict[Any, Array]  #: a number of each of k realisations, (k,), by ensemble

#: Bars over intervals.
BAR: Look = {"elinewidth": 0.8, "capsize": 1.8, "capthick": 0.8, "linewidth": 0.7}
ZERO: Look = {"color": GREY, "linewidth": 0.5, "zorder": 0}  #: of a line at zero
FRICTION = "static friction"
LAG = r"$t_\mathrm{max} - t_\mathrm{avg}$ (µs)"


def draw_points(ax: Axes, places: ArrayLike, intervals: ArrayLike, color: Any, **look: Any) -> None:
    """Draw values at `places` with bars over their intervals, and a line through them.

    `intervals` are (n, 3): value, lower and upper limit. A value without these has no bar.
    """
    mean, low, high = np.asarray(intervals, dtype=float).T
    bars = np.nan_to_num(np.array([mean - low, high - mean]).clip(0.0))
    ax.errorbar(places, mean, bars, color=color, **(BAR | look))


def draw_means(ax: Axes, samples: Mapping[Any, ArrayLike], color: Any, **look: Any) -> None:
    """Draw the mean of each sample at its place with a bar over its 95 % interval."""
    intervals = [mean_interval(sample) for sample in samples.values()]
    draw_points(ax, list(samples), intervals, color, **look)


def name_places(ax: Axes, places: ArrayLike) -> None:
    """Make a logarithmic horizontal axis with a number at each place."""
    ticks = np.unique(places)
    ax.set_xscale("log")
    ax.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    ax.xaxis.set_minor_locator(NullLocator())
    ax.margins(x=0.1, y=0.1)


def highest_and_lag(ensembles: Mapping[Any, Sequence[Run]]) -> tuple[Samples, Samples]:
    """Return static friction, 1, and t_max - t_avg, µs, of the realisations of each ensemble."""
    highest, lag = {}, {}
    for key, runs in ensembles.items():
        highest[key] = np.array([run.static_friction for run in runs])
        lag[key] = np.array([MICRO * (run.t_max - run.t_avg) for run in runs])
    return highest, lag


def friction_and_lag(xlabel: str, *further: str) -> tuple[Figure, list[Axes]]:
    """Make panels for a) static friction, b) t_max - t_avg and `further` quantities."""
    labels = (FRICTION, LAG, *further)
    letters = ";".join("abcdef"[: len(labels)])
    picture, panels = style.panels(style.COLUMN, 12.0 + 43.0 * len(labels), letters, sharex=True)
    for ax, label in zip(panels, labels, strict=True):
        ax.set_ylabel(label)
    panels[-1].set_xlabel(xlabel)
    panels[1].axhline(0.0, **ZERO)
    return picture, panels


def draw_series(
    panels: Sequence[Axes], ensembles: Mapping[int, Sequence[Run]], color: Any, **look: Any
) -> None:
    """Draw static friction and t_max - t_avg of ensembles over a number that they differ in."""
    for ax, samples in zip(panels, highest_and_lag(dict(sorted(ensembles.items()))), strict=True):
        draw_means(ax, samples, color, **look)
