"""Figure 8: a second level of grooves on the pillars (section 3.3 of the paper)."""

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from springblock.model.pattern import Pattern
from springblock.plotting.declaration import Declaration, PatternSource
from springblock.plotting.dimensions import Axis, dimension, draw_sliding
from springblock.plotting.paper.pillar import draw_pillar_dimensions, surface_and_pillar
from springblock.plotting.style import journal

FIGURE = Declaration(
    title="Grooved pillars",
    category="Figures",
    caption="""Pillars with grooves along x, drawn from the mask that the solver uses, with the
    coordinates of one pillar. Two pillars each way show the distance between them; the surfaces of
    figure 9 hold as many as their N has room for. Figure 8 of the paper.""",
    source=PatternSource(),
)


@journal
def draw(pattern: Pattern) -> Figure:
    """Draw a) the whole surface and b) one first-level pillar with its pawls and grooves.

    The slider of the paper goes along the grooves or across them: both directions are shown.

    Raises
    ------
    ValueError
        Where the pattern has no second level.
    """
    if len(pattern.levels) < 2:
        raise ValueError("figure 8 shows pillars with grooves; this pattern has no second level")
    picture, surface, pillar = surface_and_pillar(pattern, pattern.n_blocks)
    draw_pillar_dimensions(surface, pattern, "$n_p^{(1)}$", "$n_s^{(1)}$")
    draw_sliding(pillar, "x", "y")
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
    dimension(ax, across, pawl, groove, 0.2 * size, "$n_p^{(2)}$")
    dimension(ax, across, groove, groove + level.gap, 0.6 * size, "$n_s^{(2)}$", narrow=True)
