"""Figures of the supplement: what the paper leaves open, and surfaces of one's own.

Each function takes runs by the values of the keys that its declaration names.
"""

from collections.abc import Mapping, Sequence
from textwrap import fill

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from springblock.analysis import statistics
from springblock.io.records import Record
from springblock.model.direction import degrees
from springblock.plotting import curves, looks, maps, points, style
from springblock.plotting.looks import Key
from springblock.plotting.style import BLACK, FORCE, GREY, MICRO, PERCENT, Look
from springblock.simulation.run import Array, Run, friction, percent

_SPREAD = 2.0  #: degrees over which single runs are spread
_DOT: Look = {"linestyle": "none", "marker": ".", "markersize": 2.8, "alpha": 0.5}
_CLOSE = 0.85  #: share of the maximum from which the force on three levels is shown
_SIZES = (3, 5, 10, 20, 50, 100, 200, 500, 1000)  #: of subsets of an ensemble
_MILLI = 1e3  #: 10⁻³ per unit
_NORMAL = 1.96  #: half a 95 % interval in standard errors
_TIMES = np.linspace(0.0, 1.05, 106)  #: over t_max, at which switches of runs are compared
_FLOOR = 0.03  #: %, where the axis of switches begins: four blocks of a flat surface
_ROW = 62.0  #: mm, height of the panels of a surface and of its name
_LINE = 120  #: letters that fit above a row


def supplement_spacing(ensembles: Mapping[tuple[int, int], Sequence[Run]]) -> Figure:
    """Draw a) static friction and b) t_max - t_avg over n_s, a line for each n_p."""
    picture, panels = points.friction_and_lag("distance between the pillars $n_s$ (blocks)")
    for n_p in sorted({n_p for n_p, _ in ensembles}):
        by_gap = {n_s: runs for (size, n_s), runs in ensembles.items() if size == n_p}
        points.draw_series(panels, by_gap, **looks.pillar_look(n_p), label=looks.pillar_name(n_p))
    points.name_places(panels[0], [n_s for _, n_s in ensembles])
    panels[0].legend(loc="best", ncols=2)
    return picture


def supplement_size(ensembles: Mapping[tuple[int, int, str, int], Sequence[Run]]) -> Figure:
    """Draw a) static friction and b) t_max - t_avg over N, a line for each surface."""
    picture, panels = points.friction_and_lag("side of the surface $N$ (blocks)")
    for surface in looks.in_order({key[:3] for key in ensembles}):
        name, look = looks.surface_look(surface)
        by_size = {key[3]: runs for key, runs in ensembles.items() if key[:3] == surface}
        points.draw_series(panels, by_size, **look, label=name)
    points.name_places(panels[0], [n for *_, n in ensembles])
    panels[0].legend(loc="best")
    return picture


def supplement_angle(ensembles: Mapping[str, Sequence[Run]]) -> Figure:
    """Draw what changes with the angle between sliding and grooves.

    That is a) static friction, b) t_max - t_avg and c) the prominence of the lesser load peak.
    """
    label = "angle between sliding and grooves (°)"
    picture, panels = points.friction_and_lag(label, "lesser peak (% of force)")
    names = {degrees(name): name for name in ensembles}
    by_angle = {angle: ensembles[names[angle]] for angle in sorted(names)}
    highest, lag = points.highest_and_lag(by_angle)
    lesser = {
        angle: PERCENT * np.array([statistics.prominence(friction(run)) for run in runs])
        for angle, runs in by_angle.items()
    }
    for ax, samples in zip(panels, (highest, lag, lesser), strict=True):
        means = [sample.mean() for sample in samples.values()]
        ax.plot(list(samples), means, color=GREY, linewidth=0.6)
        for angle, sample in samples.items():
            color = looks.direction_color(names[angle])
            aside = _SPREAD * np.linspace(-1.0, 1.0, len(sample))
            ax.plot(angle + aside, sample, color=color, markeredgewidth=0.0, **_DOT)
            points.draw_means(ax, {angle: sample}, color, linestyle="none", marker="o", zorder=3)
        ax.set_xticks(list(samples))
    panels[2].set_ylim(0.0, None)
    return picture


def supplement_levels(ensembles: Mapping[tuple[str, int], Sequence[Run]]) -> Figure:
    """Draw the mean force towards its end, a) along and b) across the grooves, for each level."""
    found = {key: statistics.whole_curve(runs) for key, runs in sorted(ensembles.items())}
    span = curves.enlarged_span(list(found.values()), _CLOSE)
    picture, panels = style.panels(style.COLUMN, 99.0, "a;b", sharex=True)
    for direction, ax in zip(("x", "y"), panels, strict=True):
        shown = {level: curve for (name, level), curve in found.items() if name == direction}
        for level, curve in shown.items():
            color = {2: looks.direction_color(direction), 3: style.PURPLE}.get(level, style.GREEN)
            curves.draw_load_peaks(ax, curve, color, f"{level} levels")
        if shown:
            curves.fit_forces(ax, list(shown.values()), span)
            ax.legend(loc="lower left", bbox_to_anchor=(0.14, 0.0))
        ax.set_ylabel(FORCE)
        ax.set_title(f"sliding {looks.direction_name(direction)}", loc="right")
    panels[-1].set_xlabel("time (µs)")
    return picture


