"""Figures 1, 4 and 8 of the paper: the model, pillars, and grooves on pillars."""

from collections.abc import Iterable, Iterator
from itertools import product
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import ConnectionPatch, Polygon, Rectangle

from springblock.model.numbers import Array
from springblock.model.pattern import Pattern
from springblock.plotting import maps, style
from springblock.plotting.maps import Axis, Point
from springblock.plotting.style import BLACK, CONTACT, GREY, NO_CONTACT, Look

#: Stiffness over K_int of the bonds that leave a block by (dx, dy), units of l: every spring once.
BONDS = {(1, 0): 1.0, (0, 1): 1.0, (1, 1): 0.5, (-1, 1): 0.5}

# Lengths in figure 1 are in units of l. Blocks are points in the model; here they have a size.
_WIDTHS = (4.6, 9.0)  #: of panels a and b
_MESH = 4  #: blocks along a side of panel a
_SIDE_VIEW = Pattern.pillars(8, n_p=2, n_s=2).contact[2]
_BLOCK = 0.3
_KEYS = -1.12  #: height of the legends
_GROOVE = 0.45  #: height of the pillars
_LAYER = 1.5  #: l_z
_SLAB = 0.4  #: height of slider and substrate
_DRAG = 0.25  #: displacement of the slider
_SWING, _LEAD, _TURNS = 0.08, 0.23, 5  #: of a spring: half width, straight ends, turns per l

_AXIAL: Look = {"colors": BLACK, "linewidths": 0.9}
_DIAGONAL: Look = {"colors": GREY, "linewidths": 0.6}
_SHEAR: Look = {"colors": BLACK, "linewidths": 0.7}

_GRID_LIMIT = 30  #: largest pillar with borders between blocks
#: Distances of the two lines of text from the side that they describe, over its length.
_LINES = (0.05, 0.16)
_POINT: Look = {"color": "white", "markeredgecolor": BLACK, "markeredgewidth": 0.6}
_POINT |= {"markersize": 4.0, "clip_on": False, "zorder": 5}
_BEHIND = {"facecolor": CONTACT, "edgecolor": "none", "pad": 0.8}  #: hides borders of blocks


def mesh(n: int, stiffness: float) -> Iterator[tuple[Point, Point]]:
    """Yield the ends of the internal springs of a stiffness over K_int, of n x n blocks at rest."""
    bonds = [bond for bond, k in BONDS.items() if k == stiffness]
    for (y, x), (dx, dy) in product(np.ndindex(n, n), bonds):
        if 0 <= x + dx < n and y + dy < n:
            yield (x, y), (x + dx, y + dy)


def figure_1() -> Figure:
    """Draw a) the mesh of internal springs and b) the side view with slider and shear springs."""
    picture, panels = style.panels(style.ONE_AND_A_HALF, 51.0, "ab", width_ratios=_WIDTHS)
    for ax, left, width in zip(panels, (-1.0, -0.85), _WIDTHS, strict=True):
        ax.set(xlim=(left, left + width), ylim=(-1.35, 3.4), aspect="equal")
        ax.set_axis_off()
    _draw_mesh(panels[0])
    _draw_side_view(panels[1])
    return picture


def _draw_mesh(ax: Axes) -> None:
    kinds = ((0.5, _DIAGONAL, 1.7, r"$K_\mathrm{int}/2$"), (1.0, _AXIAL, 0.1, r"$K_\mathrm{int}$"))
    for stiffness, look, key, name in kinds:
        _draw_springs(ax, mesh(_MESH, stiffness), look)
        _draw_springs(ax, [((key, _KEYS), (key + 0.75, _KEYS))], look)
        ax.text(key + 0.82, _KEYS, name, va="center")
    for y, x in np.ndindex(_MESH, _MESH):
        _draw_block(ax, x, y - _BLOCK / 2, CONTACT)
    _draw_length(ax, "x", (0.0, 1.0), -0.58, -_BLOCK / 2, "$l$")
    _draw_length(ax, "y", (0.0, 1.0), -0.58, -_BLOCK / 2, "$l$")
    _draw_axes(ax, -0.85, "y")


