"""Figures beyond the paper; each function takes realisations by the folder of their scene."""

from collections.abc import Mapping, Sequence
from itertools import product
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter
from pandas import DataFrame, Series
from seaborn import heatmap

from springblock.analysis.correlation import Correlation, side_times
from springblock.analysis.lowest import lowest
from springblock.beyond import friction, lattice, peaks, scatter
from springblock.beyond.question import FEWEST, Ensembles, side_length
from springblock.io.records import Record
from springblock.model.numbers import Array
from springblock.plotting import curves, style
from springblock.plotting.style import BLACK, BLUE, GREY, VERMILION, Look

Folders = Mapping[str, Sequence[Record]]  #: realisations by the folder of their scene

_LABELS = {"spacing": "$l$ = {:g} µm", "thickness": "$l_z$ = {:g} µm"}
_DOTS: Look = {"marker": "o", "markersize": 2.0}
_TICKS = (1, 2, 5, 10, 20, 40, 80)  #: blocks, of the map of friction
_LETTERS = ("ab", "cd")  #: of the maps of load peaks
_COLORS = "viridis_r"  #: of these maps


def _by_scene(ensembles: Folders) -> Ensembles:
    """Return the realisations of each scene."""
    return {runs[0].scene: runs for runs in ensembles.values()}


def beyond_lattice(ensembles: Folders) -> Figure:
    """Draw c(r), decay lengths and static friction over spacing and thickness."""
    surfaces = lattice.by_lattice(_by_scene(ensembles))
    compared = lattice.comparisons(surfaces)
    lattices, even, thick = (
        dict(sorted(compared[name].surfaces.items())) if name in compared else {}
        for name in ("block", "area", "layer")
    )
    picture, panels = style.panels(style.DOUBLE, 122.0, "ab;cd")
    _draw_correlation(panels[0], lattices)
    _draw_lengths(panels[1], lattices, even, thick)
    _draw_sizes(panels[2], lattices, "spacing")
    _draw_sizes(panels[3], thick, "thickness")
    return picture


def _draw_correlation(ax: Axes, lattices: lattice.Surfaces) -> None:
    """Draw c_x(r) with its band over r in µm."""
    colors = style.shades(at.spacing for at in lattices)
    for at, sizes in lattices.items():
        runs = list(sizes.values())[-1]
        if "x" not in runs[0].scene.sides or len(runs) < FEWEST:
            continue
        found = Correlation(side_times(runs, runs[0].scene.pattern, "x")).interval
        label = _LABELS["spacing"].format(at.spacing)
        look = {"color": colors[at.spacing], "label": label} | _DOTS
        curves.draw_band(ax, at.spacing * np.arange(len(found.mean)), found, **look)
    ax.axhline(0.0, **curves.ZERO)
    ax.set(xlabel="distance along the side $r$ (µm)", ylabel="time correlation $c_x(r)$")
    ax.legend(loc="upper right")


def _draw_lengths(
    ax: Axes, lattices: lattice.Surfaces, even: lattice.Surfaces, thick: lattice.Surfaces
) -> None:
    """Draw decay lengths on the largest pillars against l and l_z, with guides of slope 0 and 1."""
    spots: list[float] = []
    for part, varied, color, marker, label in (
        (lattices, "spacing", BLUE, "o", "against $l$"),
        (even, "spacing", VERMILION, "s", "against $l$, equal disorder per area"),
        (thick, "thickness", BLACK, "^", "against $l_z$"),
    ):
        found = {at: side_length(sizes[max(sizes)]) for at, sizes in part.items()}
        lengths = {at: at.spacing * np.array(blocks) for at, blocks in found.items() if blocks}
        if lengths:
            places = [getattr(at, varied) for at in lengths]
            intervals = list(lengths.values())  # µm
            curves.draw_points(ax, places, intervals, color, marker=marker, label=label)
            spots += places
    ax.set_yscale("log")
    ends = np.array([min(spots), max(spots)])
    height = float(np.exp(np.mean(np.log(ax.get_ylim()))))
    for slope in (0.0, 1.0):
        guide = height * (ends / np.sqrt(ends.prod())) ** slope
        ax.plot(ends, guide, color=GREY, linewidth=0.5, linestyle=":", zorder=0)
    curves.name_places(ax, spots)
    ax.set(xlabel="spacing $l$ or thickness $l_z$ (µm)", ylabel="decay length (µm)")
    ax.set_ylim(None, 8.0 * ax.get_ylim()[1])
    ax.legend(loc="upper left")


def _draw_friction(
    ax: Axes, lines: Mapping[float, Mapping[Any, Array]], label: str, **legend: Any
) -> None:
    """Draw static friction against the size of pillars, a line for each value in the legend."""
    colors = style.shades(lines)
    for value, samples in lines.items():
        curves.draw_means(ax, samples, colors[value], marker="o", label=label.format(value))
    curves.name_places(ax, sorted({size for samples in lines.values() for size in samples}))
    ax.set(xlabel="size $n_p$ (blocks)", ylabel=curves.FRICTION)
    ax.legend(**{"loc": "best", **legend})


