"""Supplement: how far apart pillars are, which the paper leaves open (section 3.2)."""

from collections.abc import Mapping, Sequence

from matplotlib.figure import Figure

from springblock.model.scene import Scene
from springblock.plotting.declaration import INTERVALS, Declaration, RealisationsSource, Scenes
from springblock.plotting.looks import pillar_look, pillar_name
from springblock.plotting.points import draw_series, friction_and_lag, name_places
from springblock.plotting.style import journal
from springblock.simulation.run import Run


def _sizes_varied(pillars: Scenes, spacing: Scenes) -> list[Scene]:
    """Pillars of the sizes whose distance is varied."""
    sizes = {scene.n_p for scene in spacing}
    return [scene for scene in (*pillars, *spacing) if scene.n_p in sizes]


FIGURE = Declaration(
    title="Distance between pillars",
    category="Supplement",
    caption=f"""a) Static friction and b) t_max - t_avg over the distance between pillars, n_s,
    which the paper leaves open; a line for each size of the pillars. Means with {INTERVALS}.""",
    source=RealisationsSource(
        groups=("pillars", "spacing"), keys=("n_p", "n_s"), pick=_sizes_varied
    ),
)


@journal
def draw(ensembles: Mapping[tuple[int, int], Sequence[Run]]) -> Figure:
    """Draw a) static friction and b) t_max - t_avg over n_s, a line for each n_p.

    `ensembles` holds runs by (n_p, n_s).
    """
    picture, panels = friction_and_lag("distance between the pillars $n_s$ (blocks)")
    for n_p in sorted({n_p for n_p, _ in ensembles}):
        by_gap = {n_s: runs for (size, n_s), runs in ensembles.items() if size == n_p}
        draw_series(panels, by_gap, **pillar_look(n_p), label=pillar_name(n_p))
    name_places(panels[0], [n_s for _, n_s in ensembles])
    panels[0].legend(loc="best", ncols=2)
    return picture
