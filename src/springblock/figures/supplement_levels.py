"""Supplement: a third level of the pattern; the paper expects the same of it (section 3.3).

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525.
"""

from collections.abc import Mapping

from matplotlib.figure import Figure

from springblock.figures import style
from springblock.figures.ensembles import (
    FORCE,
    Runs,
    draw_force,
    enlarged_span,
    fit_forces,
    mark_load_peaks,
    peaks_in_words,
    sliding,
)
from springblock.figures.style import BLUE, GREEN, VERMILION, journal
from springblock.statistics import common_curve

_COLORS = {2: BLUE, 3: VERMILION}
_BOTTOMS, _PANEL = (53.0, 11.0), (16.0, 71.0, 36.0)  #: left edge, width and height, mm


@journal
def draw(ensembles: Mapping[tuple[str, int], Runs]) -> Figure:
    """Draw the mean force towards its end, a) along and b) across the grooves, for each level.

    `ensembles` holds runs by (direction, number of levels). Bands are 95 % bootstrap intervals
    of the mean over runs; triangles are the load peaks of the mean.
    """
    picture = style.figure(style.COLUMN, 97.0)
    left, width, height = _PANEL
    for direction, bottom, letter in zip(("x", "y"), _BOTTOMS, "ab", strict=True):
        ax = style.axes(picture, left, bottom, width, height)
        curves = {level: common_curve(r) for (d, level), r in ensembles.items() if d == direction}
        for level, curve in sorted(curves.items()):
            color = _COLORS.get(level, GREEN)
            draw_force(ax, curve, color, f"{level} levels: {peaks_in_words(curve)}")
            mark_load_peaks(ax, curve, color)
        if curves:
            span = enlarged_span(list(curves.values()))
            ax.set_xlim(*span)
            fit_forces(ax, list(curves.values()), span)
            ax.legend(loc="lower center")
        ax.set(ylabel=FORCE, title=sliding(direction))
        style.panel_letter(ax, letter, left=12.0, above=1.5)
    picture.axes[-1].set_xlabel("time (µs)")
    return picture
