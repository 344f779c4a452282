"""Supplement: sliding at an angle to the grooves; the paper has 0 and 90 degrees (section 3.3).

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525.
"""

from collections.abc import Mapping

from matplotlib.figure import Figure

from springblock.figures.declaration import Declaration, Realisations, one_pattern
from springblock.figures.ensembles import Runs, draw_no_lag, draw_series, two_panels
from springblock.figures.style import BLUE, journal

FIGURE = Declaration(
    title="Sliding at an angle to grooves",
    category="Supplement",
    caption="""a) Static friction and b) t_max - t_avg over the angle between the sliding direction
    and the grooves, 0 and 90 degrees in the paper. Means over realisations with 95 % t
    intervals.""",
    source=Realisations(groups=("grooves", "angles"), keys=("direction",), pick=one_pattern),
)

_AXES = {"x": 0.0, "y": 90.0}  #: degrees from the grooves, which run along x


@journal
def draw(ensembles: Mapping[str, Runs]) -> Figure:
    """Draw a) static friction and b) t_max - t_avg over the angle between sliding and grooves.

    `ensembles` holds runs by sliding direction: "x", "y" or degrees from x.
    """
    picture, panels = two_panels("angle between sliding and grooves (°)")
    angles = {float(_AXES.get(name, name)): runs for name, runs in ensembles.items()}
    draw_series(panels, list(angles.items()), BLUE, marker="o")
    draw_no_lag(panels[1])
    for ax in panels:
        ax.set_xticks(sorted(angles))
        ax.margins(x=0.06, y=0.14)
    return picture
