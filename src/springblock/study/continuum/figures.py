"""Figure of the continuum limit: friction of unit cells, theory and simulation."""

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from springblock.plotting import style
from springblock.plotting.curves import FRICTION
from springblock.plotting.style import BLACK, BLUE, GREEN, VERMILION, Look
from springblock.theory.layer import KAPPA, MU_D, best_widths, stripe

_MARKERS = {"across": "o", "along": "s", "square": "D"}
_COLORS = (GREEN, BLUE, BLACK, VERMILION)
#: Widths over the decay length of the lines of stripes.
_WIDTHS = np.geomspace(1.0, 16.0, 31)


def continuum_friction(table: pd.DataFrame) -> Figure:
    """Draw friction a) of stripes and b) of squares over their width, by kappa; c) best widths."""
    drawn = table[table["what"].str.match("d_c|l_z")]
    picture, (stripes, squares, best) = style.panels(style.DOUBLE, 78.0, "abc")
    by_kappa = drawn.groupby(drawn["kappa"].round(3))
    for (kappa, cells), color in zip(by_kappa, _COLORS[: by_kappa.ngroups], strict=True):
        look: Look = {"color": color, "label": rf"$\kappa$ = {kappa:.2f}"}
        narrow, square = cells[cells["shape"] != "square"], cells[cells["shape"] == "square"]
        if len(narrow):
            stripes.plot(_WIDTHS, _theory(narrow.iloc[0]), **look)
            _draw_points(stripes, narrow, narrow["width"] / narrow["decay"], color)
        if len(square):
            sizes = square["width"] / square["thickness"]
            line = square.groupby(sizes.round(6))["predicted"].mean()
            squares.plot(line.index, line, **look)
            _draw_points(squares, square, sizes, color)
    stripes.set(xlabel=r"width of stripes $a/\lambda$", ylabel=FRICTION, ylim=(None, 1.05))
    squares.set(xlabel="width of squares $a/l_z$", ylabel=FRICTION, ylim=(None, 1.05))
    for shape, words in (("across", "across"), ("along", "along sliding")):
        stripes.plot([], [], _MARKERS[shape], color=BLACK, label=words)
    by_mu_d = style.shades(MU_D)
    for mu_d, widths in zip(MU_D, best_widths(), strict=True):
        best.plot(KAPPA, widths, color=by_mu_d[mu_d], label=rf"$\mu_d$ = {mu_d:g}")
    best.set(xlabel=r"$\kappa$", ylabel=r"best width of stripes $a^*/\lambda$", xscale="log")
    for ax in (stripes, squares, best):
        ax.legend(loc="upper right", ncols=1 if ax is best else 2)
    return picture


def _theory(cell: pd.Series) -> list[float]:
    drop = cell["mu_static"] - cell["mu_dynamic"]
    residual = cell["mu_dynamic"] / drop
    excess = (stripe(a, a, residual, cell["kappa"]).excess for a in _WIDTHS)
    return [cell["mu_dynamic"] + drop * each for each in excess]


def _draw_points(ax: Axes, cells: pd.DataFrame, places: pd.Series, color: str) -> None:
    """Draw the simulation: open symbols for layers other than the paper's."""
    usual = np.isclose(cells["thickness"], 1e-5)
    for shape, marker in _MARKERS.items():
        for fill, chosen, size in (("full", usual, 3.0), ("none", ~usual, 6.0)):
            part = cells[chosen & (cells["shape"] == shape)]
            look: Look = {"color": color, "marker": marker, "linestyle": "none", "markersize": size}
            ax.plot(places[part.index], part["simulated"], fillstyle=fill, **look)
