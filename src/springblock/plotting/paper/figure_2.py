"""Figure 2: friction force and detaching blocks over time (section 3.1 of the paper)."""

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from springblock.plotting import style
from springblock.plotting.declaration import Declaration, RealisationsSource
from springblock.plotting.dimensions import arrow
from springblock.plotting.one_run import draw_blocks, draw_force, mark_times, name_times
from springblock.plotting.style import MICRO, journal
from springblock.simulation.run import Run

FIGURE = Declaration(
    title="Force and detachments, flat surface",
    category="Figures",
    caption="""Friction force on a flat surface over the normal force, and share of blocks that
    detach in each sample interval. Dotted: t_max, the time of the force maximum; solid: t_avg, the
    mean first detachment time. One realisation, the first seed, in front of the whole ensemble.
    Figure 2 of the paper.""",
    source=RealisationsSource(groups=("flat",)),
)

_BEFORE, _AFTER = 15e-6, 9e-6  #: s around t_max that are enlarged


@journal
def draw(runs: Sequence[Run]) -> Figure:
    """Draw runs[0] before the spread of the other runs: a), b) force and c), d) blocks.

    The left panels show the whole run, the right ones the time around the force maximum.

    Raises
    ------
    ValueError
        Where the other runs do not share one sample interval.
    """
    run, others = runs[0], runs[1:]
    zoom = (MICRO * (run.t_max - _BEFORE), MICRO * (run.t_max + _AFTER))
    whole = (0.0, MICRO * float(run.time[-1]))
    picture, panels = style.panels(style.DOUBLE, 95.0, "ab;cd", width_ratios=(82, 71))
    for upper, lower, span in zip(panels[:2], panels[2:], (whole, zoom), strict=True):
        draw_force(upper, run, others, span)
        draw_blocks(lower, run, others)
        for ax in (upper, lower):
            mark_times(ax, run)
            ax.set_xlim(span)
        name_times(upper, run)
        upper.tick_params(labelbottom=False)
        lower.set_xlabel("time (µs)")
    force, _, blocks, enlarged = panels
    for ax, name in ((force, "enlarged at the right"), (blocks, None)):
        ax.axvspan(*zoom, color="0.93", linewidth=0.0, zorder=0, label=name)
    early = 2.0 * run.t_max < run.time[-1]  # room beside the peak
    force.legend(loc="lower right" if early else "upper left")
    blocks.legend(loc="upper right" if early else "upper left")
    _name_precursors(enlarged, run, zoom[0])
    return picture


def _name_precursors(ax: Axes, run: Run, start: float) -> None:
    """Point from t_max back to the detachments that come before it."""
    end, height = MICRO * run.t_max, 6.0
    arrow(ax, (end, height), (end - 0.8 * (end - start), height))
    ax.text(end - 0.4 * (end - start), 1.3 * height, "precursors", ha="center", va="bottom")
