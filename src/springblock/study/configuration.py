"""Configuration of a study: checks, and expansion into scenes and batches of seeds."""

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import fields
from functools import cache
from itertools import chain
from pathlib import Path
from typing import Any

import jsonschema
import yaml

from springblock.model.asperities import check_draws
from springblock.model.blockmap import BlockMap, Cut
from springblock.model.material import Material
from springblock.model.scene import (
    AXES,
    FIELDS,
    GEOMETRY,
    OF_LAWS,
    Scene,
    expand,
    listed,
    scene_of,
)
from springblock.model.surface import Surface
from springblock.simulation.scenes import setup_of

Configuration = Mapping[str, Any]

#: Keys of all scenes, besides those of `material`.
TIMES = ("integrator", "step", "sample_interval")
#: Keys that cut a mask from a topography, besides its file.
_OF_CUT = ("bearing_area", "height", "channel", "detrend", "size", "unit")
#: PyYAML's reader in C is ten times as fast, where it is installed.
LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
#: A decimal number, as text.
_NUMBER = re.compile(r"[-+]?(?!0[0-9])([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?")
#: Words of YAML and their values.
_YAML_WORDS = {"true": True, "false": False, "null": None}
#: Groups of the paper's figures, with the level of their scenes.
_LEVELS = {"flat": 0, "pillars": 1, "grooves": 2, "other_grooves": 2}
#: Validator for which 24.0 is not an integer, as in Python.
_Validator = jsonschema.validators.extend(
    jsonschema.Draft202012Validator, type_checker=jsonschema.Draft4Validator.TYPE_CHECKER
)
#: Largest number of scenes: a minute until the first job.
_MOST_SCENES = 20_000
#: Least number of realisations for the interval of a correlation.
_CORRELATED = 3


Seeds = dict[Scene, int]  #: numbers of seeds of scenes


def refuse_repeated_keys(file: Path) -> None:
    """Refuse a YAML file in which a key stands twice, of which YAML would keep the last."""
    nodes = [yaml.compose(file.read_bytes(), LOADER)]
    for node in nodes:  # which grows
        parts = node.value if isinstance(node, yaml.CollectionNode) else []
        if isinstance(node, yaml.MappingNode):
            known: dict[str, yaml.Node] = {}
            for key, _ in parts:
                if known.setdefault(str(key.value), key) is not key:
                    line = f"{file}, line {key.start_mark.line + 1}"
                    raise ValueError(f"{line}: key {key.value!r} is repeated; rename or remove it")
            parts = [value for _, value in parts]
        nodes += [each for each in parts if each not in nodes]


def completed(configuration: Configuration) -> dict[str, Any]:
    """Convert numbers given as text, and append the entries of `add` to the lists they extend.

    Keys `x-...`, which hold anchors for other keys, are left out. YAML reads 1e-3, without a
    decimal point, as text, and so does Snakemake with nested values of `--config`.
    """
    keys = [key for key in configuration if not str(key).startswith("x-")]
    whole = {key: _with_numbers(configuration[key], key) for key in keys}
    added = whole.pop("add", None) or {}
    if not isinstance(added, dict):
        raise ValueError(f"add must hold keys of the configuration, not {added!r}")
    return _continued(whole, added)


def _with_numbers(value: Any, key: str = "") -> Any:
    if isinstance(value, dict):
        return {name: _with_numbers(inner) for name, inner in value.items()}
    if isinstance(value, list):
        return [_with_numbers(inner) for inner in value]
    if not isinstance(value, str) or key == "results":
        return value
    if _NUMBER.fullmatch(value):
        return float(value) if set(value) & set(".eE") else int(value)
    return _YAML_WORDS.get(value, value)


def _continued(node: Any, more: Any) -> Any:
    """Merge dictionaries, concatenate lists, and replace other values by new ones."""
    if isinstance(node, dict) and isinstance(more, dict):
        inner = {key: _continued(node.get(key), value) for key, value in more.items()}
        return {**node, **inner}
    return [*node, *more] if isinstance(node, list) and isinstance(more, list) else more


