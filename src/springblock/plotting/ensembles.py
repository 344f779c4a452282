"""Ensembles over time and side by side: common to figures 6 and 9 and to the supplement."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator
from numpy.typing import NDArray

from springblock.analysis.statistics import (
    Curve,
    Interval,
    load_peaks,
    mean_interval,
    mean_of_rest,
    standard_error,
)
from springblock.plotting import style
from springblock.plotting.style import BLACK, BLUE, GREEN, GREY, MICRO, VERMILION
from springblock.simulation.run import Array, Run

_BAND = 0.25  #: opacity of the intervals
SINGLE = 20  #: runs of an ensemble that are shown one by one, at most
_BIN = 2e-6  #: s, width of the bins of detachments
#: Bars over intervals.
BAR: dict[str, Any] = {"elinewidth": 0.8, "capsize": 1.8, "capthick": 0.8}
FORCE = r"friction force $F_\mathrm{fr}/F_n$"
FRICTION = "static friction"
LAG = r"$t_\mathrm{max} - t_\mathrm{avg}$ (µs)"

Runs = Sequence[Run]
Key = tuple[int, int, str]  #: n_p, n_p2 and sliding direction: what tells the main surfaces apart
Look = dict[str, Any]  #: of a line or of markers

#: What captions say of curves that `draw_force` and `draw_detachments` draw.
ENDS = """Runs end after a set time, or after the first minimum behind their force maximum. From
    where the first has ended the force is dotted, the mean over those that go on, and it ends with
    half of them; no block is left to detach for the first time in a run that has ended, so these
    shares are of all runs throughout."""

_DIRECTIONS = {"x": BLUE, "y": VERMILION}
_STRIPS: dict[str, Look] = {
    "x": {"marker": "*", "markersize": 4.5},
    "y": {"marker": "h"},
}
_MARKERS = {2: "v", 3: "<", 4: ">", 5: "p", 6: "^", 10: "s", 20: "D", 30: "P", 60: "X"}  #: by n_p
_LARGEST = 60  #: n_p at the light end of the colours, and two at the dark one
REST: Look = {"linestyle": (0, (1.0, 0.9))}  #: of a mean force where some runs have ended

# Panels above each other in one column, mm.
_LEFT, _WIDTH, _HEIGHT = 16.0, 71.0, 38.0
_BELOW, _BETWEEN, _ABOVE = 11.0, 5.0, 6.0


def draw_force(ax: Axes, curve: Curve, color: Any, label: str, **look: Any) -> Array:
    """Draw the mean force with its interval, dotted where runs are missing; return it, (n,)."""
    force = mean_of_rest(curve.friction)
    time, whole = MICRO * curve.time, _length_of_all(curve)
    ax.plot(time[:whole], force.mean[:whole], color=color, label=label, markevery=[], **look)
    ax.plot(time[whole - 1 :], force.mean[whole - 1 :], color=color, **REST)
    ax.fill_between(time, force.low, force.high, color=color, alpha=_BAND, linewidth=0.0)
    return force.mean


def _length_of_all(curve: Curve) -> int:
    """Number of samples that all runs have."""
    return int(np.isfinite(curve.friction).all(axis=0).sum())


def draw_runs(ax: Axes, curve: Curve, color: Any) -> None:
    """Draw the force of single runs, up to their own end: of the first `SINGLE`, lest they blot."""
    thin: Look = {"linewidth": 0.3, "alpha": 0.4, "zorder": 1.0}
    ax.plot(MICRO * curve.time, curve.friction[:SINGLE].T, color=color, **thin)


def draw_detachments(ax: Axes, curve: Curve, color: Any, marker: str = "") -> None:
    """Draw the mean share of first detachments in each bin with its interval.

    A marker stands on the largest.
    """
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
    width, top = edges[1] - edges[0], int(share.argmax())
    ax.plot(MICRO * (edges[top] + 0.5 * width), share[top], color=color, marker=marker)
    ax.set_ylabel(f"first detachments\n(% per {MICRO * width:.3g} µs)")


def draw_point(ax: Axes, x: float, interval: Interval, color: Any, **look: Any) -> None:
    """Draw a mean at `x` with a bar over its interval."""
    mean, low, high = (float(value) for value in interval)
    ax.errorbar(
        [x], [mean], [[mean - low], [high - mean]], color=color, linestyle="none", **BAR, **look
    )


def name_direction(direction: str) -> str:
    """Name a sliding direction on grooves that run along x."""
    named = {"x": "along grooves", "y": "across grooves"}
    return named.get(direction, f"at {direction}° to grooves")


def direction_color(direction: str) -> str:
    """Colour of what goes along x, along y, or askew."""
    return _DIRECTIONS.get(direction, GREEN)


def mark_load_peaks(ax: Axes, curve: Curve, color: Any) -> None:
    """Draw triangles above the load peaks of the mean force."""
    peaks = mean_load_peaks(curve)
    heights = curve.friction[:, peaks].mean(axis=0)
    triangle: dict[str, Any] = {"textcoords": "offset points", "ha": "center", "va": "bottom"}
    for time, height in zip(MICRO * curve.time[peaks], heights, strict=True):
        ax.annotate("▼", (time, height), (0.0, 2.0), color=color, **triangle)


def mean_load_peaks(curve: Curve) -> NDArray[np.intp]:
    """Find the load peaks of the mean force, as long as all runs go on; their indices."""
    forces = curve.friction[:, : _length_of_all(curve)]
    return load_peaks(forces.mean(axis=0), standard_error(forces))


def peaks_in_words(curve: Curve) -> str:
    """How many load peaks the mean force has."""
    number = len(mean_load_peaks(curve))
    return f"{number} load peak" + ("" if number == 1 else "s")


def enlarged_span(curves: Sequence[Curve], share: float = 0.85) -> tuple[float, float]:
    """Times in µs from which the first mean force is close to its maximum to the last one's end."""
    starts, ends = [], []
    for curve in curves:
        mean = mean_of_rest(curve.friction).mean
        starts.append(curve.time[np.argmax(mean >= share * np.nanmax(mean))])
        ends.append(curve.time[np.isfinite(mean)][-1])
    return MICRO * float(min(starts)), MICRO * float(max(ends))


