"""Errors of single runs and of ensembles against what they cost."""

from collections.abc import Iterator, Sequence
from typing import Any, cast

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FixedLocator, LogLocator, NullFormatter, SymmetricalLogLocator
from numpy.typing import ArrayLike
from pandas import DataFrame

from springblock.accuracy import budget, conventions
from springblock.accuracy.budget import Bias, Cases, Choice
from springblock.accuracy.conventions import DELAY, ENSEMBLE, LENGTH, PAPER_STEP, PLAIN, SCENES
from springblock.io.rows import Row
from springblock.model.defaults import INTEGRATOR, STEP
from springblock.plotting import style
from springblock.plotting.looks import shades
from springblock.plotting.points import draw_points, name_places
from springblock.plotting.style import BLACK, BLUE, GREY, NANO, PERCENT, VERMILION, Look
from springblock.simulation.run import Array

#: Names, colours and markers. Runge-Kutta lies on top where it covers the leapfrog.
_METHODS: dict[str, tuple[str, Look]] = {
    "leapfrog": ("leapfrog", {"color": BLUE, "marker": "o", "markersize": 4.2}),
    "rk4": ("Runge–Kutta", {"color": VERMILION, "marker": "s", "markersize": 2.6}),
    PLAIN: ("Runge–Kutta, stage-wise friction", {"color": GREY, "marker": "^", "markersize": 3.4}),
}
_ORDER_TWO: Look = {"color": BLACK, "linewidth": 0.6, "linestyle": (0, (5, 3))}
_SCATTER: Look = {"color": "#D6E4EE", "linewidth": 0.0, "zorder": 0}
_FULL_SCATTER: Look = _SCATTER | {"color": "#A4C3D9", "zorder": 0.2}
#: Name and look of the leapfrog on surfaces of the study's size.
_FULL: tuple[str, Look] = ("leapfrog, 120 × 120 blocks", {"color": BLACK, "marker": "D"})
_RING: Look = {"fillstyle": "none", "color": BLACK, "linestyle": "none"}
#: Integrator, step in s and ring of the default of `simulate` and of the paper.
_MARKED: dict[str, tuple[str, float, Look]] = {
    "default": (INTEGRATOR, STEP, {**_RING, "marker": "o", "markersize": 8.5}),
    "paper": (PLAIN, PAPER_STEP, {**_RING, "marker": "D", "markersize": 7.5}),
}

_DOTS = (1, 10, 100, 1000)  #: seeds marked along a line of total errors
_SPENT = (0.2, 2e3)  #: CPU time of ensembles, s
#: Names and looks of quantities with total errors.
_QUANTITIES: dict[str, tuple[str, Look]] = {
    "static_friction": ("static friction", {"color": BLACK, "marker": "o", "markersize": 3.0}),
    DELAY: (r"$t_\mathrm{max} - t_\mathrm{avg}$", {"color": VERMILION, "marker": "s"}),
    LENGTH: ("decay length", {"color": BLUE, "marker": "^", "markersize": 3.6}),
}
_STUDY: Look = {**_RING, "marker": "o", "markersize": 8.0}  #: ring of the study's own ensembles
_ENVELOPE: Look = {"color": "0.8", "linewidth": 4.0, "zorder": 0.5}


def work_precision(table: DataFrame, production: DataFrame | None = None) -> Figure:
    """Draw the tables of work and precision and, if there is one, of production; a scene a column.

    a-c) Single runs against a solution that locates every event: error of the detachment times
    before the horizon over force evaluations. Rings mark the default of `simulate` and the step of
    the paper. d-f) Ensembles with paired seeds: bias of static friction with its 95 % interval.
    """
    picture, panels = style.panels(style.DOUBLE, 125.0, "abc;def")
    times, biases = panels[:3], panels[3:]
    single = table[table.comparison == "reference"]
    before_horizon = single[single.quantity == "t_det before horizon"]
    _draw_costs(times, before_horizon)
    _name_scenes(times, single)
    _draw_paired(biases, table[table.quantity == "static_friction"])
    if production is not None:
        _draw_production(biases, production[production.quantity == "static_friction"])
    _fit_percent(biases, 1.0, (-5.0, -1.0, 0.0, 1.0, 5.0))
    name_places(biases[0], NANO * table[table.comparison == "paired"].step)
    _name_methods(picture, production is not None)
    return picture