def supplement_repetitions(ensembles: Mapping[Key, Sequence[Run]]) -> Figure:
    """Draw half the 95 % interval of a) static friction and b) t_max - t_avg over realisations."""
    picture, panels = style.panels(style.COLUMN, 110.0, "a;b", sharex=True)
    highest, lag = points.highest_and_lag(ensembles)
    for key in looks.in_order(ensembles):
        name, look = looks.surface_look(key)
        for ax, values in zip(panels, (_MILLI * highest[key], lag[key]), strict=True):
            _draw_widths(ax, values, look | {"label": name})
    names = ("static friction (10⁻³)", r"$t_\mathrm{max} - t_\mathrm{avg}$ (µs)")
    for ax, name in zip(panels, names, strict=True):
        ax.set(yscale="log", ylabel=f"± of {name}")
        ax.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        ax.yaxis.set_major_formatter("{x:g}")
        ax.yaxis.set_minor_formatter(NullFormatter())
    points.name_places(panels[0], [k for k in _SIZES if k <= max(map(len, ensembles.values()))])
    panels[1].set_xlabel("number of realisations")
    panels[0].plot([], [], color=GREY, linewidth=0.5, label=r"$\propto 1/\sqrt{k}$")
    picture.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return picture


def _draw_widths(ax: Axes, values: Array, look: Look) -> None:
    """Draw widths measured on subsets, over the line that the whole ensemble predicts."""
    widths = statistics.half_widths(values, _SIZES)
    if not widths:
        return
    sizes = np.array(list(widths))
    ax.plot(sizes, list(widths.values()), linestyle="none", **look)
    predicted = _NORMAL * values.std(ddof=1) / np.sqrt(sizes)
    ax.plot(sizes, predicted, color=look["color"], linewidth=0.5)


def supplement_restick(ensembles: Mapping[Key, Sequence[Run]]) -> Figure:
    """Draw how many blocks have let go again over time, for each surface.

    Up to the force maximum the rule of re-sticking can matter for these blocks alone.
    """
    picture, (ax,) = style.panels(style.COLUMN, 80.0)
    ax.set(yscale="log", ylim=(_FLOOR, 50.0))
    ax.yaxis.set_major_formatter("{x:g}")
    for i, key in enumerate(looks.in_order(ensembles)):
        name, look = looks.surface_look(key)
        again = statistics.mean_interval([let_go_again(run) for run in ensembles[key]])
        look |= {"label": name, "markevery": (62 + 3 * (i % 4), 12)}
        curves.draw_band(ax, _TIMES, again, **look)
    ax.set(xlabel=r"time $t/t_\mathrm{max}$", ylabel="let go again (% of blocks)")
    ax.set(xlim=(0.6, _TIMES[-1]))
    ax.axvline(1.0, color=GREY, linewidth=0.5, zorder=0)
    picture.legend(loc="outside upper center", ncols=3)
    return picture


def let_go_again(run: Run) -> Array:
    """Return all but the first switches from rest to sliding up to `_TIMES`, % of all blocks."""
    again = np.cumsum(percent(run, run.switches) - percent(run, run.detachments))
    return np.interp(_TIMES, run.time / run.t_max, again)


def surfaces(ensembles: Mapping[str, Sequence[Record]]) -> Figure:
    """Draw mask, mean t_det/t_max and force of each surface below the one before.

    A block that has not let go in one of the runs has no mean time.
    """
    size = (style.DOUBLE * style.MM, len(ensembles) * _ROW * style.MM)
    picture = Figure(figsize=size, layout="constrained")
    rows = picture.subplots(len(ensembles), 3, squeeze=False)
    for (contact, times, force), runs in zip(rows, ensembles.values(), strict=True):
        maps.draw_contact(contact, runs[0].scene.contact)
        contact.set_title(fill(str(runs[0].scene), _LINE), loc="left", fontsize="medium")
        mean = np.mean([run.t_det / run.t_max for run in runs], axis=0)
        maps.draw_mean_times(times, mean, r"mean $t_\mathrm{det}/t_\mathrm{max}$")
        curve = statistics.whole_curve(runs)
        curves.draw_single_forces(force, curve, GREY)
        curves.draw_mean_force(force, curve, BLACK, "mean")
        latest = MICRO * float(np.mean([run.t_max for run in runs]))
        force.axvline(latest, color=BLACK, linestyle=":", linewidth=1.0, zorder=0)
        force.set(xlabel="time (µs)", ylabel=FORCE, xlim=(0.0, None), ylim=(0.0, None))
    return picture
