"""Figure 6: friction force and detachments for several sizes of pillars (section 3.2 of the paper).

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from springblock.figures import style
from springblock.figures.declaration import Declaration, Realisations
from springblock.figures.ensembles import (
    FORCE,
    FRICTION,
    LAG,
    Runs,
    draw_detachments,
    draw_force,
    draw_no_lag,
    draw_point,
    highest_and_lag,
    logarithmic,
    size_colors,
)
from springblock.figures.style import BLACK, GREY, MICRO, journal
from springblock.run import Array
from springblock.statistics import common_curve, mean_interval

FIGURE = Declaration(
    title="Force and detachments, pillars",
    category="Figures",
    caption="""a) Friction force over the normal force and b) share of first detachments in each
    bin, on a flat surface and on pillars of several sizes; dots: t_max, rings: t_avg. c) Static
    friction and d) t_max - t_avg over the size of the pillars; dashed: flat surface. Means over
    realisations with 95 % t intervals. Curves end with the shortest realisation. Figure 6
    of the paper; c) and d) are additions.""",
    source=Realisations(groups=("flat", "pillars"), keys=("n_p",)),
)

_FLOOR = 0.01  #: %, where the logarithmic axis of detachments begins
_LEFT, _RIGHT = (17.0, 91.0), (128.0, 58.0)  #: left edge and width of the panels, mm
_UPPER, _LOWER = (54.0, 43.0), (11.0, 37.0)  #: lower edge and height

Ensembles = Mapping[int, Runs]  #: by n_p, 0 for the flat surface


@journal
def draw(ensembles: Ensembles) -> Figure:
    """Draw a) force, b) detachments over time; c) static friction, d) t_max - t_avg over n_p."""
    ensembles = dict(sorted(ensembles.items()))
    colors = size_colors(ensembles)
    picture = style.figure(style.DOUBLE, 103.0)
    places = [(column, row) for column in (_LEFT, _RIGHT) for row in (_UPPER, _LOWER)]
    force, blocks, friction, lag = (
        style.axes(picture, left, bottom, width, height)
        for (left, width), (bottom, height) in places
    )
    _draw_time(force, blocks, ensembles, colors)
    samples = zip(*(highest_and_lag(runs) for runs in ensembles.values()), strict=True)
    for ax, values in zip((friction, lag), samples, strict=True):
        _draw_sizes(ax, ensembles, values, colors)
    draw_no_lag(lag)
    friction.set_ylabel(FRICTION)
    friction.tick_params(labelbottom=False)
    lag.set(xlabel="size of the pillars $n_p$", ylabel=LAG)
    for ax, letter in zip((force, blocks, friction, lag), "abcd", strict=True):
        style.panel_letter(ax, letter, left=12.0, above=1.5)
    return picture


def _draw_time(force: Axes, blocks: Axes, ensembles: Ensembles, colors: dict[int, Any]) -> None:
    """Mean curves; on those of the force, dots at t_max and rings at t_avg."""
    for n_p, runs in ensembles.items():
        curve, color = common_curve(runs), colors[n_p]
        mean = draw_force(force, curve, color, f"$n_p$ = {n_p}" if n_p else "flat")
        draw_detachments(blocks, curve, color)
        for times, face in (([r.t_max for r in runs], color), ([r.t_avg for r in runs], "white")):
            time = float(np.mean(times))
            height = np.interp(time, curve.time, mean)
            force.plot(MICRO * time, height, "o", color=color, markerfacecolor=face, zorder=3)
    for face, name in ((GREY, r"$t_\mathrm{max}$"), ("white", r"$t_\mathrm{avg}$")):
        force.plot([], [], "o", color=GREY, markerfacecolor=face, label=name)
    force.legend(loc="lower right", ncols=2)
    force.set(ylabel=FORCE, ylim=(0.0, None), xlim=(0.0, None))
    force.tick_params(labelbottom=False)
    blocks.set_yscale("log")
    blocks.yaxis.set_major_formatter("{x:g}")
    blocks.set(xlabel="time (µs)", xlim=force.get_xlim(), ylim=(_FLOOR, 100.0))


def _draw_sizes(
    ax: Axes, ensembles: Ensembles, values: Sequence[Array], colors: dict[int, Any]
) -> None:
    """Means over n_p on a logarithmic axis; the flat surface as a line with a band."""
    for n_p, sample in zip(ensembles, values, strict=True):
        interval = mean_interval(sample)
        if n_p:
            draw_point(ax, n_p, interval, colors[n_p], marker="o")
            continue
        ax.axhline(float(interval.mean), color=BLACK, linewidth=0.8, linestyle="--")
        ax.axhspan(float(interval.low), float(interval.high), color="0.8", linewidth=0.0, zorder=0)
        ax.annotate(
            "flat",
            (0.45, float(interval.mean)),
            (0.0, -2.0),
            ax.get_yaxis_transform(),
            textcoords="offset points",
            ha="center",
            va="top",
        )
    logarithmic([ax], [n_p for n_p in ensembles if n_p])
