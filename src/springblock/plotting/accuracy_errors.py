"""Errors of single runs and of ensembles against what they cost."""

from collections.abc import Sequence
from itertools import product
from typing import Any, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, LogLocator, NullFormatter, SymmetricalLogLocator
from pandas import DataFrame

from springblock.accuracy import budget, conventions
from springblock.accuracy.budget import Bias, Choice
from springblock.accuracy.conventions import DELAY, ENSEMBLE, LENGTH, PAPER_STEP, PLAIN, SCENES
from springblock.io.rows import Row
from springblock.model.defaults import INTEGRATOR, STEP
from springblock.plotting import style
from springblock.plotting.looks import METHODS, shades
from springblock.plotting.points import draw_points, name_places
from springblock.plotting.style import BLACK, BLUE, GREY, NANO, PERCENT, VERMILION, Look
from springblock.simulation.run import Array

Cases = dict[tuple[str, str], list[Row]]  #: by quantity and scene, finest step first

#: Names, colours and markers, with the Runge-Kutta whose order is lost.
_METHODS = METHODS | {
    PLAIN: {"label": "Runge–Kutta, stage-wise friction", "color": GREY}
    | {"marker": "^", "markersize": 3.4}
}
_ORDER_TWO: Look = {"color": BLACK, "linewidth": 0.6, "linestyle": (0, (5, 3))}
_SCATTER: Look = {"color": "#D6E4EE", "linewidth": 0.0, "zorder": 0}
_FULL_SCATTER: Look = _SCATTER | {"color": "#A4C3D9", "zorder": 0.2}
#: Of the leapfrog on surfaces of the study's size.
_FULL: Look = {"label": "leapfrog, 120 × 120 blocks", "color": BLACK, "marker": "D"}
_RING: Look = {"fillstyle": "none", "color": BLACK, "linestyle": "none"}
#: Integrator, step in s and ring of the default of `simulate` and of the paper.
_MARKED: dict[str, tuple[str, float, Look]] = {
    "default": (INTEGRATOR, STEP, {**_RING, "marker": "o", "markersize": 8.5}),
    "paper": (PLAIN, PAPER_STEP, {**_RING, "marker": "D", "markersize": 7.5}),
}

