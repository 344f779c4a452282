"""Errors of single runs and of ensembles against what they cost."""

from collections.abc import Iterator, Sequence
from itertools import product
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

from springblock.accuracy import budget
from springblock.accuracy.budget import Bias, Choice
from springblock.accuracy.conventions import DELAY, ENSEMBLE, LENGTH, PAPER_STEP, PLAIN, SCENES
from springblock.io.rows import Row
from springblock.model.defaults import INTEGRATOR, STEP
from springblock.plotting import style
from springblock.plotting.looks import shades
from springblock.plotting.points import draw_points, name_places
from springblock.plotting.style import BLACK, BLUE, GREY, NANO, PERCENT, VERMILION, Look
from springblock.simulation.run import Array

Cases = dict[tuple[str, str], list[Row]]  #: by quantity and scene, finest step first

#: Names, colours and markers. Runge-Kutta lies on top where it covers the leapfrog.
_METHODS: dict[str, tuple[str, Look]] = {
    "leapfrog": ("leapfrog", {"color": BLUE, "marker": "o", "markersize": 4.2}),
    "rk4": ("Runge–Kutta", {"color": VERMILION, "marker": "s", "markersize": 2.6}),
    PLAIN: ("Runge–Kutta, stage-wise friction", {"color": GREY, "marker": "^", "markersize": 3.4}),
}
_TWINS: dict[str, Look] = {
    "flat": {"color": BLACK, "marker": "D", "markersize": 2.8},
    "pillared": {"color": style.GREEN, "marker": "v", "markersize": 3.6},
    "grooved": {"color": style.PURPLE, "marker": "P", "markersize": 3.8},
}
_ORDER_TWO: Look = {"color": BLACK, "linewidth": 0.6, "linestyle": (0, (5, 3))}
_FLOOR: Look = {"color": "0.91", "linewidth": 0.0, "zorder": 0}
_SCATTER: Look = {"color": "#D6E4EE", "linewidth": 0.0, "zorder": 0}
_RING: Look = {"fillstyle": "none", "color": BLACK, "linestyle": "none"}
#: Integrator, step in s and ring of the default of `simulate` and of the paper.
_MARKED: dict[str, tuple[str, float, Look]] = {
    "default": (INTEGRATOR, STEP, {**_RING, "marker": "o", "markersize": 8.5}),
    "paper": (PLAIN, PAPER_STEP, {**_RING, "marker": "D", "markersize": 7.5}),
}

_COSTS = {"force_evaluations": "force evaluations", "cpu_seconds": "CPU time (s)"}
_BIASES = {
    "static_friction": "bias of static\nfriction (%)",
    "t_max": "bias of\n$t_\\mathrm{max}$ (%)",
    "t_avg": "bias of\n$t_\\mathrm{avg}$ (%)",
}
_DIFFERENCES = {
    "t_det before peak": "RMS difference of\n$t_\\mathrm{det}/t_\\mathrm{max}$ before peak",
    "static_friction": "relative difference\nof static friction",
    "horizon": r"horizon$/t_\mathrm{max}$",
}

_DOTS = (1, 10, 100, 1000)  #: seeds marked along a line of total errors
_SPENT = (0.2, 2e3)  #: CPU time of ensembles, s
#: Names and looks of quantities with total errors.
_QUANTITIES: dict[str, tuple[str, Look]] = {
    "static_friction": ("static friction", {"color": BLACK, "marker": "o", "markersize": 3.0}),
    DELAY: (r"$t_\mathrm{max} - t_\mathrm{avg}$", {"color": VERMILION, "marker": "s"}),
    LENGTH: (r"$l_\mathrm{c}$", {"color": BLUE, "marker": "^", "markersize": 3.6}),
}
_DASHES: Look = dict(zip(SCENES, ("-", "--", ":"), strict=True))
_STUDY: Look = {**_RING, "marker": "o", "markersize": 8.0}  #: ring of the study's own ensembles
_ENVELOPE: Look = {"color": "0.8", "linewidth": 4.0, "zorder": 0.5}


