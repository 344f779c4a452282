"""Supplement: number of realisations, which the paper does not give, and what it buys."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from springblock.analysis.statistics import half_widths
from springblock.plotting import style
from springblock.plotting.declaration import Declaration, RealisationsSource, main_surfaces
from springblock.plotting.looks import Key, in_order, surface_look
from springblock.plotting.points import highest_and_lag, name_places
from springblock.plotting.style import GREY, Look, journal
from springblock.simulation.run import Array, Run

FIGURE = Declaration(
    title="Number of realisations",
    category="Supplement",
    caption="""Half the 95 % interval of a) static friction and b) t_max - t_avg over the number k
    of realisations, which the paper does not give. Markers: t intervals, mean over random
    subsets of the ensembles; lines: 1.96 standard deviations of the whole ensemble over the root
    of k. Few realisations know their own scatter badly: t intervals are wider for it.""",
    source=RealisationsSource(
        groups=("flat", "pillars", "grooves"),
        keys=("n_p", "n_p2", "direction"),
        pick=main_surfaces,
    ),
)

_SIZES = (3, 5, 10, 20, 50, 100, 200, 500, 1000)
_MILLI = 1e3  #: 10⁻³ per unit
_NORMAL = 1.96  #: half a 95 % interval in standard errors


@journal
def draw(ensembles: Mapping[Key, Sequence[Run]]) -> Figure:
    """Draw half the 95 % interval of a) static friction and b) t_max - t_avg over realisations.

    `ensembles` holds runs by (n_p, n_p2, direction).
    """
    picture, panels = style.panels(style.COLUMN, 110.0, "a;b", sharex=True)
    for key in in_order(ensembles):
        name, look = surface_look(key)
        highest, lag = highest_and_lag(ensembles[key])
        for ax, values in zip(panels, (_MILLI * highest, lag), strict=True):
            _draw_widths(ax, values, look | {"label": name})
    names = ("static friction (10⁻³)", r"$t_\mathrm{max} - t_\mathrm{avg}$ (µs)")
    for ax, name in zip(panels, names, strict=True):
        ax.set(yscale="log", ylabel=f"± of {name}")
        ax.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        ax.yaxis.set_major_formatter("{x:g}")
        ax.yaxis.set_minor_formatter(NullFormatter())
    name_places(panels[0], [k for k in _SIZES if k <= max(map(len, ensembles.values()))])
    panels[1].set_xlabel("number of realisations")
    panels[0].plot([], [], color=GREY, linewidth=0.5, label=r"$\propto 1/\sqrt{k}$")
    picture.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return picture


def _draw_widths(ax: Axes, values: Array, look: Look) -> None:
    """Widths measured on subsets, over the line that the whole ensemble predicts."""
    widths = half_widths(values, _SIZES)
    if not widths:
        return
    sizes = np.array(list(widths))
    ax.plot(sizes, list(widths.values()), linestyle="none", **look)
    predicted = _NORMAL * values.std(ddof=1) / np.sqrt(sizes)
    ax.plot(sizes, predicted, color=look["color"], linewidth=0.5)
