"""Maps of a surface, block by block, with arrows and dimensions."""

import math
from typing import Any, Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colorbar import Colorbar
from matplotlib.colors import ListedColormap, TwoSlopeNorm, to_rgb
from matplotlib.image import AxesImage
from matplotlib.patches import FancyArrowPatch, Patch
from matplotlib.ticker import MaxNLocator
from numpy.typing import ArrayLike, NDArray

from springblock.model.direction import heading, normalised
from springblock.model.numbers import Array
from springblock.plotting.style import BEFORE_AFTER, BLACK, CONTACT, NO_CONTACT, Look, color_bar
from springblock.simulation.run import Run

Axis = Literal["x", "y"]
Point = tuple[float, float]

_HEAD = "-|>,head_length=0.5,head_width=0.18"
_HEADS = "<|-|>,head_length=0.5,head_width=0.18"
_BLOCKS = ListedColormap([NO_CONTACT, CONTACT])
_KEY = {
    "in contact": CONTACT,
    "not detached": CONTACT,
    "detaching now": BLACK,
    "not in contact": NO_CONTACT,
}
_LEAST = 1e-3  #: least width of the scale on each side of t_max, over t_max


def draw_map(ax: Axes, values: ArrayLike, axes: str = "/l", **look: Any) -> AxesImage:
    """Show one value or colour per block; block (x, y) covers x ± 1/2, y ± 1/2.

    Later artists do not change the limits of the panel. `axes` follows x and y in their names;
    `look` are further arguments of `Axes.imshow`.
    """
    image = ax.imshow(values, origin="lower", interpolation="nearest", **look)
    ax.autoscale(False)
    ax.set(xlabel=f"$x{axes}$", ylabel=f"$y{axes}$")
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_locator(MaxNLocator(6, integer=True, steps=[1, 2, 4, 5, 10]))
    return image


def draw_contact(ax: Axes, contact: NDArray[np.bool_], axes: str = "/l", **look: Any) -> None:
    """Map the blocks in contact with the substrate."""
    draw_map(ax, contact, axes, cmap=_BLOCKS, vmin=0, vmax=1, **look)


def draw_borders(ax: Axes, shape: tuple[int, ...], corner: tuple[int, int] = (0, 0)) -> None:
    """Draw the borders between blocks, (rows, columns) from `corner` = (y, x) on."""
    (rows, columns), (y, x) = shape, corner
    look: Look = {"color": "white", "linewidth": 0.4}
    ax.vlines(x + np.arange(columns - 1) + 0.5, y - 0.5, y + rows - 0.5, **look)
    ax.hlines(y + np.arange(rows - 1) + 0.5, x - 0.5, x + columns - 0.5, **look)


def draw_mean_times(ax: Axes, times: Array, label: str, axes: str = "/l") -> None:
    """Map mean t_det/t_max on a scale of its own."""
    norm = scale(times)
    image = draw_map(ax, times, axes, cmap=BEFORE_AFTER, norm=norm)
    _cut(color_bar(ax, image, f"{label} (two scales)", ticks=_ticks(norm)))


def scale(times: Array) -> TwoSlopeNorm:
    """Return the scale of t_det/t_max, some finite: from the first to 1, from there to the last."""
    least, most = float(np.nanmin(times)), float(np.nanmax(times))
    return TwoSlopeNorm(1.0, min(least, 1.0 - _LEAST), max(most, 1.0 + _LEAST))


def _ticks(norm: TwoSlopeNorm) -> list[float]:
    """Return a few round times on each side of 1."""
    found = MaxNLocator(3, steps=[1, 2, 5, 10]).tick_values
    sides = ((float(norm.vmin or 0.0), 1.0), (1.0, float(norm.vmax or 2.0)))
    return sorted({tick for low, high in sides for tick in found(low, high) if low <= tick <= high})


def draw_times(ax: Axes, run: Run, until: float = math.inf) -> AxesImage:
    """Map the blocks of a run that have detached until a time in s, with the colours below."""
    if np.isfinite(run.t_det).any():
        label = r"first detachment $t_\mathrm{det}/t_\mathrm{max}$ (two scales)"
        norm = scale(run.t_det / run.t_max)
        look: Look = {"orientation": "horizontal", "ticks": _ticks(norm)}
        bar = _cut(color_bar(ax, ScalarMappable(norm, BEFORE_AFTER), label, **look))
        look = {"va": "bottom", "transform": bar.transAxes}
        bar.text(0.0, 1.15, "precursors", ha="left", **look)
        bar.text(1.0, 1.15, "after the force peak", ha="right", **look)
    return draw_map(ax, painted(run, until))


