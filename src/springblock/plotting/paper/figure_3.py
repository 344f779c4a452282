"""Figure 3: map of the first detachment times (section 3.1 of the paper)."""

from collections.abc import Sequence

from matplotlib.figure import Figure

from springblock.plotting import style
from springblock.plotting.declaration import Declaration, RealisationsSource
from springblock.plotting.maps import draw_key, draw_map, draw_times_bar, scale
from springblock.plotting.style import BEFORE_AFTER, journal
from springblock.simulation.run import Run

FIGURE = Declaration(
    title="First detachment times, flat surface",
    category="Figures",
    caption="""First detachment times t_det over t_max of the realisation shown in figure 2: blue
    blocks detach before the force peak, red ones after it. One realisation; a map of single events
    has no error bar. Figure 3 of the paper.""",
    source=RealisationsSource(groups=("flat",), batches=1),
)


@journal
def draw(runs: Sequence[Run]) -> Figure:
    """Map t_det/t_max of every block in runs[0]; light grey where a block is not in contact."""
    run = runs[0]
    picture, (ax,) = style.panels(style.COLUMN, 97.0)
    image = draw_map(ax, run.t_det / run.t_max)
    image.set(cmap=BEFORE_AFTER, norm=scale(run))
    draw_times_bar(ax, run)
    if not run.contact.all():
        draw_key(ax, "not in contact")
    return picture
