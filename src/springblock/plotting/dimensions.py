"""Arrows and lengths beside what they measure, in a panel's own coordinates."""

from typing import Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import FancyArrowPatch

from springblock.model.direction import heading, normalised
from springblock.plotting.style import BLACK, Look

Axis = Literal["x", "y"]
Point = tuple[float, float]

_HEAD = "-|>,head_length=0.5,head_width=0.18"
_HEADS = "<|-|>,head_length=0.5,head_width=0.18"


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
    """Show above the panel's right corner where the slider goes: "x", "y" or degrees from x."""
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
