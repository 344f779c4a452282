"""What the study's own ensembles miss, and what less would cost: bias and scatter at N = 120."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import LogLocator, NullFormatter
from numpy.typing import ArrayLike

from springblock.accuracy.budget import (
    Bias,
    Choice,
    best,
    choices,
    excess,
    halving,
    study_budget,
)
from springblock.accuracy.conventions import DELAY, LENGTH, SCENES
from springblock.io.rows import Row
from springblock.model.defaults import STEP
from springblock.plotting import style
from springblock.plotting.accuracy.percent import fit_percent
from springblock.plotting.declaration import Declaration, TableSource
from springblock.plotting.looks import shades
from springblock.plotting.points import draw_points, name_places
from springblock.plotting.style import BLACK, BLUE, GREY, NANO, PERCENT, VERMILION, Look, journal
from springblock.simulation.run import Array

if TYPE_CHECKING:
    from pandas import DataFrame

FIGURE = Declaration(
    title="Error against CPU time at full size",
    category="Accuracy",
    caption="""Errors of ensembles with 120 × 120 blocks over CPU time. a-c) Bias of the mean
    against the finest step with the same seeds, with its 95 % interval, over the CPU time of a
    realisation; numbers above are steps in ns. d-j) Total error, the root of bias² + variance/k, of
    k seeds over the CPU time of all, prelude included: dots stand for 1, 10, 100 and 1000 seeds,
    rings for the study's at the default step; lines hold the estimated bias, shades the ends of its
    interval; grey lies the least error at any step. k) Total error at each step over that at the
    best, for the CPU time at the rings, with the same three biases.""",
    source=TableSource("production"),
    upon_request=True,
)

_DOTS = (1, 10, 100, 1000)  #: seeds marked along a line
_SPENT = (0.2, 2e3)  #: CPU time of ensembles, s

#: Names and looks of quantities, in a-c) and k).
_QUANTITIES: dict[str, tuple[str, Look]] = {
    "static_friction": ("static friction", {"color": BLACK, "marker": "o", "markersize": 3.0}),
    DELAY: (r"$t_\mathrm{max} - t_\mathrm{avg}$", {"color": VERMILION, "marker": "s"}),
    LENGTH: (r"$l_\mathrm{c}$", {"color": BLUE, "marker": "^", "markersize": 3.6}),
}
_DASHES: Look = dict(zip(SCENES, ("-", "--", ":"), strict=True))
_RING: Look = {"marker": "o", "markersize": 8.0, "fillstyle": "none", "color": BLACK}
_ENVELOPE: Look = {"color": "0.8", "linewidth": 4.0, "zorder": 0.5}


@journal
def draw(table: DataFrame) -> Figure:
    """Draw the table `production`, a column per scene.

    a-c) Biases over the CPU time of a realisation; d-f) total error of static friction over that
    of an ensemble, g-i) of t_max - t_avg, j) of l_c of pillars; k) all steps at the study's
    budgets.
    """
    picture, panels = style.panels(style.DOUBLE, 217.0, "abc;def;ghi|Ljk", height_ratios=(3, 1))
    *panels, excesses, legend = panels
    _draw_biases(panels[:3], table)
    colors = shades(table.step)
    cases = [(q, scene) for q in _QUANTITIES for scene in SCENES if _rows(table, scene, q)]
    for ax, (quantity, scene) in zip(panels[3:], cases, strict=True):
        _draw_errors(ax, _rows(table, scene, quantity), colors)
        ax.set(xscale="log", yscale="log", xlabel="CPU time of an ensemble (s)", xlim=_SPENT)
    for row, (name, _) in zip(
        (panels[3:6], panels[6:9], panels[9:]), _QUANTITIES.values(), strict=True
    ):
        row[0].set_ylabel(f"error of {name} (%)")
        ends = np.array([ax.get_ylim() for ax in row])
        style.share_axes(row)
        row[0].set_ylim(0.25 * ends.min(), ends.max())  # room for words
    _draw_excess(excesses, table)
    _draw_legend(legend, colors)
    return picture


def _rows(table: DataFrame, scene: str, quantity: str) -> list[Row]:
    """Rows of one case, finest step first; none where it was not measured."""
    found = table[(table.scene == scene) & (table.quantity == quantity)].sort_values("step")
    return cast(list[Row], found.to_dict("records"))


def _draw_biases(panels: Sequence[Axes], table: DataFrame) -> None:
    """Biases of all quantities, side by side at each step but the finest, which has none."""
    n = table.n_blocks.iloc[0]
    for ax, scene in zip(panels, SCENES, strict=True):
        for aside, (quantity, (_, look)) in zip(
            (0.95, 1.0, 1.05), _QUANTITIES.items(), strict=True
        ):
            if rows := _rows(table, scene, quantity)[1:]:
                _draw_bias(ax, rows, aside, look)
        _name_steps(ax, _rows(table, scene, "static_friction"))
        ax.axhline(0.0, color=BLACK, linewidth=0.4, zorder=0.5)
        ax.set(xscale="log", xlabel="CPU time of a realisation (s)")
        ax.margins(x=0.08)
        ax.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        ax.xaxis.set_major_formatter("{x:g}")
        ax.xaxis.set_minor_formatter(NullFormatter())
        ax.set_title(f"{scene}, {n} × {n} blocks", pad=13.0)
        ax.sharey(panels[0])
        ax.tick_params(labelleft=ax is panels[0])
    fit_percent(panels, 0.1, (-1.0, -0.1, 0.0, 0.1, 1.0))
    panels[0].set_ylabel("bias (%), linear within ±0.1 %")
    handles = [Line2D([], [], label=name, **look) for name, look in _QUANTITIES.values()]
    frame: Look = {"frameon": True, "framealpha": 1.0, "edgecolor": "none"}
    panels[0].legend(handles=handles, loc="lower right", **frame)


def _draw_bias(ax: Axes, rows: list[Row], aside: float, look: Look) -> None:
    keys = ("bias", "ci_low", "ci_high")
    intervals = [[PERCENT * row[key] / row["scale"] for key in keys] for row in rows]
    draw_points(ax, [aside * row["cpu_seconds"] for row in rows], intervals, **look)


def _name_steps(ax: Axes, rows: list[Row]) -> None:
    """A line at the CPU time of each step, and the step in ns above it."""
    for row in rows:
        ax.axvline(row["cpu_seconds"], color=GREY, linewidth=0.3, zorder=0.3)
        ax.annotate(
            f"{NANO * row['step']:g}{' ns' if row is rows[0] else ''}",
            (row["cpu_seconds"], 1.0),
            (0.0, 2.5),
            xycoords=("data", "axes fraction"),
            textcoords="offset points",
            ha="center",
            fontweight="bold" if row["step"] == STEP else "normal",
        )


def _draw_errors(ax: Axes, rows: list[Row], colors: dict[float, Any]) -> None:
    """Total error of each step over the CPU time of ensembles, and the least of them all."""
    by_bias = [choices(rows, bias) for bias in Bias._fields]
    spent = np.geomspace(*_SPENT, 400)
    for choice, low, high in zip(*by_bias, strict=True):
        look: Look = {"color": colors[choice.step], "zorder": 2.0 + (choice.step == STEP)}
        ax.plot(spent, _errors(choice, spent), linewidth=_wide(choice.step), **look)
        dots = np.array([choice.spent(seeds) for seeds in _DOTS]) * (1.0 + 1e-12)
        ax.plot(dots, _errors(choice, dots), linestyle="none", marker=".", **look)
        ends = _errors(low, spent), _errors(high, spent)
        ax.fill_between(spent, *ends, color=look["color"], alpha=0.15, linewidth=0.0)
    budget, steps = study_budget(rows), by_bias[0]
    (default,) = (choice for choice in steps if choice.step == STEP)
    ax.plot([budget], _errors(default, np.array([budget])), **_RING)
    least = [PERCENT * best(steps, seconds).error(seconds) for seconds in spent]
    ax.plot(spent, least, **_ENVELOPE)
    _say_what_is_best(ax, by_bias, budget)


def _say_what_is_best(ax: Axes, by_bias: list[list[Choice]], budget: float) -> None:
    """Best step and number of seeds at the ring, and what half its error costs."""
    chosen = best(by_bias[0], budget)
    costs = [halving(steps, budget) for steps in by_bias]
    ax.text(
        0.03,
        0.05,
        f"best at {budget:.2g} s: {NANO * chosen.step:g} ns, {chosen.seeds(budget):.0f} seeds;\n"
        f"half its error: {costs[0]:.1f} × CPU time\n({min(costs):.1f} to {max(costs):.1f})",
        transform=ax.transAxes,
    )


def _errors(choice: Choice, spent: Array) -> Array:
    """Total error in percent for each CPU time in s, (n,); NaN where no realisation is done."""
    return PERCENT * _finite([choice.error(seconds) for seconds in spent])


def _finite(errors: ArrayLike) -> Array:
    """NaN, which is not drawn, in the place of infinite errors."""
    return np.where(np.isfinite(errors), errors, np.nan)


def _wide(step: float) -> float:
    return 1.6 if step == STEP else 0.8


def _draw_excess(ax: Axes, table: DataFrame) -> None:
    """Total error of each step over that of the best, at the study's budgets, case by case."""
    for scene, dashes in _DASHES.items():
        for quantity, (_, look) in _QUANTITIES.items():
            if rows := _rows(table, scene, quantity):
                found = [excess(choices(rows, bias), study_budget(rows)) for bias in Bias._fields]
                steps = [NANO * step for step in found[0]]
                ratios = _finite([list(each.values()) for each in found])
                ax.plot(steps, ratios[0], linestyle=dashes, **look)
                ends = ratios.min(axis=0), ratios.max(axis=0)
                ax.vlines(steps, *ends, color=look["color"], linewidth=2.5, alpha=0.25)
    name_places(ax, NANO * table.step)
    ax.set(yscale="log", xlabel="integration step (ns)", ylim=(0.9, 10.0))
    ax.set_yticks([1.0, 2.0, 5.0, 10.0], ["1", "2", "5", "10"])
    ax.yaxis.set_minor_formatter(NullFormatter())
    ax.set_ylabel("error over the least")
    handles = [Line2D([], [], label=s, color=BLACK, linestyle=d) for s, d in _DASHES.items()]
    ax.legend(handles=handles, loc="upper left")


def _draw_legend(ax: Axes, colors: dict[float, Any]) -> None:
    """What the panels of total errors show, in the place of one of them."""
    handles: list[Artist] = []
    for step, color in colors.items():
        name = f"{NANO * step:g} ns{', the default' if step == STEP else ''}"
        look: Look = {"color": color, "linewidth": _wide(step), "marker": "."}
        handles.append(Line2D([], [], label=name, **look))
    handles.append(Line2D([], [], label="the study's seeds", linestyle="none", **_RING))
    handles.append(Line2D([], [], label="least error", **_ENVELOPE))
    handles.append(Patch(label="bias within its interval", color=GREY, alpha=0.25, linewidth=0.0))
    ax.set_axis_off()
    ax.legend(handles=handles, loc="upper left")
