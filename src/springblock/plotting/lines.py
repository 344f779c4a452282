"""Axes and lines of sweeps: scenes that differ in one parameter, and the names of their lines.

This module loads no matplotlib: every start of the workflow reads it.
"""

import math
import re
from collections import Counter
from collections.abc import Iterable, Mapping

from springblock.io.rows import Row
from springblock.io.schemas import AXES, SETUP, said
from springblock.model.direction import degrees
from springblock.model.material import LAWS, expanded, law_units
from springblock.model.scene import LENGTHS, TEXTS, Scene

_DIGEST = re.compile(r"-[0-9a-f]{8}$")  #: at the end of the name of a mask


Names = tuple[tuple[str, str], ...]
Places = dict[float, list[Row]]  #: rows by their place on the axis
Lines = dict[str, Places]  #: by name


def axes(scenes: Iterable[Scene]) -> list[str]:
    """Return the numbers, by name, in which two scenes differ that are otherwise the same."""
    every = list(dict.fromkeys(scenes))
    names = dict.fromkeys(name for scene in every for name in scene.named)
    constants = {name for scene in every for name, _ in scene.varied} - set(TEXTS)
    numbers = [name for name in names if name in constants.union(AXES)]
    return [over for over in numbers if len({_others(s, over) for s in every}) < len(every)]


def lines(rows: Iterable[Row], over: str) -> Lines:
    """Return rows of the table `realisations` by place on an axis, for each line.

    A line is named by its mask and by what differs from other lines. Lines with
    one place are left out, unless all are such.
    """
    rows = [row for row in rows if over in AXES or over in law_units(row)]
    if not rows:
        raise ValueError(f"unknown axis {over!r}; choose one of {', '.join(AXES)}")
    found: dict[Names, Places] = {}
    scenes = [Scene.from_row(row) for row in rows]
    varied = {name for scene in scenes for name, _ in scene.varied}
    for scene, row in zip(scenes, rows, strict=True):
        known = {name: str(value) for name, value in expanded(row).items() if name in varied}
        names = _others(scene, over, known)
        found.setdefault(names, {}).setdefault(_place(row, over), []).append(row)
    places = {place for line in found.values() for place in line}
    if len(places) < 2:
        raise ValueError(f"{over} has the same value in all realisations; choose another axis")
    swept = {names: line for names, line in found.items() if len(line) > 1} or found
    ordered = sorted(swept, key=lambda names: [_by_size(value) for _, value in names])
    return {
        name: dict(sorted(swept[names].items()))
        for names, name in zip(ordered, _named(ordered, units_of(rows)), strict=True)
    }


def units_of(rows: Iterable[Row]) -> dict[str, str]:
    """Return the units of the constants of a setup, and of laws, by name; "" without one."""
    units = {field.name: said(field)[0] for field in SETUP}
    for law in {row["law"] for row in rows}:
        units |= law_units({"law": law})
    return {name: "" if unit == "1" else unit for name, unit in units.items()}


def _named(every: list[Names], units: Mapping[str, str]) -> list[str]:
    """Name each line by its surface and by what is not the same in all of them."""
    common = set.intersection(*map(set, every))
    masks = {mask for names in every if (mask := dict(names).get("mask"))}
    stems = Counter(_DIGEST.sub("", mask) for mask in masks)
    found = []
    for names in map(dict, every):
        hidden = {"level"}
        surface = "flat" if names.get("level") == "0" and ("level", "0") not in common else ""
        if mask := names.get("mask"):
            hidden |= {"mask", "N", "n_rows"}
            stem = _DIGEST.sub("", mask)
            surface = stem if stems[stem] == 1 else mask
        own = dict(names.items() - common)
        shown = [name for name in names if name in own.keys() - hidden]
        told = [f"{in_math(name)} = {own[name]} {units.get(name, '')}".rstrip() for name in shown]
        found.append(", ".join(filter(None, [surface, *told])) or "as the study")
    return found


def _place(row: Row, over: str) -> float:
    return degrees(row[over]) if over == "direction" else float(expanded(row)[over])


def _by_size(value: str) -> tuple[float, str]:
    """Return a key that sorts numbers by size and other texts after them."""
    try:
        return float(value), ""
    except ValueError:
        return math.inf, value


def _others(scene: Scene, over: str, constants: Mapping[str, str] | None = None) -> Names:
    """Return what else distinguishes a scene; n_s/n_p for n_s where n_p is on the axis.

    `constants` are those of the material that other scenes vary.
    """
    own = {"N" if key == "n_blocks" else key: value for key, value in scene.named.items()}
    varied = {key: own.pop(key, value) for key, value in (constants or {}).items()}
    named = own | varied  # in one order, whichever constants are the scene's own
    if over == "n_p" and scene.n_p:
        named["n_s/n_p"] = f"{scene.n_s / scene.n_p:.3g}"
        del named["n_s"]
    named.pop("N" if over == "n_blocks" else over, None)
    if over in LAWS.values():  # at zero they are Coulomb's law
        named.pop("law", None)
    return tuple(named.items())


def in_math(name: str) -> str:
    """Write lengths with an index, other names in words."""
    printed = re.sub(r"n_(\w+)", r"$n_{\1}$", name)
    return printed if name in ("n_s/n_p", *LENGTHS) else name.replace("_", " ")
