"""Stiff and extreme cases: what they are off by, and what is accepted."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator
from matplotlib.transforms import blended_transform_factory
from pandas import DataFrame

from springblock.plotting import style
from springblock.plotting.looks import METHODS
from springblock.plotting.style import BLACK, GREY, Look

#: Outcomes without an error to show: marker, its height as a share of the panel, and name.
_ENDS = {
    "refused": ("x", 0.95, "refused at the start"),
    "raises": ("^", 0.87, "ended by an exception"),
    "nothing": ("d", 0.79, "as expected, nothing to compare"),
}
_ACCEPTED: Look = {"label": "accepted", "color": GREY, "marker": "_", "markersize": 6.0}
_ACCEPTED |= {"linestyle": ""}

#: Families over a parameter: the name of the axis, and the beginnings of the quantities shown,
#: each with a label at (share of the axis, error).
_PANELS: dict[str, tuple[str, dict[str, tuple[str, float, float]]]] = {
    "stiffness": (
        r"$K_s/K_\mathrm{int}$",
        {
            "first detachment": ("first detachment", 0.30, 3e-15),
            "displacement": ("path of a column", 0.30, 1e-7),
        },
    ),
    "strain": (r"strain $F_n/(K_s\,l)$", {"displacement": ("path of a column", 0.42, 1e-11)}),
    "damping": (r"damping $\gamma/\omega$", {"spring force": ("force in the slip", 0.05, 1e-11)}),
    "speed": (
        r"speed $v\,K_s/(F_n\,\omega)$",
        {"spring force": ("force after the slip", 0.05, 1e-11)},
    ),
}
_SMALLEST = 1e-16  #: relative error
_LEAST = 1e-6  #: share of the accepted error; what is less, or nothing, is drawn here


def stability(cases: DataFrame) -> Figure:
    """Draw results/tables/stability.parquet.

    a) Energy residual over step, up to the stability limit and beyond; b) error of all cases
    relative to what is accepted; c) to f) error over the parameter of four families.
    """
    picture, panels = style.panels(style.DOUBLE, 116.0, "ab|cdef")
    steps, overview, *families = panels
    _draw_steps(steps, _family(cases, "step"))
    _draw_overview(overview, cases)
    for ax, (family, (name, shown)) in zip(families, _PANELS.items(), strict=True):
        _draw_family(ax, _family(cases, family), shown)
        ax.set_xlabel(name)
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
    for integrator, look in METHODS.items():
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
    ax.yaxis.set_minor_locator(NullLocator())


def _draw_overview(ax: Axes, cases: DataFrame) -> None:
    """Draw error over accepted error, family by family; within each, the cases lie side by side."""
    families = list(dict.fromkeys(cases["family"]))
    nothing = cases["tolerance"].isna() & ~cases["outcome"].isin(_ENDS)
    cases = cases.assign(outcome=cases["outcome"].mask(nothing, "nothing"))
    for (number, family), integrator in product(enumerate(families), METHODS):
        look, middle = METHODS[integrator], number + (-0.21 if integrator == "leapfrog" else 0.21)
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
    ax.yaxis.set_minor_locator(NullLocator())
    counts = cases["family"].value_counts()
    names = [f"{family} ({counts[family]})" for family in families]
    ax.set_xticks(range(len(families)), names, rotation=35.0, ha="right", rotation_mode="anchor")
    ax.tick_params(axis="x", length=0.0, pad=2.0)
    ax.set(xlabel="family (number of cases)", ylabel="error / accepted error")


def _draw_family(ax: Axes, cases: DataFrame, shown: dict[str, tuple[str, float, float]]) -> None:
    """Draw the error of a family over its parameter."""
    for start, (label, across, up) in shown.items():
        same = cases.loc[cases["quantity"].str.startswith(start)]
        for integrator, look in METHODS.items():
            runs = _of(same, integrator, "agrees")
            error = runs["relative_error"].abs().clip(lower=_SMALLEST)
            ax.plot(runs["parameter"], error, linewidth=0.6, **look)
            ax.plot(runs["parameter"], runs["tolerance"], **_ACCEPTED)
        place = blended_transform_factory(ax.transAxes, ax.transData)
        ax.text(across, up, label, transform=place, ha="left", va="center")
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
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_minor_locator(NullLocator())


def _draw_ends(ax: Axes, cases: DataFrame) -> None:
    """Mark the cases that end early at the top of the panel."""
    for (integrator, look), height in zip(METHODS.items(), (0.95, 0.87), strict=True):
        for outcome, (marker, _, _) in _ENDS.items():
            _mark(ax, _of(cases, integrator, outcome)["parameter"], height, look, marker)


def _mark(ax: Axes, places: Any, height: float, look: Look, marker: str) -> None:
    """Draw markers at a share of the panel's height."""
    looks = {**look, "marker": marker, "markersize": 4.0, "linestyle": ""}
    ax.plot(places, np.full(len(places), height), transform=ax.get_xaxis_transform(), **looks)
