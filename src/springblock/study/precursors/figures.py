"""Figure of slip precursors: lengths along edges, by theory and in the simulation."""

import math
from itertools import product

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from springblock.plotting import curves, style
from springblock.plotting.style import BLACK, BLUE, GREY, MICRO, VERMILION, Look
from springblock.theory.chain import decay_length

_EDGES: dict[str, Look] = {
    "along": {"color": BLUE, "marker": "D"},
    "across": {"color": VERMILION, "marker": "s"},
}
_SIMULATED = ["simulated", "simulated_low", "simulated_high"]  #: with its interval
_USUAL = "ξ = 10 µm, d_c = 100 nm"  #: of the fronts that are drawn
_FILLS = {1.25e-6: "full", 2.5e-6: "none"}  #: of symbols, by the spacing of the lattice


def precursors_lengths(table: pd.DataFrame) -> Figure:
    """Draw a) l_c of avalanches over the load handed on, b) c(r) of fronts beside a depth."""
    picture, (lengths, fronts) = style.panels(style.DOUBLE, 78.0, "ab")
    _draw_lengths(lengths, table[table["quantity"] == "l_c"].dropna(subset="simulated"))
    _draw_fronts(fronts, table[table["what"].str.endswith(_USUAL)])
    style.legend_above(picture, lengths, ncols=4)
    return picture


def _draw_lengths(ax: Axes, cells: pd.DataFrame) -> None:
    """Draw the simulation, the chain, open, and the length of an avalanche, a line."""
    drop = cells["mu_static"] - cells["mu_dynamic"]
    handed = drop * cells["t_1"] / (math.sqrt(2.0) * cells["mu_static_std"])
    x = np.geomspace(handed.min() / 1.2, handed.max() * 1.2)
    ax.plot(x, [decay_length(each) for each in x], color=GREY, label="avalanche")
    for edge, look in _EDGES.items():
        one = cells["edge"] == edge
        own: Look = look | {"label": f"simulation, {edge}", "linestyle": "none"}
        curves.draw_points(ax, handed[one], cells.loc[one, _SIMULATED], **own)
        open_: Look = look | {"markerfacecolor": "none", "markersize": 7.0, "linestyle": "none"}
        ax.plot(handed[one], cells.loc[one, "predicted"], label=f"chain, {edge}", **open_)
    ax.set(xscale="log", yscale="log", ylabel="correlation length $l_c$ (blocks)")
    ax.set_xlabel(r"load handed on, $(\mu_s - \mu_d)\,T_1/(\sqrt{2}\,\sigma)$")
    ax.xaxis.set_major_formatter("{x:g}")
    ax.yaxis.set_major_formatter("{x:g}")


def _draw_fronts(ax: Axes, cells: pd.DataFrame) -> None:
    """Draw c(r): lines of the theory on the finest lattice, symbols of the simulation."""
    for (edge, look), (spacing, fill) in product(_EDGES.items(), _FILLS.items()):
        part = cells[(cells["edge"] == edge) & (cells["spacing"] == spacing)]
        of_r = part[part["quantity"].str.match(r"c_\d+_um")]
        r = of_r["quantity"].str.extract(r"c_(\d+)_um")[0].astype(float)
        if fill == "full":
            ax.plot([0.0, *r], [1.0, *of_r["predicted"]], color=look["color"])
        size = 4.0 if fill == "full" else 7.0
        sign: Look = look | {"fillstyle": fill, "markersize": size, "linestyle": "none"}
        curves.draw_points(ax, r, of_r[_SIMULATED], **sign)
    for spacing, fill in _FILLS.items():
        name = f"$l$ = {MICRO * spacing:g} µm"
        ax.plot([], [], "o", color=BLACK, fillstyle=fill, label=name)
    ax.plot([], [], color=GREY, label="theory")
    ax.axhline(0.0, **curves.ZERO)
    ax.set(xlabel="distance along the edge $r$ (µm)", ylabel="correlation $c(r)$ of passages")
    ax.legend(loc="upper right")
