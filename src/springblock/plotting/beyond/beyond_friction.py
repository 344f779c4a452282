"""Beyond the paper: static friction over the size of pillars and their distance."""

from collections.abc import Mapping, Sequence
from itertools import chain

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

from springblock.analysis.statistics import mean_interval
from springblock.beyond.friction import Map, crossed, families, friction_map, residuals
from springblock.beyond.question import by_scene
from springblock.io.records import Record
from springblock.plotting import style
from springblock.plotting.declaration import Declaration, RealisationsSource
from springblock.plotting.looks import shades
from springblock.plotting.points import FRICTION, draw_points, name_places
from springblock.plotting.style import GREY, Look, color_bar, journal

FIGURE = Declaration(
    title="Size of pillars and contact fraction",
    category="Beyond",
    caption="""Static friction at one total load. a) Over size n_p and distance n_s of pillars; on
    grey lines the contact fraction is the same. b) Over n_p for each contact fraction, with 95 %
    intervals over realisations; dashes: the sum of a number for each size and one for each contact
    fraction.""",
    source=RealisationsSource(groups=("friction",), keys=("folder",)),
)

_TICKS = (1, 2, 5, 10, 20, 40, 80)


@journal
def draw(ensembles: Mapping[str, Sequence[Record]]) -> Figure:
    """Draw the map, and the lines of the same contact fraction.

    `ensembles` holds realisations by folder.
    """
    found = friction_map(by_scene(list(chain.from_iterable(ensembles.values()))))
    picture, (over_both, lines) = style.panels(style.DOUBLE, 80.0, "ab")
    _draw_map(over_both, found)
    _draw_lines(lines, found)
    return picture


def _draw_map(ax: Axes, found: Map) -> None:
    sizes, gaps = np.array(list(found), dtype=float).T
    means = [float(values.mean()) for values in found.values()]
    ends = np.array([0.8, 1.25 * sizes.max()])
    for kind in families(found):
        ax.plot(ends, float(kind) * ends, color=GREY, linewidth=0.4, zorder=0)
    points = ax.scatter(sizes, gaps, c=means, cmap="viridis", s=34.0, marker="s", linewidths=0.0)
    ax.set(xscale="log", yscale="log")
    ax.set(xlabel="size $n_p$ (blocks)", ylabel="distance $n_s$ (blocks)")
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_ticks(_TICKS, labels=[str(tick) for tick in _TICKS])
        axis.set_minor_locator(NullLocator())
    ax.set(xlim=ends, ylim=(0.8 * gaps.min(), 1.25 * gaps.max()))
    color_bar(ax, points, FRICTION)


def _draw_lines(ax: Axes, found: Map) -> None:
    alike = families(found)
    left, colors = residuals(crossed(found)), shades(float(kind) for kind in alike)
    for kind, sizes in alike.items():
        color, places = colors[float(kind)], list(sizes)
        means = [mean_interval(values) for values in sizes.values()]
        label = f"{1.0 / (1.0 + float(kind)) ** 2:.0%} in contact"
        draw_points(ax, places, means, color, marker="o", label=label)
        here = [(n_p, rest) for (n_p, n_s), rest in left.items() if n_s == kind * n_p]
        model = {n_p: float(sizes[n_p].mean()) - rest for n_p, rest in here}
        look: Look = {"linestyle": "none", "marker": "_", "markersize": 7.0}
        ax.plot(list(model), list(model.values()), color=color, **look)
    name_places(ax, sorted({n_p for n_p, _ in found}))
    ax.set(xlabel="size $n_p$ (blocks)", ylabel=FRICTION)
    ax.legend(loc="best")
