"""Any observable of ensembles against any parameter in which they differ."""

import math
import re
from collections.abc import Callable, Iterable, Sequence
from itertools import cycle

import numpy as np
from matplotlib.figure import Figure

from springblock.io.rows import Row
from springblock.io.schemas import AXES, SCENE, SETUP
from springblock.model.direction import degrees
from springblock.model.material import expanded, law_units
from springblock.model.scene import LENGTHS, Scene
from springblock.plotting import curves, style
from springblock.plotting.caption import sample_in_words
from springblock.plotting.style import BLACK, BLUE, GREEN, GREY, MICRO, PURPLE, VERMILION, Look

Names = tuple[tuple[str, str], ...]
Lines = dict[str, dict[float, list[Row]]]  #: rows by the name of their line and their place

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
_WIDE = 24  #: characters of a line's name from which on names stand below each other
_LINE = 3.6  #: mm, of the legend


def caption(found: Lines) -> str:
    """Return the caption of lines: observables, surfaces, seeds and marks."""
    seeds: dict[Scene, list[int]] = {}
    for row in drawn(found):
        seeds.setdefault(Scene.from_row(row), []).append(row["seed"])
    sample = {scene: range(min(some), max(some) + 1) for scene, some in seeds.items()}
    return (
        "Observables of ensembles; lines join those that differ in no other parameter, slightly "
        f"offset. {sample_in_words(sample)} Symbols: means; bars: 95 % t intervals over "
        "realisations. t_max and t_max - t_avg: dots: realisations; dashes: medians."
    )


def drawn(found: Lines) -> list[Row]:
    """Return all rows of lines."""
    return [row for line in found.values() for runs in line.values() for row in runs]


def lines(rows: Iterable[Row], over: str) -> Lines:
    """Return rows of the table `realisations` by place on an axis, for each line.

    A line is named by the parameters in which it differs from the others. Lines of a single place
    are left out, if there are others.
    """
    rows = list(rows)
    if over not in AXES and not all(over in law_units(row) for row in rows):
        raise ValueError(f"unknown axis {over!r}; choose one of {', '.join(AXES)}")
    found: dict[Names, dict[float, list[Row]]] = {}
    for row in rows:
        found.setdefault(_others(row, over), {}).setdefault(_place(row, over), []).append(row)
    places = {place for line in found.values() for place in line}
    if len(places) < 2:
        raise ValueError(f"{over} has the same value in all realisations; choose another axis")
    swept = {names: line for names, line in found.items() if len(line) > 1} or found
    common = set.intersection(*(set(names) for names in swept))
    ordered = sorted(swept, key=lambda names: [value for _, value in names])
    labelled = {}
    for names in ordered:
        own = [f"{_math(key)} = {value}" for key, value in names if (key, value) not in common]
        labelled[", ".join(own) or "as the study"] = dict(sorted(swept[names].items()))
    return labelled


def _place(row: Row, over: str) -> float:
    return degrees(row[over]) if over == "direction" else float(expanded(row)[over])


def _others(row: Row, over: str) -> Names:
    """Return the other parameters of a scene; n_s over n_p, if n_p varies."""
    scene = Scene.from_row(row)
    named = {"N" if key == "n_blocks" else key: value for key, value in scene.named.items()}
    if over == "n_p" and scene.n_p:
        named["n_s/n_p"] = f"{scene.n_s / scene.n_p:.3g}"
        del named["n_s"]
    named.pop("N" if over == "n_blocks" else over, None)
    if over in ("slip_distance", "speed_scale"):  # at zero they are Coulomb's law
        named.pop("law", None)
    return tuple(named.items())


def _math(name: str) -> str:
    """Write lengths as the paper prints them, other names in words."""
    printed = re.sub(r"n_(\w+)", r"$n_{\1}$", name)
    return printed if name in ("n_s/n_p", *LENGTHS) else name.replace("_", " ")


@style.journal
def draw(found: Lines, over: str, observables: Sequence[str]) -> Figure:
    """Draw observables of lines over an axis, a panel each."""
    columns = 1 if max(map(len, found)) > _WIDE else 2
    names = _LINE * math.ceil(len(found) / columns) if len(found) > 1 else 0.0
    labels = [OBSERVABLES[name][0] for name in observables]
    picture, panels = curves.stacked(_axis(over, drawn(found)[0]), labels, 15.0 + names)
    every = sorted({place for places in found.values() for place in places})
    log = 0.0 < _DECADE * every[0] <= every[-1]
    for ax, name in zip(panels, observables, strict=True):
        _, of = OBSERVABLES[name]
        looks = zip(found.items(), cycle(_COLORS), cycle(_MARKERS), strict=False)
        for i, ((line, runs), color, marker) in enumerate(looks):
            moved = curves.aside(runs, every, i, len(found), log)
            samples = {at: np.array([of(row) for row in rows]) for at, rows in moved.items()}
            if name in _CLUSTERED:
                look: Look = {"linestyle": "-", "linewidth": 0.7}
                curves.draw_realisations(ax, samples, color, label=line, **look)
            else:
                curves.draw_means(ax, samples, color, marker=marker, label=line)
        if log:
            curves.name_places(ax, every)
    if len(found) > 1:
        style.legend_above(picture, panels[0], loc="outside upper left", ncols=columns)
    return picture


def _axis(over: str, row: Row) -> str:
    """Return the name and unit of an axis, as in the tables."""
    units = {field.name: field.metadata[b"unit"].decode() for field in (*SCENE, *SETUP)}
    units |= {"direction": "degrees"}
    of_law = law_units(row)
    name, unit = (over, of_law[over]) if over in of_law else (_math(over), units[over])
    return name + ("" if unit in ("", "1") else f" ({unit})")
