"""The picture of a surface: which blocks are in contact, and where the slider goes."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from springblock.model.direction import heading, normalised
from springblock.plotting import style
from springblock.plotting.style import BLACK, CONTACT, NO_CONTACT, journal
from springblock.plotting.surface import arrow, draw_mask

CAPTION = """A surface: blocks in contact with the substrate, dark, and others, light, as the solver
takes them; a) all of it, b) single blocks from the first corner of the contact on. The arrow shows
where the slider goes."""

_ENLARGED = 24  #: blocks along a side of what is enlarged
# Layout in mm: two square panels side by side.
_LEFT, _BOTTOM, _SIDE, _BETWEEN = 13.0, 10.0, 72.0, 20.0
_HEIGHT = 105.0


@journal
def draw(contact: NDArray[np.bool_], direction: str | float, name: str = "") -> Figure:
    """Draw a) a whole surface, (N, N) [y, x], and b) single blocks of it."""
    picture = style.figure(style.DOUBLE, _HEIGHT)
    rows, columns = contact.shape
    share = f"{np.count_nonzero(contact)} of {contact.size} blocks in contact, {contact.mean():.1%}"
    title = "\n".join(filter(None, [name, share.replace("%", " %")]))
    picture.text(0.5, 1.0 - 2.0 / _HEIGHT, title, ha="center", va="top", linespacing=1.4)
    whole = style.axes(picture, _LEFT, _BOTTOM, _SIDE, _SIDE)
    _draw_blocks(whole, contact, (0, 0))
    _draw_heading(whole, direction, max(rows, columns))
    detail = style.axes(picture, _LEFT + _SIDE + _BETWEEN, _BOTTOM, _SIDE, _SIDE)
    y, x = _corner(contact)
    window = contact[y : y + _ENLARGED, x : x + _ENLARGED]
    _draw_blocks(detail, window, (y, x))
    _draw_borders(detail, window.shape, (y, x))
    frame = Rectangle((x - 0.5, y - 0.5), window.shape[1], window.shape[0], fill=False)
    whole.add_patch(frame)
    for ax, letter in ((whole, "a"), (detail, "b")):
        style.panel_letter(ax, letter, left=9.0, above=4.0)
    key = {"in contact": CONTACT, "not in contact": NO_CONTACT}
    handles = [Patch(color=color, label=word) for word, color in key.items()]
    detail.legend(handles=handles, loc="lower right", bbox_to_anchor=(1.0, 1.02), ncols=2)
    return picture


def _corner(contact: NDArray[np.bool_]) -> tuple[int, int]:
    """Where a window begins that shows the first contact with a margin, and lies inside."""
    first = (int(np.argmax(contact.any(axis=1))), int(np.argmax(contact.any(axis=0))))
    margin = _ENLARGED // 6
    y, x = (
        max(0, min(start - margin, size - _ENLARGED))
        for start, size in zip(first, contact.shape, strict=True)
    )
    return y, x


def _draw_blocks(ax: Axes, contact: NDArray[np.bool_], corner: tuple[int, int]) -> None:
    (rows, columns), (y, x) = contact.shape, corner
    image = draw_mask(ax, contact)
    extent = (x - 0.5, x + columns - 0.5, y - 0.5, y + rows - 0.5)
    image.set_extent(extent)
    ax.set(xlabel="$x/l$", ylabel="$y/l$", xlim=extent[:2], ylim=extent[2:])
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_locator(MaxNLocator(6, integer=True, steps=[1, 2, 4, 5, 10]))


def _draw_borders(ax: Axes, shape: tuple[int, ...], corner: tuple[int, int]) -> None:
    """Tell single blocks apart."""
    (rows, columns), (y, x) = shape, corner
    look: dict[str, Any] = {"color": "white", "linewidth": 0.4}
    ax.vlines(x + np.arange(columns - 1) + 0.5, y - 0.5, y + rows - 0.5, **look)
    ax.hlines(y + np.arange(rows - 1) + 0.5, x - 0.5, x + columns - 0.5, **look)


def _draw_heading(ax: Axes, direction: str | float, size: int) -> None:
    """Arrow above the right end of the panel."""
    towards, name = heading(direction), normalised(direction)
    right, top = ax.get_xlim()[1], ax.get_ylim()[1]
    length, room = 0.1 * size, 0.07 * size
    middle = np.array([right - room, top + room])
    half = 0.5 * length * np.array(towards)
    arrow(ax, tuple(middle - half), tuple(middle + half), width=1.0, color=BLACK)
    label = f"sliding direction {name}" + ("" if name in ("x", "y") else "°")
    place = (right - 2.0 * room, top + room)
    ax.text(*place, label, ha="right", va="center", clip_on=False)
