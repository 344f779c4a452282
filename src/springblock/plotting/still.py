"""Pictures of one run, of one surface, and of ensembles on surfaces of one's own."""

from collections.abc import Iterable, Mapping, Sequence
from functools import singledispatch
from textwrap import fill
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from numpy.typing import NDArray

from springblock.analysis import statistics
from springblock.analysis.runs import Runs
from springblock.model.numbers import Array
from springblock.model.pattern import Pattern
from springblock.model.surface import Surface
from springblock.plotting import curves, maps, style
from springblock.plotting.style import BLACK, COLUMN, DOUBLE, GREY, MICRO, MM, color_bar, journal
from springblock.simulation.fields import Fields
from springblock.simulation.run import Run

RUN_CAPTION = """Friction force over the normal force and share of blocks that detach in each sample
interval, against time; first detachment time t_det over t_max of each block; displacements, if the
run has snapshots. One run. Dotted line: t_max, the time of the force maximum; solid line: t_avg,
the mean first detachment time."""

FIELDS_CAPTION = """Fields of one run at the times above the columns: magnitude of the shear stress
of the blocks on the substrate (top) and slip since the first detachment (bottom). All columns of a
row share one colour scale. Grey: blocks out of contact."""

SURFACE_CAPTION = """Blocks in contact with the substrate (dark) and out of contact (light), from
the mask used by the solver: a) the whole surface; b) single blocks from the first corner of the
contact on. Arrow: sliding direction."""

_DISPLACEMENT = r"displacement $|u|$ (nm)"
_STRESS = r"shear stress $|\tau|$ (kPa)"
_SLIP = "slip (nm)"
_SHOWN = 4  #: largest number of times shown: the first, the last, and others evenly between them
_HEIGHT, _ROW = 97.0, 55.0  #: mm, and of the row of snapshots
#: Width in mm of maps of stress and slip at so many times.
_WIDTHS = {1: COLUMN, 2: COLUMN, 3: style.ONE_AND_A_HALF, 4: DOUBLE}
#: What text takes beside the maps, the tallest map, and a letter of the title, mm.
_TEXT, _TALLEST, _LETTER = 34.0, 90.0, 1.4
_ENLARGED = 24  #: blocks along a side of the part of a surface that is enlarged
#: Of values from zero on, the same for all colour vision (Nuñez, Anderton & Renslow 2018,
#: doi:10.1371/journal.pone.0199239).
_SEQUENTIAL = colormaps["cividis"].with_extremes(bad=style.NO_CONTACT)
_OF_SURFACE = 62.0  #: mm, height of the panels of a surface and of its name
_LINE = 120  #: characters that fit above them


@singledispatch
def plot(shown: Any) -> Figure:
    """Draw a run, runs of `ensemble`, fields, a pattern or a surface.

    Of a run: force, detachments, the map of t_det and any snapshots; of several: mask, mean t_det
    and mean force; of fields: shear stress and slip; else the blocks in contact. A matplotlib
    figure without pyplot: `plot(run).savefig("run.png")`.
    """
    raise TypeError(f"plot draws runs, fields, patterns and surfaces, not {shown!r}")


@plot.register
@journal
def plot_run(run: Run) -> Figure:
    """Draw force, detachments, the map of t_det and any snapshots of a run."""
    heights = [_HEIGHT, _ROW] if len(run.snapshots) else [_HEIGHT]
    picture = Figure(figsize=(DOUBLE * MM, sum(heights) * MM), layout="constrained")
    picture.suptitle(run.name, fontsize="medium")
    parts = picture.subfigures(len(heights), 1, height_ratios=heights, squeeze=False)[:, 0]
    detached = bool(np.isfinite(run.t_det).any())
    panels = parts[0].subplot_mosaic("FM;BM" if detached else "FM", width_ratios=(79, 65))
    span = (0.0, MICRO * float(run.time[-1]))
    if detached:
        curves.draw_run(panels["F"], panels["B"], run, (), span)
        early = 2.0 * run.t_max < run.time[-1]  # room beside the peak
        panels["B"].legend(loc="upper right" if early else "upper left")
    else:
        curves.draw_force(panels["F"], run, (), span)
        panels["F"].set(xlabel="time (µs)", xlim=span)
    maps.draw_times(panels["M"], run)
    others = {"not detached": run.contact & np.isnan(run.t_det), "not in contact": ~run.contact}
    maps.draw_key(panels["M"], *(name for name, blocks in others.items() if blocks.any()))
    if len(run.snapshots):
        chosen = _chosen(run.snapshot_times)
        row = parts[1].subplots(1, _SHOWN, sharey=True)
        for ax in row[len(chosen) :]:
            ax.remove()
        sizes = style.NANO * np.hypot(*run.snapshots[chosen].swapaxes(0, 1))
        _draw_maps(row[: len(chosen)], sizes, _DISPLACEMENT, run.snapshot_times[chosen])
    return picture


