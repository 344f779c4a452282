"""Pictures of ensembles on surfaces of one's own."""

from collections.abc import Mapping, Sequence
from textwrap import fill

import numpy as np
from matplotlib.figure import Figure

from springblock.analysis import statistics
from springblock.plotting import curves, maps, style
from springblock.plotting.style import BLACK, FORCE, GREY, MICRO
from springblock.simulation.run import Run

_ROW = 62.0  #: mm, height of the panels of a surface and of its name
_LINE = 120  #: characters that fit above a row


def surfaces(ensembles: Mapping[str, Sequence[Run]]) -> Figure:
    """Draw mask, mean t_det/t_max and force of each surface, by name, a row each.

    A block that has not detached in one of the runs has no mean time.
    """
    picture = style.page(style.DOUBLE, len(ensembles) * _ROW)
    rows = picture.subplots(len(ensembles), 3, squeeze=False)
    for (contact, times, force), (name, runs) in zip(rows, ensembles.items(), strict=True):
        maps.draw_contact(contact, runs[0].contact)
        title = str(getattr(runs[0], "scene", name))
        contact.set_title(fill(title, _LINE), loc="left", fontsize="medium")
        mean = np.mean([run.t_det / run.t_max for run in runs], axis=0)
        if np.isfinite(mean).any():
            maps.draw_mean_times(times, mean, r"mean $t_\mathrm{det}/t_\mathrm{max}$")
        else:
            times.set_axis_off()
        curve = statistics.whole_curve(runs)
        curves.draw_single_forces(force, curve, GREY)
        curves.draw_mean_force(force, curve, BLACK, "mean")
        latest = MICRO * float(np.mean([run.t_max for run in runs]))
        force.axvline(latest, color=BLACK, linestyle=":", linewidth=1.0, zorder=0)
        force.set(xlabel="time (µs)", ylabel=FORCE, xlim=(0.0, None), ylim=(0.0, None))
    return picture
