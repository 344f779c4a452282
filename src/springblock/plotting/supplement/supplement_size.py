"""Supplement: size of the surface, 120 blocks a side in the paper."""

from collections.abc import Mapping, Sequence

from matplotlib.figure import Figure

from springblock.model.scene import Scene
from springblock.plotting.declaration import (
    INTERVALS,
    Declaration,
    RealisationsSource,
    Scenes,
    one_pattern,
)
from springblock.plotting.looks import in_order, surface_look
from springblock.plotting.points import draw_series, friction_and_lag, name_places
from springblock.plotting.style import journal
from springblock.simulation.run import Run


def _one_of_each(*groups: Scenes) -> list[Scene]:
    """One flat, one pillared and one grooved surface, each with those of other sizes, if any."""
    found = []
    for group, varied in zip(groups[::2], groups[1::2], strict=True):
        directions = {scene.direction for scene in varied}
        scenes = one_pattern(group, varied) if varied else []
        found += [scene for scene in scenes if scene.direction in directions]
    return found


FIGURE = Declaration(
    title="Size of the surface",
    category="Supplement",
    caption=f"""a) Static friction and b) t_max - t_avg over the side N of the surface: a flat one,
    a pillared one, and a grooved one where the study varies its size. Means with {INTERVALS}.
    Figures of the paper are at N = 120.""",
    source=RealisationsSource(
        groups=("flat", "size_flat", "pillars", "size_pillars"),
        also=("grooves", "size_grooves"),
        keys=("n_p", "n_p2", "direction", "n_blocks"),
        pick=_one_of_each,
    ),
)


@journal
def draw(ensembles: Mapping[tuple[int, int, str, int], Sequence[Run]]) -> Figure:
    """Draw a) static friction and b) t_max - t_avg over N, a line for each surface.

    `ensembles` holds runs by (n_p, n_p2, direction, N), with zeros for levels that are not there.
    """
    picture, panels = friction_and_lag("side of the surface $N$ (blocks)")
    for surface in in_order({key[:3] for key in ensembles}):
        name, look = surface_look(surface)
        by_size = {key[3]: runs for key, runs in ensembles.items() if key[:3] == surface}
        draw_series(panels, by_size, **look, label=name)
    name_places(panels[0], [n for *_, n in ensembles])
    panels[0].legend(loc="best")
    return picture