def _chosen(times: Array) -> NDArray[np.int_]:
    """Return the places of up to four of these times, from the first to the last."""
    count = len(times)
    return np.unique(np.linspace(0, count - 1, min(count, _SHOWN)).round().astype(int))


def _draw_maps(
    panels: Sequence[Axes], fields: Array, label: str, times: Iterable[float] = ()
) -> None:
    """Map a field, (k, rows, columns), in common colours; `times` (s) stand above in µs."""
    largest = float(np.nanmax(fields)) or 1.0
    for ax, field in zip(panels, fields, strict=True):
        image = maps.draw_map(ax, field, cmap=_SEQUENTIAL, vmin=0.0, vmax=largest)
        ax.label_outer()
    for ax, time in zip(panels, times, strict=False):
        ax.set_title(f"{MICRO * time:.4g} µs")
    color_bar(panels[-1], image, label)


@plot.register
@journal
def plot_fields(fields: Fields, name: str = "") -> Figure:
    """Draw maps of shear stress, above, and slip, below, at up to four of the times."""
    chosen = _chosen(fields.time)
    count, (rows, columns) = len(chosen), fields.contact.shape
    letters, width = "abcdefgh"[: 2 * count], _WIDTHS[count]
    height = _TEXT + 2.0 * min((width - _TEXT) / count * rows / columns, _TALLEST)
    mosaic = f"{letters[:count]};{letters[count:]}"
    picture, panels = style.panels(width, height, mosaic, sharex=True, sharey=True)
    picture.suptitle(
        fill(name.replace(" = ", "\xa0=\xa0"), int(width / _LETTER)), fontsize="medium"
    )
    stress, slip = style.KILO * fields.shear_stress[chosen], style.NANO * fields.slip[chosen]
    _draw_maps(panels[:count], stress, _STRESS, fields.time[chosen])
    _draw_maps(panels[count:], slip, _SLIP)
    return picture


@plot.register(Pattern)
@plot.register(Surface)
def plot_surface(surface: Pattern | Surface) -> Figure:
    """Draw the blocks in contact."""
    return show(surface.contact)


@plot.register
@journal
def plot_runs(runs: Runs) -> Figure:
    """Draw mask, mean t_det/t_max and force of several runs of a surface."""
    return surfaces({runs[0].name: runs})


def surfaces(ensembles: Mapping[str, Sequence[Run]]) -> Figure:
    """Draw mask, mean t_det/t_max and force of each surface, by name, a row each.

    A block that has not detached in one of the runs has no mean time.
    """
    picture = style.page(DOUBLE, len(ensembles) * _OF_SURFACE)
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
        force.set(xlabel="time (µs)", ylabel=style.FORCE, xlim=(0.0, None), ylim=(0.0, None))
    return picture


@journal
def show(
    contact: NDArray[np.bool_], direction: str | float | None = None, name: str = ""
) -> Figure:
    """Draw a) a whole surface, (N_y, N_x), and b) single blocks of it."""
    picture, (whole, detail) = style.panels(DOUBLE, 105.0, "ab")
    share = f"{np.count_nonzero(contact)} of {contact.size} blocks in contact, {contact.mean():.1%}"
    title = "\n".join(filter(None, [name, share.replace("%", " %")]))
    picture.suptitle(title, fontsize="medium", linespacing=1.4)
    maps.draw_contact(whole, contact)
    if direction is not None:
        maps.draw_sliding(whole, direction)
    corner = []  # of a window that shows the first contact with a margin, and lies inside
    for axis, size in enumerate(contact.shape):
        first = int(np.argmax(contact.any(axis=1 - axis)))
        corner.append(max(0, min(first - _ENLARGED // 6, size - _ENLARGED)))
    y, x = corner
    window = contact[y : y + _ENLARGED, x : x + _ENLARGED]
    rows, columns = window.shape
    extent = (x - 0.5, x + columns - 0.5, y - 0.5, y + rows - 0.5)
    maps.draw_contact(detail, window, extent=extent)
    maps.draw_borders(detail, window.shape, (y, x))
    maps.draw_key(detail, "in contact", "not in contact")
    whole.add_patch(Rectangle((x - 0.5, y - 0.5), columns, rows, fill=False))
    return picture
