"""Curves over time, and means of ensembles with intervals over a varied parameter."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patheffects import withStroke
from numpy.typing import ArrayLike

from springblock.analysis import statistics
from springblock.analysis.statistics import Interval, LoadCurves
from springblock.model.numbers import Array
from springblock.plotting import style
from springblock.plotting.style import BLACK, FORCE, GREY, MICRO, Look
from springblock.simulation.peaks import both_peaks
from springblock.simulation.run import Run, friction, percent

Span = tuple[float, float]  #: of times in µs

BAND = 0.25  #: opacity of the intervals
SINGLE = 20  #: largest number of runs of an ensemble that are drawn one by one
REST: Look = {"linestyle": (0, (1.0, 0.9))}  #: of a mean force once some runs have ended
_BIN = 2e-6  #: s, width of the bins of detachments
_PERCENTILES = (5.0, 95.0)  #: of an ensemble
_MEAN: Look = {"color": GREY, "linewidth": 0.8, "linestyle": (0, (4, 2))}  #: of that ensemble

#: Bars over intervals.
BAR: Look = {"elinewidth": 0.8, "capsize": 1.8, "capthick": 0.8, "linewidth": 0.7}
#: A realisation.
DOT: Look = {"linestyle": "none", "marker": ".", "markersize": 2.8, "markeredgewidth": 0.0}
DOT |= {"alpha": 0.4}
ZERO: Look = {"color": GREY, "linewidth": 0.5, "zorder": 0}  #: of a line at zero
FRICTION = "static friction"
LAG = r"$t_\mathrm{max} - t_\mathrm{avg}$ (µs)"


def draw_band(ax: Axes, places: ArrayLike, values: Interval, color: Any, **look: Any) -> None:
    """Draw a line of values, (n,), over `places`, and a band over their intervals."""
    ax.fill_between(places, values.low, values.high, color=color, alpha=BAND, linewidth=0.0)
    ax.plot(places, values.mean, color=color, **look)


def draw_mean_force(
    ax: Axes, curve: LoadCurves, color: Any, label: str, spread: bool = False, **look: Any
) -> Array:
    """Draw the mean force, dotted where runs have ended, and return it, (n,).

    The band is its interval or, with `spread`, the percentiles of the runs until the first ends.
    """
    force = statistics.mean_of_rest(curve.friction)
    time = MICRO * curve.time
    whole = int(np.isfinite(curve.friction).all(axis=0).sum())  # samples that all runs have
    ax.plot(time[:whole], force.mean[:whole], color=color, label=label, markevery=[], **look)
    ax.plot(time[whole - 1 :], force.mean[whole - 1 :], color=color, **REST)
    band = np.percentile(curve.friction, _PERCENTILES, axis=0) if spread else force[1:]
    ax.fill_between(time, *band, color=color, alpha=BAND, linewidth=0.0)
    return force.mean


def draw_single_forces(ax: Axes, curve: LoadCurves, color: Any) -> None:
    """Draw the force of the first `SINGLE` runs, each up to its own end."""
    forces = curve.friction[:SINGLE].T
    ax.plot(MICRO * curve.time, forces, color=color, linewidth=0.3, alpha=0.4, zorder=1.0)


def draw_detachments(ax: Axes, curve: LoadCurves, color: Any, marker: str = "") -> None:
    """Draw the mean share of first detachments in each bin with its interval; mark the largest."""
    edges, shares = curve.binned(_BIN)
    share, *limits = statistics.mean_interval(shares)
    ax.stairs(share, MICRO * edges, baseline=None, color=color, linewidth=0.8)
    low, high = (np.append(limit, limit[-1]) for limit in limits)
    look: Look = {"step": "post", "alpha": BAND, "linewidth": 0.0}
    ax.fill_between(MICRO * edges, low, high, color=color, **look)
    width, top = edges[1] - edges[0], int(share.argmax())
    ax.plot(MICRO * (edges[top] + 0.5 * width), share[top], color=color, marker=marker)
    ax.set_ylabel(f"first detachments\n(% per {MICRO * width:.3g} µs)")


def draw_load_peaks(force: Axes, blocks: Axes, runs: Sequence[Run], color: Any) -> None:
    """Mark the highest peak of the mean force, its second load peak, and the time between."""
    mean, time = statistics.mean_onsets(runs).mean(axis=0), MICRO * runs[0].time
    both = both_peaks(mean)
    triangle: Look = {"textcoords": "offset points", "ha": "center", "va": "bottom"}
    for peak in (both.first, both.second) if both else (int(mean.argmax()),):
        force.annotate("▼", (time[peak], mean[peak]), (0.0, 2.0), color=color, **triangle)
    if both:
        for ax in (force, blocks):
            ax.axvspan(time[both.first], time[both.second], color=color, alpha=0.08, linewidth=0.0)


def draw_run(force: Axes, blocks: Axes, run: Run, others: Sequence[Run], span: Span) -> None:
    """Draw force above and detaching blocks below in a span, and mark t_max and t_avg in both."""
    draw_force(force, run, others, span)
    _draw_blocks(blocks, run, others)
    for ax in (force, blocks):
        ax.set_xlim(span)
        for time, dashes, width in ((run.t_max, ":", 1.1), (run.t_avg, "-", 0.6)):
            look: Look = {"linestyle": dashes, "linewidth": width, "zorder": 0.5}
            ax.axvline(MICRO * time, color=BLACK, **look)
    times = sorted(((run.t_max, r"$t_\mathrm{max}$"), (run.t_avg, r"$t_\mathrm{avg}$")))
    for (time, name), side, away in zip(times, ("right", "left"), (-1.5, 1.5), strict=True):
        look = {"ha": side, "va": "bottom", "textcoords": "offset points"}
        place = (MICRO * time, 1.0)
        force.annotate(name, place, (away, 2.0), force.get_xaxis_transform(), **look)
    force.tick_params(labelbottom=False)
    blocks.set_xlabel("time (µs)")


def draw_force(ax: Axes, run: Run, others: Sequence[Run], span: Span) -> None:
    """Draw the friction force of a run; its axis fits all runs within `span`."""
    if others:
        time, forces = statistics.cut(others, [friction(other) for other in others])
        low, high = np.percentile(forces, _PERCENTILES, axis=0)
        name = f"{_PERCENTILES[0]:g}–{_PERCENTILES[1]:g} % of {len(others)} other runs"
        ax.fill_between(MICRO * time, low, high, color="0.75", linewidth=0.0, label=name)
        ax.plot(MICRO * time, forces.mean(axis=0), label="their mean", **_MEAN)
    ax.plot(MICRO * run.time, friction(run), color=BLACK, label="one run")
    curves = [(MICRO * one.time, friction(one)) for one in (run, *others)]
    shown = np.concatenate([y[(span[0] <= x) & (x <= span[1])] for x, y in curves])
    room = 0.08 * float(np.ptp(shown))
    ax.set_ylim(max(0.0, float(shown.min()) - room), float(shown.max()) + room)
    ax.set_ylabel(FORCE)


def _draw_blocks(ax: Axes, run: Run, others: Sequence[Run]) -> None:
    """Draw shares of switching blocks on a logarithmic axis that starts below one block."""
    floor = 0.6 * float(percent(run, np.array([1]))[0])
    for counts, color, name in (
        (run.switches, "0.75", "begin to slide or turn back"),
        (run.detachments, BLACK, "of these, for the first time"),
    ):
        share = percent(run, counts[1:])  # in the interval that ends at the sample
        edges = MICRO * run.time
        ax.stairs(share, edges, baseline=floor, fill=True, color=color, label=name)
    if others:
        time, shares = statistics.cut(others, [percent(other, other.switches) for other in others])
        middle = MICRO * (time - 0.5 * (time[1] - time[0]))
        casing = [withStroke(linewidth=1.6, foreground="white")]  # visible on any ground
        name = "begin or turn back, mean of others"
        ax.plot(middle, shares.mean(axis=0), label=name, path_effects=casing, **_MEAN)
    ax.set(yscale="log", ylim=(floor, 80.0))
    ax.yaxis.set_major_formatter("{x:g}")
    interval = MICRO * (run.time[1] - run.time[0])
    ax.set_ylabel(f"blocks\n(% per {interval:.2g} µs)")


def draw_points(ax: Axes, places: ArrayLike, intervals: ArrayLike, color: Any, **look: Any) -> None:
    """Draw values at `places` with bars over their intervals, and a line through them.

    `intervals` are (n, 3): value, lower and upper limit. A value without these has no bar.
    """
    mean, low, high = np.asarray(intervals, dtype=float).T
    bars = np.nan_to_num(np.array([mean - low, high - mean]).clip(0.0))
    ax.errorbar(places, mean, bars, color=color, **(BAR | look))


def name_places(ax: Axes, places: ArrayLike, scale: str = "log") -> None:
    """Set a tick at each place of the x axis whose label does not overlap the one before."""
    ticks = np.unique(places)
    ax.set_xscale(scale)
    even = np.log(ticks) if scale == "log" else ticks
    along = (even - even[0]) / max(1e-300, even[-1] - even[0])
    at = along * span(ax)
    named, end = [], -np.inf
    for place, tick in zip(at, ticks, strict=True):
        half = 0.32 * style.SMALL * len(f"{tick:.4g}")
        if place - half > end:
            named.append(tick)
            end = place + half + 1.0
    ax.set_xticks(named, [f"{tick:.4g}" for tick in named])
    ax.xaxis.minorticks_off()
    ax.margins(x=0.1, y=0.1)


def name_categories(ax: Axes, names: Sequence[str]) -> None:
    """Name the places 0, 1, ... of an axis, at an angle where names would overlap."""
    room = span(ax) / len(names)
    long = style.SMALL * 0.6 * max(map(len, names)) > room
    turned: Look = {"rotation": 25.0, "ha": "right", "rotation_mode": "anchor"} if long else {}
    ax.set_xticks(range(len(names)), names, **turned)
    ax.set_xlim(-0.5, len(names) - 0.5)
    ax.margins(y=0.1)


def span(ax: Axes) -> float:
    """Return the length in pt from the first place of a horizontal axis to the last."""
    return 0.8 * float(ax.bbox.width) * 72.0 / ax.figure.dpi  # margins take the rest