def _by_scene(panels: Sequence[Axes], rows: DataFrame) -> Iterator[tuple[Axes, DataFrame]]:
    """Yield a panel for each scene, and its rows."""
    for ax, scene in zip(panels, SCENES, strict=True):
        yield ax, rows[rows.scene == scene]


def _name_scenes(panels: Sequence[Axes], rows: DataFrame) -> None:
    """Write above each column which scene it shows, and how large it is."""
    for ax, part in _by_scene(panels, rows):
        sizes = " or ".join(f"{n} × {n}" for n in part.n_blocks.unique())
        ax.set_title(f"{part.scene.iloc[0]}, {sizes} blocks")


def _draw_costs(panels: Sequence[Axes], rows: DataFrame) -> None:
    """Draw the error of detachment times over force evaluations, on common axes.

    Below the leapfrog lies a line of order 2.
    """
    style.share_axes(panels)
    cost = "force_evaluations"
    for ax, part in _by_scene(panels, rows):
        lines = {m: part[part.integrator == m].sort_values("step") for m in _METHODS}
        for method, (_, look) in _METHODS.items():
            ax.plot(lines[method][cost], lines[method].error, **look)
        spent, finest = lines["leapfrog"][cost].to_numpy(), lines["leapfrog"].error.iloc[0]
        ax.plot(spent, finest * (spent[0] / spent) ** 2 / 3.0, **_ORDER_TWO)
        for method, step, look in _MARKED.values():
            row = lines[method][np.isclose(lines[method].step, step, rtol=1e-6, atol=0.0)]
            ax.plot(row[cost], row.error, **look)
        ax.set_xlabel("force evaluations")
    ax = panels[0]
    ax.set(xscale="log", yscale="log")
    ax.set_ylabel("RMS error of $t_\\mathrm{det}/t_\\mathrm{max}$\nbefore the horizon")
    ax.set_xlim(0.6 * rows[cost].min(), 1.7 * rows[cost].max())
    ax.set_ylim(0.3 * rows.error.min(), 3.0 * rows.error.max())
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_minor_locator(LogLocator(subs=range(2, 10), numticks=99))


def _draw_paired(panels: Sequence[Axes], table: DataFrame) -> None:
    """Draw biases of ensembles with paired seeds, before the scatter of one of the study's size."""
    paired, scatter = (table[table.comparison == name] for name in ("paired", "scatter"))
    style.share_axes(panels)
    for ax, spread in _by_scene(panels, scatter):
        # 95 % of the means over as many seeds as in the study lie within ± half.
        deviation = (spread.ci_high - spread.ci_low) * np.sqrt(spread.realisations / ENSEMBLE)
        half = 0.5 * PERCENT * float(deviation.item())
        ax.axhspan(-half, half, **_SCATTER)
        ax.axhline(0.0, color=BLACK, linewidth=0.4, zorder=0.5)
        ax.set_xlabel("integration step (ns)")
    for ax, biases in _by_scene(panels, paired):
        for method, aside in (("leapfrog", 0.94), ("rk4", 1.06)):  # side by side
            line = biases[biases.integrator == method].sort_values("step")
            intervals = PERCENT * line[["error", "ci_low", "ci_high"]]
            draw_points(ax, aside * NANO * line.step, intervals, **_METHODS[method][1])
    _name_scenes(panels, paired)
    panels[0].set_ylabel("bias of static friction (%)")


def _draw_production(panels: Sequence[Axes], table: DataFrame) -> None:
    """Draw biases and scatter of ensembles of the study's size; the finest step has no bias."""
    for ax, rows in _by_scene(panels, table.sort_values("step")):
        share = rows[["bias", "ci_low", "ci_high"]].div(rows.scale, axis=0)[1:]
        draw_points(ax, NANO * rows.step[1:], PERCENT * share, **_FULL[1])
        spread = float((rows.deviation / rows.scale).iloc[0])
        half = PERCENT * conventions.half_width(spread, ENSEMBLE)
        ax.axhspan(-half, half, **_FULL_SCATTER)


