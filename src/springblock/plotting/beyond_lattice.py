"""Beyond the paper: do its lengths follow the lattice or the layer?

Surfaces of Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525.
"""

from collections.abc import Callable, Mapping, Sequence
from itertools import chain

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from springblock.analysis.correlation import Correlation, side_times
from springblock.analysis.statistics import Interval, mean_interval
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
from springblock.plotting.declaration import Declaration, Realisations
from springblock.plotting.ensembles import FRICTION
from springblock.plotting.style import BLACK, BLUE, GREY, VERMILION, journal
from springblock.plotting.sweeps import draw_sweep, powers, shades

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
    source=Realisations(groups=("lattice", "disorder", "layer"), keys=("folder",)),
)

_WIDTH, _HEIGHT = 76.0, 47.0  #: of a panel, mm
_PLACES = {"a": (14.0, 70.0), "b": (110.0, 70.0), "c": (14.0, 10.0), "d": (110.0, 10.0)}


@journal
def draw(ensembles: Mapping[str, Sequence[Record]]) -> Figure:
    """Draw c(r), l_c and static friction over the spacing and the thickness.

    `ensembles` holds realisations by folder.
    """
    surfaces = layers(by_scene(list(chain.from_iterable(ensembles.values()))))
    common, alike = usual(surfaces), refined(surfaces)
    lattices = {at: sizes for at, sizes in alike.items() if at.thickness == common.thickness}
    thick = {at: sizes for at, sizes in alike.items() if at.spacing == common.spacing}
    picture = style.figure(style.DOUBLE, 122.0)
    panels = {x: style.axes(picture, *at, _WIDTH, _HEIGHT) for x, at in _PLACES.items()}
    for letter, ax in panels.items():
        style.panel_letter(ax, letter, left=11.0, above=2.0)
    _draw_correlation(panels["a"], lattices)
    _draw_lengths(panels["b"], lattices, evenly_disordered(surfaces), thick)
    for letter, part, varied in (("c", lattices, "spacing"), ("d", thick, "thickness")):
        _draw_friction(panels[letter], part, varied)
    return picture


def _draw_correlation(ax: Axes, lattices: Surfaces) -> None:
    """c_x(r) with its band over r in µm."""
    colors = shades(at.spacing for at in lattices)
    for at, sizes in lattices.items():
        runs = list(sizes.values())[-1]
        if "x" not in runs[0].scene.sides or len(runs) < FEWEST:
            continue
        found = Correlation(side_times(runs, runs[0].scene.pattern, "x"))
        r, color = at.spacing * np.arange(len(found.mean)), colors[at.spacing]
        ax.fill_between(r, *found.interval[1:], color=color, alpha=0.2, linewidth=0.0)
        ax.plot(r, found.mean, color=color, marker="o", markersize=2.0, label=_named(at, "spacing"))
    ax.axhline(0.0, color=GREY, linewidth=0.5, zorder=0)
    ax.set(xlabel="distance along the side $r$ (µm)", ylabel="time correlation $c_x(r)$")
    ax.legend(loc="upper right")


def _draw_lengths(ax: Axes, lattices: Surfaces, even: Surfaces, thick: Surfaces) -> None:
    """l_c on the largest pillars over l and over l_z, with guides."""
    spots: list[float] = []
    for part, place, color, marker, label in (
        (lattices, _spacing, BLUE, "o", "over $l$"),
        (even, _spacing, VERMILION, "s", "over $l$, same disorder per area"),
        (thick, _thickness, BLACK, "^", "over $l_z$"),
    ):
        found = {at: list(fits(sizes).values())[-1:] for at, sizes in part.items()}
        lengths = {at: _micro(at, last.interval) for at, each in found.items() for last in each}
        if lengths:
            places = [place(at) for at in lengths]
            draw_sweep(ax, places, list(lengths.values()), color, marker=marker, label=label)
            spots += places
    ax.set_yscale("log")
    ends = np.array([min(spots), max(spots)])
    height = float(np.exp(np.mean(np.log(ax.get_ylim()))))
    for slope in (0.0, 1.0):
        guide = height * (ends / np.sqrt(ends.prod())) ** slope
        ax.plot(ends, guide, color=GREY, linewidth=0.5, linestyle=":", zorder=0)
    powers(ax, spots, "spacing $l$ or thickness $l_z$ (µm)")
    ax.set_ylabel("correlation length $l_c$ (µm)")
    ax.set_ylim(None, 8.0 * ax.get_ylim()[1])
    ax.legend(loc="upper left")


def _spacing(at: Layer) -> float:
    return at.spacing


def _thickness(at: Layer) -> float:
    return at.thickness


def _micro(at: Layer, blocks: Interval) -> Interval:
    return Interval(*(at.spacing * limit for limit in blocks))


def _named(at: Layer, varied: str) -> str:
    return f"${'l' if varied == 'spacing' else 'l_z'}$ = {getattr(at, varied):g} µm"


def _draw_friction(ax: Axes, part: Surfaces, varied: str) -> None:
    """Static friction over the size of pillars, and where it is lowest."""
    value: Callable[[Layer], float] = _spacing if varied == "spacing" else _thickness
    colors = shades(value(at) for at in part)
    places = sorted({size for sizes in part.values() for size in sizes})
    for at, sizes in part.items():
        means = [mean_interval(static_friction(runs)) for runs in sizes.values()]
        draw_sweep(ax, list(sizes), means, colors[value(at)], marker="o", label=_named(at, varied))
    low, high = ax.get_ylim()
    for i, (at, sizes) in enumerate(part.items(), 1):
        place, left, right = (float(limit) for limit in minimum(sizes))
        foot = low - 0.06 * i * (high - low)
        bars = np.nan_to_num([[place - left], [right - place]])
        ax.errorbar([place], [foot], xerr=bars, marker="x", color=colors[value(at)], linewidth=0.8)
    ax.set_ylim(low - 0.06 * (len(part) + 1) * (high - low), high + 0.25 * (high - low))
    powers(ax, places, "size of pillars (µm)")
    ax.set_ylabel(FRICTION)
    ax.legend(loc="upper right", ncols=2)
