"""Supplement: size of the surface, 120 blocks a side in the paper.

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525.
"""

from collections.abc import Mapping

from matplotlib.figure import Figure

from springblock.figures.declaration import Declaration, Realisations, Scenes, one_pattern
from springblock.figures.ensembles import (
    Runs,
    draw_no_lag,
    draw_series,
    logarithmic,
    size_colors,
    two_panels,
)
from springblock.figures.style import journal
from springblock.scene import Scene


def _two_patterns(*groups: Scenes) -> list[Scene]:
    """Flat surfaces and one kind of pillars, each with those of other sizes."""
    return one_pattern(*groups[:2]) + one_pattern(*groups[2:])


FIGURE = Declaration(
    title="Size of the surface",
    category="Supplement",
    caption="""a) Static friction and b) t_max - t_avg over the side N of a flat and of a pillared
    surface. Means over realisations with 95 % t intervals. Everything else is at N = 120,
    as in the paper.""",
    source=Realisations(
        groups=("flat", "size_flat", "pillars", "size_pillars"),
        keys=("n_p", "n_s", "n_blocks"),
        pick=_two_patterns,
    ),
)


@journal
def draw(ensembles: Mapping[tuple[int, int, int], Runs]) -> Figure:
    """Draw a) static friction and b) t_max - t_avg over N, a line for each surface.

    `ensembles` holds runs by (n_p, n_s, N), with zeros for flat surfaces.
    """
    picture, panels = two_panels("side of the surface $N$ (blocks)")
    colors = size_colors(n_p for n_p, _, _ in ensembles)
    for n_p, n_s in sorted({key[:2] for key in ensembles}):
        line = [(n, runs) for (*lengths, n), runs in ensembles.items() if lengths == [n_p, n_s]]
        name = f"$n_p$ = {n_p}, $n_s$ = {n_s}" if n_p else "flat"
        draw_series(panels, line, colors[n_p], marker="o", label=name)
    draw_no_lag(panels[1])
    logarithmic(panels, [n for *_, n in ensembles])
    panels[0].legend(loc="best")
    return picture
