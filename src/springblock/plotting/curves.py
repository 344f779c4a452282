"""Force and detachments of ensembles over time."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import ArrayLike

from springblock.analysis.statistics import (
    Curve,
    Interval,
    load_peaks,
    mean_interval,
    mean_of_rest,
    standard_error,
)
from springblock.plotting.style import MICRO, Look
from springblock.simulation.run import Array

BAND = 0.25  #: opacity of the intervals
SINGLE = 20  #: runs of an ensemble that are shown one by one, at most
_BIN = 2e-6  #: s, width of the bins of detachments
REST: Look = {"linestyle": (0, (1.0, 0.9))}  #: of a mean force after some runs' end

#: What captions say of curves that `draw_mean_force` and `draw_detachments` draw.
ENDS = """Runs end after a set time, or after the first minimum behind their force maximum. From
    where the first has ended the force is dotted, the mean over those that go on, and it ends with
    half of them; no block is left to detach for the first time in a run that has ended, so these
    shares are of all runs throughout."""


def draw_band(
    ax: Axes, places: ArrayLike, values: Interval, color: Any, opacity: float = BAND, **look: Any
) -> None:
    """Draw a line of values, (n,), over `places`, and a band over their intervals."""
    ax.fill_between(places, values.low, values.high, color=color, alpha=opacity, linewidth=0.0)
    ax.plot(places, values.mean, color=color, **look)


def draw_mean_force(ax: Axes, curve: Curve, color: Any, label: str, **look: Any) -> Array:
    """Draw the mean force with its interval, dotted where runs are missing; return it, (n,)."""
    force = mean_of_rest(curve.friction)
    time, whole = MICRO * curve.time, _length_of_all(curve)
    ax.plot(time[:whole], force.mean[:whole], color=color, label=label, markevery=[], **look)
    ax.plot(time[whole - 1 :], force.mean[whole - 1 :], color=color, **REST)
    ax.fill_between(time, force.low, force.high, color=color, alpha=BAND, linewidth=0.0)
    return force.mean


def _length_of_all(curve: Curve) -> int:
    """Number of samples that all runs have."""
    return int(np.isfinite(curve.friction).all(axis=0).sum())


def draw_single_forces(ax: Axes, curve: Curve, color: Any) -> None:
    """Draw the force of single runs, up to their own end: of the first `SINGLE`, lest they blot."""
    forces = curve.friction[:SINGLE].T
    ax.plot(MICRO * curve.time, forces, color=color, linewidth=0.3, alpha=0.4, zorder=1.0)


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
        alpha=BAND,
        linewidth=0.0,
    )
    width, top = edges[1] - edges[0], int(share.argmax())
    ax.plot(MICRO * (edges[top] + 0.5 * width), share[top], color=color, marker=marker)
    ax.set_ylabel(f"first detachments\n(% per {MICRO * width:.3g} µs)")


def draw_load_peaks(ax: Axes, curve: Curve, color: Any, name: str) -> None:
    """Draw the mean force, and triangles above its load peaks as long as all runs go on."""
    forces = curve.friction[:, : _length_of_all(curve)]
    peaks = load_peaks(forces.mean(axis=0), standard_error(forces))
    plural = "" if len(peaks) == 1 else "s"
    draw_mean_force(ax, curve, color, f"{name}: {len(peaks)} load peak{plural}")
    heights = forces[:, peaks].mean(axis=0)
    triangle: Look = {"textcoords": "offset points", "ha": "center", "va": "bottom"}
    for time, height in zip(MICRO * curve.time[peaks], heights, strict=True):
        ax.annotate("▼", (time, height), (0.0, 2.0), color=color, **triangle)


def enlarged_span(curves: Sequence[Curve], share: float = 0.85) -> tuple[float, float]:
    """Times in µs from which the first mean force is close to its maximum to the last one's end."""
    starts, ends = [], []
    for curve in curves:
        mean = mean_of_rest(curve.friction).mean
        starts.append(curve.time[np.argmax(mean >= share * np.nanmax(mean))])
        ends.append(curve.time[np.isfinite(mean)][-1])
    return MICRO * float(min(starts)), MICRO * float(max(ends))


def fit_forces(ax: Axes, curves: Sequence[Curve], span: tuple[float, float]) -> None:
    """Fit axes to the mean forces within `span`, with room for triangles."""
    means: list[Array] = []
    for curve in curves:
        time = MICRO * curve.time
        mean = mean_of_rest(curve.friction).mean
        means.append(mean[np.isfinite(mean) & (time >= span[0]) & (time <= span[1])])
    shown = np.concatenate(means)
    room = float(np.ptp(shown))
    ax.set_ylim(float(shown.min()) - 0.1 * room, float(shown.max()) + 0.25 * room)
    ax.set_xlim(span)
