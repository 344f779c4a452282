"""Configuration of a study: checks, and expansion into scenes and batches of seeds."""

import math
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from copy import deepcopy
from dataclasses import dataclass, fields, replace
from itertools import chain, product
from pathlib import Path
from typing import Any

import jsonschema
import yaml

from springblock.io.schemas import AXES
from springblock.model.asperities import check_draws
from springblock.model.blockmap import BlockMap, Cut
from springblock.model.law import LawFile
from springblock.model.material import Material, as_law
from springblock.model.scene import LENGTHS, TEXTS, Scene, Varied, gap_of, grid_of
from springblock.model.surface import Surface
from springblock.simulation.setup import Setup
from springblock.solver.integrators import INTEGRATORS

Configuration = Mapping[str, Any]

#: Keys of the numerical method.
TIMES = ("integrator", "step", "sample_interval")
#: PyYAML's reader in C is ten times as fast, where it is installed.
LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
#: A decimal number, as text.
_NUMBER = re.compile(r"[-+]?(?!0[0-9])([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?")
#: Words of YAML and their values.
_YAML_WORDS = {"true": True, "false": False, "null": None}
#: Groups of the paper's figures, with the level of their scenes.
_LEVELS = {"flat": 0, "pillars": 1, "grooves": 2}
#: Validator for which 24.0 is not an integer, as in Python.
_Validator = jsonschema.validators.extend(
    jsonschema.Draft202012Validator, type_checker=jsonschema.Draft4Validator.TYPE_CHECKER
)
#: Largest number of scenes: a minute until the first job.
_MOST_SCENES = 20_000
#: Least number of realisations for the interval of a correlation.
_CORRELATED = 3


