"""Figure 9: friction force and detachments on grooved pillars (section 3.3 of the paper).

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525.
"""

from collections.abc import Mapping
from itertools import cycle

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from springblock.figures import style
from springblock.figures.declaration import Declaration, Realisations
from springblock.figures.ensembles import (
    FORCE,
    Runs,
    draw_detachments,
    draw_force,
    enlarged_span,
    fit_forces,
    mark_load_peaks,
    peaks_in_words,
    sliding,
)
from springblock.figures.style import BLUE, GREEN, PURPLE, VERMILION, journal
from springblock.statistics import Curve, common_curve

FIGURE = Declaration(
    title="Force and detachments, grooved pillars",
    category="Figures",
    caption="""Friction force over the normal force and share of first detachments in each bin on
    pillars with grooves, for each sliding direction; b) and d) enlarge the end. Means over
    realisations with 95 % t intervals. Triangles are load peaks of the mean: those that
    stand out by more than two standard errors and 1 % of the largest force, and reach 90 % of it.
    Figure 9 of the paper.""",
    source=Realisations(groups=("grooves",), keys=("direction",)),
)

_COLUMNS = ((18.0, 75.0), (111.0, 75.0))  #: left edge and width of the panels, mm
_ROWS = ((54.0, 40.0), (11.0, 37.0))  #: lower edge and height
_COLORS = (BLUE, VERMILION, GREEN, PURPLE)


@journal
def draw(ensembles: Mapping[str, Runs]) -> Figure:
    """Draw a), b) the mean force and c), d) detachments for each sliding direction.

    The left panels show the whole run, the right ones its end, with the peaks of `load_peaks`.
    """
    curves = {direction: common_curve(runs) for direction, runs in sorted(ensembles.items())}
    span = enlarged_span(list(curves.values()))
    picture = style.figure(style.DOUBLE, 100.0)
    for (left, width), letters in zip(_COLUMNS, ("ac", "bd"), strict=True):
        force, blocks = (style.axes(picture, left, bottom, width, h) for bottom, h in _ROWS)
        for (direction, curve), color in zip(curves.items(), cycle(_COLORS), strict=False):
            _draw_direction(force, blocks, direction, curve, color)
        force.set_ylabel(FORCE)
        force.tick_params(labelbottom=False)
        blocks.set(xlabel="time (µs)", ylim=(0.0, None))
        for ax, letter in zip((force, blocks), letters, strict=True):
            style.panel_letter(ax, letter, left=12.0, above=1.5)
            ax.set_xlim(*(span if letter in "bd" else (0.0, span[1])))
    whole, whole_blocks, enlarged, _ = picture.axes
    for ax in (whole, whole_blocks):
        name = "enlarged at the right" if ax is whole else None
        ax.axvspan(*span, color="0.93", linewidth=0.0, zorder=0, label=name)
    whole.margins(y=0.15)  # room for triangles
    whole.set_ylim(0.0, None)
    whole.legend(loc="lower right")
    fit_forces(enlarged, list(curves.values()), span)
    return picture


def _draw_direction(force: Axes, blocks: Axes, direction: str, curve: Curve, color: str) -> None:
    """Draw both curves of one sliding direction, and triangles above its load peaks."""
    draw_force(force, curve, color, f"{sliding(direction)}: {peaks_in_words(curve)}")
    mark_load_peaks(force, curve, color)
    draw_detachments(blocks, curve, color)