def _fit_percent(panels: Sequence[Axes], linear: float, ticks: Sequence[float]) -> None:
    """Make the axis that panels share linear up to ± `linear`, % and logarithmic beyond.

    Neither the intervals of fine steps nor the biases of the coarsest get lost on it.
    """
    low = min(-linear, *(ax.dataLim.y0 for ax in panels))
    high = max(linear, *(ax.dataLim.y1 for ax in panels))
    axis = panels[0].yaxis
    panels[0].set_yscale("symlog", linthresh=linear, linscale=1.0)
    axis.set_major_locator(FixedLocator(ticks))
    axis.set_minor_locator(SymmetricalLogLocator(base=10, linthresh=linear, subs=range(2, 10)))
    axis.set_major_formatter("{x:g}")
    panels[0].set_ylim(1.5 * low, 1.5 * high)


def _name_methods(picture: Figure, full: bool) -> None:
    """Write above the panels what holds for all of them."""
    handles: list[Artist] = [Line2D([], [], label=name, **look) for name, look in _METHODS.values()]
    handles.append(Line2D([], [], label="order 2", **_ORDER_TWO))
    for name, (method, step, look) in _MARKED.items():
        label = f"{name}: {_METHODS[method][0].split(',')[0]}, {NANO * step:g} ns"
        handles.append(Line2D([], [], label=label, **look))
    handles.append(Patch(label=f"95 % of means over {ENSEMBLE} seeds", **_SCATTER))
    if full:
        handles.append(Line2D([], [], label=_FULL[0], **_FULL[1]))
        handles.append(Patch(label="the same, 120 × 120 blocks", **_FULL_SCATTER))
    picture.legend(handles=handles, loc="outside upper center", ncols=4)


def total_error(table: DataFrame) -> Figure:
    """Draw the table `production`: biases, and total errors."""
    picture, panels = style.panels(style.DOUBLE, 217.0, "abc;def;ghi|.jL", height_ratios=(3, 1))
    *panels, legend = panels
    rows = cast(list[Row], table.to_dict("records"))
    cases, colors = budget.measured(rows, _QUANTITIES), shades(table.step)
    _draw_biases(panels[:3], cases)
    for ax, rows in zip(panels[3:], cases.values(), strict=True):
        _draw_errors(ax, rows, colors)
        ax.set(xscale="log", yscale="log", xlabel="CPU time of an ensemble (s)", xlim=_SPENT)
    for first, (name, _) in zip((3, 6, 9), _QUANTITIES.values(), strict=True):
        row = panels[first : first + 3]
        row[0].set_ylabel(f"error of {name} (%)")
        ends = np.array([ax.get_ylim() for ax in row])
        style.share_axes(row)
        row[0].set_ylim(0.25 * ends.min(), ends.max())  # room for words
    _name_steps(legend, colors)
    return picture


def _draw_biases(panels: Sequence[Axes], cases: Cases) -> None:
    """Draw biases of all quantities, side by side at each step but the finest, which has none."""
    for ax, scene in zip(panels, SCENES, strict=True):
        for aside, quantity in zip((0.95, 1.0, 1.05), _QUANTITIES, strict=True):
            if rows := cases.get((quantity, scene), [])[1:]:
                keys = ("bias", "ci_low", "ci_high")
                percent = [[PERCENT * row[key] / row["scale"] for key in keys] for row in rows]
                places = [aside * row["cpu_seconds"] for row in rows]
                draw_points(ax, places, percent, **_QUANTITIES[quantity][1])
        _mark_steps(ax, cases["static_friction", scene])
        n = cases["static_friction", scene][0]["n_blocks"]
        ax.set_title(f"{scene}, {n} × {n} blocks", pad=13.0)
        ax.axhline(0.0, color=BLACK, linewidth=0.4, zorder=0.5)
        ax.set(xscale="log", xlabel="CPU time of a realisation (s)")
        ax.margins(x=0.08)
        ax.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        ax.xaxis.set_major_formatter("{x:g}")
        ax.xaxis.set_minor_formatter(NullFormatter())
        ax.sharey(panels[0])
        ax.tick_params(labelleft=ax is panels[0])
    _fit_percent(panels, 0.1, (-1.0, -0.1, 0.0, 0.1, 1.0))
    panels[0].set_ylabel("bias (%), linear within ±0.1 %")
    handles = [Line2D([], [], label=name, **look) for name, look in _QUANTITIES.values()]
    frame: Look = {"frameon": True, "framealpha": 1.0, "edgecolor": "none"}
    panels[0].legend(handles=handles, loc="lower right", **frame)