@dataclass(frozen=True)
class Planned:
    """A scene with the seeds and the duration of its realisations."""

    scene: Scene
    seeds: range
    duration: float | None  #: s; None to end after the peak, see `simulate`
    #: s, of displacements stored for all seeds, and of fields for the first
    snapshot_times: tuple[float, ...] = ()

    def batches(self, size: int) -> list[range]:
        """Return the seeds of each batch, which ends before a multiple of `size`.

        So all but the last batch of a growing study remain as they are.
        """
        first, last = self.seeds[0], self.seeds[-1]
        return [
            range(max(first, i * size), min(last + 1, (i + 1) * size))
            for i in range(first // size, last // size + 1)
        ]

    def joined(self, other: "Planned") -> "Planned":
        """Return the larger of two ensembles of the same scene, with the snapshots of both."""
        if self.duration != other.duration:
            raise ValueError(f"duration must be the same wherever {self.scene} occurs")
        times = tuple(sorted({*self.snapshot_times, *other.snapshot_times}))
        larger = max(self, other, key=lambda each: len(each.seeds))
        return replace(larger, snapshot_times=times)


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


def with_constants(schema: Mapping[str, Any]) -> dict[str, Any]:
    """Return the schema with what `Material` and `INTEGRATORS` declare, as values and as lists."""
    one: dict[str, Any] = {}
    for each in fields(Material):
        said = each.metadata
        if "may_vanish" in said:
            bound = "minimum" if said["may_vanish"] else "exclusiveMinimum"
            one[each.name] = {"type": "number", bound: 0}
        else:
            one[each.name] = {"enum": [*said["choices"]]} if said["choices"] else {"type": "string"}
        one[each.name]["description"] = f"{said['meaning']}; {said['unit']}"
    one["integrator"] = {"enum": [*INTEGRATORS], "description": "integrator"}
    many: dict[str, Any] = {
        name: {
            "description": f"value, or list of values: {value['description']}",
            "if": {"type": "array"},
            "then": {"minItems": 1, "uniqueItems": True, "items": value},
            "else": value,
        }
        for name, value in one.items()
    }
    whole = deepcopy(dict(schema))
    whole["properties"]["integrator"] = one.pop("integrator")
    whole["$defs"]["grid"]["properties"]["integrator"] = many.pop("integrator")
    whole["properties"]["material"]["properties"] = one
    whole["$defs"]["axes"]["properties"] = many
    return whole


def check(configuration: Configuration, schema: Mapping[str, Any]) -> None:
    """Refuse an invalid configuration, before any computation, by a TypeError or ValueError."""
    error = jsonschema.exceptions.best_match(_Validator(schema).iter_errors(configuration))
    if error is not None:
        raise ValueError(_sentence(error))
    usual, groups = setup(configuration), ensembles(configuration)
    if not any(groups.values()):
        raise ValueError("scenes: no scenes are given; add a group, as config/README.md shows")
    for group, members in groups.items():
        for ensemble in members:
            with _named(f"scenes.{group}"):
                _check_ensemble(ensemble, usual)
                if not is_own(configuration):
                    _check_for_figures(ensemble, group, usual)
    for name, sweep in configuration["figures"].get("sweeps", {}).items():
        _check_sweep(f"figures.sweeps.{name}", sweep, groups)


@contextmanager
def _named(key: str) -> Iterator[None]:
    """Prefix error messages with the key."""
    try:
        yield
    except ValueError as reason:
        raise ValueError(f"{key}: {reason}") from reason


def _check_sweep(key: str, sweep: Mapping[str, Any], groups: Mapping[str, list[Planned]]) -> None:
    for group in sweep["groups"]:
        if group not in groups:
            known = ", ".join(groups)
            raise ValueError(f"{key}.groups: unknown group {group!r}; choose from {known}")
    members = chain.from_iterable(groups[group] for group in sweep["groups"])
    own = [name for each in members for name, _ in each.scene.varied if name not in TEXTS]
    if sweep["over"] not in [*AXES, *own]:
        known = ", ".join(dict.fromkeys([*AXES, *own]))
        raise ValueError(f"{key}.over: unknown axis {sweep['over']!r}; choose one of {known}")


def is_own(configuration: Configuration) -> bool:
    """Whether a study has scenes of one's own alone, without the paper's groups and figures."""
    return configuration.get("study") == "own"


def _check_ensemble(ensemble: Planned, setup: Setup) -> None:
    scene, seeds, times = ensemble.scene, ensemble.seeds, ensemble.snapshot_times
    Surface(scene.contact, 1.0, 1.0, scene.is_periodic)  # refuses invalid ones
    own = setup.vary(dict(scene.varied))
    advised = replace(own, sample_interval=None).interval
    if own.interval > (1.0 + 1e-6) * max(own.longest_interval, own.step):
        raise ValueError(
            f"sample_interval = {own.interval!r} s is too long for slider_velocity = "
            f"{own.material.slider_velocity!r} m/s, since static friction would be too low; choose "
            f"at most {advised:.10g} s"
        )
    if scene.is_drawn:
        check_draws(scene.shape, own.material)
    elif len(seeds) > 1:
        raise ValueError(f"seeds must be 1, since no coefficients are drawn, not {len(seeds)}")
    strongest = own.material.mu_static
    known: Any = scene.mu_static_field and scene.mu_static_field.values
    if known is not None:
        strongest = float(known[scene.contact].max())
    for duration in (None, ensemble.duration):  # its prelude and its realisations
        own.plan(scene.contact, strongest, duration, times)


def _check_for_figures(ensemble: Planned, group: str, setup: Setup) -> None:
    """Refuse scenes that the paper's figures and the tables of correlations cannot take."""
    scene, material = ensemble.scene, setup.vary(dict(ensemble.scene.varied)).material
    if group in _LEVELS and not scene.is_papers:
        raise ValueError(
            "surfaces in this group must be square, with free edges and without files, as in the "
            "paper; choose another name for groups of other surfaces"
        )
    if scene.level != _LEVELS.get(group, scene.level):
        raise ValueError(f"scenes must be of level {_LEVELS[group]}, not {scene.level}")
    # Without scatter one realisation suffices, and no figure needs its c(r).
    scatters = material.mu_static_std > 0.0 or material.mu_dynamic_std > 0.0
    is_single = group not in _LEVELS and len(ensemble.seeds) == 1 and not scatters
    if scene.sides and len(ensemble.seeds) < _CORRELATED and not is_single:
        raise ValueError(
            f"seeds must be at least {_CORRELATED}, for correlations on pillars of {scene.n_p} "
            f"blocks, not {len(ensemble.seeds)}"
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


def ensembles(configuration: Configuration) -> dict[str, list[Planned]]:
    """Expand each group of scenes, by name.

    A scene that occurs in several groups is one ensemble, with the largest number of seeds.
    """
    groups: dict[str, list[Planned]] = {}
    largest: dict[Scene, Planned] = {}
    for group, grids in configuration["scenes"].items():
        with _named(f"scenes.{group}"):
            groups[group] = [
                each for grid in _listed(grids) for each in _expand(configuration, grid)
            ]
            for each in groups[group]:
                known = largest.get(each.scene, each)
                largest[each.scene] = known.joined(each)
    return {
        group: list(dict.fromkeys(largest[each.scene] for each in members))
        for group, members in groups.items()
    }


def setup(configuration: Configuration) -> Setup:
    """Return the setup of scenes without varied constants."""
    times = {key: configuration[key] for key in TIMES}
    with _named("material"):
        material = Material().vary(configuration["material"])
    return Setup(material, **times)


def for_figures(
    configuration: Configuration, groups: Mapping[str, list[Planned]]
) -> dict[str, list[Planned]]:
    """Return the ensembles for figures, by group: only surfaces of the paper's kind.

    The group `surfaces`, which has a figure of its own, keeps all. A study of one's own has no
    other group: each surface once in each direction.
    """
    if is_own(configuration):
        first: dict[Scene, Planned] = {}
        for each in chain.from_iterable(groups.values()):
            first.setdefault(replace(each.scene, varied=()), each)
        return {"surfaces": list(first.values())}
    return {
        group: [each for each in members if each.scene.is_papers or group == "surfaces"]
        for group, members in groups.items()
    }


def _expand(configuration: Configuration, grid: Mapping[str, Any] | None) -> Iterator[Planned]:
    if not grid:
        return
    axes = {**grid, **grid.get("material", {})}  # seeds go with n_p, and snapshots with each scene
    counts = [len(_listed(axes[key])) for key in axes.keys() - {"seeds", "snapshot_times"}]
    if (number := math.prod(counts)) > _MOST_SCENES:
        raise ValueError(f"{number} scenes are too many; choose up to {_MOST_SCENES} in a grid")
    first, duration = configuration["first_seed"], grid.get("duration")
    kept = tuple(grid.get("snapshot_times", ()))
    n_p, n_s, *deeper = (_listed(grid.get(key, 0)) for key in LENGTHS)  # a flat surface has none
    seeds = grid.get("seeds", 1)
    counts = seeds if isinstance(seeds, list) else [seeds] * len(n_p)
    if len(counts) != len(n_p):
        raise ValueError(f"seeds must have one number per n_p, {len(n_p)}, not {len(counts)}")
    of_mask = "mask" in grid or "topography" in grid  # which then gives N
    n_blocks = _listed(grid.get("n_blocks", 0 if of_mask else configuration["n_blocks"]))
    shapes = product(n_blocks, _listed(grid.get("n_rows", 0)))
    pillars, varied = zip(n_p, counts, strict=True), list(_varied(configuration, grid))
    directions = _listed(grid["direction"])
    maps = {constants: _maps(configuration, grid, constants) for constants in varied}
    ways = product(shapes, pillars, n_s, product(*deeper), directions, varied)
    for (n, rows), (size, count), given, rest, direction, constants in ways:
        lengths = dict(zip(LENGTHS, (size, gap_of(given, size), *rest), strict=True))
        how = {key: grid[key] for key in ("along_3", "edges") if key in grid}
        how |= {"direction": direction, "varied": constants, "n_rows": rows}
        for own in maps[constants]:
            scene = Scene(n, **lengths, **how, **own)
            yield Planned(scene, range(first, first + count), duration, kept)


def _maps(
    configuration: Configuration, grid: Mapping[str, Any], constants: Varied
) -> list[dict[str, Any]]:
    """Return each mask of a grid, if any, with the coefficients from files."""
    own = {
        f"{name}_field": BlockMap.coefficients(Path(grid[name]))
        for name in ("mu_static", "mu_dynamic")
        if name in grid
    }
    masks = _masks(configuration, grid, constants)
    return [own | {"mask": mask} for mask in masks] or [own]


def _masks(
    configuration: Configuration, grid: Mapping[str, Any], constants: Varied
) -> Iterator[BlockMap]:
    of_cut = ("bearing_area", "height", "channel", "detrend")
    cuts = {key: _listed(grid[key]) for key in of_cut if key in grid}
    if "mask" in grid:
        if "topography" in grid or cuts:
            raise ValueError(f"mask cannot be combined with topography, {', '.join(of_cut)}")
        yield from (BlockMap.mask(Path(file)) for file in _listed(grid["mask"]))
    elif "topography" in grid:
        spacing = dict(constants).get("spacing", setup(configuration).material.spacing)
        folder, file = Path(configuration["results"], "surfaces"), Path(grid["topography"])
        for values in product(*cuts.values()):
            cut = Cut(file, float(spacing), **dict(zip(cuts, values, strict=True)))
            yield BlockMap.of_topography(cut, folder)
    elif cuts:
        raise ValueError(f"{next(iter(cuts))} needs topography")


def _listed(given: Any) -> list[Any]:
    """Return a list of one or more values."""
    return given if isinstance(given, list) else [given]


def _varied(configuration: Configuration, grid: Mapping[str, Any]) -> Iterator[Varied]:
    """Yield each combination of the constants of a grid, without values equal to the study's."""
    law = as_law(configuration["material"].get("law", "coulomb"))
    own = law.constants if isinstance(law, LawFile) else {}
    study = {**dict(Material().items()), **own, **configuration["material"], **configuration}
    study["law"] = law
    axes = {key: grid[key] for key in ("integrator", "step") if key in grid}
    lists = {key: _listed(given) for key, given in {**axes, **grid.get("material", {})}.items()}
    for constants in grid_of(lists):
        yield tuple((key, value) for key, value in constants.items() if value != study.get(key))
