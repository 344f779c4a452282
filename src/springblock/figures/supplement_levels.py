"""Supplement: a third level of the pattern; the paper expects the same of it (section 3.3).

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525.
"""

from collections.abc import Mapping
from itertools import chain

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from springblock.figures import style
from springblock.figures.declaration import Declaration, Realisations, Scenes
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
from springblock.scene import Scene
from springblock.statistics import Curve, common_curve

_COLORS = {2: BLUE, 3: VERMILION}
_BOTTOMS, _PANEL = (53.0, 11.0), (16.0, 71.0, 38.0)  #: left edge, width and height, mm


def _along_and_across(*groups: Scenes) -> list[Scene]:
    return [scene for scene in chain(*groups) if scene.direction in ("x", "y")]


FIGURE = Declaration(
    title="A third level",
    category="Supplement",
    caption="""Friction force over the normal force towards the end of a run, on patterns of two and
    of three levels, sliding a) along and b) across the grooves. Means over realisations with 95 %
    t intervals; triangles are load peaks of the mean, as in figure 9. The paper expects
    that its effects remain on further levels.""",
    source=Realisations(
        groups=("grooves", "third_level"), keys=("direction", "level"), pick=_along_and_across
    ),
)


@journal
def draw(ensembles: Mapping[tuple[str, int], Runs]) -> Figure:
    """Draw the mean force towards its end, a) along and b) across the grooves, for each level.

    `ensembles` holds runs by (direction, number of levels).
    """
    curves = {key: common_curve(runs) for key, runs in sorted(ensembles.items())}
    span = enlarged_span(list(curves.values()))
    picture = style.figure(style.COLUMN, 97.0)
    left, width, height = _PANEL
    for direction, bottom, letter in zip(("x", "y"), _BOTTOMS, "ab", strict=True):
        ax = style.axes(picture, left, bottom, width, height)
        shown = {level: curve for (name, level), curve in curves.items() if name == direction}
        _draw_direction(ax, shown, span)
        ax.text(0.98, 0.95, sliding(direction), transform=ax.transAxes, ha="right", va="top")
        style.panel_letter(ax, letter, left=12.0, above=1.5)
    upper, lower = picture.axes
    upper.tick_params(labelbottom=False)
    lower.set_xlabel("time (µs)")
    return picture


def _draw_direction(ax: Axes, curves: Mapping[int, Curve], span: tuple[float, float]) -> None:
    """Draw the curves of one sliding direction by number of levels, and their load peaks."""
    for level, curve in curves.items():
        color = _COLORS.get(level, GREEN)
        draw_force(ax, curve, color, f"{level} levels: {peaks_in_words(curve)}")
        mark_load_peaks(ax, curve, color)
    ax.set(xlim=span, ylabel=FORCE)
    if curves:
        fit_forces(ax, list(curves.values()), span)
        ax.legend(loc="lower center")
