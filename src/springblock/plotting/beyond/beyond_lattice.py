"""Beyond the paper: do its lengths follow the lattice or the layer?"""

from collections.abc import Mapping, Sequence
from itertools import chain

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from springblock.analysis.correlation import Correlation, side_times
from springblock.analysis.statistics import mean_interval
from springblock.beyond.friction import static_friction
from springblock.beyond.lattice import (
    Layer,
    Surfaces,
    evenly_disordered,
    fits,
    layers,
    minimum,
    refined,
    usual,
)
from springblock.beyond.question import by_scene
from springblock.beyond.resampling import FEWEST
from springblock.io.records import Record
from springblock.plotting import style
from springblock.plotting.curves import draw_band
from springblock.plotting.declaration import Declaration, RealisationsSource
from springblock.plotting.looks import shades
from springblock.plotting.points import FRICTION, draw_points, name_places
from springblock.plotting.style import BLACK, BLUE, GREY, VERMILION, Look, journal

FIGURE = Declaration(
    title="Lattice or layer",
    category="Beyond",
    caption="""a) Correlation of detachment times along the sides of the largest pillars, sliding
    along x, on lattices of different spacing l, with the layer's thickness l_z and all sizes in
    metres unchanged; bands are 95 % intervals over realisations. b) Correlation length of
    A exp(-r/l_c) on these pillars over l, over l with the same disorder per area, and over l_z;
    grey lines have slope 0 and 1. Static friction over the size of pillars for c) different l and
    d) different l_z; crosses at the foot: size of the friction-minimising pillar. Bars are 95 %
    intervals over realisations.""",
    source=RealisationsSource(groups=("lattice", "disorder", "layer"), keys=("folder",)),
)

_NAMES = {"spacing": "l", "thickness": "l_z"}


@journal
def draw(ensembles: Mapping[str, Sequence[Record]]) -> Figure:
    """Draw c(r), l_c and static friction over the spacing and the thickness.

    `ensembles` holds realisations by folder.
    """
    surfaces = layers(by_scene(list(chain.from_iterable(ensembles.values()))))
    common, alike = usual(surfaces), refined(surfaces)
    lattices = {at: sizes for at, sizes in alike.items() if at.thickness == common.thickness}
    thick = {at: sizes for at, sizes in alike.items() if at.spacing == common.spacing}
    picture, panels = style.panels(style.DOUBLE, 122.0, "ab;cd")
    _draw_correlation(panels[0], lattices)
    _draw_lengths(panels[1], lattices, evenly_disordered(surfaces), thick)
    _draw_friction(panels[2], lattices, "spacing")
    _draw_friction(panels[3], thick, "thickness")
    return picture


def _draw_correlation(ax: Axes, lattices: Surfaces) -> None:
    """c_x(r) with its band over r in µm."""
    colors = shades(at.spacing for at in lattices)
    for at, sizes in lattices.items():
        runs = list(sizes.values())[-1]
        if "x" not in runs[0].scene.sides or len(runs) < FEWEST:
            continue
        found = Correlation(side_times(runs, runs[0].scene.pattern, "x")).interval
        look: Look = {"marker": "o", "markersize": 2.0, "label": _named(at, "spacing")}
        draw_band(ax, at.spacing * np.arange(len(found.mean)), found, colors[at.spacing], **look)
    ax.axhline(0.0, color=GREY, linewidth=0.5, zorder=0)
    ax.set(xlabel="distance along the side $r$ (µm)", ylabel="time correlation $c_x(r)$")
    ax.legend(loc="upper right")


def _draw_lengths(ax: Axes, lattices: Surfaces, even: Surfaces, thick: Surfaces) -> None:
    """l_c on the largest pillars over l and over l_z, with guides."""
    spots: list[float] = []
    for part, varied, color, marker, label in (
        (lattices, "spacing", BLUE, "o", "over $l$"),
        (even, "spacing", VERMILION, "s", "over $l$, same disorder per area"),
        (thick, "thickness", BLACK, "^", "over $l_z$"),
    ):
        found = {at: list(fits(sizes).values())[-1:] for at, sizes in part.items()}
        lengths = {at: last.interval for at, each in found.items() for last in each}
        if lengths:
            places = [getattr(at, varied) for at in lengths]
            intervals = [at.spacing * np.array(blocks) for at, blocks in lengths.items()]  # µm
            draw_points(ax, places, intervals, color, marker=marker, label=label)
            spots += places
    ax.set_yscale("log")
    ends = np.array([min(spots), max(spots)])
    height = float(np.exp(np.mean(np.log(ax.get_ylim()))))
    for slope in (0.0, 1.0):
        guide = height * (ends / np.sqrt(ends.prod())) ** slope
        ax.plot(ends, guide, color=GREY, linewidth=0.5, linestyle=":", zorder=0)
    name_places(ax, spots)
    ax.set(xlabel="spacing $l$ or thickness $l_z$ (µm)", ylabel="correlation length $l_c$ (µm)")
    ax.set_ylim(None, 8.0 * ax.get_ylim()[1])
    ax.legend(loc="upper left")


def _named(at: Layer, varied: str) -> str:
    return f"${_NAMES[varied]}$ = {getattr(at, varied):g} µm"


def _draw_friction(ax: Axes, part: Surfaces, varied: str) -> None:
    """Static friction over the size of pillars, and where it is lowest."""
    colors = shades(getattr(at, varied) for at in part)
    for at, sizes in part.items():
        means = [mean_interval(static_friction(runs)) for runs in sizes.values()]
        color = colors[getattr(at, varied)]
        draw_points(ax, list(sizes), means, color, marker="o", label=_named(at, varied))
    low, high = ax.get_ylim()
    line = 0.06 * (high - low)
    for i, (at, sizes) in enumerate(part.items(), 1):
        place, left, right = (float(limit) for limit in minimum(sizes))
        bars = np.nan_to_num([[place - left], [right - place]])
        look: Look = {"marker": "x", "linewidth": 0.8}
        ax.errorbar([place], [low - i * line], xerr=bars, color=colors[getattr(at, varied)], **look)
    ax.set_ylim(low - (len(part) + 1) * line, high + 4.0 * line)
    name_places(ax, [size for sizes in part.values() for size in sizes])
    ax.set(xlabel="size of pillars (µm)", ylabel=FRICTION)
    ax.legend(loc="upper center", ncols=2)
