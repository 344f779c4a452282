"""Figures of the supplement: choices that the paper leaves open, and surfaces of one's own.

Each function takes runs by the values of the keys in its declaration.
"""

from collections.abc import Mapping, Sequence
from textwrap import fill

import numpy as np
from matplotlib.figure import Figure

from springblock.analysis import statistics
from springblock.io.records import Record
from springblock.model.direction import degrees
from springblock.plotting import curves, maps, style
from springblock.plotting.style import BLACK, FORCE, GREY, MICRO, Key, Look
from springblock.simulation.run import Array, Run, percent

_SPREAD = 2.0  #: degrees over which single runs are spread
_CLOSE = 0.85  #: share of the maximum from which the force on three levels is shown
_TIMES = (0.8, 0.9, 1.0)  #: t/t_max up to which repeated detachments are counted
_ROW = 62.0  #: mm, height of the panels of a surface and of its name
_TITLE = "$n_p/n_s$ of each level: lesser peak"  #: of the legends of levels
_LINE = 120  #: characters that fit above a row


def supplement_spacing(ensembles: Mapping[tuple[int, int], Sequence[Run]]) -> Figure:
    """Draw a) static friction and b) t_max - t_avg over n_s, a line for each n_p."""
    picture, panels = curves.stacked("distance between the pillars $n_s$ (blocks)")
    looks = style.pillar_looks(n_p for n_p, _ in ensembles)
    for n_p in looks:
        by_gap = {n_s: runs for (size, n_s), runs in sorted(ensembles.items()) if size == n_p}
        look, (highest, lag) = looks[n_p], curves.highest_and_lag(by_gap)
        curves.draw_means(panels[0], highest, **look, label=style.pillar_name(n_p))
        curves.draw_realisations(panels[1], lag, look["color"])
    curves.name_places(panels[0], [n_s for _, n_s in ensembles])
    panels[0].legend(loc="best", ncols=2)
    return picture


def supplement_size(ensembles: Mapping[tuple[int, int, str, int], Sequence[Run]]) -> Figure:
    """Draw a) static friction over its mean at the largest N and b) t_max - t_avg, over N."""
    picture, (ratio, lags) = curves.stacked("side of the surface $N$ (blocks)")
    surfaces = style.in_order({key[:3] for key in ensembles})
    every = sorted({key[3] for key in ensembles})
    for i, surface in enumerate(surfaces):
        look = style.surface_look(surface)
        by_size = {key[3]: runs for key, runs in sorted(ensembles.items()) if key[:3] == surface}
        moved = curves.aside(by_size, every, i, len(surfaces), log=True)
        highest, lag = curves.highest_and_lag(moved)
        usual = highest[max(highest)].mean()
        relative = {place: sample / usual for place, sample in highest.items()}
        curves.draw_means(ratio, relative, **look)
        curves.draw_realisations(lags, lag, look["color"])
    ratio.axhline(1.0, **curves.ZERO)
    ratio.set_ylabel("static friction\nover that at the largest $N$")
    curves.name_places(ratio, every)
    ratio.legend(loc="best")
    return picture


def supplement_angle(ensembles: Mapping[str, Sequence[Run]]) -> Figure:
    """Draw three observables against the angle between sliding direction and grooves.

    a) Static friction, b) t_max - t_avg and c) the prominence of the lesser load peak.
    """
    label = "angle between sliding and grooves (°)"
    quantities = (curves.FRICTION, curves.LAG, "lesser peak (% of force)")
    picture, panels = curves.stacked(label, quantities)
    names = {degrees(name): name for name in ensembles}
    by_angle = {angle: ensembles[names[angle]] for angle in sorted(names)}
    highest, lag = curves.highest_and_lag(by_angle)
    lesser = {angle: curves.lesser_peaks(runs) for angle, runs in by_angle.items()}
    for ax, samples in zip(panels, (highest, lag, lesser), strict=True):
        for angle, sample in samples.items():
            color = style.direction_color(names[angle])
            spread = _SPREAD * np.linspace(-1.0, 1.0, len(sample))
            ax.plot(angle + spread, sample, color=color, **curves.DOT)
            if samples is not lag:  # its mean would lie between two clusters of realisations
                look: Look = {"linestyle": "none", "marker": "o", "zorder": 3}
                curves.draw_means(ax, {angle: sample}, color, **look)
        ax.set_xticks(list(samples))
    panels[2].set_ylim(0.0, None)
    return picture


def supplement_levels(ensembles: Mapping[tuple[str, int], Sequence[Record]]) -> Figure:
    """Draw the mean force towards its end, a) along and b) across the grooves, for each level."""
    found = {key: statistics.whole_curve(runs) for key, runs in sorted(ensembles.items())}
    picture, panels = style.panels(style.COLUMN, 99.0, "a;b", sharex=True, sharey=True)
    for direction, ax in zip(("x", "y"), panels, strict=True):
        shown = {level: curve for (name, level), curve in found.items() if name == direction}
        for level, curve in shown.items():
            color = {2: style.direction_color(direction), 3: style.PURPLE}.get(level, style.GREEN)
            runs = ensembles[direction, level]
            sizes = [str(size) for size in runs[0].scene.lengths.values() if size]
            pairs = ", ".join(map("/".join, zip(sizes[::2], sizes[1::2], strict=True)))
            curves.draw_load_peaks(ax, curve, color, f"{pairs}: {curves.lesser_peak(runs)}")
        if shown:
            ax.legend(loc="lower left", title=_TITLE, alignment="left")
        ax.set_ylabel(FORCE)
        ax.set_title(f"sliding {style.direction_name(direction)}", loc="right")
    curves.fit_forces(panels[0], list(found.values()), _CLOSE)
    low, high = panels[0].get_ylim()
    panels[0].set_ylim(low - 0.4 * (high - low), high)  # room for the legends
    panels[-1].set_xlabel("time (µs)")
    return picture


def supplement_restick(ensembles: Mapping[Key, Sequence[Run]]) -> Figure:
    """Draw the share of blocks that have detached again by three times, for each surface.

    The rule for re-sticking can affect the force maximum through these blocks alone.
    """
    picture, (ax,) = style.panels(style.COLUMN, 66.0)
    keys = style.in_order(ensembles)
    again = [np.stack([let_go_again(run) for run in ensembles[key]], axis=1) for key in keys]
    for i, (time, color) in enumerate(style.shades(_TIMES).items()):
        places = np.arange(len(keys)) + 0.25 * (i - 1)
        samples = {place: shares[i] for place, shares in zip(places, again, strict=True)}
        label = rf"$t$ = {time:g} $t_\mathrm{{max}}$"
        curves.draw_realisations(ax, samples, color, label=label)
    names = [style.surface_look(key)["label"] for key in keys]
    ax.set_xticks(range(len(keys)), names, rotation=35.0, ha="right", rotation_mode="anchor")
    ax.set(xlabel="surface", ylabel="detached again (% of blocks)", ylim=(0.0, None))
    ax.legend(loc="upper left")
    return picture


def let_go_again(run: Run) -> Array:
    """Return the repeated switches from rest to sliding up to `_TIMES`, (3,) % of blocks."""
    again = np.cumsum(percent(run, run.switches) - percent(run, run.detachments))
    return np.interp(_TIMES, run.time / run.t_max, again)


def surfaces(ensembles: Mapping[str, Sequence[Record]]) -> Figure:
    """Draw mask, mean t_det/t_max and force of each surface, a row each.

    A block that has not detached in one of the runs has no mean time.
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
