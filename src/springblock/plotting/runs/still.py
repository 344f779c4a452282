"""The picture of one run: its force, its detachments, where they are, and its snapshots."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from springblock.plotting import style
from springblock.plotting.figure_2 import draw_blocks, draw_force, draw_times, name_times
from springblock.plotting.runs.maps import (
    DISPLACED,
    draw_key,
    draw_map,
    draw_times_bar,
    painted,
    size_of_displacement,
)
from springblock.plotting.style import MICRO, journal
from springblock.simulation.run import Array, Run

CAPTION = """One run. Friction force over the normal force, with t_max, the time of the force
maximum (dotted), and t_avg, the mean first detachment time (solid); share of blocks that detach in
each sample interval; first detachment times t_det over t_max, block by block; displacements, where
the run has kept snapshots."""

_SNAPSHOTS = 4  #: at most; of more, the first, the last, and others evenly between them
# Layout in mm, above the row of snapshots.
_LEFT, _WIDTH = 20.0, 79.0
_MAP, _SIDE = 118.0, 65.0
_HEIGHT, _ROW = 97.0, 55.0


@journal
def plot(run: Run) -> Figure:
    """Draw what a run holds: force, detachments, the map of t_det, and snapshots if any.

    A matplotlib figure without pyplot: `plot(run).savefig("run.png")`. Notebooks show it after
    `%matplotlib inline`.
    """
    row = _ROW if len(run.snapshots) else 0.0
    detached = bool(np.isfinite(run.t_det).any())
    picture = style.figure(style.DOUBLE, _HEIGHT + row)
    picture.text(0.5, 1.0 - 2.0 / (_HEIGHT + row), run.name, ha="center", va="top")
    _draw_curves(picture, run, row, detached)
    _draw_times(picture, run, row, detached)
    if row:
        _draw_snapshots(picture, run)
    return picture


def _draw_curves(picture: Figure, run: Run, row: float, detached: bool) -> None:
    """Force, and below it detachments where there are any."""
    lower, height = (51.0, 36.0) if detached else (11.0, 76.0)
    force = style.axes(picture, _LEFT, row + lower, _WIDTH, height)
    span = (0.0, MICRO * float(run.time[-1]))
    draw_force(force, run, (), span)
    panels = [force]
    if detached:
        panels.append(style.axes(picture, _LEFT, row + 11.0, _WIDTH, 36.0))
        draw_blocks(panels[1], run, ())
        early = 2.0 * run.t_max < run.time[-1]  # room beside the peak
        panels[1].legend(loc="upper right" if early else "upper left")
        force.tick_params(labelbottom=False)
        name_times(force, run)
    for ax in panels:
        if detached:
            draw_times(ax, run)
        ax.set_xlim(span)
    panels[-1].set_xlabel("time (µs)")


def _draw_times(picture: Figure, run: Run, row: float, detached: bool) -> None:
    """Where blocks have detached, and when."""
    ax = style.axes(picture, _MAP, row + 24.5, _SIDE, _SIDE)
    draw_map(ax, painted(run))
    names = {
        "not detached": (run.contact & np.isnan(run.t_det)).any(),
        "not in contact": not run.contact.all(),
    }
    draw_key(ax, *(name for name, occurs in names.items() if occurs))
    if detached:
        draw_times_bar(picture, style.axes(picture, _MAP, row + 8.5, _SIDE, 3.0), run)


def _draw_snapshots(picture: Figure, run: Run) -> None:
    """Displacements at up to four times, in the same colours."""
    count = len(run.snapshots)
    chosen = np.unique(np.linspace(0, count - 1, min(count, _SNAPSHOTS)).round().astype(int))
    fields = [size_of_displacement(run.snapshots[i]) for i in chosen]
    norm = Normalize(0.0, max(float(np.max(fields)), 1e-12))
    for place, (i, field) in enumerate(zip(chosen, fields, strict=True)):
        ax = style.axes(picture, 13.0 + 38.0 * place, 10.0, 34.0, 34.0)
        _draw_snapshot(ax, field, norm)
        ax.set_title(f"{MICRO * run.snapshot_times[i]:.4g} µs")
        if place:
            ax.set_ylabel("")
            ax.tick_params(labelleft=False)
    bar = style.axes(picture, 12.0 + 38.0 * len(chosen), 10.0, 3.0, 34.0)
    label = r"displacement $|u|$ (nm)"
    picture.colorbar(ScalarMappable(norm, DISPLACED), bar).set_label(label)


def _draw_snapshot(ax: Axes, field: Array, norm: Normalize) -> None:
    image = draw_map(ax, field)
    image.set(cmap=DISPLACED, norm=norm)
