"""Supplement: a third level of the pattern; the paper expects the same of it (section 3.3).

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525.
"""

from collections.abc import Mapping
from dataclasses import replace

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from springblock.analysis.statistics import Curve, whole_curve
from springblock.model.scene import Scene
from springblock.plotting import style
from springblock.plotting.declaration import INTERVALS, Declaration, Realisations, Scenes
from springblock.plotting.ensembles import (
    ENDS,
    FORCE,
    Runs,
    direction_color,
    draw_force,
    enlarged_span,
    fit_forces,
    mark_load_peaks,
    name_direction,
    peaks_in_words,
)
from springblock.plotting.style import GREEN, PURPLE, journal

_BOTTOMS, _PANEL = (55.0, 11.0), (16.0, 71.0, 38.0)  #: left edge, width and height, mm


def _with_and_without(grooves: Scenes, third_level: Scenes) -> list[Scene]:
    """The first pattern of three levels along x and y, and the same without its third level."""
    cut = third_level[0]
    whole = replace(cut, n_p3=0, n_s3=0, along_3="")
    wanted = {replace(pattern, direction=way) for pattern in (cut, whole) for way in ("x", "y")}
    return [scene for scene in (*grooves, *third_level) if scene in wanted]


FIGURE = Declaration(
    title="A third level",
    category="Supplement",
    caption=f"""Friction force over the normal force towards the end of a run, on patterns of two
    and of three levels, sliding a) along and b) across the grooves. Means with {INTERVALS};
    triangles are load peaks of the mean, as in figure 9. {ENDS} The paper expects that its effects
    remain on further levels.""",
    source=Realisations(
        groups=("grooves", "third_level"), keys=("direction", "level"), pick=_with_and_without
    ),
)


@journal
def draw(ensembles: Mapping[tuple[str, int], Runs]) -> Figure:
    """Draw the mean force towards its end, a) along and b) across the grooves, for each level.

    `ensembles` holds runs by (direction, number of levels).
    """
    curves = {key: whole_curve(runs) for key, runs in sorted(ensembles.items())}
    span = enlarged_span(list(curves.values()))
    picture = style.figure(style.COLUMN, 99.0)
    left, width, height = _PANEL
    for direction, bottom, letter in zip(("x", "y"), _BOTTOMS, "ab", strict=True):
        ax = style.axes(picture, left, bottom, width, height)
        shown = {level: curve for (name, level), curve in curves.items() if name == direction}
        _draw_direction(ax, direction, shown, span)
        ax.set_title(f"sliding {name_direction(direction)}", loc="right", pad=3.0)
        style.panel_letter(ax, letter, left=12.0, above=1.5)
    upper, lower = picture.axes
    upper.tick_params(labelbottom=False)
    lower.set_xlabel("time (µs)")
    return picture


def _draw_direction(
    ax: Axes, direction: str, curves: Mapping[int, Curve], span: tuple[float, float]
) -> None:
    """Draw the curves of one sliding direction by number of levels, and their load peaks."""
    for level, curve in curves.items():
        color = {2: direction_color(direction), 3: PURPLE}.get(level, GREEN)
        draw_force(ax, curve, color, f"{level} levels: {peaks_in_words(curve)}")
        mark_load_peaks(ax, curve, color)
    ax.set(xlim=span, ylabel=FORCE)
    if curves:
        fit_forces(ax, list(curves.values()), span)
        ax.legend(loc="lower left", bbox_to_anchor=(0.14, 0.0))
