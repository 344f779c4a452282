"""Error against cost, and what is left of it where single runs no longer agree."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import LogLocator

from springblock.accuracy.conventions import ENSEMBLE, PAPER_STEP, PLAIN, SCENES, order
from springblock.model.defaults import INTEGRATOR, STEP
from springblock.plotting import style
from springblock.plotting.accuracy.percent import fit_percent
from springblock.plotting.declaration import Declaration, TableSource
from springblock.plotting.points import draw_points, name_places

if TYPE_CHECKING:
    from pandas import DataFrame

FIGURE = Declaration(
    title="Error against run time",
    category="Accuracy",
    caption="""Error against cost of both integrators, and of Runge-Kutta with the friction of each
    stage, which does not converge. Single runs are compared with an event-located reference
    solution, ensembles with the same seeds at a fine step, with 95 % t intervals. The grey area
    lies below the disagreement of the finest step with the reference, the blue band holds 95 % of
    the means over 20 seeds. Axes of biases are linear within ±1 % and logarithmic beyond.""",
    source=TableSource("work_precision"),
)

#: Names, colours and markers. Runge-Kutta lies on top where it covers the leapfrog.
_METHODS: dict[str, tuple[str, style.Look]] = {
    "leapfrog": ("leapfrog", {"color": style.BLUE, "marker": "o", "markersize": 4.2}),
    "rk4": ("Runge–Kutta", {"color": style.VERMILION, "marker": "s", "markersize": 2.6}),
    PLAIN: (
        "Runge–Kutta, stage-wise friction",
        {"color": style.GREY, "marker": "^", "markersize": 3.4},
    ),
}
_TWINS: dict[str, style.Look] = {
    "flat": {"color": style.BLACK, "marker": "D", "markersize": 2.8},
    "pillared": {"color": style.GREEN, "marker": "v", "markersize": 3.6},
    "grooved": {"color": style.PURPLE, "marker": "P", "markersize": 3.8},
}
_ORDER_TWO: style.Look = {"color": style.BLACK, "linewidth": 0.6, "linestyle": (0, (5, 3))}
_FLOOR: style.Look = {"color": "0.91", "linewidth": 0.0, "zorder": 0}
_SCATTER: style.Look = {"color": "#D6E4EE", "linewidth": 0.0, "zorder": 0}
_RINGS: dict[str, style.Look] = {
    "default": {"marker": "o", "markersize": 8.5},
    "paper": {"marker": "D", "markersize": 7.5},
}
_RING: style.Look = {"fillstyle": "none", "color": style.BLACK, "linestyle": "none"}

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


@style.journal
def draw(table: DataFrame) -> Figure:
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
    _write_orders(times, before_horizon)
    _draw_biases(biases, table)
    _draw_twins(twins, table[table.comparison == "twin"])
    _draw_legend(picture, single[single.integrator == "leapfrog"].step.min())
    return picture


def _by_scene(panels: Sequence[Axes], rows: DataFrame) -> Iterator[tuple[Axes, DataFrame]]:
    """A panel for each scene, and its rows."""
    for ax, scene in zip(panels, SCENES, strict=True):
        yield ax, rows[rows.scene == scene]


def _name_scenes(panels: Sequence[Axes], rows: DataFrame) -> None:
    """Write above each column which scene it shows, and how large it is."""
    for ax, part in _by_scene(panels, rows):
        sizes = " or ".join(f"{n} × {n}" for n in part.n_blocks.unique())
        ax.set_title(f"{part.scene.iloc[0]}, {sizes} blocks")


def _draw_costs(panels: Sequence[Axes], rows: DataFrame, cost: str) -> None:
    """Error of one quantity over one cost, on common axes."""
    style.share_axes(panels)
    for ax, part in _by_scene(panels, rows):
        for method, (_, look) in _METHODS.items():
            line = part[part.integrator == method].sort_values("step")
            ax.plot(line[cost], line.error, **look)
        _draw_guides(ax, part, cost)
        _mark_default_and_paper(ax, part, cost)
        ax.set_xlabel(_COSTS[cost])
    ax = panels[0]
    ax.set(xscale="log", yscale="log")
    ax.set_xlim(0.6 * rows[cost].min(), 1.7 * rows[cost].max())
    ax.set_ylim(0.3 * rows.error.min(), 3.0 * rows.error.max())
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_minor_locator(LogLocator(subs=range(2, 10), numticks=99))


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


def _write_orders(panels: Sequence[Axes], rows: DataFrame) -> None:
    """Write the orders of both integrators in the corner of little work and small errors."""
    for ax, part in _by_scene(panels, rows):
        for height, method in ((0.16, "leapfrog"), (0.05, "rk4")):
            line = part[part.integrator == method]
            text, color = f"order {order(line.step, line.error):.1f}", _METHODS[method][1]["color"]
            ax.text(0.03, height, text, color=color, transform=ax.transAxes)


def _draw_biases(panels: Sequence[Sequence[Axes]], table: DataFrame) -> None:
    """Ensembles with paired seeds, before the scatter of an ensemble as large as the study's."""
    paired, scatter = (table[table.comparison == name] for name in ("paired", "scatter"))
    every = [ax for row in panels for ax in row]
    style.share_axes(every)
    for row, (quantity, label) in zip(panels, _BIASES.items(), strict=True):
        for ax, spread in _by_scene(row, scatter[scatter.quantity == quantity]):
            half = _half_width(spread)
            ax.axhspan(-half, half, **_SCATTER)
            ax.axhline(0.0, color=style.BLACK, linewidth=0.4, zorder=0.5)
        for ax, biases in _by_scene(row, paired[paired.quantity == quantity]):
            _draw_bias(ax, biases)
            ax.tick_params(labelleft=ax is row[0], labelbottom=row is panels[-1])
        row[0].set_ylabel(label)
    for ax in panels[-1]:
        ax.set_xlabel("integration step (ns)")
    _name_scenes(panels[0], paired)
    fit_percent(every, 1.0, (-5.0, -1.0, 0.0, 1.0, 5.0))
    name_places(every[0], style.NANO * np.unique(paired.step))


