"""Figure 5: first detachment times on one pillar (section 3.2 of the paper)."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from springblock.analysis.statistics import mean_interval, pillar_map, pillar_ring
from springblock.io.records import Record
from springblock.plotting import style
from springblock.plotting.declaration import INTERVALS, Declaration, RealisationsSource
from springblock.plotting.dimensions import draw_sliding
from springblock.plotting.maps import draw_mean_times
from springblock.plotting.points import draw_points
from springblock.plotting.style import BLACK, BLUE, GREY, VERMILION, journal
from springblock.simulation.run import Array

FIGURE = Declaration(
    title="First detachment times on one pillar",
    category="Figures",
    caption=f"""First detachment times t_det over t_max on one pillar, means over all pillars and
    realisations: a) by place on the pillar, blue before the force maximum and red after it, on a
    scale of its own for each; b) by part of each ring of blocks from the edge to the middle, with
    {INTERVALS}. Figure 5 of the paper; b) is an addition.""",
    source=RealisationsSource(groups=("pillars",)),
)

_TIME = r"mean first detachment $t_\mathrm{det}/t_\mathrm{max}$"
#: Colour, marker and name of the parts of a ring, each moved aside a little to show its bar.
_PARTS = {
    "corners": (BLACK, "o", "corners", -0.12),
    "y": (VERMILION, "s", "sides along $y$ ($x_p$ = const.)", 0.0),
    "x": (BLUE, "D", "sides along $x$ ($y_p$ = const.)", 0.12),
}


@journal
def draw(runs: Sequence[Record]) -> Figure:
    """Map a) t_det/t_max by place on a pillar and b) compare the parts of its rings.

    Means over all pillars and `runs`, which share one scene; bars are 95 % intervals.
    """
    scene = runs[0].scene
    times = pillar_map(runs, scene.pattern)
    picture, (pillar, rings) = style.panels(style.DOUBLE, 75.0, "ab")
    draw_mean_times(pillar, times.mean(axis=0), _TIME, axes="_p/l")
    draw_sliding(pillar, scene.direction)
    _draw_rings(rings, times)
    return picture


def _draw_rings(ax: Axes, times: Array) -> None:
    """Means over the corners and the sides of each ring, from the edge to the middle."""
    size = times.shape[-1]
    depths = range((size + 1) // 2)
    for part, (color, marker, name, aside) in _PARTS.items():
        masks = {depth: pillar_ring(size, depth)[part] for depth in depths}
        shown = [depth for depth, mask in masks.items() if mask.any()]
        if not shown:
            continue
        values = np.stack([times[:, masks[depth]].mean(axis=1) for depth in shown], axis=1)
        intervals = np.transpose(mean_interval(values))
        draw_points(ax, np.array(shown) + aside, intervals, color, marker=marker, label=name)
    ax.set(xlabel="distance from the edge of the pillar (blocks)", ylabel=_TIME)
    ax.axhline(1.0, color=GREY, linestyle=":", zorder=0)
    side = ax.get_yaxis_transform()
    ax.text(0.985, 0.995, "force maximum", transform=side, color=GREY, ha="right", va="top")
    ax.set_xlim(-0.5, len(depths) - 0.5)
    ax.xaxis.set_major_locator(MaxNLocator(integer=True))
    ax.legend(loc="lower right")
