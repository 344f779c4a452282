"""Figure 4: square pillars, and the coordinates on one of them (section 3.2 of the paper)."""

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from springblock.model.pattern import Pattern
from springblock.plotting.declaration import Declaration, PatternSource
from springblock.plotting.dimensions import Axis, dimension, draw_sliding
from springblock.plotting.paper.pillar import draw_pillar_dimensions, surface_and_pillar
from springblock.plotting.style import BLACK, BLUE, CONTACT, VERMILION, Look, journal

FIGURE = Declaration(
    title="Square pillars",
    category="Figures",
    caption="""Square pillars, drawn from the mask that the solver uses, with the coordinates (x_p,
    y_p) of one pillar. Figure 4 of the paper.""",
    source=PatternSource(),
)

#: Distances of the two lines of text from the side that they describe, as shares of its length.
_LINES = (0.05, 0.16)
_POINT: Look = {
    "color": "white",
    "markeredgecolor": BLACK,
    "markeredgewidth": 0.6,
    "markersize": 4.0,
    "clip_on": False,
    "zorder": 5,
}
_BEHIND = {"facecolor": CONTACT, "edgecolor": "none", "pad": 0.8}  #: hides borders of blocks


@journal
def draw(pattern: Pattern) -> Figure:
    """Draw a) the first three pillars each way and b) one pillar with its sides.

    The side along x is y_p = 0, the side
    along y is x_p = 0; the correlation functions c_x and c_y start at their centres (n_p/2, 0) and
    (0, n_p/2).
    """
    portion = 3 * sum(level.size + level.gap for level in pattern.levels[:1])
    picture, surface, pillar = surface_and_pillar(pattern, portion)
    draw_pillar_dimensions(surface, pattern, "$n_p$", "$n_s$")
    size = pattern.levels[0].size
    names = {0: "$0$", size // 2: "$n_p/2$", size - 1: "$n_p-1$"}
    for axis in (pillar.xaxis, pillar.yaxis):
        axis.set_ticks(list(names), labels=list(names.values()))
    draw_sliding(pillar, "x")
    _draw_side(pillar, "x", size, BLUE)
    _draw_side(pillar, "y", size, VERMILION)
    return picture


def _draw_side(ax: Axes, along: Axis, size: int, color: str) -> None:
    """Mark the blocks of one side, its centre, and a distance r of its correlation function."""

    def point(along_side: float, inwards: float) -> tuple[float, float]:
        return (along_side, inwards) if along == "x" else (inwards, along_side)

    def write(label: str, along_side: float, inwards: float) -> None:
        where = point(along_side, inwards)
        ax.text(*where, label, ha="center", va="center", rotation=rotation, bbox=_BEHIND)

    rotation = 0.0 if along == "x" else 90.0
    centre, other = size // 2, size // 2 + max(1, size // 5)
    corners = ((-0.5, -0.5), (size - 0.5, -0.5), (size - 0.5, 0.5), (0.5, 0.5))
    ax.add_patch(Polygon([point(*corner) for corner in corners], color=color, linewidth=0.0))
    for place, look in ((centre, "o"), (other, "s")):
        ax.plot(*point(place, 0.0), look, **_POINT)
    first, second = (0.5 + line * size for line in _LINES)
    dimension(ax, along, centre, other, first, "$r$")
    write("$(n_p/2, 0)$" if along == "x" else "$(0, n_p/2)$", centre - 0.12 * size, first)
    write(f"side along ${along}$: $c_{along}(r)$", centre, second)
