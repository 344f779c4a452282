"""The picture of a surface: which blocks are in contact, and where the slider goes."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from numpy.typing import NDArray

from springblock.plotting import style
from springblock.plotting.dimensions import draw_sliding
from springblock.plotting.maps import draw_borders, draw_contact, draw_key
from springblock.plotting.style import journal

CAPTION = """A surface: blocks in contact with the substrate, dark, and others, light, as the solver
takes them; a) all of it, b) single blocks from the first corner of the contact on. The arrow shows
where the slider goes."""

_ENLARGED = 24  #: blocks along a side of what is enlarged


@journal
def draw(contact: NDArray[np.bool_], direction: str | float, name: str = "") -> Figure:
    """Draw a) a whole surface, (N, N) [y, x], and b) single blocks of it."""
    picture, (whole, detail) = style.panels(style.DOUBLE, 105.0, "ab")
    share = f"{np.count_nonzero(contact)} of {contact.size} blocks in contact, {contact.mean():.1%}"
    title = "\n".join(filter(None, [name, share.replace("%", " %")]))
    picture.suptitle(title, fontsize="medium", linespacing=1.4)
    draw_contact(whole, contact)
    draw_sliding(whole, direction)
    y, x = _corner(contact)
    window = contact[y : y + _ENLARGED, x : x + _ENLARGED]
    rows, columns = window.shape
    extent = (x - 0.5, x + columns - 0.5, y - 0.5, y + rows - 0.5)
    draw_contact(detail, window).set_extent(extent)
    detail.set(xlim=extent[:2], ylim=extent[2:])
    draw_borders(detail, window.shape, (y, x))
    draw_key(detail, "in contact", "not in contact")
    whole.add_patch(Rectangle((x - 0.5, y - 0.5), columns, rows, fill=False))
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
