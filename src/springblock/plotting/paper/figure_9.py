"""Figure 9: friction force and detachments on grooved pillars (section 3.3 of the paper)."""

from collections.abc import Mapping, Sequence
from string import ascii_lowercase

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from springblock.analysis.statistics import Curve, whole_curve
from springblock.plotting import style
from springblock.plotting.curves import (
    ENDS,
    SINGLE,
    draw_detachments,
    draw_load_peaks,
    draw_single_forces,
    enlarged_span,
    fit_forces,
)
from springblock.plotting.declaration import INTERVALS, Declaration, RealisationsSource
from springblock.plotting.looks import direction_color, direction_name
from springblock.plotting.style import FORCE, Look, journal
from springblock.simulation.run import Run

FIGURE = Declaration(
    title="Force and detachments, grooved pillars",
    category="Figures",
    caption=f"""Friction force over the normal force, at the left, and share of first detachments in
    each bin, at the right, on pillars with grooves, for each sliding direction; a row for each
    width of pawls and grooves, n_p2/n_s2. Thin lines: single runs, the first {SINGLE};
    thick ones: means with {INTERVALS}. The panels begin where a force has reached 80 % of its
    maximum; before, it grows with time. {ENDS} Triangles are load peaks of the mean as long as
    all runs go on: those that stand out by more than two standard errors and 1 % of the largest
    force, and reach 90 % of it.
    Figure 9 of the paper, which does not give its sizes.""",
    source=RealisationsSource(groups=("grooves",), keys=("n_p2", "n_s2", "direction")),
)

_SHOWN = 0.8  #: share of the maximum from which the force is shown


@journal
def draw(ensembles: Mapping[tuple[int, int, str], Sequence[Run]]) -> Figure:
    """Draw force and detachments, a row for each configuration of grooves.

    `ensembles` holds runs by (n_p2, n_s2, direction). All rows have the same axes.
    """
    curves = {key: whole_curve(runs) for key, runs in sorted(ensembles.items())}
    rows = sorted({key[:2] for key in curves})
    letters = [ascii_lowercase[2 * i : 2 * i + 2] for i in range(len(rows))]
    look: Look = {"width_ratios": (95, 57), "sharex": True}
    height = 17.0 + 37.5 * len(rows)
    picture, panels = style.panels(style.DOUBLE, height, ";".join(letters), **look)
    for force, blocks, row in zip(panels[::2], panels[1::2], rows, strict=True):
        shown = {key[2]: curve for key, curve in curves.items() if key[:2] == row}
        _draw_row(force, blocks, row, shown)
        fit_forces(force, list(curves.values()), enlarged_span(list(curves.values()), _SHOWN))
        blocks.sharey(panels[1])
    panels[1].set_ylim(0.0, 1.04 * max(ax.dataLim.y1 for ax in panels[1::2]))
    for ax in panels[-2:]:
        ax.set_xlabel("time (µs)")
    return picture


def _draw_row(force: Axes, blocks: Axes, row: tuple[int, int], curves: Mapping[str, Curve]) -> None:
    """Draw one configuration, with triangles above its load peaks."""
    for direction, curve in curves.items():
        color = direction_color(direction)
        draw_single_forces(force, curve, color)
        draw_load_peaks(force, curve, color, direction_name(direction))
        draw_detachments(blocks, curve, color)
    force.set_ylabel(FORCE)
    force.legend(ncols=2, loc="lower right", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.2)
    name = f"$n_p^{{(2)}}/n_s^{{(2)}}$ = {row[0]}/{row[1]}"
    force.text(0.02, 0.94, name, transform=force.transAxes, va="top")