def check(configuration: Configuration, schema: Mapping[str, Any]) -> None:
    """Refuse an invalid configuration, before any computation, by a TypeError or ValueError."""
    error = jsonschema.exceptions.best_match(_Validator(schema).iter_errors(configuration))
    if error is not None:
        raise ValueError(_sentence(error))
    with _named("material"):
        setup_of(scene_of(_usual(configuration)))
    groups = ensembles(configuration)
    if not any(groups.values()):
        raise ValueError("scenes: no scenes are given; add a group, as config/README.md shows")
    for group, members in groups.items():
        for scene, seeds in members.items():
            with _named(f"scenes.{group}"):
                _check_ensemble(scene, seeds)
                if not is_own(configuration):
                    _check_for_figures(scene, seeds, group)
    for name, sweep in configuration["figures"].get("sweeps", {}).items():
        _check_sweep(f"figures.sweeps.{name}", sweep, groups)


@contextmanager
def _named(key: str) -> Iterator[None]:
    """Prefix error messages with the key."""
    try:
        yield
    except ValueError as reason:
        raise ValueError(f"{key}: {reason}") from reason


def _check_sweep(key: str, sweep: Mapping[str, Any], groups: Mapping[str, Seeds]) -> None:
    for group in sweep["groups"]:
        if group not in groups:
            known = ", ".join(groups)
            raise ValueError(f"{key}.groups: unknown group {group!r}; choose from {known}")
    members = chain.from_iterable(groups[group] for group in sweep["groups"])
    own = [name for scene in members for name in scene.values if name not in FIELDS]
    if sweep["over"] not in [*AXES, *own]:
        known = ", ".join(dict.fromkeys([*AXES, *own]))
        raise ValueError(f"{key}.over: unknown axis {sweep['over']!r}; choose one of {known}")


def is_own(configuration: Configuration) -> bool:
    """Whether a study has scenes of one's own alone, without the paper's groups and figures."""
    return configuration.get("study") == "own"


def _check_ensemble(scene: Scene, seeds: int) -> None:
    Surface(scene.contact, 1.0, 1.0, scene.is_periodic)  # refuses invalid ones
    setup = setup_of(scene)
    if scene.is_drawn:
        check_draws(scene.shape, scene.material)
    elif seeds > 1:
        raise ValueError(f"seeds must be 1, since no coefficients are drawn, not {seeds}")
    strongest = scene.mu_static
    known: Any = scene.mu_static_field and scene.mu_static_field.values
    if known is not None:
        strongest = float(known[scene.contact].max())
    for duration in (None, scene.duration or None):  # its prelude and its realisations
        setup.plan(scene.contact, strongest, duration, scene.snapshot_times)


def _check_for_figures(scene: Scene, seeds: int, group: str) -> None:
    """Refuse scenes that the paper's figures and the tables of correlations cannot take."""
    if group in _LEVELS and not scene.is_papers:
        raise ValueError(
            "surfaces in this group must be square, with free edges and without files, as in the "
            "paper; choose another name for groups of other surfaces"
        )
    if scene.level != _LEVELS.get(group, scene.level):
        raise ValueError(f"scenes must be of level {_LEVELS[group]}, not {scene.level}")
    scatters = scene.mu_static_std > 0.0 or scene.mu_dynamic_std > 0.0
    # Without scatter one realisation suffices, and no figure needs its c(r).
    if not scene.sides or (group not in _LEVELS and seeds == 1 and not scatters):
        return
    if not scatters:
        raise ValueError(
            "without scatter c(r) is not defined; give one seed, in a group of another name, or "
            "scatter"
        )
    if seeds < _CORRELATED:
        raise ValueError(
            f"seeds must be at least {_CORRELATED}, for correlations on pillars of {scene.n_p} "
            f"blocks, not {seeds}"
        )


def _sentence(error: jsonschema.ValidationError) -> str:
    key = ".".join(str(part) for part in error.absolute_path) or "the configuration"
    if error.validator == "additionalProperties":
        known = ", ".join(error.schema["properties"])
        unknown = sorted(set(error.instance) - set(error.schema["properties"]))
        return f"{key}: unknown key {unknown[0]!r}; choose from {known}"
    if error.validator == "required":
        return f"{key}: {error.message}"
    meaning = error.schema.get("description")
    return f"{key} is not valid: {error.message}" + (f" ({meaning})" if meaning else "")


