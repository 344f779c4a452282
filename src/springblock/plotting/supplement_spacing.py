"""Supplement: how far apart pillars are, which the paper leaves open (section 3.2).

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525.
"""

from collections.abc import Mapping

from matplotlib.figure import Figure

from springblock.model.scene import Scene
from springblock.plotting.declaration import INTERVALS, Declaration, Realisations, Scenes
from springblock.plotting.ensembles import (
    Runs,
    draw_no_lag,
    draw_series,
    logarithmic,
    pillar_look,
    pillar_name,
    stacked_panels,
)
from springblock.plotting.style import journal


def _sizes_varied(pillars: Scenes, spacing: Scenes) -> list[Scene]:
    """Pillars of the sizes whose distance is varied."""
    sizes = {scene.n_p for scene in spacing}
    return [scene for scene in (*pillars, *spacing) if scene.n_p in sizes]


FIGURE = Declaration(
    title="Distance between pillars",
    category="Supplement",
    caption=f"""a) Static friction and b) t_max - t_avg over the distance between pillars, n_s,
    which the paper leaves open; a line for each size of the pillars. Means with {INTERVALS}.""",
    source=Realisations(groups=("pillars", "spacing"), keys=("n_p", "n_s"), pick=_sizes_varied),
)


@journal
def draw(ensembles: Mapping[tuple[int, int], Runs]) -> Figure:
    """Draw a) static friction and b) t_max - t_avg over n_s, a line for each n_p.

    `ensembles` holds runs by (n_p, n_s).
    """
    picture, panels = stacked_panels("distance between the pillars $n_s$ (blocks)")
    for n_p in sorted({n_p for n_p, _ in ensembles}):
        line = [(n_s, runs) for (size, n_s), runs in ensembles.items() if size == n_p]
        draw_series(panels, line, **pillar_look(n_p), label=pillar_name(n_p))
    draw_no_lag(panels[1])
    logarithmic(panels, [n_s for _, n_s in ensembles])
    panels[0].legend(loc="best", ncols=2)
    return picture
