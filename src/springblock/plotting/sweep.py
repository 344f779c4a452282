"""Observables of ensembles against any parameter in which they differ."""

import math
import re
from collections.abc import Sequence
from itertools import cycle, islice
from string import ascii_lowercase
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure

from springblock.analysis.statistics import mean_interval
from springblock.model.numbers import Array
from springblock.model.scene import FIELDS
from springblock.plotting import curves, style
from springblock.plotting.lines import NAMED, SHARE, in_math, units_of
from springblock.plotting.style import MICRO, Look, span

if TYPE_CHECKING:
    from pandas import DataFrame

_CAPTION = (
    "N = {n_blocks}, {runs} realisations of each ensemble. Symbols, slightly offset: means; bars: "
    "95 % t intervals over realisations."
)
_JOINED = (
    "Lines join ensembles that differ only in the quantity on the axis; with another n_p, n_s "
    "changes in proportion. "
)

#: Labels of axes, and factors of their units, of columns of realisations or their differences.
OBSERVABLES = {
    "static_friction": (curves.FRICTION, 1.0),
    "dynamic_friction": ("dynamic friction", 1.0),
    "t_max": (r"$t_\mathrm{max}$ (µs)", MICRO),
    "t_avg": (r"$t_\mathrm{avg}$ (µs)", MICRO),
    "t_first": ("first detachment (µs)", MICRO),
    "prominence": ("prominence (%)", style.PERCENT),
    "t_quiet": ("between load peaks (µs)", MICRO),
    "t_width": ("width of the peak (µs)", MICRO),
    "t_max-t_avg": (curves.LAG, MICRO),
}

_COLORS = (style.BLUE, style.VERMILION, style.GREEN, style.PURPLE, style.BLACK, style.GREY)
_MARKERS = ("o", "s", "^", "D", "v", "P", "X")
_DECADE = 10.0  #: ratio of the largest to the smallest place from which on the axis is logarithmic
_SIGN, _LETTER, _LINE = 12.0, 1.375, 3.6  #: mm, widths and height in the legend


def caption(found: "DataFrame") -> str:
    """Return the caption of lines."""
    runs = span(found.groupby(["line", "place"], observed=True).size())
    told = _CAPTION.format(runs=runs, n_blocks=span(found["n_blocks"]))
    return told if found["tick"].any() else _JOINED + told


@style.journal
def draw(found: "DataFrame", over: str, observables: Sequence[str]) -> Figure:
    """Draw observables of lines over an axis, a panel each."""
    from seaborn import lineplot  # slow to import

    names, places = list(found["line"].cat.categories), np.unique(found["place"])
    is_named = len(names) > 1 or (over != "mask" and bool(found["mask"].iloc[0]))
    longest = max(len(re.sub(r"[${}_]", "", name)) for name in names)
    columns = max(1, int(style.COLUMN / (_SIGN + _LETTER * longest)))
    legend = is_named * _LINE * math.ceil(len(names) / columns)
    size = style.COLUMN, 15.0 + legend + 43.0 * len(observables)
    letters = ";".join(ascii_lowercase[: len(observables)])
    picture, panels = style.panels(*size, letters, sharex=True)
    scale = "log" if over not in NAMED and 0.0 < _DECADE * places[0] <= places[-1] else "linear"
    axis, ticks = _axis(over, found), found.groupby("place")["tick"].first().tolist()
    ticks = ticks if any(ticks) else []
    found = found.assign(**{axis: _aside(found, places, scale)})
    look: Look = {"hue": "line", "style": "line", "dashes": False, "err_style": "bars"}
    look |= {"errorbar": lambda sample: mean_interval(sample)[1:], "err_kws": {"elinewidth": 0.8}}
    look |= {"linewidth": 0.0 if ticks else 0.7, "markersize": 4.0, "markeredgewidth": 0.0}
    for name, values in (("palette", _COLORS), ("markers", _MARKERS)):
        look[name] = list(islice(cycle(values), len(names)))
    for ax, name in zip(panels, observables, strict=True):
        label, factor = OBSERVABLES[name]
        observed: Any = found.eval(name)
        if label == curves.LAG:
            ax.axhline(0.0, **curves.ZERO)
        lineplot(found.assign(**{label: factor * observed}), x=axis, y=label, **look, ax=ax)
        ax.legend().remove()
        if ticks:
            curves.name_categories(ax, ticks)
        else:
            curves.name_places(ax, places, scale)
    if is_named:
        style.legend_above(picture, panels[0], loc="outside upper left", ncols=columns)
    return picture


def _aside(found: "DataFrame", places: Array, scale: str) -> Array:
    """Return places that are offset, so that bars of several lines do not overlap.

    Lines stand 3 % of the axis apart, or less where those of neighbouring places would meet.
    """
    even, back = (np.log, np.exp) if scale == "log" else (np.array, np.array)
    count = len(found["line"].cat.categories)
    apart = min(0.03 * np.ptp(even(places)), *(0.7 / count * np.diff(even(places))))
    rank = found["line"].cat.codes - 0.5 * (count - 1)
    return back(even(found["place"]) + apart * rank)


def _axis(over: str, found: "DataFrame") -> str:
    """Return the name and unit of an axis, as in the tables."""
    is_named = over in FIELDS or over == SHARE  # others are constants of laws from files
    shown = in_math(over.replace("n_blocks", "N")) if is_named else over
    own = {"direction": "degrees"} | dict.fromkeys((SHARE, *NAMED), "")
    unit = (units_of(found["law"]) | own).get(over, "blocks")
    return shown + (f" ({unit})" if unit else "")
