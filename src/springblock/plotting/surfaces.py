"""Surfaces of one's own: where they touch, when they let go, and under which force."""

from collections.abc import Mapping, Sequence
from textwrap import fill
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import TwoSlopeNorm
from matplotlib.figure import Figure

from springblock.analysis.statistics import whole_curve
from springblock.plotting import style
from springblock.plotting.declaration import INTERVALS, Declaration, Realisations
from springblock.plotting.ensembles import FORCE, draw_force, draw_runs
from springblock.plotting.style import BEFORE_AFTER, BLACK, GREY, MICRO, journal
from springblock.plotting.surface import draw_mask
from springblock.simulation.run import Array

if TYPE_CHECKING:
    from springblock.io.records import Record

FIGURE = Declaration(
    title="Surfaces of one's own",
    category="Supplement",
    caption=f"""Each surface of the group `surfaces`: at the left which blocks are in contact; in
    the middle their first detachment times t_det over t_max, means over realisations, blue before
    the force maximum and red after it, on a scale of its own for each, and grey where there is no
    contact or a run in which the block has not let go; at the right the friction force over the
    normal force, mean with {INTERVALS}, up to 20 single runs, and t_max, the mean over
    realisations, as a dotted line. Runs end after a set time, or after the first minimum behind
    their force maximum; from where the first has ended the force is dotted, the mean over those
    that go on, and it ends with half of them.""",
    source=Realisations(groups=("surfaces",), keys=("folder",)),
)

# Layout in mm: a row of three panels for each surface, with room for its name above.
_SIDE, _ROW, _BELOW = 44.0, 62.0, 10.0
_MASK, _MAP, _BAR, _FORCE = 12.0, 66.0, 112.0, 143.0  #: left edges
_LINE = 120  #: letters that fit above a row


@journal
def draw(ensembles: "Mapping[str, Sequence[Record]]") -> Figure:
    """Draw mask, mean t_det/t_max and force of each surface below the one before.

    `ensembles` holds the realisations of scenes by their folder.
    """
    picture = style.figure(style.DOUBLE, len(ensembles) * _ROW)
    for i, runs in enumerate(ensembles.values(), 1):
        bottom = (len(ensembles) - i) * _ROW + _BELOW
        _draw_surface(picture, bottom, runs)
    return picture


def _draw_surface(picture: Figure, bottom: float, runs: "Sequence[Record]") -> None:
    mask, times = (style.axes(picture, at, bottom, _SIDE, _SIDE) for at in (_MASK, _MAP))
    draw_mask(mask, runs[0].scene.contact)
    _draw_times(picture, times, style.axes(picture, _BAR, bottom, 3.0, _SIDE), mean_times(runs))
    mask.set(xlabel="$x/l$", ylabel="$y/l$")
    times.set(xlabel="$x/l$")
    name = fill(str(runs[0].scene), _LINE)
    mask.text(0.0, 1.03, name, va="bottom", transform=mask.transAxes)
    force = style.axes(picture, _FORCE, bottom, _SIDE, _SIDE)
    curve = whole_curve(runs)
    draw_runs(force, curve, GREY)
    draw_force(force, curve, BLACK, "mean")
    latest = float(np.mean([run.t_max for run in runs]))
    force.axvline(MICRO * latest, color=BLACK, linestyle=":", linewidth=1.0, zorder=0)
    force.set(xlabel="time (µs)", ylabel=FORCE, xlim=(0.0, None), ylim=(0.0, None))


def mean_times(runs: "Sequence[Record]") -> Array:
    """Mean of t_det/t_max over realisations, (N_y, N_x); NaN where one has not let go."""
    return np.mean([run.t_det / run.t_max for run in runs], axis=0)


def _draw_times(picture: Figure, ax: Axes, bar: Axes, times: Array) -> None:
    shown = np.append(times[np.isfinite(times)], (0.999, 1.001))
    norm = TwoSlopeNorm(1.0, float(shown.min()), float(shown.max()))
    image = ax.imshow(times, BEFORE_AFTER, norm=norm, origin="lower", interpolation="nearest")
    picture.colorbar(image, bar).set_label(r"mean $t_\mathrm{det}/t_\mathrm{max}$")