def _draw_side_view(ax: Axes) -> None:
    n, underside = len(_SIDE_VIEW), _GROOVE + _LAYER
    middle, top = _GROOVE + _BLOCK / 2, _GROOVE + _BLOCK
    _draw_springs(ax, [((x, middle), (x + 1.0, middle)) for x in range(n - 1)], _AXIAL)
    _draw_springs(ax, [((x, top), (x + _DRAG, underside)) for x in range(n)], _SHEAR)
    for x, touches in enumerate(_SIDE_VIEW):
        foot = _GROOVE if touches else 0.0
        _draw_block(ax, x, _GROOVE - foot, CONTACT if touches else NO_CONTACT, _BLOCK + foot)
    _draw_slab(ax, -0.3, -_SLAB, "substrate", edgecolor=GREY, hatch="/////")  # it does not move
    _draw_slab(ax, _DRAG - 0.3, underside, "slider", edgecolor=BLACK)
    left = int(np.flatnonzero(~_SIDE_VIEW[1:])[0]) + 1  # first block above a groove inside
    ax.text(left - 0.5, middle + 0.13, r"$K_\mathrm{int}$", ha="center", va="bottom")
    ax.text(left + 1.3 * _DRAG, 0.5 * (middle + underside), "$K_s$", ha="left", va="center")
    _draw_length(ax, "x", (left, left + 1.0), 0.12, _GROOVE, "$l$")
    _draw_length(ax, "y", (_GROOVE, underside), n - 0.2, n - 1 + _BLOCK / 2, "$l_z$")
    above = underside + _SLAB + 0.25
    maps.arrow(ax, (n - 2.0, above), (n - 1.0, above), width=1.0)
    ax.text(n - 0.9, above, "$v$", va="center")
    for key, color, name in ((1.0, CONTACT, "in contact"), (3.2, NO_CONTACT, "not in contact")):
        _draw_block(ax, key, _KEYS - _BLOCK / 2, color)
        ax.text(key + 0.27, _KEYS, name, va="center")
    _draw_axes(ax, -0.7, "z")


def _draw_springs(ax: Axes, ends: Iterable[tuple[Point, Point]], look: Look) -> None:
    ax.add_collection(LineCollection([_zigzag(*pair) for pair in ends], **look), autolim=False)


def _zigzag(start: Point, end: Point) -> Array:
    """Return the corners of a spring, (k, 2); it is straight where it leaves a block."""
    length = float(np.hypot(end[0] - start[0], end[1] - start[1]))
    along = np.subtract(end, start) / length
    across = np.array([-along[1], along[0]])
    turns = round(_TURNS * length)
    places = np.linspace(_LEAD, length - _LEAD, 2 * turns + 2)
    swing = np.concatenate([[0.0], np.tile([_SWING, -_SWING], turns), [0.0]])
    coils = np.add(start, np.outer(places, along) + np.outer(swing, across))
    return np.vstack([start, coils, end])


def _draw_block(ax: Axes, x: float, bottom: float, color: str, height: float = _BLOCK) -> None:
    corner = (x - _BLOCK / 2, bottom)
    ax.add_patch(Rectangle(corner, _BLOCK, height, facecolor=color, edgecolor=BLACK, zorder=3))


def _draw_slab(ax: Axes, left: float, bottom: float, name: str, **look: Any) -> None:
    right = len(_SIDE_VIEW) - 0.4
    ax.add_patch(Rectangle((left, bottom), right - left, _SLAB, facecolor="white", **look))
    behind = {"facecolor": "white", "edgecolor": "none", "pad": 1.5}
    middle = (0.5 * (left + right), bottom + 0.5 * _SLAB)
    ax.text(*middle, name, ha="center", va="center", bbox=behind)


def _draw_length(ax: Axes, axis: Axis, ends: Point, at: float, edge: float, label: str) -> None:
    """Draw a dimension arrow with extension lines from `edge`."""
    extend = ax.vlines if axis == "x" else ax.hlines
    extend(ends, at, edge, color=GREY, linewidth=0.4, zorder=0)
    maps.dimension(ax, axis, *ends, at, label)


def _draw_axes(ax: Axes, x: float, up: str) -> None:
    """Draw the directions of the panel's two coordinates, below the panel."""
    y = -1.2
    maps.arrow(ax, (x, y), (x + 0.5, y))
    maps.arrow(ax, (x, y), (x, y + 0.5))
    ax.text(x + 0.54, y, "$x$", va="center")
    ax.text(x, y + 0.54, f"${up}$", ha="center", va="bottom")


