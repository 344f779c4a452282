"""Means of ensembles with their intervals, over what they vary with."""

from collections.abc import Iterable, Mapping, Sequence
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
#: A realisation, and the median of an ensemble.
DOT: Look = {"linestyle": "none", "marker": ".", "markersize": 2.8, "markeredgewidth": 0.0}
DOT |= {"alpha": 0.6}
MEDIAN: Look = {"linestyle": "none", "marker": "_", "markersize": 6.0, "markeredgewidth": 1.4}
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


def draw_realisations(ax: Axes, samples: Samples, color: Any, **look: Any) -> None:
    """Draw each realisation as a dot, and the median of each sample as a dash.

    A sample may lie in two clusters, where no realisation has the mean. The median of an even
    number is the lower one of those in the middle: one of the realisations.
    """
    for place, sample in samples.items():
        ax.plot(np.full(len(sample), place), sample, color=color, **DOT)
    medians = [np.quantile(sample, 0.5, method="inverted_cdf") for sample in samples.values()]
    ax.plot(list(samples), medians, color=color, **(MEDIAN | look))


def name_places(ax: Axes, places: ArrayLike) -> None:
    """Make a logarithmic horizontal axis with a tick at each place, and numbers that have room."""
    ticks = np.unique(places)
    ax.set_xscale("log")
    along = np.log(ticks / ticks[0]) / max(1e-9, np.log(ticks[-1] / ticks[0]))
    at = 0.8 * along * ax.bbox.width * 72.0 / ax.figure.dpi  # pt; margins take the rest
    names, end = [], -np.inf
    for place, tick in zip(at, ticks, strict=True):
        half = 0.32 * style.SMALL * len(f"{tick:g}")
        names.append(f"{tick:g}" if place - half > end else "")
        end = place + half + 1.0 if names[-1] else end
    ax.set_xticks(ticks, names)
    ax.xaxis.set_minor_locator(NullLocator())
    ax.margins(x=0.1, y=0.1)


def highest_and_lag(ensembles: Mapping[Any, Sequence[Run]]) -> tuple[Samples, Samples]:
    """Return static friction, 1, and t_max - t_avg, µs, of the realisations of each ensemble."""
    highest = {k: np.array([r.static_friction for r in runs]) for k, runs in ensembles.items()}
    lag = {k: MICRO * np.array([r.t_max - r.t_avg for r in runs]) for k, runs in ensembles.items()}
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


def aside(
    places: Iterable[float], every: Sequence[float], line: int, lines: int, log: bool
) -> list[float]:
    """Move places of one of several lines a little, so that their bars do not cover each other.

    By a share of an axis, logarithmic or not, that shows `every` place.
    """
    share, low, high = 0.03 * (line - 0.5 * (lines - 1)), min(every), max(every)
    return [x * (high / low) ** share if log else x + share * (high - low) for x in places]
