"""Errors of single runs and of ensembles against their cost, and of extreme cases."""

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
from springblock.plotting.curves import draw_points, name_places
from springblock.plotting.style import BLACK, BLUE, GREY, NANO, PERCENT, VERMILION, Look
from springblock.simulation.run import Array

Cases = dict[tuple[str, str], DataFrame]  #: by quantity and scene, finest step first

#: Names, colours and markers, with the Runge-Kutta whose order is lost.
_METHODS = style.METHODS | {
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

#: Outcomes without an error to show: marker, its height as a share of the panel, and name.
_ENDS = {
    "refused": ("x", 0.95, "refused at the start"),
    "raises": ("^", 0.87, "ended by an exception"),
    "nothing": ("d", 0.79, "as expected, nothing to compare"),
}
_ACCEPTED: Look = {"label": "accepted", "color": GREY, "marker": "_", "markersize": 6.0}
_ACCEPTED |= {"linestyle": ""}

#: Families over a parameter: names of the axis and the panel, and how what it shows begins.
_PANELS = {
    "stiffness": (
        r"$K_s/K_\mathrm{int}$",
        "path of a column,\ndotted: first detachment",
        ("displacement", "first detachment"),
    ),
    "strain": (r"strain $u/l$", "path of a column", ("displacement",)),
    "damping": (r"damping $\gamma/\omega$", "force in the slip", ("spring force",)),
    "speed": (r"speed $v\,K_s/(F_n\,\omega)$", "force after the slip", ("spring force",)),
}
_SMALLEST = 1e-16  #: relative error
_LEAST = 1e-6  #: share of the accepted error; what is less, or nothing, is drawn here


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


def _name_scene(ax: Axes, rows: DataFrame, pad: float | None = None) -> None:
    """Write the scene and its size above a panel."""
    sizes = " or ".join(f"{n} × {n}" for n in rows.n_blocks.unique())
    ax.set_title(f"{rows.scene.iloc[0]}, {sizes} blocks", pad=pad)


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
    for method, aside in (("leapfrog", 0.94), ("rk4", 1.06), (PLAIN, 1.0)):  # side by side
        line = paired[paired.integrator == method].sort_values("step")
        intervals = PERCENT * line[["error", "ci_low", "ci_high"]]
        draw_points(ax, aside * NANO * line.step, intervals, **_METHODS[method])
    ax.set_xlabel("integration step (ns)")
    _name_scene(ax, paired)


def _draw_production(ax: Axes, rows: DataFrame) -> None:
    """Draw biases and scatter of ensembles of the study's size; the finest step has no bias."""
    draw_points(ax, NANO * rows.step[1:], _percent(rows), **_FULL)
    spread = float((rows.deviation / rows.scale).iloc[0])
    half = PERCENT * conventions.half_width(spread, ENSEMBLE)
    ax.axhspan(-half, half, label="the same, 120 × 120 blocks", **_FULL_SCATTER)


def _percent(rows: DataFrame) -> DataFrame:
    """Return biases at all steps but the finest with their intervals, (n, 3) %."""
    return PERCENT * rows[["bias", "ci_low", "ci_high"]].div(rows.scale, axis=0)[1:]


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
    measured = table.sort_values("step").groupby(["quantity", "scene"])
    every = [case for case in product(_QUANTITIES, SCENES) if case in measured.groups]
    cases, colors = {case: measured.get_group(case) for case in every}, style.shades(table.step)
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


def _draw_biases(panels: Sequence[Axes], cases: Cases) -> None:
    """Draw biases of all quantities, side by side at each step but the finest, which has none."""
    for ax, scene in zip(panels, SCENES, strict=True):
        for aside, quantity in zip((0.95, 1.0, 1.05), _QUANTITIES, strict=True):
            if (quantity, scene) in cases:
                rows = cases[quantity, scene]
                places = aside * rows.cpu_seconds[1:]
                draw_points(ax, places, _percent(rows), **_QUANTITIES[quantity])
        _mark_steps(ax, cases["static_friction", scene])
        _name_scene(ax, cases["static_friction", scene], pad=13.0)
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


def _mark_steps(ax: Axes, rows: DataFrame) -> None:
    """Draw a line at the CPU time of each step, and write the step in ns above it."""
    for spent, step in zip(rows.cpu_seconds, rows.step, strict=True):
        ax.axvline(spent, color=GREY, linewidth=0.3, zorder=0.3)
        name = f"{NANO * step:g}{' ns' if step == rows.step.min() else ''}"
        look: Look = {"xycoords": ("data", "axes fraction"), "textcoords": "offset points"}
        look |= {"ha": "center", "fontweight": "bold" if step == STEP else "normal"}
        ax.annotate(name, (spent, 1.0), (0.0, 2.5), **look)


def _draw_errors(ax: Axes, table: DataFrame, colors: dict[float, Any]) -> None:
    """Draw the total error of each step over the CPU time of ensembles, and the least of all.

    Words name the best step and number of seeds at the ring, and what half its error costs.
    """
    rows = cast(list[Row], table.to_dict("records"))
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
    """Return the total error in percent at CPU times in s, (n,); NaN below one realisation."""
    errors = PERCENT * np.array([choice.error(seconds) for seconds in spent])
    return np.where(np.isfinite(errors), errors, np.nan)


def stability(cases: DataFrame) -> Figure:
    """Draw results/tables/stability.parquet.

    a) Energy residual over step, up to the stability limit and beyond; b) error of all cases
    relative to what is accepted; c) to f) error over the parameter of four families.
    """
    picture, panels = style.panels(style.DOUBLE, 116.0, "ab|cdef")
    steps, overview, *families = panels
    _draw_steps(steps, _family(cases, "step"))
    _draw_overview(overview, cases)
    for ax, (family, (axis, name, quantities)) in zip(families, _PANELS.items(), strict=True):
        _draw_family(ax, _family(cases, family), quantities)
        ax.text(0.04, 0.96, name, transform=ax.transAxes, va="top")
        ax.set_xlabel(axis)
        ax.tick_params(labelleft=ax is families[0])
    families[0].set_ylabel("relative error")
    for marker, _, name in _ENDS.values():
        _mark(families[0], [], 0.0, {"color": GREY, "label": name}, marker)
    style.legend_above(picture, steps, families[0], ncols=6, columnspacing=1.4)
    return picture


def _family(cases: DataFrame, name: str) -> DataFrame:
    return cases.loc[cases["family"] == name].sort_values("parameter", kind="stable")


def _of(cases: DataFrame, integrator: str, outcome: str) -> DataFrame:
    """Return the cases of one integrator with this outcome."""
    return cases.loc[(cases["integrator"] == integrator) & (cases["outcome"] == outcome)]


def _draw_steps(ax: Axes, cases: DataFrame) -> None:
    """Draw the energy residual of one scene over the step, small and unstable steps too."""
    scene = cases.loc[cases["case"].str.startswith("pillars")]
    for integrator, look in style.METHODS.items():
        runs = _of(scene, integrator, "stable")
        ax.plot(runs["parameter"], runs["energy_error"].abs(), linewidth=0.6, **look)
    ax.axvline(1.0, color=BLACK, linewidth=0.8, linestyle="--", zorder=0.5)
    _draw_ends(ax, scene)
    side = ax.get_xaxis_transform()
    ax.text(0.95, 0.03, "stability limit", transform=side, ha="right", va="bottom")
    ax.set(xscale="log", yscale="log", xlim=(0.035, 14.0), ylim=(1e-8, 30.0))
    ax.set(xlabel="step over the stability limit", ylabel="energy residual / work")
    ax.xaxis.set_major_formatter("{x:g}")
    ax.set_yticks([10.0**k for k in range(-8, 1, 2)])
    ax.yaxis.minorticks_off()


def _draw_overview(ax: Axes, cases: DataFrame) -> None:
    """Draw error over accepted error for each family, with its cases side by side."""
    families = list(dict.fromkeys(cases["family"]))
    nothing = cases["tolerance"].isna() & ~cases["outcome"].isin(_ENDS)
    cases = cases.assign(outcome=cases["outcome"].mask(nothing, "nothing"))
    for (number, family), integrator in product(enumerate(families), style.METHODS):
        look = style.METHODS[integrator]
        middle = number + (-0.21 if integrator == "leapfrog" else 0.21)
        runs = _family(cases, family).query("integrator == @integrator")
        known = runs.dropna(subset="tolerance")
        share = known["relative_error"].abs() / known["tolerance"]
        share = share.fillna(0.0).clip(lower=_LEAST)  # 0/0: none is accepted, and none there
        aside = np.linspace(-0.13, 0.13, len(share)) if len(share) > 1 else 0.0 * share
        ax.plot(middle + aside, share, linestyle="", **look)
        for outcome, (marker, height, _) in _ENDS.items():
            if outcome in set(runs["outcome"]):
                _mark(ax, [middle], height, look, marker)
    ax.axhline(1.0, color=GREY, linewidth=0.8)
    ax.text(len(families) - 0.5, 1.4, "accepted", color=GREY, ha="right", va="bottom")
    ax.set(yscale="log", ylim=(_LEAST / 4.0, 1e4), xlim=(-0.6, len(families) - 0.4))
    labels = [f"$10^{{{k}}}$" for k in range(-4, 1, 2)]
    ax.set_yticks([_LEAST, 1e-4, 1e-2, 1.0], ["<$10^{-6}$", *labels])
    ax.yaxis.minorticks_off()
    counts = cases["family"].value_counts()
    names = [f"{family} ({counts[family]})" for family in families]
    ax.set_xticks(range(len(families)), names, rotation=35.0, ha="right", rotation_mode="anchor")
    ax.tick_params(axis="x", length=0.0, pad=2.0)
    ax.set(xlabel="family (number of cases)", ylabel="error / accepted error")


def _draw_family(ax: Axes, cases: DataFrame, quantities: Sequence[str]) -> None:
    """Draw the error of a family over its parameter, the second quantity dotted."""
    for start, line in zip(quantities, ("-", ":"), strict=False):
        same = cases.loc[cases["quantity"].str.startswith(start)]
        for integrator, look in style.METHODS.items():
            runs = _of(same, integrator, "agrees")
            error = runs["relative_error"].abs().clip(lower=_SMALLEST)
            ax.plot(runs["parameter"], error, linewidth=0.6, linestyle=line, **look)
            ax.plot(runs["parameter"], runs["tolerance"], **_ACCEPTED)
    _draw_ends(ax, cases)
    ax.set(yscale="log", ylim=(_SMALLEST / 5.0, 1e3))
    ax.margins(x=0.1)  # of whole symbols
    ax.set_yticks([10.0**k for k in range(-16, 1, 4)])
    positive = cases["parameter"][cases["parameter"] > 0.0]
    smallest, largest = np.log10([positive.min(), positive.max()]).round()
    powers = 10.0 ** np.arange(smallest, largest + 1.0, 2.0)
    if len(positive) == len(cases):
        ax.set_xscale("log")
        ax.set_xticks(powers)
    else:
        ax.set_xscale("symlog", linthresh=powers[0])
        ax.set_xlim(-0.5 * powers[0], 5.0 * powers[-1])
        ax.set_xticks([0.0, *powers])
    ax.minorticks_off()


def _draw_ends(ax: Axes, cases: DataFrame) -> None:
    """Mark the cases that end early at the top of the panel."""
    for (integrator, look), height in zip(style.METHODS.items(), (0.95, 0.87), strict=True):
        for outcome, (marker, _, _) in _ENDS.items():
            _mark(ax, _of(cases, integrator, outcome)["parameter"], height, look, marker)


def _mark(ax: Axes, places: Any, height: float, look: Look, marker: str) -> None:
    """Draw markers at a share of the panel's height."""
    looks = {**look, "marker": marker, "markersize": 4.0, "linestyle": ""}
    ax.plot(places, np.full(len(places), height), transform=ax.get_xaxis_transform(), **looks)
