"""Figure 6: friction force and detachments for several sizes of pillars (section 3.2)."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from springblock.analysis.statistics import mean_interval, whole_curve
from springblock.plotting import points, style
from springblock.plotting.curves import ENDS, REST, draw_detachments, draw_mean_force
from springblock.plotting.declaration import INTERVALS, Declaration, RealisationsSource
from springblock.plotting.looks import pillar_look, pillar_name
from springblock.plotting.style import BLACK, FORCE, GREY, MICRO, Look, journal
from springblock.simulation.run import Array, Run

FIGURE = Declaration(
    title="Force and detachments, pillars",
    category="Figures",
    caption=f"""a) Friction force over the normal force and b) share of first detachments in each
    bin, on a flat surface and on pillars of several sizes; markers: a) t_max, or t_avg where they
    are open, b) the largest share. c) Static friction and d) t_max - t_avg over the size of the
    pillars; dashed: flat surface. Means with {INTERVALS}. {ENDS} Figure 6 of the paper; c) and d)
    are additions.""",
    source=RealisationsSource(groups=("flat", "pillars"), keys=("n_p",)),
)

_FLOOR = 0.01  #: %, where the logarithmic axis of detachments begins

BySize = Mapping[int, Sequence[Run]]  #: by n_p, 0 for the flat surface


@journal
def draw(ensembles: BySize) -> Figure:
    """Draw a) force, b) detachments over time; c) static friction, d) t_max - t_avg over n_p."""
    ensembles = dict(sorted(ensembles.items()))
    ratios: Look = {"width_ratios": (105, 46), "height_ratios": (43, 37)}
    picture, panels = style.panels(style.DOUBLE, 103.0, "ac;bd", **ratios)
    force, blocks, friction, lag = panels
    _draw_time(force, blocks, ensembles)
    samples = zip(*(points.highest_and_lag(runs) for runs in ensembles.values()), strict=True)
    for ax, values in zip((friction, lag), samples, strict=True):
        _draw_sizes(ax, ensembles, values)
    points.draw_no_lag(lag)
    friction.set_ylabel(points.FRICTION)
    friction.tick_params(labelbottom=False)
    lag.set(xlabel="size of the pillars $n_p$ (blocks)", ylabel=points.LAG)
    return picture


def _draw_time(force: Axes, blocks: Axes, ensembles: BySize) -> None:
    """Mean curves; on those of the force, markers at t_max and open ones at t_avg."""
    highest = 0.0
    for n_p, runs in ensembles.items():
        curve, look = whole_curve(runs), pillar_look(n_p)
        mean = draw_mean_force(force, curve, label=pillar_name(n_p), **look)
        draw_detachments(blocks, curve, **look)
        highest = max(highest, float(np.nanmax(mean)))
        for times, face in (
            ([r.t_max for r in runs], look["color"]),
            ([r.t_avg for r in runs], "white"),
        ):
            time = float(np.mean(times))
            height = np.interp(time, curve.time, mean)
            force.plot(MICRO * time, height, **look, markerfacecolor=face, zorder=3)
    force.plot([], [], color=GREY, **REST, label="fewer runs")
    force.add_artist(force.legend(loc="lower right", ncols=2))
    signs = [
        Line2D([], [], color=GREY, marker="o", linestyle="none", markerfacecolor=face, label=name)
        for face, name in ((GREY, r"$t_\mathrm{max}$"), ("white", r"$t_\mathrm{avg}$"))
    ]
    force.legend(handles=signs, loc="upper left")
    force.set(ylabel=FORCE, ylim=(0.0, 1.07 * highest), xlim=(0.0, None))
    force.tick_params(labelbottom=False)
    blocks.set_yscale("log")
    blocks.yaxis.set_major_formatter("{x:g}")
    blocks.set(xlabel="time (µs)", xlim=force.get_xlim(), ylim=(_FLOOR, 100.0))


def _draw_sizes(ax: Axes, ensembles: BySize, values: Sequence[Array]) -> None:
    """Means over n_p on a logarithmic axis; the flat surface as a line with a band."""
    for n_p, sample in zip(ensembles, values, strict=True):
        interval = mean_interval(sample)
        if n_p:
            points.draw_point(ax, n_p, interval, **pillar_look(n_p))
            continue
        ax.axhline(float(interval.mean), color=BLACK, linewidth=0.8, linestyle="--")
        ax.axhspan(float(interval.low), float(interval.high), color="0.8", linewidth=0.0, zorder=0)
        below: Look = {"textcoords": "offset points", "ha": "center", "va": "top"}
        place = (0.45, float(interval.mean))
        ax.annotate("flat", place, (0.0, -2.0), ax.get_yaxis_transform(), **below)
    points.name_places(ax, [n_p for n_p in ensembles if n_p])
