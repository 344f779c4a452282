"""Axes and lines of sweeps: scenes that differ in one parameter, and the names of their lines.

This module loads neither matplotlib nor pandas: every start of the workflow reads it.
"""

import math
import re
from collections import Counter
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from springblock.io.rows import Row, scene_of
from springblock.model.direction import degrees
from springblock.model.law import LawFile
from springblock.model.material import LAWS, as_law
from springblock.model.scene import (
    AXES,
    CONSTANTS,
    FIELDS,
    GEOMETRY,
    LENGTHS,
    OF_LAWS,
    Scene,
    constants_of,
    differing,
)

if TYPE_CHECKING:
    from pandas import DataFrame

_DIGEST = re.compile(r"-[0-9a-f]{8}$")  #: at the end of the name of a mask

SHARE = "contact_fraction"  #: axis that is no field of a scene
NAMED = ("law", "mask", "texture")  #: axes with a name at each place
#: Of surfaces, which differ with the mask, the texture or the share of blocks in contact.
_BLOCKS = ("mask", "n_blocks", "n_rows", *LENGTHS)
_SIZES = (*_BLOCKS, "feature", "pitch", "width")
Names = tuple[tuple[str, str], ...]


def axes(scenes: Iterable[Scene]) -> list[str]:
    """Return the axes, by name, on which two scenes differ that are otherwise the same."""
    every = list(dict.fromkeys(scenes))
    apart = [name for name in differing(scene.values for scene in every) if _is_axis(name)]
    return [over for over in apart if len({_others(s, over) for s in every}) < len(every)]


def _is_axis(name: str) -> bool:
    return name in (*AXES, *NAMED) or name not in FIELDS  # of a law from a file


def lines(rows: Iterable[Row], over: str) -> "DataFrame":
    """Return rows of the table `realisations` with their `place` on an axis, and their `line`.

    Places of an axis of names are numbered; `tick` names each.

    A line is named by its mask and by what differs from other lines. Lines with one place are left
    out, unless all are such. A ModuleNotFoundError says if seaborn, which draws them, is missing.
    """
    try:
        import pandas as pd
        import seaborn  # noqa: F401
    except ModuleNotFoundError:
        raise ModuleNotFoundError("sweeps are drawn by seaborn: pip install seaborn") from None
    runs = list(rows)
    scenes = [scene_of(row) for row in runs]
    told: dict[str, Any] = {
        "value": [_value(scene, row, over) for scene, row in zip(scenes, runs, strict=True)],
        "line": [_others(scene, over) for scene in scenes],
        "surface": [_others(scene, "") for scene in scenes],
    }
    every = pd.DataFrame(runs).assign(**told).dropna(subset="value")
    if every.empty:
        varying = ", ".join([*axes(scenes)[:3], SHARE])
        raise ValueError(f"unknown axis {over!r}; choose for instance {varying}")
    ticks = _ticks(every["value"]) if over in NAMED else {}
    every["tick"] = every["value"].map(ticks) if ticks else ""
    every["place"] = every["value"].map([*ticks].index if ticks else _place)
    mixed = every[every.groupby(["line", "place"])["surface"].transform("nunique") > 1]
    if over == SHARE and len(mixed):
        place = mixed["place"].iloc[0]
        raise ValueError(f"{SHARE} = {place:.4g} in different surfaces; choose another axis")
    if every["place"].nunique() < 2:
        raise ValueError(f"{over} has the same value in all realisations; choose another axis")
    several = every.groupby("line")["place"].transform("nunique") > 1
    found = every[several] if several.any() else every
    if over in NAMED:  # without places of which no line is left
        found = found.assign(place=found["place"].rank(method="dense").astype(int) - 1)
    ordered = sorted({*found["line"]}, key=lambda names: [_by_size(*each) for each in names])
    titles = dict(zip(ordered, _named(ordered, units_of(every["law"])), strict=True))
    return found.assign(line=pd.Categorical(found["line"].map(titles), [*titles.values()]))


def units_of(laws: Iterable[str]) -> dict[str, str]:
    """Return the units of constants, also of these laws, by name; "" without one."""
    own = (*CONSTANTS, "sample_interval", "feature", "pitch", "width")
    units = {name: FIELDS[name].metadata["unit"] for name in own}
    for law in map(as_law, {*laws}):
        units |= law.units if isinstance(law, LawFile) else {}
    return {name: "" if unit == "1" else unit for name, unit in units.items()}


