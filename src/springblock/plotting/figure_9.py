"""Figure 9: friction force and detachments on grooved pillars (section 3.3 of the paper).

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525.
"""

from collections.abc import Mapping
from string import ascii_lowercase

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from springblock.analysis.statistics import Curve, whole_curve
from springblock.plotting import style
from springblock.plotting.declaration import INTERVALS, Declaration, Realisations
from springblock.plotting.ensembles import (
    ENDS,
    FORCE,
    SINGLE,
    Runs,
    direction_color,
    draw_detachments,
    draw_force,
    draw_runs,
    enlarged_span,
    fit_forces,
    mark_load_peaks,
    name_direction,
    peaks_in_words,
)
from springblock.plotting.style import journal

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
    source=Realisations(groups=("grooves",), keys=("n_p2", "n_s2", "direction")),
)

_SHOWN = 0.8  #: share of the maximum from which the force is shown
_FORCE, _BLOCKS = (15.0, 95.0), (130.0, 57.0)  #: left edge and width of the panels, mm
_BELOW, _HEIGHT, _BETWEEN, _ABOVE = 11.0, 31.0, 6.5, 6.0


@journal
def draw(ensembles: Mapping[tuple[int, int, str], Runs]) -> Figure:
    """Draw force and detachments, a row for each configuration of grooves.

    `ensembles` holds runs by (n_p2, n_s2, direction). All rows have the same axes.
    """
    curves = {key: whole_curve(runs) for key, runs in sorted(ensembles.items())}
    rows = sorted({key[:2] for key in curves})
    step = _HEIGHT + _BETWEEN
    picture = style.figure(style.DOUBLE, _BELOW + len(rows) * step - _BETWEEN + _ABOVE)
    for i, row in enumerate(rows):
        bottom = _BELOW + (len(rows) - 1 - i) * step
        force, blocks = (style.axes(picture, x, bottom, w, _HEIGHT) for x, w in (_FORCE, _BLOCKS))
        shown = {key[2]: curve for key, curve in curves.items() if key[:2] == row}
        _draw_row(force, blocks, row, shown)
        for ax, letter in zip((force, blocks), ascii_lowercase[2 * i :], strict=False):
            ax.tick_params(labelbottom=row == rows[-1])
            style.panel_letter(ax, letter, left=11.0, above=1.0)
    _share_axes(picture, list(curves.values()))
    for ax in picture.axes[-2:]:
        ax.set_xlabel("time (µs)")
    return picture


def _draw_row(force: Axes, blocks: Axes, row: tuple[int, int], curves: Mapping[str, Curve]) -> None:
    """Draw one configuration, with triangles above its load peaks."""
    for direction, curve in curves.items():
        color = direction_color(direction)
        draw_runs(force, curve, color)
        draw_force(force, curve, color, f"{name_direction(direction)}: {peaks_in_words(curve)}")
        mark_load_peaks(force, curve, color)
        draw_detachments(blocks, curve, color)
    force.set_ylabel(FORCE)
    force.legend(ncols=2, loc="lower right", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.2)
    name = f"$n_p^{{(2)}}/n_s^{{(2)}}$ = {row[0]}/{row[1]}"
    force.text(0.02, 0.94, name, transform=force.transAxes, va="top")


def _share_axes(picture: Figure, curves: list[Curve]) -> None:
    """The same axes in all rows."""
    span = enlarged_span(curves, _SHOWN)
    for force, blocks in zip(picture.axes[::2], picture.axes[1::2], strict=True):
        fit_forces(force, curves, span)
        blocks.set_ylim(0.0, 1.04 * max(ax.dataLim.y1 for ax in picture.axes[1::2]))
        for ax in (force, blocks):
            ax.set_xlim(span)