def work_precision(table: DataFrame) -> Figure:
    """Draw the table of work and precision, a column per scene.

    a-c) Single runs against a solution that locates every event: error of the detachment times
    before the horizon over force evaluations; d-f) of static friction over CPU time. Rings mark
    the default of `simulate` and the step of the paper. g-i) Ensembles with paired seeds: bias
    with its 95 % interval. j-l) Runs against themselves with thresholds changed by a little.
    """
    letters, ratios = "abc;def|ghi;GHI;JKL|jkl", (94, 78, 43)
    picture, panels = style.panels(style.DOUBLE, 225.0, letters, height_ratios=ratios)
    times, frictions, *biases, twins = (panels[i : i + 3] for i in (0, 3, 6, 12, 15, 9))
    single = table[table.comparison == "reference"]
    before_horizon = single[single.quantity == "t_det before horizon"]
    _draw_costs(times, before_horizon, "force_evaluations")
    times[0].set_ylabel("RMS error of $t_\\mathrm{det}/t_\\mathrm{max}$\nbefore the horizon")
    _draw_costs(frictions, single[single.quantity == "static_friction"], "cpu_seconds")
    frictions[0].set_ylabel("relative error of\nstatic friction")
    _name_scenes(times, single)
    orders = table[(table.comparison == "order") & (table.step == PAPER_STEP)]
    _write_orders(times, orders[orders.quantity == "t_det before horizon"])
    _draw_paired(biases, table)
    _draw_twins(twins, table[table.comparison == "twin"])
    _name_methods(picture, single[single.integrator == "leapfrog"].step.min())
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


def _draw_costs(panels: Sequence[Axes], rows: DataFrame, cost: str) -> None:
    """Draw the error of one quantity over one cost, on common axes.

    Below the leapfrog lies a line of order 2; its error at the finest step is a floor.
    """
    style.share_axes(panels)
    for ax, part in _by_scene(panels, rows):
        lines = {m: part[part.integrator == m].sort_values("step") for m in _METHODS}
        for method, (_, look) in _METHODS.items():
            ax.plot(lines[method][cost], lines[method].error, **look)
        spent, finest = lines["leapfrog"][cost].to_numpy(), lines["leapfrog"].error.iloc[0]
        ax.plot(spent, finest * (spent[0] / spent) ** 2 / 3.0, **_ORDER_TWO)
        ax.axhspan(0.0, finest, **_FLOOR)
        for method, step, look in _MARKED.values():
            row = lines[method][np.isclose(lines[method].step, step, rtol=1e-6, atol=0.0)]
            ax.plot(row[cost], row.error, **look)
        ax.set_xlabel(_COSTS[cost])
    ax = panels[0]
    ax.set(xscale="log", yscale="log")
    ax.set_xlim(0.6 * rows[cost].min(), 1.7 * rows[cost].max())
    ax.set_ylim(0.3 * rows.error.min(), 3.0 * rows.error.max())
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_minor_locator(LogLocator(subs=range(2, 10), numticks=99))


def _write_orders(panels: Sequence[Axes], rows: DataFrame) -> None:
    """Write the orders of both integrators in the corner of little work and small errors."""
    for ax, part in _by_scene(panels, rows):
        for height, method in ((0.16, "leapfrog"), (0.05, "rk4")):
            text = f"order {part[part.integrator == method].error.item():.1f}"
            color = _METHODS[method][1]["color"]
            ax.text(0.03, height, text, color=color, transform=ax.transAxes)


def _draw_paired(panels: Sequence[Sequence[Axes]], table: DataFrame) -> None:
    """Draw biases of ensembles with paired seeds, before the scatter of one of the study's size."""
    paired, scatter = (table[table.comparison == name] for name in ("paired", "scatter"))
    every = [ax for row in panels for ax in row]
    style.share_axes(every)
    for row, (quantity, label) in zip(panels, _BIASES.items(), strict=True):
        for ax, spread in _by_scene(row, scatter[scatter.quantity == quantity]):
            # 95 % of the means over as many seeds as in the study lie within ± half.
            deviation = (spread.ci_high - spread.ci_low) * np.sqrt(spread.realisations / ENSEMBLE)
            half = 0.5 * PERCENT * float(deviation.item())
            ax.axhspan(-half, half, **_SCATTER)
            ax.axhline(0.0, color=BLACK, linewidth=0.4, zorder=0.5)
        for ax, biases in _by_scene(row, paired[paired.quantity == quantity]):
            for method, aside in (("leapfrog", 0.96), ("rk4", 1.04)):  # side by side
                line = biases[biases.integrator == method].sort_values("step")
                intervals = PERCENT * line[["error", "ci_low", "ci_high"]]
                look = _METHODS[method][1] | {"markersize": 2.4}  # no larger than most intervals
                draw_points(ax, aside * NANO * line.step, intervals, **look)
            ax.tick_params(labelleft=ax is row[0], labelbottom=row is panels[-1])
        row[0].set_ylabel(label)
    for ax in panels[-1]:
        ax.set_xlabel("integration step (ns)")
    _name_scenes(panels[0], paired)
    _fit_percent(every, 1.0, (-5.0, -1.0, 0.0, 1.0, 5.0))
    name_places(every[0], NANO * np.unique(paired.step))


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


