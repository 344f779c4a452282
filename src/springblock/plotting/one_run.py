"""Force and detachments of one run over time, which may stand in front of others."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patheffects import Normal, Stroke

from springblock.analysis.statistics import cut
from springblock.plotting.style import BLACK, FORCE, GREY, MICRO, Look
from springblock.simulation.run import Array, Run, friction, percent

_BAND = (5.0, 95.0)  #: percentiles of the ensemble
_CASED = [Stroke(linewidth=1.6, foreground="white"), Normal()]  #: visible on any ground
_MEAN: Look = {"color": GREY, "linewidth": 0.8, "linestyle": (0, (4, 2))}


def draw_force(ax: Axes, run: Run, others: Sequence[Run], span: tuple[float, float]) -> None:
    """Friction force over normal force; its axis fits what the runs show within `span`."""
    if others:
        time, forces = cut(others, [friction(other) for other in others])
        low, high = np.percentile(forces, _BAND, axis=0)
        name = f"{_BAND[0]:g}–{_BAND[1]:g} % of {len(others)} other runs"
        ax.fill_between(MICRO * time, low, high, color="0.75", linewidth=0.0, label=name)
        ax.plot(MICRO * time, forces.mean(axis=0), label="their mean", **_MEAN)
    ax.plot(MICRO * run.time, friction(run), color=BLACK, label="one run")
    shown = np.concatenate([_within(span, each) for each in (run, *others)])
    room = 0.08 * float(np.ptp(shown))
    ax.set_ylim(max(0.0, float(shown.min()) - room), float(shown.max()) + room)
    ax.set_ylabel(FORCE)


def _within(span: tuple[float, float], run: Run) -> Array:
    """Friction force over normal force between two times in µs."""
    time = MICRO * run.time
    return friction(run)[(time >= span[0]) & (time <= span[1])]


def draw_blocks(ax: Axes, run: Run, others: Sequence[Run]) -> None:
    """Shares of detaching blocks, on a logarithmic axis that begins below one block."""
    floor = 0.6 * float(percent(run, np.array([1]))[0])
    for counts, color, name in (
        (run.switches, "0.75", "rest to sliding"),
        (run.detachments, BLACK, "of these, for the first time"),
    ):
        share = percent(run, counts[1:])  # in the interval that ends at the sample
        edges = MICRO * run.time
        ax.stairs(share, edges, baseline=floor, fill=True, color=color, label=name)
    if others:
        time, shares = cut(others, [percent(other, other.switches) for other in others])
        middle = MICRO * (time - 0.5 * (time[1] - time[0]))
        name = "rest to sliding, mean of others"
        ax.plot(middle, shares.mean(axis=0), label=name, path_effects=_CASED, **_MEAN)
    ax.set_yscale("log")
    ax.set_ylim(floor, 80.0)
    ax.yaxis.set_major_formatter("{x:g}")
    interval = MICRO * (run.time[1] - run.time[0])
    ax.set_ylabel(f"detaching blocks\n(% per {interval:.2g} µs)")


def mark_times(ax: Axes, run: Run) -> None:
    """Mark t_max with a dotted and t_avg with a thin solid line."""
    for time, dashes, width in ((run.t_max, ":", 1.1), (run.t_avg, "-", 0.6)):
        ax.axvline(MICRO * time, color=BLACK, linestyle=dashes, linewidth=width, zorder=0.5)


def name_times(ax: Axes, run: Run) -> None:
    """Write the names of both times above the panel, away from each other."""
    first, second = sorted(((run.t_max, r"t_\mathrm{max}"), (run.t_avg, r"t_\mathrm{avg}")))
    for (time, name), side in ((first, "right"), (second, "left")):
        place = (MICRO * time, 1.03)
        ax.text(*place, f"${name}$", ha=side, va="bottom", transform=ax.get_xaxis_transform())
