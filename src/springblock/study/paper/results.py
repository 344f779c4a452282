"""Figures 2, 3, 5, 6, 7 and 9 of the paper: forces, detachments and their correlation."""

from collections.abc import Mapping, Sequence
from string import ascii_lowercase
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from springblock.analysis import statistics
from springblock.analysis.statistics import Interval, LoadCurves
from springblock.io.records import Record
from springblock.model.numbers import Array
from springblock.model.scene import CONSTANTS
from springblock.plotting import curves, maps, style
from springblock.plotting.style import BLACK, BLUE, FORCE, GREY, MICRO, VERMILION, Look
from springblock.simulation.run import Run

if TYPE_CHECKING:  # read by the command, and only then
    import pandas as pd

BySize = Mapping[int, Sequence[Run]]  #: by n_p, 0 for the flat surface
Grooves = tuple[int, int, int, int, str, str]  #: values of its keys in `results.toml`

_BEFORE, _AFTER = 15e-6, 9e-6  #: s around t_max that figure 2 enlarges
_TIME = r"mean first detachment $t_\mathrm{det}/t_\mathrm{max}$"
#: Colour, marker and name of the parts of a ring.
_PARTS = {
    "corners": (BLACK, "o", "corners"),
    "y": (VERMILION, "s", "sides along $y$ ($x_p$ = const.)"),
    "x": (BLUE, "D", "sides along $x$ ($y_p$ = const.)"),
}
_IN_TIME = (0, 2, 3, 6, 10, 20, 30, 60)  #: n_p in the curves of figure 6: the paper's
_SMALL: Look = {"markersize": 1.8, "capsize": 2.2}  #: smaller than most intervals
_SIZE = "size of the pillars $n_p$ (blocks)"
_FLOOR = 0.01  #: %, where the logarithmic axis of detachments begins in figure 6
_LEAST = 0.01  #: c(r) at the foot of the logarithmic axis in figure 7
_SIDES: dict[str, Look] = {
    "x": {"color": BLUE, "marker": "D", "linestyle": "none"},
    "y": {"color": VERMILION, "marker": "s", "linestyle": "none"},
}
_DASHED: Look = {"linestyle": (0, (3.5, 1.2)), "linewidth": 0.9}  #: with A free
#: Colour and name of sliding directions on grooves along x; others are oblique.
_WAYS = {"x": (BLUE, "along grooves"), "y": (VERMILION, "across grooves")}
_SHOWN = 0.7  #: share of the highest mean force from which figure 9 shows forces


def figure_2(runs: Sequence[Run]) -> Figure:
    """Draw a), b) force, c), d) blocks of runs[0]; behind: spread or mean of the other runs.

    All runs share one sample interval.
    """
    run, others = runs[0], runs[1:]
    zoom = (MICRO * (run.t_max - _BEFORE), MICRO * (run.t_max + _AFTER))
    whole = (0.0, MICRO * float(run.time[-1]))
    picture, panels = style.panels(style.DOUBLE, 95.0, "ab;cd", width_ratios=(82, 71))
    for upper, lower, span in zip(panels[:2], panels[2:], (whole, zoom), strict=True):
        curves.draw_run(upper, lower, run, others, span)
    force, _, blocks, enlarged = panels
    for ax, name in ((force, "enlarged at the right"), (blocks, None)):
        ax.axvspan(*zoom, facecolor="none", edgecolor=BLACK, linestyle=":", zorder=0, label=name)
    style.legend_above(picture, force, blocks, ncols=4)
    end, height, before = MICRO * run.t_max, 6.0, MICRO * _BEFORE
    maps.arrow(enlarged, (end, height), (end - 0.8 * before, height))
    enlarged.text(end - 0.4 * before, 1.3 * height, "precursors", ha="center", va="bottom")
    return picture


def figure_3(runs: Sequence[Record]) -> Figure:
    """Map t_det/t_max of every block in runs[0]; light grey where a block is not in contact."""
    picture, (ax,) = style.panels(style.COLUMN, 100.0)
    maps.draw_times(ax, runs[0])
    maps.draw_sliding(ax, runs[0].scene.direction)
    return picture


def figure_5(runs: Sequence[Record]) -> Figure:
    """Map a) t_det/t_max by place on a pillar and b) compare the parts of its rings."""
    scene = runs[0].scene
    times = statistics.pillar_map(runs, scene.pattern)
    picture, (pillar, rings) = style.panels(style.DOUBLE, 75.0, "ab")
    maps.draw_mean_times(pillar, times.mean(axis=0), _TIME.replace("first detachment ", ""), "_p/l")
    maps.draw_sliding(pillar, scene.direction)
    _draw_rings(rings, times)
    return picture


