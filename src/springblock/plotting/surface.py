"""A patterned surface beside one of its pillars, with dimensions: common to figures 4 and 8."""

from typing import Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.patches import ConnectionPatch, Rectangle
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from springblock.model.pattern import Pattern
from springblock.plotting import style
from springblock.plotting.style import BLACK, CONTACT, GREY, NO_CONTACT

Axis = Literal["x", "y"]

_BLOCKS = ListedColormap([NO_CONTACT, CONTACT])
_GRID_LIMIT = 30  #: largest pillar whose single blocks are told apart
_HEAD = "-|>,head_length=0.5,head_width=0.18"
_HEADS = "<|-|>,head_length=0.5,head_width=0.18"

# Layout in mm: two square panels side by side, with room for dimensions above.
_LEFT, _BOTTOM, _SIDE, _BETWEEN, _HEIGHT = 12.5, 9.5, 50.0, 11.5, 70.0


def surface_and_pillar(pattern: Pattern, portion: int) -> tuple[Figure, Axes, Axes]:
    """Draw a) the first `portion` blocks of the surface each way and b) one whole pillar of it.

    Raises
    ------
    ValueError
        Where there is no whole pillar.
    """
    row, column, size = _chosen_pillar(pattern, portion)
    picture = style.figure(style.ONE_AND_A_HALF, _HEIGHT)
    surface = style.axes(picture, _LEFT, _BOTTOM, _SIDE, _SIDE)
    draw_mask(surface, pattern.contact[:portion, :portion])
    surface.set(xlabel=r"$x/l$", ylabel=r"$y/l$")
    for axis in (surface.xaxis, surface.yaxis):
        axis.set_major_locator(MaxNLocator(6, integer=True, steps=[1, 2, 4, 5, 10]))

    pillar = style.axes(picture, _LEFT + _SIDE + _BETWEEN, _BOTTOM, _SIDE, _SIDE)
    draw_mask(pillar, pattern.contact[row : row + size, column : column + size])
    _draw_block_borders(pillar, size)
    pillar.set(xlabel=r"$x_p/l$", ylabel=r"$y_p/l$")
    pillar.yaxis.tick_right()
    pillar.yaxis.set_label_position("right")

    _draw_zoom(picture, surface, pillar, (column - 0.5, row - 0.5, size))
    style.panel_letter(surface, "a", left=9.0, above=5.0)
    style.panel_letter(pillar, "b", above=5.0)
    return picture, surface, pillar


def draw_mask(ax: Axes, contact: NDArray[np.bool_]) -> AxesImage:
    """Show which blocks touch the substrate; block (x, y) covers x ± 1/2, y ± 1/2."""
    image = ax.imshow(contact, _BLOCKS, vmin=0, vmax=1, origin="lower", interpolation="nearest")
    ax.autoscale(False)  # what is drawn later measures the mask, also from outside
    return image


def draw_pillar_dimensions(ax: Axes, pattern: Pattern, size: str, spacing: str) -> None:
    """Measure the first pillar and the gap after it, above a panel that shows the surface.

    Where there is no second pillar, measure the half gap before the first.
    """
    level, (right, top) = pattern.levels[0], (ax.get_xlim()[1], ax.get_ylim()[1])
    begin = pattern.profile("x", depth=1)[0][0] - 0.5
    end = begin + level.size
    gaps = {(end, end + level.gap): spacing, (-0.5, begin): f"{spacing}$/2$"}
    gap = next((gap for gap in gaps if gap[0] < gap[1] < right), None)
    lengths = {(begin, end): size} | ({gap: gaps[gap]} if gap else {})
    edges = sorted({edge for length in lengths for edge in length})
    rows = np.flatnonzero(pattern.contact[: round(top + 0.5)].any(axis=1))
    above = top + 0.035 * (top + 0.5)
    ax.vlines(edges, rows[-1] + 0.5, above, color=GREY, linewidth=0.4, clip_on=False)
    for (start, stop), label in lengths.items():
        dimension(ax, "x", start, stop, above, label)


