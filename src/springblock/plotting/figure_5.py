"""Figure 5: first detachment times on one pillar (section 3.2 of the paper).

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import TwoSlopeNorm
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from springblock.analysis.statistics import mean_interval, pillar_map, pillar_ring
from springblock.plotting import style
from springblock.plotting.declaration import INTERVALS, Declaration, Realisations
from springblock.plotting.ensembles import BAR
from springblock.plotting.style import BEFORE_AFTER, BLACK, BLUE, GREY, VERMILION, journal
from springblock.plotting.surface import Axis, draw_sliding
from springblock.simulation.run import Array

if TYPE_CHECKING:
    from springblock.io.records import Record

FIGURE = Declaration(
    title="First detachment times on one pillar",
    category="Figures",
    caption=f"""First detachment times t_det over t_max on one pillar, means over all pillars and
    realisations: a) by place on the pillar, blue before the force maximum and red after it, on a
    scale of its own for each; b) by part of each ring of blocks from the edge to the middle, with
    {INTERVALS}. Figure 5 of the paper; b) is an addition.""",
    source=Realisations(groups=("pillars",)),
)

_TIME = r"mean first detachment $t_\mathrm{det}/t_\mathrm{max}$"
#: Colour, marker and name of the parts of a ring, each moved aside a little to show its bar.
_PARTS = {
    "corners": (BLACK, "o", "corners", -0.12),
    "y": (VERMILION, "s", "sides along $y$ ($x_p$ = const.)", 0.0),
    "x": (BLUE, "D", "sides along $x$ ($y_p$ = const.)", 0.12),
}


@journal
def draw(runs: "Sequence[Record]") -> Figure:
    """Map a) t_det/t_max by place on a pillar and b) compare the parts of its rings.

    Means over all pillars and `runs`, which share one scene; bars are 95 % intervals. An arrow
    shows the sliding direction if it is "x" or "y".
    """
    scene = runs[0].scene
    times = pillar_map(runs, scene.pattern)
    picture = style.figure(style.DOUBLE, 75.0)
    _draw_map(picture, times.mean(axis=0), scene.direction)
    rings = style.axes(picture, 110.0, 11.0, 76.0, 54.0)
    _draw_rings(rings, times)
    style.panel_letter(picture.axes[0], "a", left=11.0, above=1.5)
    style.panel_letter(rings, "b", left=14.0, above=1.5)
    return picture


def _draw_map(picture: Figure, times: Array, direction: str) -> None:
    ax = style.axes(picture, 13.0, 11.0, 54.0, 54.0)
    norm = TwoSlopeNorm(1.0, min(times.min(), 0.999), max(times.max(), 1.001))
    image = ax.imshow(times, BEFORE_AFTER, norm=norm, origin="lower", interpolation="nearest")
    ax.set(xlabel="$x_p/l$", ylabel="$y_p/l$")
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_locator(MaxNLocator(6, integer=True, steps=[1, 2, 5, 10]))
    if direction in ("x", "y"):
        draw_sliding(ax, cast(Axis, direction))
    bar = picture.colorbar(image, style.axes(picture, 70.0, 11.0, 3.0, 54.0))
    bar.set_label(_TIME)


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
        mean, low, high = mean_interval(values)
        look = {"color": color, "marker": marker, "label": name, "linewidth": 0.6, **BAR}
        ax.errorbar(np.array(shown) + aside, mean, (mean - low, high - mean), **look)
    ax.set(xlabel="distance from the edge of the pillar (blocks)", ylabel=_TIME)
    ax.axhline(1.0, color=GREY, linestyle=":", zorder=0)
    side = ax.get_yaxis_transform()
    ax.text(0.985, 0.995, "force maximum", transform=side, color=GREY, ha="right", va="top")
    ax.set_xlim(-0.5, len(depths) - 0.5)
    ax.xaxis.set_major_locator(MaxNLocator(integer=True))
    ax.legend(loc="lower right")
