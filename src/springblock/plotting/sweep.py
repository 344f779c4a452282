"""Observables of ensembles against any parameter in which they differ."""

import math
import re
from collections.abc import Callable, Sequence
from string import ascii_lowercase

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from springblock.io.rows import Row
from springblock.model.scene import FIELDS
from springblock.plotting import curves, style
from springblock.plotting.lines import Lines, Places, in_math, units_of
from springblock.plotting.style import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    MICRO,
    PURPLE,
    VERMILION,
    Look,
    span,
)

_CAPTION = (
    "Lines join ensembles that differ only in the quantity on the axis; with another n_p, n_s "
    "changes in proportion. N = {n_blocks}, {runs} realisations of each ensemble. Symbols, "
    "slightly offset: means; bars: 95 % t intervals over realisations."
)

#: What is drawn of each realisation: the label of its axis, and its value there.
OBSERVABLES: dict[str, tuple[str, Callable[[Row], float]]] = {
    "static_friction": (curves.FRICTION, lambda row: row["static_friction"]),
    "dynamic_friction": ("dynamic friction", lambda row: row["dynamic_friction"]),
    "t_max": (r"$t_\mathrm{max}$ (µs)", lambda row: MICRO * row["t_max"]),
    "t_avg": (r"$t_\mathrm{avg}$ (µs)", lambda row: MICRO * row["t_avg"]),
    "t_first": ("first detachment (µs)", lambda row: MICRO * row["t_first"]),
    "t_max-t_avg": (curves.LAG, lambda row: MICRO * (row["t_max"] - row["t_avg"])),
}

_COLORS = (BLUE, VERMILION, GREEN, PURPLE, BLACK, GREY)
_MARKERS = ("o", "s", "^", "D", "v", "P", "X")
_DECADE = 10.0  #: ratio of the largest to the smallest place from which on the axis is logarithmic
_SIGN, _LETTER, _LINE = 12.0, 1.375, 3.6  #: mm, widths and height in the legend


def caption(found: Lines) -> str:
    """Return the caption of lines."""
    runs = span(len(rows) for line in found.values() for rows in line.values())
    return _CAPTION.format(runs=runs, n_blocks=span(row["n_blocks"] for row in drawn(found)))


def drawn(found: Lines) -> list[Row]:
    """Return all rows of lines."""
    return [row for line in found.values() for runs in line.values() for row in runs]


@style.journal
def draw(found: Lines, over: str, observables: Sequence[str]) -> Figure:
    """Draw observables of lines over an axis, a panel each."""
    is_named = len(found) > 1 or bool(drawn(found)[0]["mask"])
    longest = max(len(re.sub(r"[${}_]", "", name)) for name in found)
    columns = max(1, int(style.COLUMN / (_SIGN + _LETTER * longest)))
    legend = is_named * _LINE * math.ceil(len(found) / columns)
    size = style.COLUMN, 15.0 + legend + 43.0 * len(observables)
    letters = ";".join(ascii_lowercase[: len(observables)])
    picture, panels = style.panels(*size, letters, sharex=True)
    every = sorted({place for places in found.values() for place in places})
    log = 0.0 < _DECADE * every[0] <= every[-1]
    cap = 0.4 * _apart(every, len(found), log) * curves.span(panels[0])
    for ax, observable in zip(panels, observables, strict=True):
        ax.set_ylabel(OBSERVABLES[observable][0])
        if OBSERVABLES[observable][0] == curves.LAG:
            ax.axhline(0.0, **curves.ZERO)
        for i, (name, runs) in enumerate(found.items()):
            look: Look = {"marker": _MARKERS[i % len(_MARKERS)], "label": name}
            look |= {"capsize": min(cap, curves.BAR["capsize"])}
            moved = _aside(runs, every, i, len(found), log)
            _draw_line(ax, observable, moved, _COLORS[i % len(_COLORS)], look)
        curves.name_places(ax, every, "log" if log else "linear")
    panels[-1].set_xlabel(_axis(over, drawn(found)))
    if is_named:
        style.legend_above(picture, panels[0], loc="outside upper left", ncols=columns)
    return picture


def _apart(every: Sequence[float], lines: int, log: bool) -> float:
    """Return how far lines stand apart at one place, as a share of the axis.

    That is 3 %, or less where lines of neighbouring places would meet.
    """
    even = np.unique(np.log(every) if log else every)
    gaps = np.diff(even) / np.ptp(even)
    return float(min([0.03, *(0.7 * gaps / lines)]))


def _aside(runs: Places, every: Sequence[float], line: int, lines: int, log: bool) -> Places:
    """Offset the runs of one of several lines, so that their bars do not overlap.

    The offset is a share of the axis, logarithmic or linear, through `every` place.
    """
    low, high = min(every), max(every)
    share = _apart(every, lines, log) * (line - 0.5 * (lines - 1))
    if log:
        return {x * (high / low) ** share: of_place for x, of_place in runs.items()}
    return {x + share * (high - low): of_place for x, of_place in runs.items()}


def _draw_line(ax: Axes, observable: str, runs: Places, color: str, look: Look) -> None:
    """Draw an observable of one line by place."""
    _, value = OBSERVABLES[observable]
    samples = {place: [value(row) for row in rows] for place, rows in runs.items()}
    curves.draw_means(ax, samples, color, **look)


def _axis(over: str, rows: list[Row]) -> str:
    """Return the name and unit of an axis, as in the tables."""
    shown = in_math(over.replace("n_blocks", "N")) if over in FIELDS else over
    unit = (units_of(rows) | {"direction": "degrees"}).get(over, "blocks")
    return shown + (f" ({unit})" if unit else "")
