"""What the study's own ensembles miss, and what less would cost.

Not in the paper (Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525): bias and
scatter of surfaces with N = 120, over CPU time.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from matplotlib import colormaps
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import (
    FixedLocator,
    LogLocator,
    NullFormatter,
    NullLocator,
    SymmetricalLogLocator,
)
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
from springblock.plotting.declaration import Declaration, Table
from springblock.plotting.style import BLACK, BLUE, GREY, VERMILION, journal
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
    source=Table("production"),
    upon_request=True,
)

_NANO = 1e9  #: ns per s
_PERCENT = 100.0
_DOTS = (1, 10, 100, 1000)  #: seeds marked along a line
_SPENT = (0.2, 2e3)  #: CPU time of ensembles, s

#: Names and looks of quantities, in a-c) and k).
_QUANTITIES: dict[str, tuple[str, dict[str, Any]]] = {
    "static_friction": ("static friction", {"color": BLACK, "marker": "o", "markersize": 3.0}),
    DELAY: (r"$t_\mathrm{max} - t_\mathrm{avg}$", {"color": VERMILION, "marker": "s"}),
    LENGTH: (r"$l_\mathrm{c}$", {"color": BLUE, "marker": "^", "markersize": 3.6}),
}
_DASHES: dict[str, Any] = dict(zip(SCENES, ("-", "--", ":"), strict=True))
_RING: dict[str, Any] = {"marker": "o", "markersize": 8.0, "fillstyle": "none", "color": BLACK}
_ENVELOPE: dict[str, Any] = {"color": "0.8", "linewidth": 4.0, "zorder": 0.5}

# Layout in mm.
_HEIGHT = 217.0
_LEFT, _WIDTH, _BETWEEN = 17.0, 53.0, 6.0  #: of a panel per scene
_TALL = 38.0
_BIASES, _ERRORS = 167.0, (114.5, 63.0, 11.0)  #: lower edges of the rows
_ASIDE = 9.0  #: what panel k leaves at its left for its own numbers


@journal
def draw(table: DataFrame) -> Figure:
    """Draw the table `production`, a column per scene.

    a-c) Biases over the CPU time of a realisation; d-f) total error of static friction over that
    of an ensemble, g-i) of t_max - t_avg, j) of l_c of pillars; k) all steps at the study's
    budgets.
    """
    picture = style.figure(style.DOUBLE, _HEIGHT)
    _draw_biases([_panel(picture, i, _BIASES) for i in range(3)], table)
    colors = _step_colors(table.step.unique().tolist())
    letters = iter("defghij")
    for quantity, bottom in zip(_QUANTITIES, _ERRORS, strict=True):
        panels = []
        for i, scene in enumerate(SCENES):
            if rows := _rows(table, scene, quantity):
                panels.append(_panel(picture, i, bottom))
                _draw_errors(panels[-1], rows, colors)
                style.panel_letter(panels[-1], next(letters), above=1.5)
        panels[0].set_ylabel(f"error of {_QUANTITIES[quantity][0]} (%)")
        _share_limits(panels)
    _draw_excess(_panel(picture, 2, _ERRORS[-1], _ASIDE), table)
    _draw_legend(picture, colors)
    return picture


def _panel(picture: Figure, column: int, bottom: float, aside: float = 0.0) -> Axes:
    left = _LEFT + column * (_WIDTH + _BETWEEN) + aside
    return style.axes(picture, left, bottom, _WIDTH - aside, _TALL)


def _rows(table: DataFrame, scene: str, quantity: str) -> list[Row]:
    """Rows of one case, finest step first; none where it was not measured."""
    found = table[(table.scene == scene) & (table.quantity == quantity)].sort_values("step")
    return cast(list[Row], found.to_dict("records"))


def _step_colors(steps: Sequence[float]) -> dict[float, Any]:
    """Dark for fine steps."""
    shades = np.linspace(0.0, 0.9, len(steps))
    return dict(zip(sorted(steps), map(colormaps["viridis"], shades), strict=True))


def _draw_biases(panels: Sequence[Axes], table: DataFrame) -> None:
    """Biases of all quantities, side by side at each step but the finest, which has none."""
    for ax, scene, letter in zip(panels, SCENES, "abc", strict=True):
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
        style.panel_letter(ax, letter, left=6.0, above=1.5)
        ax.set_title(
            f"{scene}, {table.n_blocks.iloc[0]} × {table.n_blocks.iloc[0]} blocks", pad=13.0
        )
    low = min(ax.dataLim.y0 for ax in panels)
    high = max(ax.dataLim.y1 for ax in panels)
    for ax in panels:
        ax.set_yscale("symlog", linthresh=0.1, linscale=1.0)
        ax.yaxis.set_major_locator(FixedLocator([-1.0, -0.1, 0.0, 0.1, 1.0]))
        ax.yaxis.set_minor_locator(SymmetricalLogLocator(base=10, linthresh=0.1, subs=range(2, 10)))
        ax.yaxis.set_major_formatter("{x:g}")
        ax.set_ylim(1.5 * low, 1.5 * high)
        ax.tick_params(labelleft=ax is panels[0])
    panels[0].set_ylabel("bias (%), linear within ±0.1 %")
    handles = [Line2D([], [], label=name, **look) for name, look in _QUANTITIES.values()]
    frame: dict[str, Any] = {"frameon": True, "framealpha": 1.0, "edgecolor": "none"}
    panels[0].legend(handles=handles, loc="lower right", **frame)


def _draw_bias(ax: Axes, rows: list[Row], aside: float, look: dict[str, Any]) -> None:
    bias, low, high = (
        np.array([_PERCENT * row[key] / row["scale"] for row in rows])
        for key in ("bias", "ci_low", "ci_high")
    )
    spent = [aside * row["cpu_seconds"] for row in rows]
    bars: dict[str, Any] = {"elinewidth": 0.8, "capsize": 1.5, "linewidth": 0.6}
    ax.errorbar(spent, bias, [bias - low, high - bias], **bars, **look)


def _name_steps(ax: Axes, rows: list[Row]) -> None:
    """A line at the CPU time of each step, and the step in ns above it."""
    for row in rows:
        ax.axvline(row["cpu_seconds"], color=GREY, linewidth=0.3, zorder=0.3)
        ax.annotate(
            f"{_NANO * row['step']:g}{' ns' if row is rows[0] else ''}",
            (row["cpu_seconds"], 1.0),
            (0.0, 2.5),
            xycoords=("data", "axes fraction"),
            textcoords="offset points",
            ha="center",
            fontweight="bold" if row["step"] == STEP else "normal",
        )


def _share_limits(panels: Sequence[Axes]) -> None:
    """The same axes for all scenes; numbers at the left only."""
    ends = np.array([ax.get_ylim() for ax in panels])
    for ax in panels:
        ax.set_xlim(*_SPENT)
        ax.set_ylim(0.25 * ends.min(), ends.max())  # room for words
        ax.tick_params(labelleft=ax is panels[0])


def _draw_errors(ax: Axes, rows: list[Row], colors: dict[float, Any]) -> None:
    """Total error of each step over the CPU time of ensembles, and the least of them all."""
    by_bias = [choices(rows, bias) for bias in Bias._fields]
    spent = np.geomspace(*_SPENT, 400)
    for choice, low, high in zip(*by_bias, strict=True):
        look: dict[str, Any] = {"color": colors[choice.step], "zorder": 2.0 + (choice.step == STEP)}
        ax.plot(spent, _errors(choice, spent), linewidth=_wide(choice.step), **look)
        dots = np.array([choice.spent(seeds) for seeds in _DOTS]) * (1.0 + 1e-12)
        ax.plot(dots, _errors(choice, dots), linestyle="none", marker=".", **look)
        ends = _errors(low, spent), _errors(high, spent)
        ax.fill_between(spent, *ends, color=look["color"], alpha=0.15, linewidth=0.0)
    budget, steps = study_budget(rows), by_bias[0]
    (default,) = (choice for choice in steps if choice.step == STEP)
    ax.plot([budget], _errors(default, np.array([budget])), **_RING)
    least = [_PERCENT * best(steps, seconds).error(seconds) for seconds in spent]
    ax.plot(spent, least, **_ENVELOPE)
    ax.set(xscale="log", yscale="log", xlabel="CPU time of an ensemble (s)")
    _say_what_is_best(ax, by_bias, budget)


def _say_what_is_best(ax: Axes, by_bias: list[list[Choice]], budget: float) -> None:
    """Best step and number of seeds at the ring, and what half its error costs."""
    chosen = best(by_bias[0], budget)
    costs = [halving(steps, budget) for steps in by_bias]
    ax.text(
        0.03,
        0.05,
        f"best at {budget:.2g} s: {_NANO * chosen.step:g} ns, {chosen.seeds(budget):.0f} seeds;\n"
        f"half its error: {costs[0]:.1f} × CPU time\n({min(costs):.1f} to {max(costs):.1f})",
        transform=ax.transAxes,
    )


def _errors(choice: Choice, spent: Array) -> Array:
    """Total error in percent for each CPU time in s, (n,); NaN where no realisation is done."""
    return _PERCENT * _finite([choice.error(seconds) for seconds in spent])


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
                steps = [_NANO * step for step in found[0]]
                ratios = _finite([list(each.values()) for each in found])
                ax.plot(steps, ratios[0], linestyle=dashes, **look)
                ends = ratios.min(axis=0), ratios.max(axis=0)
                ax.vlines(steps, *ends, color=look["color"], linewidth=2.5, alpha=0.25)
    names = [_NANO * step for step in sorted(table.step.unique())]
    ax.set(xscale="log", yscale="log", xlabel="integration step (ns)", ylim=(0.9, 10.0))
    ax.set_xticks(names, [f"{name:g}" for name in names])
    ax.xaxis.set_minor_locator(NullLocator())
    ax.set_yticks([1.0, 2.0, 5.0, 10.0], ["1", "2", "5", "10"])
    ax.yaxis.set_minor_formatter(NullFormatter())
    ax.set_ylabel("error over the least", labelpad=1.0)
    handles = [Line2D([], [], label=s, color=BLACK, linestyle=d) for s, d in _DASHES.items()]
    ax.legend(handles=handles, loc="upper left")
    style.panel_letter(ax, "k", above=1.5)


def _draw_legend(picture: Figure, colors: dict[float, Any]) -> None:
    """What the panels of total errors show, in the place of one of them."""
    handles: list[Artist] = []
    for step, color in colors.items():
        name = f"{_NANO * step:g} ns{', the default' if step == STEP else ''}"
        look: dict[str, Any] = {"color": color, "linewidth": _wide(step), "marker": "."}
        handles.append(Line2D([], [], label=name, **look))
    handles.append(Line2D([], [], label="the study's seeds", linestyle="none", **_RING))
    handles.append(Line2D([], [], label="least error", **_ENVELOPE))
    handles.append(Patch(label="bias within its interval", color=GREY, alpha=0.25, linewidth=0.0))
    place = (0.5 * _LEFT / style.DOUBLE, (_ERRORS[-1] + _TALL) / _HEIGHT)
    picture.legend(handles=handles, loc="upper left", bbox_to_anchor=place)
