"""Figure 2: friction force and detaching blocks over time (section 3.1 of the paper).

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import Normal, Stroke

from springblock.analysis.statistics import cut
from springblock.plotting import style
from springblock.plotting.declaration import Declaration, Realisations
from springblock.plotting.style import BLACK, GREY, MICRO, journal
from springblock.plotting.surface import arrow
from springblock.simulation.run import Array, Run, friction, percent

FIGURE = Declaration(
    title="Force and detachments, flat surface",
    category="Figures",
    caption="""Friction force on a flat surface over the normal force, and share of blocks that
    detach in each sample interval. Dotted: t_max, the time of the force maximum; solid: t_avg, the
    mean first detachment time. One realisation, the first seed, in front of the whole ensemble.
    Figure 2 of the paper.""",
    source=Realisations(groups=("flat",)),
)

_BAND = (5.0, 95.0)  #: percentiles of the ensemble
_BEFORE, _AFTER = 15e-6, 9e-6  #: s around t_max that are enlarged
_COLUMNS = ((16.0, 82.0), (116.0, 71.0))  #: left edge and width of the panels, mm
_ROWS = ((53.0, 37.0), (11.0, 37.0))  #: lower edge and height
_CASED = [Stroke(linewidth=1.6, foreground="white"), Normal()]  #: visible on any ground
_MEAN: dict[str, Any] = {"color": GREY, "linewidth": 0.8, "linestyle": (0, (4, 2))}


@journal
def draw(runs: Sequence[Run]) -> Figure:
    """Draw runs[0] before the spread of the other runs: a), b) force and c), d) blocks.

    The left panels show the whole run, the right ones the time around the force maximum.

    Raises
    ------
    ValueError
        Where the other runs do not share one sample interval.
    """
    run, others = runs[0], runs[1:]
    picture = style.figure(style.DOUBLE, 95.0)
    zoom = (MICRO * (run.t_max - _BEFORE), MICRO * (run.t_max + _AFTER))
    spans = ((0.0, MICRO * float(run.time[-1])), zoom)
    for column, letters, span in zip(_COLUMNS, ("ac", "bd"), spans, strict=True):
        upper, lower = (style.axes(picture, column[0], y, column[1], h) for y, h in _ROWS)
        draw_force(upper, run, others, span)
        draw_blocks(lower, run, others)
        for ax, letter in zip((upper, lower), letters, strict=True):
            draw_times(ax, run)
            ax.set_xlim(span)
            style.panel_letter(ax, letter, left=14.0, above=1.5)
        name_times(upper, run)
        upper.tick_params(labelbottom=False)
        lower.set_xlabel("time (µs)")
    whole_force, whole_blocks, _, blocks = picture.axes
    for ax in (whole_force, whole_blocks):
        name = "enlarged at the right" if ax is whole_force else None
        ax.axvspan(*zoom, color="0.93", linewidth=0.0, zorder=0, label=name)
    early = 2.0 * run.t_max < run.time[-1]  # room beside the peak
    whole_force.legend(loc="lower right" if early else "upper left")
    whole_blocks.legend(loc="upper right" if early else "upper left")
    _name_precursors(blocks, run, zoom[0])
    return picture


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
    ax.set_ylabel(r"friction force $F_\mathrm{fr}/F_n$")


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


def draw_times(ax: Axes, run: Run) -> None:
    """Mark t_max with a dotted and t_avg with a thin solid line."""
    for time, dashes, width in ((run.t_max, ":", 1.1), (run.t_avg, "-", 0.6)):
        ax.axvline(MICRO * time, color=BLACK, linestyle=dashes, linewidth=width, zorder=0.5)


def name_times(ax: Axes, run: Run) -> None:
    """Write the names of both times above the panel, away from each other."""
    first, second = sorted(((run.t_max, r"t_\mathrm{max}"), (run.t_avg, r"t_\mathrm{avg}")))
    for (time, name), side in ((first, "right"), (second, "left")):
        place = (MICRO * time, 1.03)
        ax.text(*place, f"${name}$", ha=side, va="bottom", transform=ax.get_xaxis_transform())


def _name_precursors(ax: Axes, run: Run, start: float) -> None:
    """Point from t_max back to the detachments that come before it."""
    end, height = MICRO * run.t_max, 6.0
    arrow(ax, (end, height), (end - 0.8 * (end - start), height))
    ax.text(end - 0.4 * (end - start), 1.3 * height, "precursors", ha="center", va="bottom")
