"""Figures of the mechanism: stress before slip, friction by model, and sensitivities."""

from collections.abc import Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from seaborn import lineplot

from springblock.analysis.statistics import mean_interval
from springblock.model.material import Material
from springblock.model.numbers import Array
from springblock.plotting import style
from springblock.plotting.curves import BAR, FRICTION, LAG, name_places
from springblock.plotting.maps import draw_map
from springblock.plotting.style import BLACK, BLUE, GREEN, GREY, PURPLE, VERMILION, Look, color_bar
from springblock.study.mechanism.page import NAMES
from springblock.study.mechanism.surfaces import PARTS
from springblock.theory.elasticity import Layer

_SHOWN = (3, 6, 10, 20)  #: n_p of the pillars whose stress is mapped
#: Colours and markers of the models, in their order.
_LOOKS = {
    "independent": (BLUE, "s"),
    "quasi_static": (GREEN, "^"),
    "sticking": (PURPLE, "v"),
    "overshooting": (VERMILION, "D"),
    "simulation": (BLACK, "o"),
}
#: Quantities of the sensitivities, their axes and the factors to the units of these.
_QUANTITIES = {
    "size": ("$n_p$ of lowest friction", 1.0),
    "depth": ("depth of the minimum", 1.0),
    "lag": (LAG, style.MICRO),
    "prominence": ("prominence of the\nsecond load peak (%)", style.PERCENT),
}
_SYMBOLS = {"": "paper", "l_z": "$l_z$", "mu_s - mu_d": r"$\mu_s - \mu_d$", "v": "$v$", "P": "$P$"}
_SYMBOLS |= {"K_s": "$K_s$", "gamma": r"$\gamma$ ="}
_GAP = 0.7  #: between rows of different kinds, over the distance of rows


def mechanism_friction(table: pd.DataFrame) -> Figure:
    """Draw a-d) stress on pillars, e) its relative deviation and f) friction by model over n_p."""
    picture, panels = style.panels(style.DOUBLE, 118.0, "abcd|eeff", height_ratios=(45, 73))
    _draw_stress(panels[:4])
    uneven, friction = panels[4:]
    variation = table.groupby("n_p")["stress_variation"].first()
    uneven.plot(variation.index, variation, color=GREY, marker="o")
    uneven.set(ylabel="stress: standard deviation over mean", ylim=(0.0, None))
    _draw_friction(friction, table)
    for ax in (uneven, friction):
        name_places(ax, table["n_p"])
        ax.set_xlabel("size of pillars $n_p$ (blocks)")
    low, high = friction.get_ylim()
    friction.set_ylim(low, high + 0.3 * (high - low))  # room for the legend
    return picture


def mechanism_sensitivities(table: pd.DataFrame) -> Figure:
    """Draw a) the size of lowest friction, b) its depth, c) t_max - t_avg, d) prominence."""
    picture, panels = style.panels(style.DOUBLE, 130.0, "abcd", sharey=True)
    shown = table[(table["edges"] == "free") | (table["varied"] == "edges")]
    rows = list(dict.fromkeys(zip(shown["varied"], shown["value"], strict=True)))
    kinds = list(dict.fromkeys(varied for varied, _ in rows))
    places = {row: i + _GAP * kinds.index(row[0]) for i, row in enumerate(rows)}
    for ax, (quantity, (label, factor)) in zip(panels, _QUANTITIES.items(), strict=True):
        part = shown[shown["quantity"] == quantity]
        means, low, high = factor * part[["mean", "mean_low", "mean_high"]].to_numpy().T
        at = [places[row] for row in zip(part["varied"], part["value"], strict=True)]
        bars = np.array([means - low, high - means])
        ax.errorbar(means, at, xerr=bars, color=BLACK, marker="o", linestyle="none", **BAR)
        ax.axvline(means[at.index(0.0)], color=GREY, linewidth=0.5, linestyle=":", zorder=0)
        ax.set_xlabel(label)
    names = [f"{_SYMBOLS.get(varied, varied)} {value}" for varied, value in rows]
    panels[0].set_yticks(list(places.values()), names)
    name_places(panels[0], table.loc[table["quantity"] == "size", "mean"])
    panels[0].set_ylabel("setting")
    panels[0].margins(y=0.03)
    panels[0].invert_yaxis()
    return picture


def _draw_friction(ax: Axes, table: pd.DataFrame) -> None:
    """Draw mean friction by model over n_p, with 95 % intervals of Student's t."""
    names = [NAMES[name] for name in _LOOKS]
    colors, markers = (
        dict(zip(names, each, strict=True)) for each in zip(*_LOOKS.values(), strict=True)
    )
    friction = table.rename(columns=NAMES).melt("n_p", names, "model", FRICTION)
    look: Look = {"err_style": "bars", "err_kws": BAR, "errorbar": lambda s: mean_interval(s)[1:]}
    groups: Look = {"hue": "model", "style": "model", "palette": colors, "markers": markers}
    lineplot(friction, x="n_p", y=FRICTION, **groups, **look, ax=ax)
    ax.legend(loc="upper right", ncols=2)


def _draw_stress(panels: Sequence[Axes]) -> None:
    """Map the stress on one pillar of each size over its mean, in common colours."""
    stresses = {n_p: _pillar_stress(n_p) for n_p in _SHOWN}
    limits = min(map(np.min, stresses.values())), max(map(np.max, stresses.values()))
    for ax, (n_p, stress) in zip(panels, stresses.items(), strict=True):
        image = draw_map(ax, stress, "_p/l", cmap="cividis", vmin=limits[0], vmax=limits[1])
        ax.set_title(f"$n_p$ = {n_p}", loc="right")
    color_bar(panels[-1], image, "stress over its mean")


def _pillar_stress(n_p: int) -> Array:
    """Return |F_mot| on the blocks of the first pillar before any slip, over the mean of all."""
    pattern = PARTS[f"mechanism-{n_p}"][0].pattern
    pulled = Layer(pattern.contact, Material()).stress
    stress = np.zeros(pattern.shape)
    stress[pattern.contact] = pulled / pulled.mean()
    y, x = pattern.origins[0]
    return stress[y : y + n_p, x : x + n_p]