def _draw_sizes(ax: Axes, part: lattice.Surfaces, varied: str) -> None:
    """Draw static friction against pillar size, and mark where it is lowest."""
    lines = {getattr(at, varied): friction.samples(sizes) for at, sizes in part.items()}
    _draw_friction(ax, lines, _LABELS[varied], loc="upper center", ncols=2)
    ax.set_xlabel("size of pillars (µm)")
    colors = style.shades(lines)
    low, high = ax.get_ylim()
    line = 0.06 * (high - low)
    for i, (value, samples) in enumerate(lines.items(), 1):
        found = lowest(samples)
        bars = [[found.place - min(found.alike)], [max(found.alike) - found.place]]
        look: Look = {"color": colors[value], "marker": "x", "linewidth": 0.8}
        ax.errorbar([found.place], [low - i * line], xerr=bars, **look)
    ax.set_ylim(low - (len(part) + 1) * line, high + 4.0 * line)


def beyond_disorder(ensembles: Folders) -> Figure:
    """Draw a) decay lengths over scatter and b) static friction over n_p by scatter."""
    scatters = scatter.by_scatter(_by_scene(ensembles))
    picture, panels = style.panels(style.DOUBLE, 64.0, "ab")
    _draw_lengths_of_scatters(panels[0], scatters)
    lines = {std: friction.samples(sizes) for std, sizes in scatters.items()}
    _draw_friction(panels[1], lines, "{:g}", title="scatter")
    return picture


def _draw_lengths_of_scatters(ax: Axes, scatters: Mapping[float, scatter.Sizes]) -> None:
    lengths = scatter.decay_lengths(scatters)
    colors = style.shades(lengths)
    for i, (n_p, fitted) in enumerate(lengths.items(), -1):
        places = [std * (1.0 + 0.03 * i) for std in fitted]
        look: Look = {"marker": "o", "label": f"$n_p$ = {n_p}"}
        curves.draw_points(ax, places, list(fitted.values()), colors[n_p], **look)
    curves.name_places(ax, list(scatters))
    ax.set(xlabel="scatter of static coefficients", ylabel="decay length (blocks)")
    ax.set_yscale("log")
    ax.yaxis.set_minor_formatter(NullFormatter())
    ax.legend(loc="best")


def beyond_friction(ensembles: Folders) -> Figure:
    """Draw a) a map of friction over n_p and n_s and b) friction for each contact fraction."""
    found = friction.friction_map(_by_scene(ensembles))
    picture, (over_both, lines) = style.panels(style.DOUBLE, 80.0, "ab")
    _draw_friction_map(over_both, found)
    families = friction.families(found).items()
    by_contact = {1.0 / (1.0 + float(kind)) ** 2: sizes for kind, sizes in families}
    _draw_friction(lines, by_contact, "{:.0%} in contact")
    return picture


def _draw_friction_map(ax: Axes, found: friction.Map) -> None:
    sizes, gaps = np.array(list(found), dtype=float).T
    means = [float(values.mean()) for values in found.values()]
    ends = np.array([0.8, 1.25 * sizes.max()])
    for kind in friction.families(found):
        ax.plot(ends, float(kind) * ends, color=GREY, linewidth=0.4, zorder=0)
    points = ax.scatter(sizes, gaps, c=means, cmap="viridis", s=34.0, marker="s", linewidths=0.0)
    ax.set(xscale="log", yscale="log")
    ax.set(xlabel="size $n_p$ (blocks)", ylabel="distance $n_s$ (blocks)")
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_ticks(_TICKS, labels=[str(tick) for tick in _TICKS])
        axis.minorticks_off()
    ax.set(xlim=ends, ylim=(0.8 * gaps.min(), 1.25 * gaps.max()))
    style.color_bar(ax, points, curves.FRICTION)


def beyond_peaks(ensembles: Folders) -> Figure:
    """Draw a map of the lesser peak for each width of grooves, with pillars and without."""
    found = peaks.by_grooves(_by_scene(ensembles))
    every = [each for angles in found.values() for each in angles.values()]
    largest = max(float(each.mean()) for each in every)
    widths = sorted({key.n_s2 for key in found})
    letters = ";".join(_LETTERS[: len(widths)])
    picture, panels = style.panels(style.ONE_AND_A_HALF, 6.0 + 55.0 * len(widths), letters)
    for ax, (n_s2, pillars) in zip(panels, product(widths, (True, False)), strict=True):
        part = {k: v for k, v in found.items() if k.n_s2 == n_s2 and bool(k.n_p) is pillars}
        if part:
            _draw_peaks(ax, part, largest)
        where = "on pillars" if pillars else "whole surface"
        ax.set_title(f"{where}, $n_{{s2}}$ = {n_s2}")
        ax.set(xlabel="angle to grooves (°)", ylabel="width of pawls $n_{p2}$ (blocks)")
    colors = ScalarMappable(Normalize(0.0, largest), _COLORS)
    picture.colorbar(colors, ax=panels, label="prominence of the lesser load peak (%)", aspect=40)
    return picture


def _draw_peaks(
    ax: Axes, part: Mapping[peaks.Grooves, Mapping[float, Series]], largest: float
) -> None:
    """Draw cells by angle and pawl, coloured and numbered."""
    means = {
        key.n_p2: {angle: float(each.mean()) for angle, each in angles.items()}
        for key, angles in part.items()
    }
    cells = DataFrame(means).sort_index().T.sort_index(ascending=False)  # by pawl and angle
    cells.columns = [f"{angle:g}" for angle in cells]
    look: Look = {"cmap": _COLORS, "vmin": 0.0, "vmax": largest, "cbar": False}
    heatmap(cells, ax=ax, annot=True, fmt=".1f", **look)
    ax.tick_params(length=0.0, rotation=0.0)
