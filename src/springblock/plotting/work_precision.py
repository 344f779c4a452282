"""Error against cost, and what is left of it where single runs no longer agree.

Not in the paper (Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525): it shows
what an integration step costs and what it is good for.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FixedLocator, LogLocator, NullLocator, SymmetricalLogLocator

from springblock.accuracy.conventions import ENSEMBLE, PAPER_STEP, PLAIN, SCENES, order
from springblock.model.defaults import INTEGRATOR, STEP
from springblock.plotting import style
from springblock.plotting.declaration import Declaration, Table
from springblock.plotting.style import BLACK, BLUE, GREEN, GREY, PURPLE, VERMILION, journal

if TYPE_CHECKING:
    from pandas import DataFrame

FIGURE = Declaration(
    title="Error against run time",
    category="Accuracy",
    caption="""Error against cost of both integrators, and of Runge-Kutta with the friction of each
    stage, which does not converge. Single runs are compared with an event-located reference
    solution, ensembles with the same seeds at a fine step, with 95 % t intervals. The grey area
    lies below the disagreement of the finest step with the reference, the blue band holds 95 % of
    the means over 20 seeds.""",
    source=Table("work_precision"),
)

_NANO = 1e9  #: ns per s
_PERCENT = 100.0

#: Names, colours and markers. Runge-Kutta lies on top where it covers the leapfrog.
_METHODS: dict[str, tuple[str, dict[str, Any]]] = {
    "leapfrog": ("leapfrog", {"color": BLUE, "marker": "o", "markersize": 4.2}),
    "rk4": ("Runge–Kutta", {"color": VERMILION, "marker": "s", "markersize": 2.6}),
    PLAIN: (
        "Runge–Kutta, stage-wise friction",
        {"color": GREY, "marker": "^", "markersize": 3.4},
    ),
}
_TWINS: dict[str, dict[str, Any]] = {
    "flat": {"color": BLACK, "marker": "D", "markersize": 2.8},
    "pillared": {"color": GREEN, "marker": "v", "markersize": 3.6},
    "grooved": {"color": PURPLE, "marker": "P", "markersize": 3.8},
}
_ORDER_TWO: dict[str, Any] = {"color": BLACK, "linewidth": 0.6, "linestyle": (0, (5, 3))}
_FLOOR: dict[str, Any] = {"color": "0.91", "linewidth": 0.0, "zorder": 0}
_SCATTER: dict[str, Any] = {"color": "#D6E4EE", "linewidth": 0.0, "zorder": 0}
_RINGS: dict[str, dict[str, Any]] = {
    "default": {"marker": "o", "markersize": 8.5},
    "paper": {"marker": "D", "markersize": 7.5},
}
_RING: dict[str, Any] = {"fillstyle": "none", "color": BLACK, "linestyle": "none"}

_COSTS = {"force_evaluations": "force evaluations", "cpu_seconds": "CPU time (s)"}
_BIASES = {
    "static_friction": "static\nfriction",
    "t_max": r"$t_\mathrm{max}$",
    "t_avg": r"$t_\mathrm{avg}$",
}
_DIFFERENCES = {
    "t_det before peak": "RMS difference of\n$t_\\mathrm{det}/t_\\mathrm{max}$ before peak",
    "static_friction": "relative difference\nof static friction",
    "horizon": r"horizon$/t_\mathrm{max}$",
}

# Layout in mm.
_HEIGHT = 225.0
_LEFT, _WIDTH, _BETWEEN = 19.5, 52.5, 4.5  #: of a panel per scene; the columns share their axis
_COST_ROWS, _COST_HEIGHT = (174.5, 125.5), 35.0  #: lower edges and height
_BIAS_ROWS, _BIAS_HEIGHT = (93.0, 74.0, 55.0), 17.3
_TWIN_WIDTH, _TWIN_BETWEEN = 42.5, 19.5
_TWIN_BOTTOM, _TWIN_HEIGHT = 10.0, 31.0


@journal
def draw(table: DataFrame) -> Figure:
    """Draw the table of work and precision, a column per scene.

    a-c) Single runs against a solution that locates every event: error of the detachment times
    before the horizon over force evaluations; d-f) of static friction over CPU time. Rings mark
    the default of `simulate` and the step of the paper. g-i) Ensembles with paired seeds: bias
    with its 95 % interval. j-l) Runs against themselves with thresholds changed by a little.
    """
    picture = style.figure(style.DOUBLE, _HEIGHT)
    single = table[table.comparison == "reference"]
    quantities = ("t_det before horizon", "static_friction")
    labels = (
        "RMS error of $t_\\mathrm{det}/t_\\mathrm{max}$\nbefore the horizon",
        "relative error of\nstatic friction",
    )
    for bottom, cost, quantity, label, letters in zip(
        _COST_ROWS, _COSTS, quantities, labels, ("abc", "def"), strict=True
    ):
        panels = _row(picture, bottom, _COST_HEIGHT)
        shown = single[single.quantity == quantity]
        _draw_costs(panels, shown, cost)
        panels[0].set_ylabel(label)
        _letters(panels, letters)
    _name_scenes(picture.axes[:3], single)
    for ax, (_, rows) in zip(picture.axes[:3], _by_scene(single), strict=True):
        _write_orders(ax, rows[rows.quantity == quantities[0]])

    _draw_biases(picture, table)
    _draw_twins(picture, table[table.comparison == "twin"])
    _draw_legend(picture, single[single.integrator == "leapfrog"].step.min())
    return picture


def _row(picture: Figure, bottom: float, height: float) -> list[Axes]:
    """A panel for each scene, side by side."""
    lefts = (_LEFT + i * (_WIDTH + _BETWEEN) for i in range(len(SCENES)))
    return [style.axes(picture, left, bottom, _WIDTH, height) for left in lefts]


def _letters(panels: Sequence[Axes], letters: str, left: float = 0.0) -> None:
    for ax, letter in zip(panels, letters, strict=True):
        style.panel_letter(ax, letter, left=left, above=1.5)


def _by_scene(rows: DataFrame) -> Iterator[tuple[str, DataFrame]]:
    for scene in SCENES:
        yield scene, rows[rows.scene == scene]


def _name_scenes(panels: Sequence[Axes], rows: DataFrame) -> None:
    """Write above each column which scene it shows, and how large it is."""
    for ax, (scene, part) in zip(panels, _by_scene(rows), strict=True):
        sizes = " or ".join(f"{n} × {n}" for n in part.n_blocks.unique())
        ax.set_title(f"{scene}, {sizes} blocks", pad=4.5)


def _draw_costs(panels: Sequence[Axes], rows: DataFrame, cost: str) -> None:
    """Error of one quantity over one cost, on common axes."""
    for ax, (_, part) in zip(panels, _by_scene(rows), strict=True):
        ax.set(xscale="log", yscale="log", xlabel=_COSTS[cost])
        for method, (_, look) in _METHODS.items():
            line = part[part.integrator == method].sort_values("step")
            ax.plot(line[cost], line.error, **look)
        _draw_guides(ax, part, cost)
        _mark_default_and_paper(ax, part, cost)
    _share_limits(panels, rows, cost)


def _share_limits(panels: Sequence[Axes], rows: DataFrame, cost: str) -> None:
    """The same axes for all scenes; numbers at the left only."""
    for ax in panels:
        ax.set_xlim(0.6 * rows[cost].min(), 1.7 * rows[cost].max())
        ax.set_ylim(0.3 * rows.error.min(), 3.0 * rows.error.max())
        for axis in (ax.xaxis, ax.yaxis):
            axis.set_minor_locator(LogLocator(subs=range(2, 10), numticks=99))
    for ax in panels[1:]:
        ax.tick_params(labelleft=False)


def _draw_guides(ax: Axes, rows: DataFrame, cost: str) -> None:
    """A line of order 2 below the leapfrog, and the error of its finest step as a floor."""
    line = rows[rows.integrator == "leapfrog"].sort_values("step")
    spent = line[cost].to_numpy()
    ax.plot(spent, line.error.iloc[0] * (spent[0] / spent) ** 2 / 3.0, **_ORDER_TWO)
    ax.axhspan(0.0, line.error.iloc[0], **_FLOOR)


def _ringed() -> dict[str, tuple[str, float]]:
    """Integrator and step in s as `simulate` has them by default, and as the paper."""
    return {"default": (INTEGRATOR, STEP), "paper": (PLAIN, PAPER_STEP)}


def _mark_default_and_paper(ax: Axes, rows: DataFrame, cost: str) -> None:
    for name, (method, step) in _ringed().items():
        row = rows[(rows.integrator == method) & np.isclose(rows.step, step, rtol=1e-6, atol=0.0)]
        ax.plot(row[cost], row.error, **_RING, **_RINGS[name])


def _write_orders(ax: Axes, rows: DataFrame) -> None:
    """Write the orders of both integrators in the corner of little work and small errors."""
    for i, method in enumerate(("leapfrog", "rk4")):
        line = rows[rows.integrator == method]
        text = f"order {order(line.step, line.error):.1f}"
        place = (0.03, 0.16 - 0.11 * i)
        ax.text(*place, text, color=_METHODS[method][1]["color"], transform=ax.transAxes)


def _draw_biases(picture: Figure, table: DataFrame) -> None:
    """Ensembles with paired seeds, before the scatter of an ensemble as large as the study's.

    All on one axis, linear up to 1 % and logarithmic beyond: neither the intervals of fine steps
    nor the biases of the coarsest get lost.
    """
    paired, scatter = (table[table.comparison == name] for name in ("paired", "scatter"))
    rows = [_row(picture, bottom, _BIAS_HEIGHT) for bottom in _BIAS_ROWS]
    for panels, (quantity, name) in zip(rows, _BIASES.items(), strict=True):
        for ax, scene in zip(panels, SCENES, strict=True):
            biases, spread = (
                part[(part.quantity == quantity) & (part.scene == scene)]
                for part in (paired, scatter)
            )
            half = _half_width(spread)
            ax.axhspan(-half, half, **_SCATTER)
            ax.axhline(0.0, color=BLACK, linewidth=0.4, zorder=0.5)
            _draw_bias(ax, biases)
            ax.tick_params(labelleft=ax is panels[0], labelbottom=panels is rows[-1])
        panels[0].set_ylabel(name)
        panels[0].yaxis.set_label_coords(-0.155, 0.5)
    _share_percent([ax for panels in rows for ax in panels])
    for ax in rows[-1]:
        ax.set_xlabel("integration step (ns)")
    _letters(rows[0], "ghi")
    _name_scenes(rows[0], paired)
    across, up = 1.5 / style.DOUBLE, 0.5 * (_BIAS_ROWS[0] + _BIAS_HEIGHT + _BIAS_ROWS[-1]) / _HEIGHT
    look: dict[str, Any] = {"rotation": "vertical", "ha": "left", "va": "center"}
    picture.text(across, up, "bias (%), linear within ±1 %", fontsize=style.NORMAL, **look)


def _share_percent(panels: Sequence[Axes]) -> None:
    """One axis that holds what any of the panels shows."""
    low = min(-1.0, *(ax.dataLim.y0 for ax in panels))
    high = max(1.0, *(ax.dataLim.y1 for ax in panels))
    for ax in panels:
        ax.set_yscale("symlog", linthresh=1.0, linscale=1.0)
        ax.yaxis.set_major_locator(FixedLocator([-5.0, -1.0, 0.0, 1.0, 5.0]))
        ax.yaxis.set_minor_locator(SymmetricalLogLocator(base=10, linthresh=1, subs=range(2, 10)))
        ax.yaxis.set_major_formatter("{x:g}")
        ax.set_ylim(1.5 * low, 1.5 * high)


def _half_width(rows: DataFrame) -> float:
    """Where 95 % of the means over as many seeds as in the study lie: ± so many percent."""
    half = 0.5 * (rows.ci_high - rows.ci_low) * np.sqrt(rows.realisations / ENSEMBLE)
    return _PERCENT * float(half.item())


def _draw_bias(ax: Axes, rows: DataFrame) -> None:
    """Bias over step; the integrators stand side by side."""
    for method, aside in (("leapfrog", 0.96), ("rk4", 1.04)):
        line = rows[rows.integrator == method].sort_values("step")
        reach = (line.error - line.ci_low, line.ci_high - line.error)
        look = _METHODS[method][1] | {"markersize": 2.4}  # no larger than most intervals
        ax.errorbar(
            aside * _NANO * line.step,
            _PERCENT * line.error,
            [_PERCENT * side for side in reach],
            elinewidth=0.8,
            capsize=1.5,
            **look,
        )
    steps = _NANO * np.unique(rows.step)
    ax.set_xscale("log")
    ax.set_xlim(0.8 * steps[0], 1.25 * steps[-1])
    ax.xaxis.set_minor_locator(NullLocator())
    ax.set_xticks(steps, [f"{step:g}" for step in steps])


def _draw_twins(picture: Figure, rows: DataFrame) -> None:
    """How far a change of the thresholds takes a run from itself, and from when on."""
    panels = []
    for i, (quantity, label) in enumerate(_DIFFERENCES.items()):
        left = _LEFT + i * (_TWIN_WIDTH + _TWIN_BETWEEN)
        ax = style.axes(picture, left, _TWIN_BOTTOM, _TWIN_WIDTH, _TWIN_HEIGHT)
        shown = rows[rows.quantity == quantity]
        for scene, part in _by_scene(shown):
            line = part.sort_values("nudge")
            ax.plot(line.nudge, line.error, label=scene, clip_on=False, **_TWINS[scene])
        ax.set(xscale="log", xlabel="relative change of thresholds", ylabel=label)
        if quantity != "horizon":  # no difference at all is a result: zero belongs on the axis
            ax.set_yscale("symlog", linthresh=1e-6, linscale=0.6)
            ax.set_ylim(0.0, 2.0 * max(1e-6, shown.error.max()))
        panels.append(ax)
    _letters(panels, "jkl")
    panels[-1].legend(loc="lower left")


def _draw_legend(picture: Figure, finest: float) -> None:
    """What holds for all panels, above them."""
    handles: list[Artist] = [Line2D([], [], label=name, **look) for name, look in _METHODS.values()]
    handles.append(Line2D([], [], label="order 2", **_ORDER_TWO))
    for name, (method, step) in _ringed().items():
        label = f"{name}: {_METHODS[method][0].split(',')[0]}, {_NANO * step:g} ns"
        handles.append(Line2D([], [], label=label, **_RING, **_RINGS[name]))
    handles += [
        Patch(label=f"below the leapfrog at {_NANO * finest:g} ns", **_FLOOR),
        Patch(label=f"95 % of means over {ENSEMBLE} seeds", **_SCATTER),
    ]
    picture.legend(handles=handles, loc="upper center", ncols=4, bbox_to_anchor=(0.5, 1.0))