def _half_width(rows: DataFrame) -> float:
    """Where 95 % of the means over as many seeds as in the study lie: ± so many percent."""
    half = 0.5 * (rows.ci_high - rows.ci_low) * np.sqrt(rows.realisations / ENSEMBLE)
    return style.PERCENT * float(half.item())


def _draw_bias(ax: Axes, rows: DataFrame) -> None:
    """Bias over step; the integrators stand side by side."""
    for method, aside in (("leapfrog", 0.96), ("rk4", 1.04)):
        line = rows[rows.integrator == method].sort_values("step")
        intervals = style.PERCENT * line[["error", "ci_low", "ci_high"]]
        look = _METHODS[method][1] | {"markersize": 2.4}  # no larger than most intervals
        draw_points(ax, aside * style.NANO * line.step, intervals, **look)


def _draw_twins(panels: Sequence[Axes], rows: DataFrame) -> None:
    """How far a change of the thresholds takes a run from itself, and from when on."""
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


def _draw_legend(picture: Figure, finest: float) -> None:
    """What holds for all panels, above them."""
    handles: list[Artist] = [Line2D([], [], label=name, **look) for name, look in _METHODS.values()]
    handles.append(Line2D([], [], label="order 2", **_ORDER_TWO))
    for name, (method, step) in _ringed().items():
        label = f"{name}: {_METHODS[method][0].split(',')[0]}, {style.NANO * step:g} ns"
        handles.append(Line2D([], [], label=label, **_RING, **_RINGS[name]))
    handles += [
        Patch(label=f"below the leapfrog at {style.NANO * finest:g} ns", **_FLOOR),
        Patch(label=f"95 % of means over {ENSEMBLE} seeds", **_SCATTER),
    ]
    picture.legend(handles=handles, loc="outside upper center", ncols=4)