def dimension(
    ax: Axes, axis: Axis, start: float, end: float, at: float, label: str, narrow: bool = False
) -> None:
    """Draw a dimension arrow along `axis` from `start` to `end`, `at` on the other axis.

    All in data coordinates, which may lie outside the panel. A `narrow` length has its arrows
    outside, pointing at it, and its label where the second one begins.
    """
    along_x, middle = axis == "x", 0.5 * (start + end)

    def point(along: float) -> tuple[float, float]:
        return (along, at) if along_x else (at, along)

    if narrow:
        tail = 2.0 * (end - start)
        arrow(ax, point(start - tail), point(start))
        middle = end + tail
        arrow(ax, point(middle), point(end))
    else:
        arrow(ax, point(start), point(end), _HEADS)
    ax.annotate(
        label,
        point(middle),
        (0.0, 2.5) if along_x else (3.5, 0.0),
        textcoords="offset points",
        ha="center" if along_x else "left",
        va="bottom" if along_x else "center",
        annotation_clip=False,
    )


def arrow(
    ax: Axes,
    start: tuple[float, float],
    end: tuple[float, float],
    heads: str = _HEAD,
    color: str = BLACK,
    width: float = 0.6,
) -> None:
    """Draw an arrow whose tip is at `end`, in data coordinates, also outside the panel."""
    look = {
        "arrowstyle": heads,
        "color": color,
        "linewidth": width,
        "mutation_scale": 8.0,
        "shrinkA": 0.0,
        "shrinkB": 0.0,
        "joinstyle": "miter",
    }
    ax.annotate("", end, start, arrowprops=look, annotation_clip=False)


def draw_sliding(ax: Axes, *directions: Axis) -> None:
    """Show above the panel's right corner where the slider goes."""
    right, top = ax.get_xlim()[1], ax.get_ylim()[1]
    length = 0.11 * (top + 0.5)
    x, y = right - length, top + 0.045 * (top + 0.5)
    for direction in directions:
        tip = (x + length, y) if direction == "x" else (x, y + length)
        arrow(ax, (x, y), tip, width=1.0)
        ax.annotate(
            f"${direction}$",
            tip,
            (3.0, 0.0),
            textcoords="offset points",
            ha="left",
            va="center" if direction == "x" else "top",
            annotation_clip=False,
        )
    ax.annotate(
        "sliding direction" if len(directions) == 1 else "sliding directions",
        (x, y),
        (-4.0, 0.0),
        textcoords="offset points",
        ha="right",
        va="center",
        annotation_clip=False,
    )


def _chosen_pillar(pattern: Pattern, portion: int) -> tuple[int, int, int]:
    """Row, column and size of a pillar at the right, halfway up: next to its enlargement."""
    if not pattern.levels:
        raise ValueError("a flat surface has no pillar to enlarge")
    size = pattern.levels[0].size
    whole = [o for o in pattern.origins.tolist() if max(o) + size <= portion]
    if not whole:
        raise ValueError(f"a portion of {portion} blocks holds no whole pillar of {size} blocks")
    column = max(x for _, x in whole)
    rows = sorted(y for y, x in whole if x == column)
    return rows[len(rows) // 2], column, size


def _draw_block_borders(ax: Axes, size: int) -> None:
    """Tell single blocks apart where there is room to see them."""
    if size <= _GRID_LIMIT:
        borders = np.arange(size - 1) + 0.5
        ax.vlines(borders, -0.5, size - 0.5, color="white", linewidth=0.4)
        ax.hlines(borders, -0.5, size - 0.5, color="white", linewidth=0.4)


def _draw_zoom(picture: Figure, surface: Axes, pillar: Axes, box: tuple[float, float, int]) -> None:
    """Frame the pillar at `box` = (x, y, size) and lead from it to the panel that enlarges it."""
    x, y, size = box
    frame = Rectangle((x, y), size, size, fill=False, edgecolor=BLACK, linewidth=1.0)
    surface.add_patch(frame)
    for up in (0, 1):
        corner = (x + size, y + up * size)
        line = ConnectionPatch(
            corner, (0, up), "data", "axes fraction", axesA=surface, axesB=pillar
        )
        line.set(color=GREY, linewidth=0.5)
        picture.add_artist(line)