def _draw_rings(ax: Axes, times: Array) -> None:
    """Draw means over the corners and the sides of each ring, from the edge to the middle.

    Their intervals are too narrow to be drawn: the legend says how wide the widest one is.
    """
    size = times.shape[-1]
    depths = range((size + 1) // 2)
    widths = []
    for part, (color, marker, name) in _PARTS.items():
        masks = {depth: statistics.pillar_ring(size, depth)[part] for depth in depths}
        samples = {d: times[:, m].mean(axis=1) for d, m in masks.items() if m.any()}
        if samples:
            means = statistics.mean_interval(np.stack(list(samples.values()), axis=1))
            ax.plot(list(samples), means.mean, color=color, marker=marker, label=name)
            widths.append(np.max(means.high - means.low))
    ax.set(xlabel="distance from the edge of the pillar (blocks)", ylabel=_TIME)
    ax.axhline(1.0, color=GREY, linestyle=":", zorder=0)
    side = ax.get_yaxis_transform()
    ax.text(0.985, 0.995, "force maximum", transform=side, color=GREY, ha="right", va="top")
    ax.set_xlim(-0.5, len(depths) - 0.5)
    ax.xaxis.set_major_locator(MaxNLocator(integer=True))
    sure = f"95 % intervals: up to ±{0.5 * max(widths):.2g}" if len(times) > 1 else None
    ax.legend(loc="lower right", title=sure, alignment="left")


def figure_6(ensembles: BySize) -> Figure:
    """Draw a) force, b) detachments over time; c) static friction, d) t_max - t_avg over n_p.

    The paper's sizes only in a) and b), where more could not be told apart.
    """
    ensembles = dict(sorted(ensembles.items()))
    ratios: Look = {"width_ratios": (90, 61), "height_ratios": (46, 40)}
    picture, panels = style.panels(style.DOUBLE, 118.0, "ac;bd", **ratios)
    force, blocks, static, lag = panels
    looks = style.pillar_looks(ensembles)
    shown = {n_p: runs for n_p, runs in ensembles.items() if n_p in _IN_TIME} or ensembles
    _draw_time(force, blocks, shown, looks)
    for n_p, runs in ensembles.items():
        highest = np.array([run.static_friction for run in runs])
        lags = MICRO * np.array([run.t_max - run.t_avg for run in runs])
        if n_p:  # each realisation, since these may form two clusters
            lag.plot(np.full(len(lags), n_p), lags, color=looks[n_p]["color"], **curves.DOT)
        for ax, sample in ((static, highest), (lag, lags)):
            mean = statistics.mean_interval(sample)
            if n_p:
                curves.draw_points(ax, [n_p], [mean], linestyle="none", **(looks[n_p] | _SMALL))
            else:
                _draw_flat(ax, mean)
    for ax, name in ((static, curves.FRICTION), (lag, curves.LAG)):
        curves.name_places(ax, [n_p for n_p in ensembles if n_p])
        ax.set(xlabel=_SIZE, ylabel=name)
    lag.axhline(0.0, **curves.ZERO)
    style.legend_above(picture, force, ncols=8)
    return picture


def _draw_time(force: Axes, blocks: Axes, ensembles: BySize, looks: Mapping[int, Look]) -> None:
    """Draw mean curves; on those of the force, markers at t_max."""
    highest = 0.0
    for n_p, runs in ensembles.items():
        curve, look = statistics.whole_curve(runs), looks[n_p]
        name = f"$n_p$ = {n_p}" if n_p else "flat"
        mean = curves.draw_mean_force(force, curve, label=name, spread=True, **look)
        curves.draw_detachments(blocks, curve, **look)
        highest = max(highest, float(np.nanmax(mean)))
        time = float(np.mean([run.t_max for run in runs]))
        force.plot(MICRO * time, np.interp(time, curve.time, mean), **look, zorder=3)
    force.plot([], [], color=GREY, **curves.REST, label="fewer runs")
    sign: Look = {"marker": "o", "linestyle": "none", "label": r"$t_\mathrm{max}$"}
    force.plot([], [], color=GREY, **sign)
    force.set(xlabel="time (µs)", ylabel=FORCE, ylim=(0.0, 1.07 * highest), xlim=(0.0, None))
    blocks.set(xlabel="time (µs)", xlim=force.get_xlim(), yscale="log", ylim=(_FLOOR, 100.0))
    blocks.yaxis.set_major_formatter("{x:g}")


def _draw_flat(ax: Axes, interval: Interval) -> None:
    """Draw the mean of a flat surface as a line with a band over its interval."""
    mean, low, high = map(float, interval)
    ax.axhline(mean, color=BLACK, linewidth=0.8, linestyle="--")
    ax.axhspan(low, high, color="0.8", linewidth=0.0, zorder=0)
    below: Look = {"textcoords": "offset points", "ha": "center", "va": "top"}
    ax.annotate("flat", (0.45, mean), (0.0, -2.0), ax.get_yaxis_transform(), **below)


def figure_7(
    n_p: int,
    correlation: "pd.DataFrame",
    lengths: "pd.DataFrame",
    edges: "pd.DataFrame | None" = None,
) -> Figure:
    """Draw a) c_x(r) and c_y(r) for one n_p, b) with their fits, and c) their lengths over n_p.

    `correlation`, `lengths` and `edges` are the tables correlation, correlation_length and
    precursors. Drawn are square pillars with equal gaps on the surface of most sizes.
    """
    correlation, lengths = _equal_gaps(correlation), _equal_gaps(lengths)
    correlation = correlation[correlation["n_p"] == n_p]
    shown = lengths[lengths["n_p"] == n_p].set_index("side")
    if shown.empty:
        raise ValueError(f"there is no correlation length for n_p = {n_p}")
    picture, (linear, log, sizes) = style.panels(style.DOUBLE, 66.0, "abc")
    for side, curve in correlation.groupby("side"):
        told = curve[(curve["ci_low"] > 0.0).cummin()]  # not zero
        look = _SIDES[str(side)] | {"label": f"$c_{side}(r)$, $n_p$ = {n_p}"}
        for ax, part in ((linear, curve[1:]), (log, told[1:])):
            values = Interval(*part[["correlation", "ci_low", "ci_high"]].to_numpy().T)
            curves.draw_band(ax, part["r"], values, **look)
        _draw_fits(log, look["color"], curve["r"].max(), shown.loc[str(side)])
    if edges is not None:
        _draw_chain(log, edges)
    linear.axhline(0.0, **curves.ZERO)
    log.plot([], [], color=GREY, label=r"$\exp(-r/l_c)$")
    log.plot([], [], color=GREY, label=r"$A\,\exp(-r/l_d)$", **_DASHED)
    log.set(yscale="log", ylim=(_LEAST, 1.1))
    log_end = 1.0 + correlation["r"][correlation["ci_low"] > 0.0].max()
    log.yaxis.set_major_formatter("{x:g}")
    for ax, end in ((linear, None), (log, log_end)):
        ax.set(xlabel="distance along the side $r$ (blocks)", ylabel="time correlation $c(r)$")
        ax.set_xlim(0.0, end)
        ax.xaxis.set_major_locator(MaxNLocator(integer=True, steps=[1, 2, 5, 10]))
    _draw_lengths(sizes, lengths[lengths["side"] == "x"])
    sizes.axhline(3.0, color=GREY, linestyle=":", zorder=0)  # l_c of the paper for n_p >= 20
    style.legend_above(picture, log, sizes, ncols=6)
    return picture


def _draw_chain(ax: Axes, edges: "pd.DataFrame") -> None:
    """Draw c(r) of the chain on edges along x and y, where it exceeds the foot of the axis."""
    paper = edges[(edges["what"] == "paper") & edges["quantity"].str.match(r"c_\d+$")]
    for edge, side in (("along", "x"), ("across", "y")):
        part = paper[(paper["edge"] == edge) & (paper["predicted"] > _LEAST)]
        r = part["quantity"].str.removeprefix("c_").astype(int)
        ax.plot(r, part["predicted"], "x", color=BLACK, label="chain" if side == "x" else None)


def _equal_gaps(table: "pd.DataFrame") -> "pd.DataFrame":
    """Return the rows of pillars with n_s = n_p, with surface and constants of most sizes."""
    found = table[(table["level"] == 1) & (table["n_s"] == table["n_p"])]
    same = ["n_blocks", "n_rows", "edges", "direction", *CONSTANTS]
    sizes = found.groupby(same, sort=False)["n_p"].transform("nunique")
    return found[(found[same] == found[same].iloc[sizes.to_numpy().argmax()]).all(axis=1)]


def _draw_fits(ax: Axes, color: str, end: int, length: Any) -> None:
    """Draw the fitted exponentials, dotted beyond what they were fitted to."""
    last = length["r_last"]
    for r, line in ((np.linspace(0.0, last), "-"), (np.linspace(last, end), ":")):
        ax.plot(r, np.exp(-r / length["l_c"]), color=color, linestyle=line)
    if np.isfinite(length["tail"]):
        r = np.linspace(1.0, last)
        ax.plot(r, length["amplitude"] * np.exp(-r / length["tail"]), color=color, **_DASHED)


def _draw_lengths(ax: Axes, lengths: "pd.DataFrame") -> None:
    """Draw l_c of c_x over log n_p; open points: l_d, with A free."""
    for columns, face, aside, label in (
        (["l_c", "ci_low", "ci_high"], BLUE, 0.96, "correlation length $l_c$"),
        (["tail", "tail_low", "tail_high"], "white", 1.04, "decay length $l_d$"),
    ):
        look = _SIDES["x"] | {"markerfacecolor": face, "label": label}
        curves.draw_points(ax, aside * lengths["n_p"], lengths[columns], **look)
    curves.name_places(ax, lengths["n_p"])
    ax.set(xlabel=_SIZE, ylabel="lengths in $c_x$ (blocks)", ylim=(0.0, None))


def figure_9(ensembles: Mapping[Grooves, Sequence[Run]]) -> Figure:
    """Draw force and detachments on grooved pillars, a row for each pattern, with the same axes.

    Rows in descending order of the clearest second load peak of the mean force.
    """
    found = {key: statistics.whole_curve(runs) for key, runs in sorted(ensembles.items())}
    falls = {key: statistics.prominence_of_mean(ensembles[key]) for key in found}
    clearest = sorted(falls, key=lambda key: -float(falls[key].mean))
    rows = list(dict.fromkeys(key[:-1] for key in clearest))
    letters = [ascii_lowercase[2 * i : 2 * i + 2] for i in range(len(rows))]
    look: Look = {"width_ratios": (95, 57), "sharex": True}
    height = 22.0 + 43.0 * len(rows)
    picture, panels = style.panels(style.DOUBLE, height, ";".join(letters), **look)
    for force, blocks, row in zip(panels[::2], panels[1::2], rows, strict=True):
        told = []
        for direction, curve in [(key[-1], found[key]) for key in found if key[:-1] == row]:
            color, name = _WAYS.get(direction, (style.GREEN, f"at {direction}° to grooves"))
            curves.draw_single_forces(force, curve, color)
            curves.draw_mean_force(force, curve, color, name)
            curves.draw_detachments(blocks, curve, color)
            curves.draw_load_peaks(force, blocks, ensembles[*row, direction], color)
            told.append(f"{name.removesuffix(' grooves')} {_percent(falls[*row, direction])}")
        force.set_ylabel(FORCE)
        named = f"{_pattern_name(row)}: mean force falls between its peaks by"
        force.set_title("\n".join([named, ", ".join(told)]), loc="right", fontsize="medium")
        force.sharey(panels[0])
        blocks.sharey(panels[1])
    _fit_forces(panels[0], list(found.values()))
    panels[1].set(yscale="log", ylim=(_FLOOR, 100.0))
    panels[1].yaxis.set_major_formatter("{x:g}")
    for ax in panels[-2:]:
        ax.set_xlabel("time (µs)")
    peak: Look = {"marker": "v", "linestyle": "none", "label": "load peak of the mean"}
    panels[-2].plot([], [], color=GREY, **peak)
    panels[-2].plot([], [], color=GREY, **curves.REST, label="fewer runs")
    style.legend_above(picture, *panels[::2], ncols=4)
    return picture


def _pattern_name(pattern: tuple[int, int, int, int, str]) -> str:
    """Name the levels above the pillars, from their lengths and direction."""
    *lengths, along_3 = pattern
    pairs = zip(lengths[::2], lengths[1::2], strict=True)
    levels = [
        f"$n_p^{{({level})}}/n_s^{{({level})}}$ = {size}/{gap}"
        for level, (size, gap) in enumerate(pairs, 2)
        if size
    ]
    return ", ".join(levels) + (f", cut along {along_3}" if along_3 else "")


def _percent(share: Interval) -> str:
    """Return a share in percent, with its interval if it has one."""
    mean, low, high = (style.PERCENT * float(each) for each in share)
    return f"{mean:.1f} %" + (f" [{low:.1f}, {high:.1f}]" if np.isfinite(low) else "")


def _fit_forces(ax: Axes, every: Sequence[LoadCurves]) -> None:
    """Fit an axis to mean forces above `_SHOWN` of the highest, with room for triangles."""
    means = [(MICRO * c.time, statistics.mean_of_rest(c.friction).mean) for c in every]
    highest = max(np.nanmax(mean) for _, mean in means)
    lowest = _SHOWN * highest
    start = min(time[np.argmax(mean >= lowest)] for time, mean in means)
    end = max(time[np.isfinite(mean)][-1] for time, mean in means)
    ax.set(xlim=(start, end), ylim=(lowest, highest + 0.15 * (highest - lowest)))
