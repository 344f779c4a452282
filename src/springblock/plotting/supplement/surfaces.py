"""Surfaces of one's own: where they touch, when they let go, and under which force."""

from collections.abc import Mapping, Sequence
from textwrap import fill

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from springblock.analysis.statistics import whole_curve
from springblock.io.records import Record
from springblock.plotting.curves import draw_mean_force, draw_single_forces
from springblock.plotting.declaration import INTERVALS, Declaration, RealisationsSource
from springblock.plotting.maps import draw_contact, draw_mean_times
from springblock.plotting.style import BLACK, DOUBLE, FORCE, GREY, MICRO, MM, journal
from springblock.simulation.run import Array

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
    source=RealisationsSource(groups=("surfaces",), keys=("folder",)),
)

_ROW = 62.0  #: mm, height of the panels of a surface and of its name
_LINE = 120  #: letters that fit above a row


@journal
def draw(ensembles: Mapping[str, Sequence[Record]]) -> Figure:
    """Draw mask, mean t_det/t_max and force of each surface below the one before.

    `ensembles` holds the realisations of scenes by their folder.
    """
    size = (DOUBLE * MM, len(ensembles) * _ROW * MM)
    picture = Figure(figsize=size, layout="constrained")
    rows = picture.subplots(len(ensembles), 3, squeeze=False)
    for (contact, times, force), runs in zip(rows, ensembles.values(), strict=True):
        draw_contact(contact, runs[0].scene.contact)
        contact.set_title(fill(str(runs[0].scene), _LINE), loc="left", fontsize="medium")
        draw_mean_times(times, mean_times(runs), r"mean $t_\mathrm{det}/t_\mathrm{max}$")
        _draw_force(force, runs)
    return picture


def mean_times(runs: Sequence[Record]) -> Array:
    """Mean of t_det/t_max over realisations, (N_y, N_x); NaN where one has not let go."""
    return np.mean([run.t_det / run.t_max for run in runs], axis=0)


def _draw_force(ax: Axes, runs: Sequence[Record]) -> None:
    """Mean force and single runs, with the mean t_max."""
    curve = whole_curve(runs)
    draw_single_forces(ax, curve, GREY)
    draw_mean_force(ax, curve, BLACK, "mean")
    latest = float(np.mean([run.t_max for run in runs]))
    ax.axvline(MICRO * latest, color=BLACK, linestyle=":", linewidth=1.0, zorder=0)
    ax.set(xlabel="time (µs)", ylabel=FORCE, xlim=(0.0, None), ylim=(0.0, None))
