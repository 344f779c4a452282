"""Errors of single runs and of ensembles against their cost, and of extreme cases."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator
from pandas import DataFrame

from springblock.model.defaults import INTEGRATOR, PAPER_STEP, STEP
from springblock.plotting import style
from springblock.plotting.curves import draw_points
from springblock.plotting.style import BLACK, GREEN, GREY, NANO, PURPLE, Look
from springblock.study.accuracy.conventions import ENSEMBLE, PLAIN, SCENES

#: Names, colours and markers, with the Runge-Kutta whose order is lost.
_METHODS = style.METHODS | {
    PLAIN: {"label": "plain Runge–Kutta", "color": GREY} | {"marker": "^", "markersize": 3.4}
}
_ORDER_TWO: Look = {"color": BLACK, "linewidth": 0.6, "linestyle": (0, (5, 3))}
_SCATTER: Look = {"color": "#D6E4EE", "linewidth": 0.0, "zorder": 0}
#: Quantities whose biases are shown, and by how much their symbols are moved aside.
_BIASES: dict[str, tuple[Look, float]] = {
    "static_friction": ({"label": "static friction", "color": BLACK, "marker": "D"}, 0.94),
    "t_max": ({"label": r"$t_\mathrm{max}$", "color": GREEN, "marker": "v"}, 1.0),
    "t_avg": ({"label": r"$t_\mathrm{avg}$", "color": PURPLE, "marker": "s"}, 1.06),
}
_COARSEST = 2.0 * STEP  #: s; biases of larger steps are many times as large
_RING: Look = {"fillstyle": "none", "color": BLACK, "linestyle": "none"}
_DEFAULT_RING: Look = _RING | {"marker": "o", "markersize": 8.5}
#: Integrator, step in s and ring of the default of `simulate` and of the paper.
_MARKED: dict[str, tuple[str, float, Look]] = {
    "default": (INTEGRATOR, STEP, _DEFAULT_RING),
    "paper": (PLAIN, PAPER_STEP, {**_RING, "marker": "D", "markersize": 7.5}),
}

#: Outcomes without an error to show: marker, its height as a share of the panel, and name.
_ENDS = {
    "refused": ("x", 0.95, "refused at the start"),
    "raises": ("^", 0.87, "ended by an exception"),
    "nothing": ("d", 0.79, "as expected, nothing to compare"),
}
_ACCEPTED: Look = {"label": "accepted", "color": GREY, "marker": "_", "markersize": 6.0}
_ACCEPTED |= {"linestyle": ""}

#: Families over a parameter: label of the axis, what is compared, and start of `quantity`.
_PANELS = {
    "stiffness": (r"$K_s/K_\mathrm{int}$", "path of a column", "displacement"),
    "strain": (r"strain $u/l$", "path of a column", "displacement"),
    "damping": (r"damping $\gamma/\omega$", "force in the slip", "spring force"),
    "speed": (r"speed $v\,K_s/(F_n\,\omega)$", "force after the slip", "spring force"),
}
_SMALLEST = 1e-16  #: relative error
_LEAST = 1e-6  #: share of the accepted error; what is less, or nothing, is drawn here


def work_precision(table: DataFrame, production: DataFrame) -> Figure:
    """Draw a-c) errors of single runs over force evaluations and d-f) biases over the CPU time.

    A column for each scene, from the tables `work_precision` and `production`.
    """
    picture, panels = style.panels(style.DOUBLE, 125.0, "abc;def")
    times, biases = panels[:3], panels[3:]
    is_reference = table.comparison == "reference"
    single = table[is_reference & (table.quantity == "t_det before horizon")]
    times[1].sharex(times[0])
    times[2].sharex(times[0])
    for left, *others in (times, biases):  # the same axes, with numbers at the left only
        for ax in others:
            ax.sharey(left)
            ax.tick_params(labelleft=False)
    for scene, upper, lower in zip(SCENES, times, biases, strict=True):
        runs, full = single[single.scene == scene], production[production.scene == scene]
        _draw_costs(upper, runs)
        _draw_biases(lower, full[full.step <= _COARSEST])
        for ax, rows in ((upper, runs), (lower, full)):
            sizes = " or ".join(f"{n} × {n}" for n in rows.n_blocks.unique())
            ax.set_title(f"{scene}, {sizes} blocks")
    ends = 0.3 * single.error.min(), 3.0 * single.error.max()
    times[0].set(xscale="log", yscale="log", ylim=ends)
    times[0].set_ylabel("RMS error of $t_\\mathrm{det}/t_\\mathrm{max}$\nbefore the horizon")
    biases[0].set_ylabel(f"bias / standard error\nof a mean over {ENSEMBLE} seeds")
    style.legend_above(picture, times[0], biases[0], ncols=5)
    return picture


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


def _draw_biases(ax: Axes, rows: DataFrame) -> None:
    """Draw biases with their intervals over the CPU time, and name the steps; the default ringed.

    Biases are in units of the standard error of a mean over ENSEMBLE seeds.
    """
    ax.axhspan(-1.0, 1.0, label=f"standard error of {ENSEMBLE} seeds", **_SCATTER)
    ax.axhline(0.0, color=BLACK, linewidth=0.4, zorder=0.5)
    for quantity, (look, aside) in _BIASES.items():
        line = rows[rows.quantity == quantity].sort_values("step")
        error = line.deviation.iloc[0] / np.sqrt(ENSEMBLE)
        intervals = line[["bias", "ci_low", "ci_high"]] / error
        draw_points(ax, aside * line.cpu_seconds, intervals, **look)
        default = line.step == STEP
        ax.plot(aside * line.cpu_seconds[default], intervals.bias[default], **_DEFAULT_RING)
    side = ax.get_xaxis_transform()
    for step, seconds in line[["step", "cpu_seconds"]].itertuples(index=False):
        weight = "bold" if step == STEP else "normal"
        place: Look = {"transform": side, "ha": "center", "va": "top"}
        ax.text(seconds, 0.97, f"{NANO * step:g} ns", weight=weight, **place)
    ax.set_xscale("log")
    ax.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    ax.xaxis.set_major_formatter("{x:g}")
    ax.xaxis.set_minor_formatter("")
    ax.margins(x=0.12, y=0.2)
    ax.set_xlabel("CPU seconds per realisation")


def stability(cases: DataFrame) -> Figure:
    """Draw a) energy residual over step, b) error over accepted error, c-f) of four families."""
    picture, panels = style.panels(style.DOUBLE, 116.0, "ab|cdef")
    steps, overview, *families = panels
    _draw_steps(steps, cases[(cases.family == "step") & cases.case.str.startswith("pillars")])
    _draw_overview(overview, cases)
    for ax, (family, (axis, name, quantity)) in zip(families, _PANELS.items(), strict=True):
        _draw_family(ax, cases[cases.family == family], quantity)
        ax.text(0.04, 0.96, name, transform=ax.transAxes, va="top")
        ax.set_xlabel(axis)
        ax.tick_params(labelleft=ax is families[0])
    families[0].set_ylabel("relative error")
    for outcome, (_, _, name) in _ENDS.items():
        _mark(families[0], [], outcome, color=GREY, label=name)
    style.legend_above(picture, steps, families[0], ncols=6, columnspacing=1.4)
    return picture


def _draw_steps(ax: Axes, cases: DataFrame) -> None:
    """Draw the energy residual of one scene over the step, small and unstable steps too."""
    _draw_errors(ax, cases[cases.outcome == "stable"], "energy_error")
    _draw_ends(ax, cases)
    ax.axvline(1.0, color=BLACK, linewidth=0.8, linestyle="--", zorder=0.5)
    side = ax.get_xaxis_transform()
    ax.text(0.95, 0.03, "stability limit", transform=side, ha="right", va="bottom")
    ax.set(xscale="log", yscale="log", xlim=(0.035, 14.0), ylim=(1e-8, 30.0))
    ax.set(xlabel="step over the stability limit", ylabel="energy residual / work")
    ax.xaxis.set_major_formatter("{x:g}")


def _draw_overview(ax: Axes, cases: DataFrame) -> None:
    """Draw error over accepted error for each family, with its cases side by side."""
    families, methods = list(dict.fromkeys(cases.family)), list(style.METHODS)
    beside = dict(zip(methods, np.linspace(-0.21, 0.21, len(methods)), strict=True))
    reach = 0.26 / len(methods)
    nothing = cases.tolerance.isna() & ~cases.outcome.isin(_ENDS)
    cases = cases.assign(outcome=cases.outcome.mask(nothing, "nothing"))
    for (family, integrator), runs in cases.groupby(["family", "integrator"]):
        look = style.METHODS[str(integrator)] | {"linestyle": ""}
        middle = families.index(family) + beside[str(integrator)]
        known = runs.dropna(subset="tolerance").sort_values("parameter", kind="stable")
        share = (known.relative_error.abs() / known.tolerance).clip(lower=_LEAST)
        aside = np.linspace(-reach, reach, len(share)) if len(share) > 1 else 0.0
        ax.plot(np.full(len(share), middle) + aside, share, **look)
        for outcome in (end for end in _ENDS if end in set(runs.outcome)):
            _mark(ax, [middle], outcome, **look)
    ax.axhline(1.0, color=GREY, linewidth=0.8)
    ax.text(len(families) - 0.5, 1.4, "accepted", color=GREY, ha="right", va="bottom")
    ax.set(yscale="log", ylim=(_LEAST / 4.0, 1e4), xlim=(-0.6, len(families) - 0.4))
    labels = [f"$10^{{{k}}}$" for k in range(-4, 1, 2)]
    ax.set_yticks([_LEAST, 1e-4, 1e-2, 1.0], ["<$10^{-6}$", *labels])
    ax.yaxis.minorticks_off()
    counts = cases.family.value_counts()
    names = [f"{family} ({counts[family]})" for family in families]
    ax.set_xticks(range(len(families)), names, rotation=35.0, ha="right", rotation_mode="anchor")
    ax.tick_params(axis="x", length=0.0, pad=2.0)
    ax.set(xlabel="family (number of cases)", ylabel="error / accepted error")


def _draw_family(ax: Axes, cases: DataFrame, quantity: str) -> None:
    """Draw the error of a quantity over the parameter of a family, and what is accepted."""
    compared = cases[cases.quantity.str.startswith(quantity) & (cases.outcome == "agrees")]
    _draw_errors(ax, compared, "relative_error")
    ax.plot(compared.parameter, compared.tolerance, **_ACCEPTED)
    _draw_ends(ax, cases)
    ax.set(yscale="log", ylim=(_SMALLEST / 5.0, 1e3))
    if cases.parameter.min() > 0.0:
        ax.set_xscale("log")
    else:
        ax.set_xscale("symlog", linthresh=cases.parameter[cases.parameter > 0.0].min())
        locator: Any = ax.xaxis.get_major_locator()
        locator.set_params(numticks=5)
    ax.margins(x=0.1)  # of whole symbols
    ax.minorticks_off()


def _draw_errors(ax: Axes, cases: DataFrame, error: str) -> None:
    """Draw the modulus of an error over the parameter, a line for each integrator."""
    cases = cases.sort_values("parameter", kind="stable")
    for integrator, look in style.METHODS.items():
        runs = cases[cases.integrator == integrator]
        ax.plot(runs.parameter, runs[error].abs().clip(lower=_SMALLEST), linewidth=0.6, **look)


def _draw_ends(ax: Axes, cases: DataFrame) -> None:
    """Mark the cases that end early at the top of the panel."""
    for i, (integrator, look) in enumerate(style.METHODS.items()):
        for outcome in _ENDS:
            runs = cases[(cases.integrator == integrator) & (cases.outcome == outcome)]
            _mark(ax, runs.parameter, outcome, 0.08 * i, **look)


def _mark(ax: Axes, places: Any, outcome: str, below: float = 0.0, **look: Any) -> None:
    """Draw the markers of an outcome at its height in the panel or `below`, in shares of it."""
    marker, height, _ = _ENDS[outcome]
    look |= {"marker": marker, "markersize": 4.0, "linestyle": ""}
    heights = np.full(len(places), height - below)
    ax.plot(places, heights, transform=ax.get_xaxis_transform(), **look)
