"""Figure 7: correlation of detachment times along the sides of pillars (section 3.2)."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from springblock.analysis.statistics import Interval
from springblock.plotting import style
from springblock.plotting.curves import draw_band
from springblock.plotting.declaration import (
    CORRELATION_INTERVALS,
    CorrelationsSource,
    Declaration,
)
from springblock.plotting.points import draw_points, name_places
from springblock.plotting.style import BLUE, GREY, VERMILION, Look, journal

if TYPE_CHECKING:  # read by the command, and only then
    import pandas as pd

FIGURE = Declaration(
    title="Correlation of detachments on pillars",
    category="Figures",
    caption=f"""Correlation of first detachment times along the sides of a pillar, from the middle
    of the side, sliding along x: c_x on sides along x, c_y on sides along y. Solid: exp(-r/l_c),
    which is 1 at r = 0, dotted beyond the range of the fit; dashed: A exp(-r/l_c) with A free, over
    that range, where it has three distances or more. Inset: l_c of c_x over the size of the
    pillars; open: with A free. Means over all pillars and realisations; bands and bars are
    {CORRELATION_INTERVALS}. Figure 7 of the paper; fits with A free are an addition.""",
    source=CorrelationsSource(groups=("pillars",)),
)

#: Colour and marker of the sides along each axis.
_SIDES = {"x": (BLUE, "D"), "y": (VERMILION, "s")}
_EXPONENTIAL = r"$\exp(-r/l_c)$"
_FREE = r"$A\,$" + _EXPONENTIAL
_DASHED: Look = {"linestyle": (0, (3.5, 1.2)), "linewidth": 0.9}  #: with A free


@journal
def draw(correlation: "pd.DataFrame", lengths: "pd.DataFrame") -> Figure:
    """Draw c_x(r) and c_y(r) of one scene with their fits, and l_c over n_p in an inset.

    `correlation` and `lengths` are tables of the schemas CORRELATION, of one scene, and
    CORRELATION_LENGTH, of one scene for each n_p, that of `correlation` among them.

    Raises
    ------
    ValueError
        Where several scenes in `lengths` have the same n_p, or none that of `correlation`.
    """
    if lengths.duplicated(["n_p", "side"]).any():
        raise ValueError("several scenes have the same n_p, which the inset cannot tell apart")
    n_p = correlation["n_p"].iloc[0]
    shown = lengths[lengths["n_p"] == n_p].set_index("side")
    if shown.empty:
        raise ValueError(f"there is no correlation length for n_p = {n_p}")
    picture, (ax,) = style.panels(style.COLUMN, 78.0)
    for side, curve in correlation.groupby("side"):
        _draw_side(ax, str(side), curve, shown.loc[side])
    ax.plot([], [], color=GREY, label=_EXPONENTIAL)
    ax.plot([], [], color=GREY, label=_FREE, **_DASHED)
    ax.axhline(0.0, color=GREY, linewidth=0.5, zorder=0)
    ax.set(xlabel="distance along the side $r$ (blocks)", ylabel="time correlation $c(r)$")
    ax.set_ylim(None, 1.04)
    ax.margins(x=0.02)
    ax.xaxis.set_major_locator(MaxNLocator(integer=True, steps=[1, 2, 5, 10]))
    ax.legend(loc="upper left", bbox_to_anchor=(0.06, 1.0), title=f"$n_p$ = {n_p}")
    _draw_lengths(ax.inset_axes((0.475, 0.47, 0.5, 0.5)), lengths[lengths["side"] == "x"])
    return picture


def _draw_side(ax: Axes, side: str, curve: "pd.DataFrame", length: "pd.Series") -> None:
    """Points and band of c(r) and the fitted exponential, dotted beyond what it was fitted to."""
    color, marker = _SIDES[side]
    values = Interval(*curve[["correlation", "ci_low", "ci_high"]].to_numpy().T)
    look: Look = {"marker": marker, "linestyle": "none", "label": f"$c_{side}(r)$"}
    draw_band(ax, curve["r"], values, color, **look)
    last, end = length["r_last"], curve["r"].max()
    for r, line in ((np.linspace(0.0, last), "-"), (np.linspace(last, end), ":")):
        ax.plot(r, np.exp(-r / length["l_c"]), color=color, linestyle=line)
    if np.isfinite(length["tail"]):
        r = np.linspace(1.0, last)
        ax.plot(r, amplitude(curve, length) * np.exp(-r / length["tail"]), color=color, **_DASHED)


def amplitude(curve: "pd.DataFrame", length: "pd.Series") -> float:
    """The A of A exp(-r/l_c) that goes with the length of the table: by least squares, linear.

    Weights are those of the fit, 1/error²; errors are in proportion to the intervals.
    """
    fitted = curve[(curve["r"] >= 1) & (curve["r"] <= length["r_last"])]
    decay = np.exp(-fitted["r"] / length["tail"])
    weight = (fitted["ci_high"] - fitted["ci_low"]) ** -2.0
    return float((weight * decay * fitted["correlation"]).sum() / (weight * decay**2).sum())


def _draw_lengths(ax: Axes, lengths: "pd.DataFrame") -> None:
    """Draw l_c of c_x over n_p on a logarithmic axis; open points have a free amplitude."""
    color, marker = _SIDES["x"]
    look = {"color": color, "marker": marker, "linestyle": "none"}
    for (name, low, high), face, aside, label in (
        (("l_c", "ci_low", "ci_high"), color, 0.96, _EXPONENTIAL),
        (("tail", "tail_low", "tail_high"), "white", 1.04, _FREE),
    ):
        places, intervals = aside * lengths["n_p"], lengths[[name, low, high]]
        draw_points(ax, places, intervals, markerfacecolor=face, label=label, **look)
    name_places(ax, lengths["n_p"])
    ax.set_ylim(0.0, 2.2 * lengths["ci_high"].max())  # room for the legend
    ax.set_xlabel("$n_p$ (blocks)", fontsize=style.SMALL, labelpad=1.0)
    ax.set_ylabel("$l_c$ of $c_x$ (blocks)", fontsize=style.SMALL)
    ax.legend(loc="upper left", borderaxespad=0.2, handletextpad=0.2, labelspacing=0.3)