def _draw_twins(panels: Sequence[Axes], rows: DataFrame) -> None:
    """Draw how far a change of the thresholds takes a run from itself, and from when on."""
    for ax, (quantity, label) in zip(panels, _DIFFERENCES.items(), strict=True):
        shown = rows[rows.quantity == quantity].sort_values("nudge")
        for scene, look in _TWINS.items():
            line = shown[shown.scene == scene]
            ax.plot(line.nudge, line.error, label=scene, clip_on=False, **look)
        ax.set(xscale="log", xlabel="relative change of thresholds", ylabel=label)
        if quantity != "horizon":  # no difference at all is a result: zero belongs on the axis
            ax.set_yscale("symlog", linthresh=1e-6, linscale=0.6)
            ax.set_ylim(0.0, 2.0 * max(1e-6, shown.error.max()))
    panels[-1].legend(loc="lower left")


def _name_methods(picture: Figure, finest: float) -> None:
    """Write above the panels what holds for all of them."""
    handles: list[Artist] = [Line2D([], [], label=name, **look) for name, look in _METHODS.values()]
    handles.append(Line2D([], [], label="order 2", **_ORDER_TWO))
    for name, (method, step, look) in _MARKED.items():
        label = f"{name}: {_METHODS[method][0].split(',')[0]}, {NANO * step:g} ns"
        handles.append(Line2D([], [], label=label, **look))
    handles += [
        Patch(label=f"below the leapfrog at {NANO * finest:g} ns", **_FLOOR),
        Patch(label=f"95 % of means over {ENSEMBLE} seeds", **_SCATTER),
    ]
    picture.legend(handles=handles, loc="outside upper center", ncols=4)


def total_error(table: DataFrame) -> Figure:
    """Draw the table `production`: biases, total errors, and all steps at the study's budgets."""
    picture, panels = style.panels(style.DOUBLE, 217.0, "abc;def;ghi|Ljk", height_ratios=(3, 1))
    *panels, excesses, legend = panels
    cases, colors = _cases(table), shades(table.step)
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
    _draw_excess(excesses, cases)
    _name_steps(legend, colors)
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


def _draw_excess(ax: Axes, cases: Cases) -> None:
    """Draw the total error of each step over that of the best, at the study's budgets."""
    for scene, dashes in _DASHES.items():
        for quantity, (_, look) in _QUANTITIES.items():
            if rows := cases.get((quantity, scene)):
                seconds = budget.study_budget(rows)
                found = [budget.excess(budget.choices(rows, b), seconds) for b in Bias._fields]
                steps = [NANO * step for step in found[0]]
                ratios = _finite([list(each.values()) for each in found])
                ax.plot(steps, ratios[0], linestyle=dashes, **look)
                ends = ratios.min(axis=0), ratios.max(axis=0)
                ax.vlines(steps, *ends, color=look["color"], linewidth=2.5, alpha=0.25)
    name_places(ax, [NANO * row["step"] for rows in cases.values() for row in rows])
    ax.set(yscale="log", ylim=(0.9, 10.0))
    ax.set_yticks([1.0, 2.0, 5.0, 10.0], ["1", "2", "5", "10"])
    ax.yaxis.set_minor_formatter(NullFormatter())
    ax.set(xlabel="integration step (ns)", ylabel="error over the least")
    handles = [Line2D([], [], label=s, color=BLACK, linestyle=d) for s, d in _DASHES.items()]
    ax.legend(handles=handles, loc="upper left")


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