def fit_forces(ax: Axes, curves: Sequence[Curve], span: tuple[float, float]) -> None:
    """Fit the axis of forces to the means within `span`, with room for triangles."""
    means: list[Array] = []
    for curve in curves:
        time = MICRO * curve.time
        mean = mean_of_rest(curve.friction).mean
        means.append(mean[np.isfinite(mean) & (time >= span[0]) & (time <= span[1])])
    shown = np.concatenate(means)
    room = float(np.ptp(shown))
    ax.set_ylim(float(shown.min()) - 0.1 * room, float(shown.max()) + 0.25 * room)


def highest_and_lag(runs: Runs) -> tuple[Array, Array]:
    """Static friction, 1, and t_max - t_avg, µs, of each of k realisations, (k,)."""
    highest = np.array([run.static_friction for run in runs])
    return highest, np.array([MICRO * (run.t_max - run.t_avg) for run in runs])


def stacked_panels(
    xlabel: str, labels: Sequence[str] = (FRICTION, LAG), above: float = 0.0
) -> tuple[Figure, list[Axes]]:
    """Make a panel for each label above the next one, one column wide.

    By default that is a) for static friction and b) for t_max - t_avg. There are `above` mm of room
    for a legend.
    """
    heights = len(labels) * (_HEIGHT + _BETWEEN) - _BETWEEN
    picture = style.figure(style.COLUMN, _BELOW + heights + _ABOVE + above)
    panels = []
    for i, (label, letter) in enumerate(zip(labels, "abc", strict=False)):
        bottom = _BELOW + (len(labels) - 1 - i) * (_HEIGHT + _BETWEEN)
        ax = style.axes(picture, _LEFT, bottom, _WIDTH, _HEIGHT)
        ax.set_ylabel(label)
        ax.tick_params(labelbottom=False)
        style.panel_letter(ax, letter, left=12.0, above=1.5)
        panels.append(ax)
    panels[-1].tick_params(labelbottom=True)
    panels[-1].set_xlabel(xlabel)
    return picture, panels


def draw_series(
    panels: Sequence[Axes], ensembles: Sequence[tuple[float, Runs]], color: Any, **look: Any
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


def pillar_look(n_p: int) -> Look:
    """Colour and marker of pillars of a size, the same in all figures; 0 is a flat surface."""
    if not n_p:
        return {"color": BLACK, "marker": "o"}
    place = np.log(n_p / 2.0) / np.log(_LARGEST / 2.0)
    return {"color": colormaps["viridis"](0.93 * place), "marker": _MARKERS.get(n_p, "o")}


def pillar_name(n_p: int) -> str:
    """Name of pillars of a size."""
    return f"$n_p$ = {n_p}" if n_p else "flat"


def in_order(keys: Iterable[Key]) -> list[Key]:
    """The flat surface, pillars by their size, grooved ones."""
    return sorted(keys, key=lambda key: (key[1] > 0, key))


def surface_look(key: Key) -> tuple[str, Look]:
    """Name, colour and marker of a surface."""
    n_p, n_p2, direction = key
    if n_p2:
        look = {"color": direction_color(direction), **_STRIPS.get(direction, {"marker": "d"})}
        return name_direction(direction), look
    return pillar_name(n_p), pillar_look(n_p)


def logarithmic(panels: Sequence[Axes], places: Sequence[int]) -> None:
    """A logarithmic axis with a number at each place."""
    for ax in panels:
        ax.set_xscale("log")
        ax.set_xticks(sorted(set(places)), [str(place) for place in sorted(set(places))])
        ax.xaxis.set_minor_locator(NullLocator())
        ax.margins(x=0.12, y=0.14)