def _named(every: list[Names], units: Mapping[str, str]) -> list[str]:
    """Name each line by its surface and by what is not the same in all of them."""
    common = set.intersection(*map(set, every))
    surfaces = _without_digests(mask for names in every if (mask := dict(names).get("mask")))
    found = []
    for names in map(dict, every):
        hidden = {"level"}
        surface = "flat" if names.get("level") == "0" and ("level", "0") not in common else ""
        if mask := names.get("mask"):
            hidden |= {"mask", "N", "n_rows"}
            surface = surfaces[mask]
        shown = [pair for pair in names.items() if pair not in common and pair[0] not in hidden]
        told = [
            f"{in_math(name)} = {value} {units.get(name, '')}".rstrip() for name, value in shown
        ]
        told = [re.sub(r"^(direction = [^xy]+)$", r"\1°", each) for each in told]
        found.append(", ".join(filter(None, [surface, *told])) or "as the study")
    return found


def _value(scene: Scene, row: Row, over: str) -> str | float | None:
    """Return the value of a run on an axis, None if it has none."""
    if over == SHARE:
        return float(row[SHARE])
    if over == "law":  # with its constants, so that no two laws share a place
        units = units_of([str(row["law"])])
        numbers = [name for name in constants_of(scene.law) if name != "healing"]
        own = [f"{scene.values[name]:g} {units[name]}".strip() for name in numbers]
        return ", ".join([str(scene.law), *own, *([scene.healing] * (scene.healing != "instant"))])
    value = scene.values.get(over) if _is_axis(over) else None
    return None if value == "" else value


def _ticks(values: Iterable[str]) -> dict[str, str]:
    """Return a name for each value of an axis of names, in their order: Coulomb's law first."""

    def order(value: str) -> tuple[bool, list[tuple[float, str]]]:
        words = re.split("[, ]+", value)
        return not value.startswith("coulomb"), [_by_size("", word) for word in words]

    short = _without_digests(sorted({*values}, key=order))
    return {value: name.replace("_", " ") for value, name in short.items()}


def _without_digests(names: Iterable[str]) -> dict[str, str]:
    """Return masks' names without their digests, unless two would have the same."""
    short = {name: _DIGEST.sub("", name) for name in names}
    times = Counter(short.values())
    return {name: stem if times[stem] == 1 else name for name, stem in short.items()}


def _place(value: str | float) -> float:
    return degrees(value) if isinstance(value, str) else float(value)


def _by_size(name: str, value: str) -> tuple[float, str]:
    """Return a key that sorts numbers and directions by size and other texts after them."""
    try:
        return (degrees(value) if name == "direction" else float(value)), ""
    except ValueError:
        return math.inf, value


def _others(scene: Scene, over: str) -> Names:
    """Return what else distinguishes a scene; n_s/n_p for n_s where n_p is on the axis."""
    values: Row = {"level": scene.level, **scene.values}
    follows = {
        SHARE: _SIZES,
        "mask": _SIZES,
        "texture": _BLOCKS,
        "law": (*OF_LAWS, *constants_of(scene.law)),
        **dict.fromkeys(LAWS.values(), ("law",)),  # at zero they are Coulomb's law
    }
    hidden = {"sample_interval", "duration", "snapshot_times", over, *follows.get(over, ())}
    if scene.n_rows == scene.n_blocks:
        hidden.add("n_rows")
    if over == "n_p" and scene.n_p:
        values["n_s/n_p"] = f"{scene.n_s / scene.n_p:.3g}"
        hidden.add("n_s")
    return tuple(
        ("N" if name == "n_blocks" else name, str(value))
        for name, value in values.items()
        if name not in hidden and (value not in (0, "", "free") or name not in GEOMETRY)
    )


def in_math(name: str) -> str:
    """Write lengths with an index, other names in words."""
    printed = re.sub(r"n_(\w+)", r"$n_{\1}$", name)
    return printed if name in ("n_s/n_p", *LENGTHS) else name.replace("_", " ")