_DOTS = (1, 10, 100, 1000)  #: seeds marked along a line of total errors
_SPENT = (0.2, 2e3)  #: CPU time of ensembles, s
#: Looks of quantities with total errors.
_QUANTITIES: dict[str, Look] = {
    "static_friction": {"label": "static friction", "color": BLACK, "marker": "o"},
    DELAY: {"label": r"$t_\mathrm{max} - t_\mathrm{avg}$", "color": VERMILION, "marker": "s"},
    LENGTH: {"label": "decay length", "color": BLUE, "marker": "^", "markersize": 3.6},
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
    reference = table[table.comparison == "reference"]
    single = reference[reference.quantity == "t_det before horizon"]
    ensembles = table[table.quantity == "static_friction"]
    for row in (times, biases):
        style.share_axes(row)
    for scene, upper, lower in zip(SCENES, times, biases, strict=True):
        _draw_costs(upper, single[single.scene == scene])
        _draw_paired(lower, ensembles[ensembles.scene == scene])
        if production is not None:
            full = production[production.quantity == "static_friction"]
            _draw_production(lower, full[full.scene == scene].sort_values("step"))
    _fit_costs(times[0], single)
    biases[0].set_ylabel("bias of static friction (%)")
    _fit_percent(biases, 1.0, (-5.0, -1.0, 0.0, 1.0, 5.0))
    name_places(biases[0], NANO * table[table.comparison == "paired"].step)
    style.legend_above(picture, times[0], biases[0], ncols=4)
    return picture


def _name_scene(ax: Axes, rows: DataFrame) -> None:
    """Write above a panel which scene it shows, and how large it is."""
    sizes = " or ".join(f"{n} × {n}" for n in rows.n_blocks.unique())
    ax.set_title(f"{rows.scene.iloc[0]}, {sizes} blocks")


def _draw_costs(ax: Axes, rows: DataFrame) -> None:
    """Draw the error of detachment times over force evaluations, and a line of order 2."""
    lines = {method: rows[rows.integrator == method].sort_values("step") for method in _METHODS}
    for method, look in _METHODS.items():
        ax.plot(lines[method].force_evaluations, lines[method].error, **look)
    finest = lines["leapfrog"].iloc[0]
    spent = lines["leapfrog"].force_evaluations
    order_two = finest.error * (finest.force_evaluations / spent) ** 2 / 3.0
    ax.plot(spent, order_two, label="order 2", **_ORDER_TWO)
    for name, (method, step, look) in _MARKED.items():
        row = lines[method][np.isclose(lines[method].step, step, rtol=1e-6, atol=0.0)]
        label = f"{name}: {_METHODS[method]['label'].split(',')[0]}, {NANO * step:g} ns"
        ax.plot(row.force_evaluations, row.error, label=label, **look)
    ax.set_xlabel("force evaluations")
    _name_scene(ax, rows)


def _fit_costs(ax: Axes, rows: DataFrame) -> None:
    """Make the axes that panels share logarithmic, with room for rings and lines."""
    ax.set(xscale="log", yscale="log")
    ax.set_ylabel("RMS error of $t_\\mathrm{det}/t_\\mathrm{max}$\nbefore the horizon")
    ax.set_xlim(0.6 * rows.force_evaluations.min(), 1.7 * rows.force_evaluations.max())
    ax.set_ylim(0.3 * rows.error.min(), 3.0 * rows.error.max())
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_minor_locator(LogLocator(subs=range(2, 10), numticks=99))


def _draw_paired(ax: Axes, table: DataFrame) -> None:
    """Draw biases of ensembles with paired seeds, before the scatter of one of the study's size."""
    paired, scatter = (table[table.comparison == name] for name in ("paired", "scatter"))
    # 95 % of the means over as many seeds as in the study lie within ± half.
    deviation = (scatter.ci_high - scatter.ci_low) * np.sqrt(scatter.realisations / ENSEMBLE)
    half = 0.5 * PERCENT * float(deviation.item())
    ax.axhspan(-half, half, label=f"95 % of means over {ENSEMBLE} seeds", **_SCATTER)
    ax.axhline(0.0, color=BLACK, linewidth=0.4, zorder=0.5)
    for method, aside in (("leapfrog", 0.94), ("rk4", 1.06)):  # side by side
        line = paired[paired.integrator == method].sort_values("step")
        intervals = PERCENT * line[["error", "ci_low", "ci_high"]]
        draw_points(ax, aside * NANO * line.step, intervals, **_METHODS[method])
    ax.set_xlabel("integration step (ns)")
    _name_scene(ax, paired)


def _draw_production(ax: Axes, rows: DataFrame) -> None:
    """Draw biases and scatter of ensembles of the study's size; the finest step has no bias."""
    share = rows[["bias", "ci_low", "ci_high"]].div(rows.scale, axis=0)[1:]
    draw_points(ax, NANO * rows.step[1:], PERCENT * share, **_FULL)
    spread = float((rows.deviation / rows.scale).iloc[0])
    half = PERCENT * conventions.half_width(spread, ENSEMBLE)
    ax.axhspan(-half, half, label="the same, 120 × 120 blocks", **_FULL_SCATTER)


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


def total_error(table: DataFrame) -> Figure:
    """Draw the table `production`: biases, and total errors."""
    picture, panels = style.panels(style.DOUBLE, 217.0, "abc;def;ghi|.jL", height_ratios=(3, 1))
    *panels, legend = panels
    cases, colors = _cases(table), shades(table.step)
    _draw_biases(panels[:3], cases)
    for ax, rows in zip(panels[3:], cases.values(), strict=True):
        _draw_errors(ax, rows, colors)
        ax.set(xscale="log", yscale="log", xlabel="CPU time of an ensemble (s)", xlim=_SPENT)
    for first, look in zip((3, 6, 9), _QUANTITIES.values(), strict=True):
        row = panels[first : first + 3]
        row[0].set_ylabel(f"error of {look['label']} (%)")
        ends = np.array([ax.get_ylim() for ax in row])
        style.share_axes(row)
        row[0].set_ylim(0.25 * ends.min(), ends.max())  # room for words
    legend.set_axis_off()
    legend.legend(*panels[3].get_legend_handles_labels(), loc="upper left")
    return picture


def _cases(table: DataFrame) -> Cases:
    """Return the rows of each quantity and scene that were measured together."""
    ordered = table.sort_values("step")
    cases = {}
    for quantity, scene in product(_QUANTITIES, SCENES):
        rows = ordered[(ordered.quantity == quantity) & (ordered.scene == scene)]
        if len(rows):
            cases[quantity, scene] = cast(list[Row], rows.to_dict("records"))
    return cases


def _draw_biases(panels: Sequence[Axes], cases: Cases) -> None:
    """Draw biases of all quantities, side by side at each step but the finest, which has none."""
    for ax, scene in zip(panels, SCENES, strict=True):
        for aside, quantity in zip((0.95, 1.0, 1.05), _QUANTITIES, strict=True):
            if rows := cases.get((quantity, scene), [])[1:]:
                keys = ("bias", "ci_low", "ci_high")
                percent = [[PERCENT * row[key] / row["scale"] for key in keys] for row in rows]
                places = [aside * row["cpu_seconds"] for row in rows]
                draw_points(ax, places, percent, **_QUANTITIES[quantity])
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
    frame: Look = {"frameon": True, "framealpha": 1.0, "edgecolor": "none"}
    named = panels[SCENES.index("pillared")].get_legend_handles_labels()  # all quantities
    panels[0].legend(*named, loc="lower right", **frame)


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
        is_default = choice.step == STEP
        look: Look = {"color": colors[choice.step], "zorder": 2.0 + is_default}
        name = f"{NANO * choice.step:g} ns{', the default' if is_default else ''}"
        width = 1.6 if is_default else 0.8
        ax.plot(spent, _errors(choice, spent), linewidth=width, label=name, **look)
        dots = np.array([choice.spent(seeds) for seeds in _DOTS]) * (1.0 + 1e-12)
        ax.plot(dots, _errors(choice, dots), linestyle="none", marker=".", **look)
        ends = _errors(low, spent), _errors(high, spent)
        ax.fill_between(spent, *ends, color=look["color"], alpha=0.15, linewidth=0.0)
    seconds, steps = budget.study_budget(rows), by_bias[0]
    (default,) = (choice for choice in steps if choice.step == STEP)
    ax.plot([seconds], _errors(default, np.array([seconds])), label="the study's seeds", **_STUDY)
    least = [PERCENT * budget.best(steps, s).error(s) for s in spent]
    ax.plot(spent, least, label="least error", **_ENVELOPE)
    ax.plot([], [], color=GREY, alpha=0.25, linewidth=5.0, label="bias within its interval")
    chosen, costs = budget.best(steps, seconds), [budget.halving(each, seconds) for each in by_bias]
    words = (
        f"best at {seconds:.2g} s: {NANO * chosen.step:g} ns, {chosen.seeds(seconds):.0f} seeds;\n"
        f"half its error: {costs[0]:.1f} × CPU time\n({min(costs):.1f} to {max(costs):.1f})"
    )
    ax.text(0.03, 0.05, words, transform=ax.transAxes)


def _errors(choice: Choice, spent: Array) -> Array:
    """Return the total error in percent for each CPU time in s, (n,); NaN before one is done."""
    errors = PERCENT * np.array([choice.error(seconds) for seconds in spent])
    return np.where(np.isfinite(errors), errors, np.nan)