def ensembles(configuration: Configuration) -> dict[str, Seeds]:
    """Return the scenes of each group with their numbers of seeds.

    A scene that occurs several times has the largest of its numbers.
    """
    groups: dict[str, list[tuple[Scene, int]]] = {}
    for group, grids in configuration["scenes"].items():
        with _named(f"scenes.{group}"):
            given = [_expand(configuration, grid) for grid in listed(grids) if grid]
            groups[group] = [*chain.from_iterable(given)]
    largest: Seeds = {}
    for scene, seeds in chain.from_iterable(groups.values()):
        largest[scene] = max(seeds, largest.get(scene, 0))
    return {
        group: {scene: largest[scene] for scene, _ in members} for group, members in groups.items()
    }


def for_figures(
    configuration: Configuration, groups: Mapping[str, Iterable[Scene]]
) -> dict[str, list[Scene]]:
    """Return the scenes for figures, by group: only surfaces of the paper's kind.

    The group `surfaces`, which has a figure of its own, keeps all. A study of one's own has no
    other group: each surface once in each direction.
    """
    if is_own(configuration):
        first: dict[tuple[Any, ...], Scene] = {}
        for scene in chain.from_iterable(groups.values()):
            first.setdefault(tuple(getattr(scene, name) for name in GEOMETRY), scene)
        return {"surfaces": list(first.values())}
    return {
        group: [each for each in members if each.is_papers or group == "surfaces"]
        for group, members in groups.items()
    }


def _usual(configuration: Configuration) -> dict[str, Any]:
    """Return the values of all scenes that do not replace them."""
    names = ("n_blocks", *TIMES)
    return {**configuration["material"], **{name: configuration[name] for name in names}}


def _expand(configuration: Configuration, grid: Mapping[str, Any]) -> Iterator[tuple[Scene, int]]:
    """Yield the scenes of a grid, with the number of seeds of each."""
    material, usual = grid.get("material", {}), _usual(configuration)
    for name in material.keys() & FIELDS.keys() - {each.name for each in fields(Material)}:
        raise ValueError(f"{name} is not a constant of the material; give it beside `material`")
    if "law" in material:  # which has its own constants
        usual = {name: usual[name] for name in usual.keys() & FIELDS.keys() - set(OF_LAWS)}
    if grid.keys() & {"mask", "topography", "texture"}:  # which then gives N
        del usual["n_blocks"]
    own = {name: grid[name] for name in grid.keys() - {"material", "seeds"}}
    own |= {"snapshot_times": [tuple(grid.get("snapshot_times", ()))]}
    lists = usual | own | material
    if (number := math.prod(len(listed(values)) for values in lists.values())) > _MOST_SCENES:
        raise ValueError(f"{number} scenes are too many; choose up to {_MOST_SCENES} in a grid")
    sizes, seeds = listed(grid.get("n_p", 0)), grid.get("seeds", 1)
    counts = seeds if isinstance(seeds, list) else [seeds] * len(sizes)
    if len(counts) != len(sizes):
        raise ValueError(f"seeds must have one number per n_p, {len(sizes)}, not {len(counts)}")
    folder = Path(configuration["results"], "surfaces")
    mask_of = cache(lambda cut: BlockMap.of_topography(cut, folder))
    for row in expand(lists):
        scene = scene_of(_with_mask(row, mask_of))
        for file in scene.files:
            if "{" in file or "}" in file:
                raise ValueError(f"{file}: rename it; Snakemake reads braces as wildcards")
        yield scene, counts[sizes.index(scene.n_p)]


def _with_mask(row: dict[str, Any], mask_of: Callable[[Cut], BlockMap]) -> dict[str, Any]:
    """Return a row with the mask in place of the cut through a topography, if any."""
    cut = {key: row.pop(key) for key in _OF_CUT if key in row}
    file = row.pop("topography", None)
    if "mask" in row and (file or cut):
        raise ValueError(f"mask cannot be combined with topography, {', '.join(_OF_CUT)}")
    if file:
        spacing = float(row.get("spacing", Material.spacing))
        return row | {"mask": mask_of(Cut(Path(file), spacing, **cut))}
    if cut:
        raise ValueError(f"{next(iter(cut))} needs topography")
    return row
