"""Beyond the paper: scatter of thresholds, and how friction varies with the size of the surface."""

from collections.abc import Mapping, Sequence
from itertools import chain

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from springblock.analysis.statistics import mean_interval
from springblock.beyond.friction import static_friction
from springblock.beyond.question import Ensembles, by_scene
from springblock.beyond.scatter import Sizes, by_scatter, fits, long_enough, shared
from springblock.beyond.variance import by_pattern, exponent, variance
from springblock.io.records import Record
from springblock.plotting import style
from springblock.plotting.declaration import Declaration, RealisationsSource
from springblock.plotting.looks import shades
from springblock.plotting.points import FRICTION, draw_points, name_places
from springblock.plotting.style import BLUE, GREY, VERMILION, journal

FIGURE = Declaration(
    title="Scatter of thresholds, and of friction",
    category="Beyond",
    caption="""a) Correlation length of A exp(-r/l_c) over the standard deviation of the static
    coefficients, for pillars of n_p blocks. b) Static friction over n_p for each standard
    deviation. c) Variance of static friction between realisations over the number of blocks of the
    surface; grey: as of independent blocks. Bars are 95 % intervals over realisations.""",
    source=RealisationsSource(groups=("flat", "pillars", "scatter", "variance"), keys=("folder",)),
)


@journal
def draw(ensembles: Mapping[str, Sequence[Record]]) -> Figure:
    """Draw a) l_c and b) static friction over scatter, and c) its variance over N².

    `ensembles` holds realisations by folder.
    """
    found = by_scene(list(chain.from_iterable(ensembles.values())))
    scatters = shared(by_scatter(found))
    picture, panels = style.panels(style.DOUBLE, 64.0, "abc")
    _draw_lengths(panels[0], scatters)
    _draw_friction(panels[1], scatters)
    _draw_variance(panels[2], found)
    return picture


def _draw_lengths(ax: Axes, scatters: Mapping[float, Sizes]) -> None:
    sizes = long_enough(scatters)
    for n_p, color in shades(sizes).items():
        fitted = fits(scatters, int(n_p))
        lengths = [fit.interval for fit in fitted.values()]
        places = [std * (1.0 + 0.03 * (sizes.index(int(n_p)) - 1)) for std in fitted]
        draw_points(ax, places, lengths, color, marker="o", label=f"$n_p$ = {n_p}")
    name_places(ax, list(scatters))
    ax.set(xlabel="scatter of static coefficients", ylabel="correlation length $l_c$ (blocks)")
    ax.set_yscale("log")
    ax.yaxis.set_minor_formatter(NullFormatter())
    ax.legend(loc="best")


def _draw_friction(ax: Axes, scatters: Mapping[float, Sizes]) -> None:
    for std, color in shades(scatters).items():
        means = [mean_interval(static_friction(runs)) for runs in scatters[std].values()]
        draw_points(ax, list(scatters[std]), means, color, marker="o", label=f"{std:g}")
    name_places(ax, [n_p for sizes in scatters.values() for n_p in sizes])
    ax.set(xlabel="size $n_p$ (blocks)", ylabel=FRICTION)
    ax.legend(loc="best", title="scatter")


def _draw_variance(ax: Axes, ensembles: Ensembles) -> None:
    patterns = by_pattern(ensembles)
    for (pattern, sizes), color in zip(patterns.items(), (BLUE, VERMILION), strict=False):
        blocks = [float(n**2) for n in sizes]
        spread = [variance(values) for values in sizes.values()]
        named = f"$n_p$ = {pattern[0]}" if any(pattern) else "flat"
        label = f"{named}: $x$ = {float(exponent(sizes).mean):.2f}"
        draw_points(ax, blocks, spread, color, marker="o", linestyle="none", label=label)
        products = [n * float(each.mean) for n, each in zip(blocks, spread, strict=True)]
        independent = np.exp(np.mean(np.log(products))) / np.array(blocks)
        ax.plot(blocks, independent, color=GREY, linewidth=0.5, zorder=0)
    ax.set_yscale("log")
    name_places(ax, [n**2 for sizes in patterns.values() for n in sizes])
    ax.set(xlabel="blocks of the surface $N^2$", ylabel="variance of static friction")
    ax.legend(loc="best")