def figure_4(pattern: Pattern) -> Figure:
    """Draw a) the first three pillars each way and b) one pillar with its sides.

    The side along x is y_p = 0, the side along y is x_p = 0; the correlation functions c_x and c_y
    start at their centres (n_p/2, 0) and (0, n_p/2).
    """
    portion = 3 * sum(level.size + level.gap for level in pattern.levels[:1])
    picture, surface, pillar = _surface_and_pillar(pattern, portion)
    _draw_pillar_dimensions(surface, pattern, "$n_p$", "$n_s$")
    size = pattern.levels[0].size
    names = {0: "$0$", size // 2: "$n_p/2$", size - 1: "$n_p-1$"}
    for axis in (pillar.xaxis, pillar.yaxis):
        axis.set_ticks(list(names), labels=list(names.values()))
    maps.draw_sliding(pillar, "x")
    _draw_side(pillar, "x", size, style.BLUE)
    _draw_side(pillar, "y", size, style.VERMILION)
    return picture


def _draw_side(ax: Axes, along: Axis, size: int, color: str) -> None:
    """Mark the blocks of one side, its centre, and a distance r of its correlation function."""
    centre, other = size // 2, size // 2 + max(1, size // 5)
    corners = ((-0.5, -0.5), (size - 0.5, -0.5), (size - 0.5, 0.5), (0.5, 0.5))
    places = [maps.point(along, *corner) for corner in corners]
    ax.add_patch(Polygon(places, color=color, linewidth=0.0))
    for place, marker in ((centre, "o"), (other, "s")):
        ax.plot(*maps.point(along, place, 0.0), marker, **_POINT)
    first, second = (0.5 + line * size for line in _LINES)
    maps.dimension(ax, along, centre, other, first, "$r$")
    name = "$(n_p/2, 0)$" if along == "x" else "$(0, n_p/2)$"
    look: Look = {"ha": "center", "va": "center", "rotation": 0.0 if along == "x" else 90.0}
    ax.text(*maps.point(along, centre - 0.12 * size, first), name, bbox=_BEHIND, **look)
    side = f"side along ${along}$: $c_{along}(r)$"
    ax.text(*maps.point(along, centre, second), side, bbox=_BEHIND, **look)


def figure_8(pattern: Pattern) -> Figure:
    """Draw a) the whole surface and b) one first-level pillar with its pawls and grooves.

    The slider of the paper goes along the grooves or across them: both directions are shown.
    """
    if len(pattern.levels) < 2:
        raise ValueError("figure 8 shows pillars with grooves; this pattern has no second level")
    picture, surface, pillar = _surface_and_pillar(pattern, pattern.n_blocks)
    _draw_pillar_dimensions(surface, pattern, "$n_p^{(1)}$", "$n_s^{(1)}$")
    maps.draw_sliding(pillar, "x", "y")
    _draw_groove_dimensions(pillar, pattern)
    return picture


def _draw_groove_dimensions(ax: Axes, pattern: Pattern) -> None:
    """Measure a pawl and a groove at the middle of the pillar, across the grooves."""
    across: Axis = "y" if pattern.levels[1].along == "x" else "x"
    first = pattern.profile(across, depth=1)[0][0]
    starts = [start - first - 0.5 for start, _ in pattern.profile(across, depth=2)]
    level, size = pattern.levels[1], pattern.levels[0].size
    pawl = starts[size // (level.size + level.gap) // 2]
    groove = pawl + level.size
    maps.dimension(ax, across, pawl, groove, 0.2 * size, "$n_p^{(2)}$")
    maps.dimension(ax, across, groove, groove + level.gap, 0.6 * size, "$n_s^{(2)}$", narrow=True)


def _surface_and_pillar(pattern: Pattern, portion: int) -> tuple[Figure, Axes, Axes]:
    """Draw a) the first `portion` blocks of the surface each way and b) one whole pillar of it."""
    x, y, size = _chosen_pillar(pattern, portion)
    picture, (surface, pillar) = style.panels(style.ONE_AND_A_HALF, 70.0, "ab")
    maps.draw_contact(surface, pattern.contact[:portion, :portion])
    enlarged = pattern.contact[y : y + size, x : x + size]
    maps.draw_contact(pillar, enlarged, axes="_p/l")
    if size <= _GRID_LIMIT:
        maps.draw_borders(pillar, enlarged.shape)
    pillar.yaxis.tick_right()
    pillar.yaxis.set_label_position("right")
    left, bottom = x - 0.5, y - 0.5
    frame = Rectangle((left, bottom), size, size, fill=False, edgecolor=BLACK, linewidth=1.0)
    surface.add_patch(frame)
    for up in (0, 1):
        corner = (left + size, bottom + up * size)
        ends = corner, (0, up), surface.transData, pillar.transAxes
        picture.add_artist(ConnectionPatch(*ends, color=GREY, linewidth=0.5))
    return picture, surface, pillar


def _chosen_pillar(pattern: Pattern, portion: int) -> tuple[int, int, int]:
    """Return x, y and size of a pillar at the right, halfway up: next to its enlargement."""
    if not pattern.levels:
        raise ValueError("a flat surface has no pillar to enlarge")
    size = pattern.levels[0].size
    whole = [(x, y) for y, x in pattern.origins.tolist() if max(x, y) + size <= portion]
    column = sorted(place for place in whole if place[0] == max(whole)[0])
    return *column[len(column) // 2], size


def _draw_pillar_dimensions(ax: Axes, pattern: Pattern, size: str, spacing: str) -> None:
    """Measure the first pillar and the gap after it, above a panel that shows the surface.

    A pillar that is alone has the margin of half a gap after it.
    """
    level, (_, top) = pattern.levels[0], ax.get_ylim()
    begin = pattern.profile("x", depth=1)[0][0] - 0.5
    edges = (begin, begin + level.size, min(top, begin + level.size + level.gap))
    if edges[-1] == top:
        spacing += "$/2$"
    rows = np.flatnonzero(pattern.contact[: round(top + 0.5)].any(axis=1))
    above = top + 0.035 * (top + 0.5)
    ax.vlines(edges, rows[-1] + 0.5, above, color=GREY, linewidth=0.4, clip_on=False)
    for start, stop, label in zip(edges, edges[1:], (size, spacing), strict=False):
        maps.dimension(ax, "x", start, stop, above, label)
