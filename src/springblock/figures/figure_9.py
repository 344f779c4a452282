"""Figure 9: friction force and detachments on grooved pillars (section 3.3 of the paper).

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525.
"""

from collections.abc import Sequence
from itertools import cycle
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from springblock.figures import style
from springblock.figures.ensembles import FORCE, draw_detachments, draw_force
from springblock.figures.style import BLUE, GREEN, MICRO, PURPLE, VERMILION, journal
from springblock.run import Array, Run
from springblock.statistics import Curve, common_curve, load_peaks, standard_error

_ENLARGED = 0.85  #: share of the largest mean force from which on the curves are enlarged
_COLUMNS = ((18.0, 75.0), (111.0, 75.0))  #: left edge and width of the panels, mm
_ROWS = ((54.0, 40.0), (11.0, 37.0))  #: lower edge and height
_COLORS = (BLUE, VERMILION, GREEN, PURPLE)
_NAMES = {"x": "sliding along grooves", "y": "sliding across grooves"}  #: grooves run along x


@journal
def draw(ensembles: Sequence[tuple[str, Sequence[Run]]]) -> Figure:
    """Draw a), b) the mean force and c), d) detachments for each sliding direction.

    The left panels show the whole run, the right ones its end. Bands are 95 % bootstrap
    intervals of the mean over runs; triangles are the load peaks that `load_peaks` finds.
    """
    curves = {direction: common_curve(runs) for direction, runs in sorted(ensembles)}
    span = _enlarged(list(curves.values()))
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
    _fit(enlarged, list(curves.values()), span)
    return picture


def _enlarged(curves: Sequence[Curve]) -> tuple[float, float]:
    """Times in µs from which the first mean force is close to its maximum to the last end."""
    starts = []
    for curve in curves:
        mean = curve.friction.mean(axis=0)
        starts.append(curve.time[np.argmax(mean >= _ENLARGED * mean.max())])
    return MICRO * float(min(starts)), MICRO * float(max(curve.time[-1] for curve in curves))


def _draw_direction(force: Axes, blocks: Axes, direction: str, curve: Curve, color: str) -> None:
    """Draw both curves of one sliding direction, and triangles above its load peaks."""
    peaks = load_peaks(curve.friction.mean(axis=0), standard_error(curve.friction))
    name = _NAMES.get(direction, f"sliding at {direction}° to grooves")
    count = f"{len(peaks)} load peak" + ("" if len(peaks) == 1 else "s")
    mean = draw_force(force, curve, color, f"{name}: {count}")
    draw_detachments(blocks, curve, color)
    triangle: dict[str, Any] = {"textcoords": "offset points", "ha": "center", "va": "bottom"}
    for time, height in zip(MICRO * curve.time[peaks], mean[peaks], strict=True):
        force.annotate("▼", (time, height), (0.0, 2.0), color=color, **triangle)


def _fit(ax: Axes, curves: Sequence[Curve], span: tuple[float, float]) -> None:
    """Fit the axis of forces to the means within `span`, with room for triangles."""
    means: list[Array] = []
    for curve in curves:
        time = MICRO * curve.time
        means.append(curve.friction.mean(axis=0)[(time >= span[0]) & (time <= span[1])])
    shown = np.concatenate(means)
    room = float(np.ptp(shown))
    ax.set_ylim(float(shown.min()) - 0.1 * room, float(shown.max()) + 0.25 * room)
