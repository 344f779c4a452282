"""Ensembles over time and side by side: common to figures 6 and 9 and to the supplement."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator
from numpy.typing import NDArray

from springblock.figures import style
from springblock.figures.style import BLACK, GREY, MICRO, PURPLE, VERMILION
from springblock.run import Array, Run
from springblock.statistics import Curve, Interval, load_peaks, mean_interval, standard_error

_BAND = 0.25  #: opacity of the intervals
_BIN = 2e-6  #: s, width of the bins of detachments
#: Bars over intervals.
BAR: dict[str, Any] = {"elinewidth": 0.8, "capsize": 1.8, "capthick": 0.8}
FORCE = r"friction force $F_\mathrm{fr}/F_n$"
FRICTION = "static friction coefficient"
LAG = r"$t_\mathrm{max} - t_\mathrm{avg}$ (µs)"

Runs = Sequence[Run]
Key = tuple[int, int, str]  #: n_p, n_p2 and sliding direction: what tells the main surfaces apart

_GROOVED = {"x": ("along grooves", VERMILION), "y": ("across grooves", PURPLE)}

# Two panels above each other in one column, mm.
_PANELS = {"left": 16.0, "width": 71.0, "height": 38.0}
_BOTTOMS = (53.0, 11.0)


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


def sliding(direction: str) -> str:
    """Name a sliding direction on grooves that run along x."""
    named = {"x": "sliding along grooves", "y": "sliding across grooves"}
    return named.get(direction, f"sliding at {direction}° to grooves")


def mark_load_peaks(ax: Axes, curve: Curve, color: Any) -> None:
    """Draw triangles above the load peaks of the mean force."""
    mean, peaks = curve.friction.mean(axis=0), mean_load_peaks(curve)
    triangle: dict[str, Any] = {"textcoords": "offset points", "ha": "center", "va": "bottom"}
    for time, height in zip(MICRO * curve.time[peaks], mean[peaks], strict=True):
        ax.annotate("▼", (time, height), (0.0, 2.0), color=color, **triangle)


def mean_load_peaks(curve: Curve) -> NDArray[np.intp]:
    """Find the load peaks of the mean force; their indices."""
    return load_peaks(curve.friction.mean(axis=0), standard_error(curve.friction))


def peaks_in_words(curve: Curve) -> str:
    """How many load peaks the mean force has."""
    number = len(mean_load_peaks(curve))
    return f"{number} load peak" + ("" if number == 1 else "s")


def enlarged_span(curves: Sequence[Curve], share: float = 0.85) -> tuple[float, float]:
    """Times in µs from which the first mean force is close to its maximum to the last end."""
    starts = []
    for curve in curves:
        mean = curve.friction.mean(axis=0)
        starts.append(curve.time[np.argmax(mean >= share * mean.max())])
    return MICRO * float(min(starts)), MICRO * float(max(curve.time[-1] for curve in curves))


def fit_forces(ax: Axes, curves: Sequence[Curve], span: tuple[float, float]) -> None:
    """Fit the axis of forces to the means within `span`, with room for triangles."""
    means: list[Array] = []
    for curve in curves:
        time = MICRO * curve.time
        means.append(curve.friction.mean(axis=0)[(time >= span[0]) & (time <= span[1])])
    shown = np.concatenate(means)
    room = float(np.ptp(shown))
    ax.set_ylim(float(shown.min()) - 0.1 * room, float(shown.max()) + 0.25 * room)


def highest_and_lag(runs: Runs) -> tuple[Array, Array]:
    """Static friction, 1, and t_max - t_avg, µs, of each of k realisations, (k,)."""
    highest = np.array([run.static_friction for run in runs])
    return highest, np.array([MICRO * (run.t_max - run.t_avg) for run in runs])


def two_panels(xlabel: str, above: float = 0.0) -> tuple[Figure, tuple[Axes, Axes]]:
    """Make a) a panel for static friction over b) one for t_max - t_avg, one column wide.

    There are `above` mm of room for a legend.
    """
    picture = style.figure(style.COLUMN, 97.0 + above)
    upper, lower = (style.axes(picture, bottom=bottom, **_PANELS) for bottom in _BOTTOMS)
    upper.set_ylabel(FRICTION)
    upper.tick_params(labelbottom=False)
    lower.set(xlabel=xlabel, ylabel=LAG)
    for ax, letter in ((upper, "a"), (lower, "b")):
        style.panel_letter(ax, letter, left=12.0, above=1.5)
    return picture, (upper, lower)


def draw_series(
    panels: tuple[Axes, Axes], ensembles: Sequence[tuple[float, Runs]], color: Any, **look: Any
) -> None:
    """Draw static friction and t_max - t_avg of ensembles over a number that they differ in."""
    ordered = sorted(ensembles, key=lambda ensemble: ensemble[0])
    places = [place for place, _ in ordered]
    samples = zip(*(highest_and_lag(runs) for _, runs in ordered), strict=True)
    for ax, values in zip(panels, samples, strict=True):
        intervals = [mean_interval(sample) for sample in values]
        means = [float(interval.mean) for interval in intervals]
        ax.plot(places, means, color=color, linewidth=0.6, **look)
        for place, interval in zip(places, intervals, strict=True):
            draw_point(ax, place, interval, color, marker=look.get("marker", "o"))


def draw_no_lag(ax: Axes) -> None:
    """A line where t_max = t_avg."""
    ax.axhline(0.0, color=GREY, linewidth=0.5, zorder=0)


def size_colors(sizes: Iterable[int]) -> dict[int, Any]:
    """Black for the flat surface, n_p = 0, and a palette in order of n_p for pillars."""
    from seaborn import color_palette  # slow to load: it brings pandas and scipy

    pillars = sorted({size for size in sizes if size})
    return {0: BLACK} | dict(zip(pillars, color_palette("viridis", len(pillars)), strict=True))


def in_order(keys: Iterable[Key]) -> list[Key]:
    """The flat surface, pillars by their size, grooved ones."""
    return sorted(keys, key=lambda key: (key[1] > 0, key))


def name_surface(key: Key, colors: dict[int, Any]) -> tuple[str, Any]:
    """Name and color of a surface."""
    n_p, n_p2, direction = key
    if n_p2:
        return _GROOVED.get(direction, (f"{direction}° to grooves", GREY))
    return (f"$n_p$ = {n_p}" if n_p else "flat"), colors[n_p]


def logarithmic(panels: Sequence[Axes], places: Sequence[int]) -> None:
    """A logarithmic axis with a number at each place."""
    for ax in panels:
        ax.set_xscale("log")
        ax.set_xticks(sorted(set(places)), [str(place) for place in sorted(set(places))])
        ax.xaxis.set_minor_locator(NullLocator())
        ax.margins(x=0.12, y=0.14)