def _mark_steps(ax: Axes, rows: list[Row]) -> None:
    """Draw a line at the CPU time of each step, and write the step in ns above it."""
    for row in rows:
        ax.axvline(row["cpu_seconds"], color=GREY, linewidth=0.3, zorder=0.3)
        name = f"{NANO * row['step']:g}{' ns' if row is rows[0] else ''}"
        look: Look = {"xycoords": ("data", "axes fraction"), "textcoords": "offset points"}
        look |= {"ha": "center", "fontweight": "bold" if row["step"] == STEP else "normal"}
        ax.annotate(name, (row["cpu_seconds"], 1.0), (0.0, 2.5), **look)


def _draw_errors(ax: Axes, rows: list[Row], colors: dict[float, Any]) -> None:
    """Draw the total error of each step over the CPU time of ensembles, and the least of all.

    Words name the best step and number of seeds at the ring, and what half its error costs.
    """
    by_bias = [budget.choices(rows, bias) for bias in Bias._fields]
    spent = np.geomspace(*_SPENT, 400)
    for choice, low, high in zip(*by_bias, strict=True):
        look: Look = {"color": colors[choice.step], "zorder": 2.0 + (choice.step == STEP)}
        ax.plot(spent, _errors(choice, spent), linewidth=_wide(choice.step), **look)
        dots = np.array([choice.spent(seeds) for seeds in _DOTS]) * (1.0 + 1e-12)
        ax.plot(dots, _errors(choice, dots), linestyle="none", marker=".", **look)
        ends = _errors(low, spent), _errors(high, spent)
        ax.fill_between(spent, *ends, color=look["color"], alpha=0.15, linewidth=0.0)
    seconds, steps = budget.study_budget(rows), by_bias[0]
    (default,) = (choice for choice in steps if choice.step == STEP)
    ax.plot([seconds], _errors(default, np.array([seconds])), **_STUDY)
    ax.plot(spent, [PERCENT * budget.best(steps, s).error(s) for s in spent], **_ENVELOPE)
    chosen, costs = budget.best(steps, seconds), [budget.halving(each, seconds) for each in by_bias]
    words = (
        f"best at {seconds:.2g} s: {NANO * chosen.step:g} ns, {chosen.seeds(seconds):.0f} seeds;\n"
        f"half its error: {costs[0]:.1f} × CPU time\n({min(costs):.1f} to {max(costs):.1f})"
    )
    ax.text(0.03, 0.05, words, transform=ax.transAxes)


def _errors(choice: Choice, spent: Array) -> Array:
    """Return the total error in percent for each CPU time in s, (n,); NaN before one is done."""
    return PERCENT * _finite([choice.error(seconds) for seconds in spent])


def _finite(errors: ArrayLike) -> Array:
    """Replace infinite errors by NaN, which is not drawn."""
    return np.where(np.isfinite(errors), errors, np.nan)


def _wide(step: float) -> float:
    return 1.6 if step == STEP else 0.8


def _name_steps(ax: Axes, colors: dict[float, Any]) -> None:
    """Explain the panels of total errors, in the place of one of them."""
    handles: list[Artist] = []
    for step, color in colors.items():
        name = f"{NANO * step:g} ns{', the default' if step == STEP else ''}"
        look: Look = {"color": color, "linewidth": _wide(step), "marker": "."}
        handles.append(Line2D([], [], label=name, **look))
    handles.append(Line2D([], [], label="the study's seeds", **_STUDY))
    handles.append(Line2D([], [], label="least error", **_ENVELOPE))
    handles.append(Patch(label="bias within its interval", color=GREY, alpha=0.25, linewidth=0.0))
    ax.set_axis_off()
    ax.legend(handles=handles, loc="upper left")
