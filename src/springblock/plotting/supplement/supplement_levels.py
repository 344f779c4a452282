"""Supplement: a third level of the pattern; the paper expects the same of it (section 3.3)."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from matplotlib.figure import Figure

from springblock.analysis.statistics import whole_curve
from springblock.model.scene import Scene
from springblock.plotting import style
from springblock.plotting.curves import ENDS, draw_load_peaks, enlarged_span, fit_forces
from springblock.plotting.declaration import INTERVALS, Declaration, RealisationsSource, Scenes
from springblock.plotting.looks import direction_color, direction_name
from springblock.plotting.style import FORCE, GREEN, PURPLE, journal
from springblock.simulation.run import Run


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
    source=RealisationsSource(
        groups=("grooves", "third_level"), keys=("direction", "level"), pick=_with_and_without
    ),
)


@journal
def draw(ensembles: Mapping[tuple[str, int], Sequence[Run]]) -> Figure:
    """Draw the mean force towards its end, a) along and b) across the grooves, for each level.

    `ensembles` holds runs by (direction, number of levels).
    """
    curves = {key: whole_curve(runs) for key, runs in sorted(ensembles.items())}
    span = enlarged_span(list(curves.values()))
    picture, panels = style.panels(style.COLUMN, 99.0, "a;b", sharex=True)
    for direction, ax in zip(("x", "y"), panels, strict=True):
        shown = {level: curve for (name, level), curve in curves.items() if name == direction}
        for level, curve in shown.items():
            color = {2: direction_color(direction), 3: PURPLE}.get(level, GREEN)
            draw_load_peaks(ax, curve, color, f"{level} levels")
        if shown:
            fit_forces(ax, list(shown.values()), span)
            ax.legend(loc="lower left", bbox_to_anchor=(0.14, 0.0))
        ax.set_ylabel(FORCE)
        ax.set_title(f"sliding {direction_name(direction)}", loc="right")
    panels[-1].set_xlabel("time (µs)")
    return picture
