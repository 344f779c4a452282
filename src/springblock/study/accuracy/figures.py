"""Errors of single runs and of ensembles against their cost, and of extreme cases."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from pandas import DataFrame

from springblock.model.defaults import INTEGRATOR, PAPER_STEP, STEP
from springblock.plotting import style
from springblock.plotting.style import BLACK, GREY, NANO, Look
from springblock.study.accuracy.conventions import ENSEMBLE, PLAIN, SCENES

#: Names, colours and markers, with the Runge-Kutta whose order is lost.
_METHODS = style.METHODS | {
    PLAIN: {"label": "plain Runge–Kutta", "color": GREY} | {"marker": "^", "markersize": 3.4}
}
_ORDER_TWO: Look = {"color": BLACK, "linewidth": 0.6, "linestyle": (0, (5, 3))}
_SCATTER: Look = {"color": "#D6E4EE", "linewidth": 0.0, "zorder": 0}
_RING: Look = {"fillstyle": "none", "color": BLACK, "linestyle": "none"}
#: Integrator, step in s, and marker of the ring of the default of `simulate` and of the paper.
_MARKED: dict[str, tuple[str, float, Look]] = {
    "default": (INTEGRATOR, STEP, {"marker": "o", "markersize": 8.5}),
    "paper": (PLAIN, PAPER_STEP, {"marker": "D", "markersize": 7.5}),
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
    """Draw the error of detachment times over the CPU time of a run, a panel for each scene.

    From the tables `work_precision` and `production`; the latter has the scatter of realisations.
    """
    picture, panels = style.panels(style.DOUBLE, 72.0, "abc")
    is_reference = table.comparison == "reference"
    single = table[is_reference & (table.quantity == "t_det before horizon")]
    for ax, scene in zip(panels, SCENES, strict=True):
        runs = single[single.scene == scene]
        _draw_scatter(ax, production[production.scene == scene])
        _draw_costs(ax, runs)
        ax.set_title(f"{scene}, {runs.n_blocks.iloc[0]} × {runs.n_blocks.iloc[0]} blocks")
        ax.set(xscale="log", yscale="log", xlabel="CPU seconds per realisation")
        ax.xaxis.set_minor_formatter("")  # names of less than a decade, which overlap
    for ax in panels[1:]:
        ax.sharey(panels[0])
        ax.tick_params(labelleft=False)
    panels[0].set_ylim(0.3 * single.error.min(), 3.0 * single.error.max())
    panels[0].set_ylabel("relative error of $t_\\mathrm{det}$")
    style.legend_above(picture, panels[0], ncols=4)
    return picture


def _draw_scatter(ax: Axes, rows: DataFrame) -> None:
    """Draw a band up to the standard error of a mean t_avg over ENSEMBLE seeds, over t_avg."""
    row = rows[(rows.quantity == "t_avg") & np.isclose(rows.step, STEP, atol=0.0)].iloc[0]
    error = float(row.deviation / row.value) / ENSEMBLE**0.5
    ax.axhspan(1e-12, error, label=f"statistical error of {ENSEMBLE} realisations", **_SCATTER)


def _draw_costs(ax: Axes, rows: DataFrame) -> None:
    """Draw the error of detachment times over the CPU time, and a line of order 2."""
    lines = {method: rows[rows.integrator == method].sort_values("step") for method in _METHODS}
    for method, look in _METHODS.items():
        ax.plot(lines[method].cpu_seconds, lines[method].error, **look)
    finest, spent = lines["leapfrog"].iloc[0], lines["leapfrog"].cpu_seconds
    order_two = finest.error * (finest.cpu_seconds / spent) ** 2 / 3.0
    ax.plot(spent, order_two, label="order 2", **_ORDER_TWO)
    for name, (method, step, marker) in _MARKED.items():
        row = lines[method][np.isclose(lines[method].step, step, rtol=1e-6, atol=0.0)]
        label = f"{name}: {_METHODS[method]['label'].split(',')[0]}, {NANO * step:g} ns"
        ax.plot(row.cpu_seconds, row.error, label=label, **_RING, **marker)


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
