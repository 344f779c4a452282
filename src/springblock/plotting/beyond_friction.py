"""Beyond the paper: static friction over the size of pillars and their distance.

Surfaces of Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525.
"""

from collections.abc import Mapping, Sequence
from itertools import chain
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

from springblock.analysis.statistics import mean_interval
from springblock.beyond.friction import Map, crossed, families, friction_map, residuals
from springblock.beyond.question import by_scene
from springblock.io.records import Record
from springblock.plotting import style
from springblock.plotting.declaration import Declaration, Realisations
from springblock.plotting.ensembles import FRICTION
from springblock.plotting.style import GREY, journal
from springblock.plotting.sweeps import draw_sweep, powers, shades

FIGURE = Declaration(
    title="Size of pillars and contact fraction",
    category="Beyond",
    caption="""Static friction at one total load. a) Over size n_p and distance n_s of pillars; on
    grey lines the contact fraction is the same. b) Over n_p for each contact fraction, with 95 %
    intervals over realisations; dashes: the sum of a number for each size and one for each contact
    fraction.""",
    source=Realisations(groups=("friction",), keys=("folder",)),
)

_TICKS = (1, 2, 5, 10, 20, 40, 80)


@journal
def draw(ensembles: Mapping[str, Sequence[Record]]) -> Figure:
    """Draw the map, and the lines of the same contact fraction.

    `ensembles` holds realisations by folder.
    """
    found = friction_map(by_scene(list(chain.from_iterable(ensembles.values()))))
    picture = style.figure(style.DOUBLE, 80.0)
    left = style.axes(picture, 13.0, 11.0, 62.0, 62.0)
    right = style.axes(picture, 112.0, 11.0, 75.0, 62.0)
    for ax, letter, aside in ((left, "a", 10.0), (right, "b", 11.0)):
        style.panel_letter(ax, letter, left=aside, above=2.5)
    _draw_map(picture, left, found)
    _draw_lines(right, found)
    return picture


def _draw_map(picture: Figure, ax: Axes, found: Map) -> None:
    sizes, gaps = np.array(list(found), dtype=float).T
    means = [float(values.mean()) for values in found.values()]
    ends = np.array([0.8, 1.25 * sizes.max()])
    for kind in families(found):
        ax.plot(ends, float(kind) * ends, color=GREY, linewidth=0.4, zorder=0)
    points = ax.scatter(sizes, gaps, c=means, cmap="viridis", s=34.0, marker="s", linewidths=0.0)
    for axis, span in ((ax.xaxis, sizes), (ax.yaxis, gaps)):
        axis.axes.set(**{f"{axis.axis_name}scale": "log"})
        axis.axes.set(**{f"{axis.axis_name}lim": (0.8, 1.25 * span.max())})
        axis.set_ticks(_TICKS, labels=[str(tick) for tick in _TICKS])
        axis.set_minor_locator(NullLocator())
    ax.set_ylim(0.8 * gaps.min(), 1.25 * gaps.max())
    ax.set(xlabel="size $n_p$ (blocks)", ylabel="distance $n_s$ (blocks)")
    bar = picture.colorbar(points, cax=style.axes(picture, 78.0, 11.0, 3.0, 62.0))
    bar.set_label(FRICTION)
    bar.outline.set_linewidth(0.6)


def _draw_lines(ax: Axes, found: Map) -> None:
    alike = families(found)
    left, colors = residuals(crossed(found)), shades(float(kind) for kind in alike)
    for kind, sizes in alike.items():
        color, places = colors[float(kind)], list(sizes)
        means = [mean_interval(values) for values in sizes.values()]
        label = f"{1.0 / (1.0 + float(kind)) ** 2:.0%} in contact"
        draw_sweep(ax, places, means, color, marker="o", label=label)
        here = [(n_p, rest) for (n_p, n_s), rest in left.items() if n_s == kind * n_p]
        model = {n_p: float(sizes[n_p].mean()) - rest for n_p, rest in here}
        look: dict[str, Any] = {"linestyle": "none", "marker": "_", "markersize": 7.0}
        ax.plot(list(model), list(model.values()), color=color, **look)
    powers(ax, _TICKS, "size $n_p$ (blocks)")
    ax.set_ylabel(FRICTION)
    ax.legend(loc="best")