def _cut(bar: Colorbar) -> Axes:
    """Cut a bar of two scales where the second one begins, and return its panel."""
    line = bar.ax.axhline if bar.orientation == "vertical" else bar.ax.axvline
    line(1.0, -0.15, 1.15, color="white", linewidth=2.0, clip_on=False, zorder=10.0)
    return bar.ax


def painted(run: Run, until: float = math.inf, since: float = math.inf) -> Array:
    """Return the colours of all blocks at a time in s, (N_y, N_x, 3).

    Detached blocks have the colour of their time, or are black if they detached after `since`;
    other blocks in contact and blocks out of contact have colours of their own.
    """
    image = np.where(run.contact[..., None], to_rgb(CONTACT), to_rgb(NO_CONTACT))
    detached = run.t_det <= until
    if detached.any():
        colours = BEFORE_AFTER(scale(run.t_det / run.t_max)(run.t_det[detached] / run.t_max))
        image[detached] = colours[:, :3]
    image[detached & (run.t_det > since)] = to_rgb(BLACK)
    return image


def draw_key(ax: Axes, *names: str) -> None:
    """Draw a legend of block colours above a map."""
    handles = [Patch(color=_KEY[name], label=name) for name in names]
    look: Look = {"columnspacing": 1.0, "handlelength": 1.0, "bbox_to_anchor": (1.0, 1.0)}
    ax.legend(handles=handles, loc="lower right", ncols=3, **look)


def dimension(
    ax: Axes, axis: Axis, start: float, end: float, at: float, label: str, narrow: bool = False
) -> None:
    """Draw a dimension arrow along `axis` from `start` to `end`, `at` on the other axis.

    All in data coordinates, which may lie outside the panel. A `narrow` length has its arrows
    outside, pointing at it, and its label where the second one begins.
    """
    along_x, middle = axis == "x", 0.5 * (start + end)
    if narrow:
        tail = 2.0 * (end - start)
        arrow(ax, point(axis, start - tail, at), point(axis, start, at))
        middle = end + tail
        arrow(ax, point(axis, middle, at), point(axis, end, at))
    else:
        arrow(ax, point(axis, start, at), point(axis, end, at), _HEADS)
    aside = (0.0, 2.5) if along_x else (3.5, 0.0)  # points
    look: Look = {"ha": "center" if along_x else "left"}
    look |= {"va": "bottom" if along_x else "center", "textcoords": "offset points"}
    ax.annotate(label, point(axis, middle, at), aside, annotation_clip=False, **look)


def point(axis: Axis, along: float, at: float) -> Point:
    """Return the point (x, y) at `along` on an axis and `at` on the other one."""
    return (along, at) if axis == "x" else (at, along)


def arrow(ax: Axes, start: Point, end: Point, heads: str = _HEAD, width: float = 0.6) -> None:
    """Draw an arrow whose tip is at `end`, in data coordinates, also outside the panel."""
    look: Look = {"shrinkA": 0.0, "shrinkB": 0.0, "mutation_scale": 8.0}
    look |= {"color": BLACK, "linewidth": width, "joinstyle": "miter"}
    look |= {"clip_on": False, "zorder": 3}
    ax.add_artist(FancyArrowPatch(start, end, arrowstyle=heads, **look))


def draw_sliding(ax: Axes, *directions: str | float) -> None:
    """Show the sliding direction above the panel's right corner: "x", "y" or degrees from x."""
    right, top = ax.get_xlim()[1], ax.get_ylim()[1]
    size = max(right, top) + 0.5
    length, corner = 0.1 * size, np.array([right - 0.1 * size, top + 0.05 * size])
    for direction in directions:
        way = length * np.array(heading(direction))
        start = corner - way.clip(max=0.0)
        arrow(ax, tuple(start), tuple(start + way), width=1.0)
    names = [normalised(direction) for direction in directions]
    angles = ", ".join(f"${name}$" if name in ("x", "y") else f"{name}°" for name in names)
    label = f"sliding direction{'s' if len(names) > 1 else ''} {angles}"
    ax.text(corner[0] - 0.03 * size, corner[1], label, ha="right", va="center")
