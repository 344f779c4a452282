"""Figure 1: the spring-block model (section 2 of the paper)."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from numpy.typing import NDArray

from springblock.model.pattern import Pattern
from springblock.plotting import style
from springblock.plotting.declaration import Declaration, Source
from springblock.plotting.dimensions import Axis, Point, arrow, dimension
from springblock.plotting.style import BLACK, CONTACT, GREY, NO_CONTACT, Look, journal

FIGURE = Declaration(
    title="The model",
    category="Figures",
    caption="""The model: a) the mesh of internal springs, drawn from a list of bonds that is tested
    against the energy of all springs; b) side view of the slider, moving at constant velocity v,
    and of the shear springs K_s. Figure 1 of the paper.""",
    source=Source(),
)

#: One bond of each kind that leaves a block, as (dx, dy) in units of l: every spring once.
BONDS = ((1, 0), (0, 1), (1, 1), (-1, 1))

# Drawn lengths are in units of l. Blocks are points in the model; here they have a size.
_MESH_WIDTH, _SIDE_WIDTH = 4.6, 9.0  #: of panels a and b
_MESH = 4  #: blocks along a side of panel a
_SIDE_VIEW = Pattern.pillars(8, n_p=2, n_s=2).contact[2]
_BLOCK = 0.3
_KEYS = -1.12  #: height of the legends
_GROOVE = 0.45  #: height of the pillars
_LAYER = 1.5  #: l_z
_SLAB = 0.4  #: height of slider and substrate
_DRAG = 0.25  #: how far the slider has run ahead of the blocks
_SWING, _LEAD, _TURNS = 0.08, 0.23, 5  #: of a spring: half width, straight ends, turns per l

_AXIAL: Look = {"colors": BLACK, "linewidths": 0.9}
_DIAGONAL: Look = {"colors": GREY, "linewidths": 0.6}
_SHEAR: Look = {"colors": BLACK, "linewidths": 0.7}


@dataclass(frozen=True)
class Spring:
    """An internal spring at rest; lengths in units of l, stiffness in units of K_int."""

    start: Point
    end: Point
    stiffness: float


def mesh(n: int) -> Iterator[Spring]:
    """Yield every internal spring of n x n blocks."""
    for y, x in np.ndindex(n, n):
        for dx, dy in BONDS:
            if 0 <= x + dx < n and y + dy < n:
                stiffness = 1.0 if 0 in (dx, dy) else 0.5
                yield Spring((x, y), (x + dx, y + dy), stiffness)


@journal
def draw() -> Figure:
    """Draw a) the mesh of internal springs and b) the side view with slider and shear springs."""
    ratios = (_MESH_WIDTH, _SIDE_WIDTH)
    picture, panels = style.panels(style.ONE_AND_A_HALF, 51.0, "ab", width_ratios=ratios)
    for ax, left, width in zip(panels, (-1.0, -0.85), ratios, strict=True):
        ax.set(xlim=(left, left + width), ylim=(-1.35, 3.4), aspect="equal")
        ax.set_axis_off()
    _draw_mesh(panels[0])
    _draw_side_view(panels[1])
    return picture


def _draw_mesh(ax: Axes) -> None:
    springs = list(mesh(_MESH))
    kinds = ((0.5, _DIAGONAL, 1.7, r"$K_\mathrm{int}/2$"), (1.0, _AXIAL, 0.1, r"$K_\mathrm{int}$"))
    for stiffness, look, key, name in kinds:
        _draw_springs(ax, [(s.start, s.end) for s in springs if s.stiffness == stiffness], look)
        _draw_springs(ax, [((key, _KEYS), (key + 0.75, _KEYS))], look)
        ax.text(key + 0.82, _KEYS, name, va="center")
    for y, x in np.ndindex(_MESH, _MESH):
        _draw_block(ax, x, y - _BLOCK / 2, CONTACT)
    _draw_length(ax, "x", (0.0, 1.0), -0.58, -_BLOCK / 2, "$l$")
    _draw_length(ax, "y", (0.0, 1.0), -0.58, -_BLOCK / 2, "$l$")
    _draw_axes(ax, (-0.85, -1.2), "x", "y")


def _draw_side_view(ax: Axes) -> None:
    n, underside = len(_SIDE_VIEW), _GROOVE + _LAYER
    middle, top = _GROOVE + _BLOCK / 2, _GROOVE + _BLOCK
    _draw_springs(ax, [((x, middle), (x + 1.0, middle)) for x in range(n - 1)], _AXIAL)
    _draw_springs(ax, [((x, top), (x + _DRAG, underside)) for x in range(n)], _SHEAR)
    for x, touches in enumerate(_SIDE_VIEW):
        foot = _GROOVE if touches else 0.0
        _draw_block(ax, x, _GROOVE - foot, CONTACT if touches else NO_CONTACT, _BLOCK + foot)
    _draw_slab(ax, -0.3, n - 0.4, -_SLAB, "substrate")
    _draw_slab(ax, _DRAG - 0.3, n - 0.4, underside, "slider")
    _draw_labels(ax, middle, underside)
    for key, color, name in ((1.0, CONTACT, "in contact"), (3.2, NO_CONTACT, "not in contact")):
        _draw_block(ax, key, _KEYS - _BLOCK / 2, color)
        ax.text(key + 0.27, _KEYS, name, va="center")
    _draw_axes(ax, (-0.7, -1.2), "x", "z")


def _draw_labels(ax: Axes, middle: float, underside: float) -> None:
    """Name what the side view shows: the first groove and what is above it."""
    n = len(_SIDE_VIEW)
    left = int(np.flatnonzero(~_SIDE_VIEW[1:])[0]) + 1  # first block above a groove inside
    ax.text(left - 0.5, middle + 0.13, r"$K_\mathrm{int}$", ha="center", va="bottom")
    ax.text(left + 1.3 * _DRAG, 0.5 * (middle + underside), "$K_s$", ha="left", va="center")
    _draw_length(ax, "x", (left, left + 1.0), 0.12, _GROOVE, "$l$")
    _draw_length(ax, "y", (_GROOVE, underside), n - 0.2, n - 1 + _BLOCK / 2, "$l_z$")
    arrow(ax, (n - 2.0, underside + _SLAB + 0.25), (n - 1.0, underside + _SLAB + 0.25), width=1.0)
    ax.text(n - 0.9, underside + _SLAB + 0.25, "$v$", va="center")


def _draw_springs(ax: Axes, ends: Iterable[tuple[Point, Point]], look: Look) -> None:
    ax.add_collection(LineCollection([zigzag(*pair) for pair in ends], **look), autolim=False)


def zigzag(start: Point, end: Point) -> NDArray[np.float64]:
    """Corners of a spring from `start` to `end`, (k, 2); straight where it leaves a block."""
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


def _draw_slab(ax: Axes, left: float, right: float, bottom: float, name: str) -> None:
    """Draw the slider, or hatched the substrate, which does not move."""
    fixed = name == "substrate"
    slab = Rectangle((left, bottom), right - left, _SLAB, facecolor="white")
    slab.set(edgecolor=GREY if fixed else BLACK, hatch="/////" if fixed else None)
    ax.add_patch(slab)
    behind = {"facecolor": "white", "edgecolor": "none", "pad": 1.5}
    middle = (0.5 * (left + right), bottom + 0.5 * _SLAB)
    ax.text(*middle, name, ha="center", va="center", bbox=behind)


def _draw_length(ax: Axes, axis: Axis, ends: Point, at: float, edge: float, label: str) -> None:
    """Draw a dimension arrow with lines that extend what it measures, from `edge` to it."""
    extend = ax.vlines if axis == "x" else ax.hlines
    extend(ends, at, edge, color=GREY, linewidth=0.4, zorder=0)
    dimension(ax, axis, *ends, at, label)


def _draw_axes(ax: Axes, origin: Point, right: str, up: str) -> None:
    """Draw the directions of the panel's two coordinates."""
    x, y = origin
    arrow(ax, origin, (x + 0.5, y))
    arrow(ax, origin, (x, y + 0.5))
    ax.text(x + 0.54, y, f"${right}$", va="center")
    ax.text(x, y + 0.54, f"${up}$", ha="center", va="bottom")
