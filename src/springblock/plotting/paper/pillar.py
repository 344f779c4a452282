"""A patterned surface beside one of its pillars, with dimensions: common to figures 4 and 8."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import ConnectionPatch, Rectangle

from springblock.model.pattern import Pattern
from springblock.plotting import style
from springblock.plotting.dimensions import dimension
from springblock.plotting.maps import draw_borders, draw_contact
from springblock.plotting.style import BLACK, GREY

_GRID_LIMIT = 30  #: largest pillar whose single blocks are told apart


def surface_and_pillar(pattern: Pattern, portion: int) -> tuple[Figure, Axes, Axes]:
    """Draw a) the first `portion` blocks of the surface each way and b) one whole pillar of it.

    Raises
    ------
    ValueError
        Where there is no whole pillar.
    """
    row, column, size = _chosen_pillar(pattern, portion)
    picture, (surface, pillar) = style.panels(style.ONE_AND_A_HALF, 70.0, "ab")
    draw_contact(surface, pattern.contact[:portion, :portion])
    enlarged = pattern.contact[row : row + size, column : column + size]
    draw_contact(pillar, enlarged, axes="_p/l")
    if size <= _GRID_LIMIT:
        draw_borders(pillar, enlarged.shape)
    pillar.yaxis.tick_right()
    pillar.yaxis.set_label_position("right")
    _draw_zoom(picture, surface, pillar, (column - 0.5, row - 0.5, size))
    return picture, surface, pillar


def draw_pillar_dimensions(ax: Axes, pattern: Pattern, size: str, spacing: str) -> None:
    """Measure the first pillar and the gap after it, above a panel that shows the surface."""
    level, (_, top) = pattern.levels[0], ax.get_ylim()
    begin = pattern.profile("x", depth=1)[0][0] - 0.5
    edges = (begin, begin + level.size, begin + level.size + level.gap)
    rows = np.flatnonzero(pattern.contact[: round(top + 0.5)].any(axis=1))
    above = top + 0.035 * (top + 0.5)
    ax.vlines(edges, rows[-1] + 0.5, above, color=GREY, linewidth=0.4, clip_on=False)
    for start, stop, label in zip(edges, edges[1:], (size, spacing), strict=False):
        dimension(ax, "x", start, stop, above, label)


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
