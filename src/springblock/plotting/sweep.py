"""Observables of ensembles against any parameter in which they differ."""

import math
import re
from collections.abc import Callable, Mapping, Sequence
from string import ascii_lowercase
from typing import Any, TypeVar

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from springblock.io.rows import Row
from springblock.io.schemas import SCENE, SETUP
from springblock.model.material import law_units
from springblock.model.scene import Scene
from springblock.plotting import curves, style
from springblock.plotting.caption import sample_in_words
from springblock.plotting.lines import Lines, in_math
from springblock.plotting.style import BLACK, BLUE, GREEN, GREY, MICRO, PURPLE, VERMILION, Look

T = TypeVar("T")

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
#: Observables that form two clusters of realisations where runs have two load peaks.
_CLUSTERED = ("t_max", "t_max-t_avg")
_SIGN, _LETTER, _LINE = 12.0, 1.375, 3.6  #: mm, widths and height in the legend
_WIDTHS = (style.COLUMN, style.ONE_AND_A_HALF, style.DOUBLE)  #: mm, by the number of directions


def caption(found: Lines) -> str:
    """Return the caption of lines: observables, surfaces, seeds and marks."""
    seeds: dict[Scene, list[int]] = {}
    for row in drawn(found):
        seeds.setdefault(Scene.from_row(row), []).append(row["seed"])
    sample = {scene: range(min(some), max(some) + 1) for scene, some in seeds.items()}
    return (
        "Observables of ensembles; lines join ensembles that differ in no other parameter. "
        f"{sample_in_words(sample)} Symbols, slightly offset: means; bars: 95 % t intervals over "
        "realisations. For t_max and t_max - t_avg, dots: realisations; dashes: medians."
    )


def drawn(found: Lines) -> list[Row]:
    """Return all rows of lines."""
    return [row for line in found.values() for runs in line.values() for row in runs]


@style.journal
def draw(found: Lines, over: str, observables: Sequence[str]) -> Figure:
    """Draw observables of lines over an axis: a row of panels each, a column for each direction."""
    names = list(dict.fromkeys(line.name for line in found))
    directions = list(dict.fromkeys(line.direction for line in found))
    is_named = len(names) > 1 or bool(drawn(found)[0]["mask"])
    longest = max(len(re.sub(r"[${}_]", "", name)) for name in names)
    columns = max(1, int(_WIDTHS[len(directions) - 1] / (_SIGN + _LETTER * longest)))
    room = 15.0 + is_named * _LINE * math.ceil(len(names) / columns)
    picture, grid = _panels(observables, directions, room)
    every = sorted({place for places in found.values() for place in places})
    log = 0.0 < _DECADE * every[0] <= every[-1]
    cap = 0.4 * _apart(every, len(names), log) * curves.span(grid[0, 0])
    for line, runs in found.items():
        i, column = names.index(line.name), grid[:, directions.index(line.direction)]
        moved = _aside(runs, every, i, len(names), log)
        look: Look = {"marker": _MARKERS[i % len(_MARKERS)], "label": line.name}
        look |= {"capsize": min(cap, curves.BAR["capsize"])}
        for ax, observable in zip(column, observables, strict=True):
            _draw_line(ax, observable, moved, _COLORS[i % len(_COLORS)], look)
    for ax in grid.flat:
        curves.name_places(ax, every, "log" if log else "linear")
    for ax in grid[-1]:
        ax.set_xlabel(_axis(over, drawn(found)[0]))
    if is_named:
        style.legend_above(picture, *grid[0], loc="outside upper left", ncols=columns)
    return picture


def _apart(every: Sequence[float], lines: int, log: bool) -> float:
    """Return how far lines stand apart at one place, as a share of the axis.

    That is 3 %, or less where lines of neighbouring places would meet.
    """
    even = np.unique(np.log(every) if log else every)
    gaps = np.diff(even) / np.ptp(even)
    return float(min([0.03, *(0.7 * gaps / lines)]))


def _aside(
    runs: Mapping[float, T], every: Sequence[float], line: int, lines: int, log: bool
) -> dict[float, T]:
    """Offset the runs of one of several lines, so that their bars do not overlap.

    The offset is a share of the axis, logarithmic or linear, through `every` place.
    """
    low, high = min(every), max(every)
    share = _apart(every, lines, log) * (line - 0.5 * (lines - 1))
    if log:
        return {x * (high / low) ** share: of_place for x, of_place in runs.items()}
    return {x + share * (high - low): of_place for x, of_place in runs.items()}


def _panels(
    observables: Sequence[str], directions: Sequence[str], room: float
) -> tuple[Figure, NDArray[Any]]:
    """Return a panel for each observable and direction, (rows, columns), with equal axes in a row.

    There are `room` mm around them.
    """
    shape = len(observables), len(directions)
    letters = ascii_lowercase[: math.prod(shape)]
    rows = (letters[i : i + shape[1]] for i in range(0, len(letters), shape[1]))
    size = _WIDTHS[shape[1] - 1], room + 43.0 * shape[0]
    picture, panels = style.panels(*size, ";".join(rows), sharex=True)
    grid = np.reshape(np.array(panels), shape)
    for row, observable in zip(grid, observables, strict=True):
        for ax in row[1:]:
            ax.sharey(row[0])
            ax.tick_params(labelleft=False)
        row[0].set_ylabel(OBSERVABLES[observable][0])
        if OBSERVABLES[observable][0] == curves.LAG:
            for ax in row:
                ax.axhline(0.0, **curves.ZERO)
    for ax, direction in zip(grid[0], directions, strict=True):
        if direction:
            at = f"along {direction}" if direction in ("x", "y") else f"at {direction}° from x"
            ax.set_title(f"sliding {at}", loc="right")
    return picture, grid


def _draw_line(
    ax: Axes, observable: str, runs: Mapping[float, Sequence[Row]], color: str, look: Look
) -> None:
    """Draw an observable of one line by place."""
    _, value = OBSERVABLES[observable]
    samples = {place: np.array([value(row) for row in rows]) for place, rows in runs.items()}
    if observable in _CLUSTERED:
        joined: Look = {"linestyle": "-", "linewidth": 0.7, "label": look["label"]}
        curves.draw_realisations(ax, samples, color, **joined)
    else:
        curves.draw_means(ax, samples, color, **look)


def _axis(over: str, row: Row) -> str:
    """Return the name and unit of an axis, as in the tables."""
    units = {field.name: field.metadata[b"unit"].decode() for field in (*SCENE, *SETUP)}
    units |= {"direction": "degrees"}
    of_law = law_units(row)
    shown = "N" if over == "n_blocks" else in_math(over)
    name, unit = (over, of_law[over]) if over in of_law else (shown, units[over])
    return name + ("" if unit in ("", "1") else f" ({unit})")
