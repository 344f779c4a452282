"""The study's configuration: checked, and expanded into scenes and batches of seeds."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from itertools import chain, combinations, product
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np

from springblock.io.schemas import AXES
from springblock.model.asperities import check_draws
from springblock.model.blockmap import BlockMap, Cut
from springblock.model.law import LawFile
from springblock.model.material import Material, as_law
from springblock.model.scene import LENGTHS, MAPS, TEXTS, Scene, Varied
from springblock.simulation.checks import checked_surface, count_samples
from springblock.simulation.setup import Setup
from springblock.study.texts import check_texts

Configuration = Mapping[str, Any]

#: What YAML means by these words.
_YAML_WORDS = {"true": True, "false": False, "null": None}
#: Groups that figures are drawn from, and the level of their scenes.
_LEVELS = {"flat": 0, "pillars": 1, "grooves": 2}
#: To which 24.0 is no integer, as it is none to Python.
_Validator = jsonschema.validators.extend(
    jsonschema.Draft202012Validator, type_checker=jsonschema.Draft4Validator.TYPE_CHECKER
)
#: Realisations below which a correlation has no interval.
_CORRELATED = 3


@dataclass(frozen=True)
class Ensemble:
    """A scene, how often it is simulated, and for how long."""

    scene: Scene
    seeds: range
    duration: float | None  #: s; None until the scene has shown its peak

    def batches(self, size: int) -> dict[int, range]:
        """Return the seeds of each batch by its number: batch i has those from i·size on.

        Where batches begin does not depend on the number of seeds: a study that grows has each
        seed in one batch alone.
        """
        first, last = self.seeds[0], self.seeds[-1]
        return {
            i: range(max(first, i * size), min(last + 1, (i + 1) * size))
            for i in range(first // size, last // size + 1)
        }


def completed(configuration: Configuration) -> dict[str, Any]:
    """Read numbers that came as text, and continue lists by what `add` holds in their places.

    YAML takes 1e-3, which has no point, for text, and Snakemake all that `--config` holds deeper
    than its first level.

    Raises
    ------
    ValueError
        Where `add` holds no keys.
    """
    whole = {key: _with_numbers(value, key) for key, value in configuration.items()}
    added = whole.pop("add", None) or {}
    if not isinstance(added, dict):
        raise ValueError(f"add is {added!r}; it may hold keys of the configuration")
    return _continued(whole, added)


def _with_numbers(value: Any, key: str = "") -> Any:
    if isinstance(value, dict):
        return {name: _with_numbers(inner) for name, inner in value.items()}
    if isinstance(value, list):
        return [_with_numbers(inner) for inner in value]
    if not isinstance(value, str) or key == "results":
        return value
    for read in (int, float, _YAML_WORDS.__getitem__):
        with suppress(ValueError, KeyError):
            return read(value)
    return value


def _continued(node: Any, more: Any) -> Any:
    """Merge dictionaries, append lists, and take whatever else is new."""
    if isinstance(node, dict) and isinstance(more, dict):
        inner = {key: _continued(node.get(key), value) for key, value in more.items()}
        return {**node, **inner}
    return [*node, *more] if isinstance(node, list) and isinstance(more, list) else more


def check(configuration: Configuration, schema: Mapping[str, Any]) -> None:
    """Refuse a configuration that could not be computed, before anything is.

    Raises
    ------
    TypeError, ValueError
        With one sentence that names the key, what it holds and what it may hold.
    """
    check_texts(configuration)
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
        _check_sweep(f"figures.sweeps.{name}", sweep, configuration)


@contextmanager
def _named(key: str) -> Iterator[None]:
    """Put the key before what is wrong with it."""
    try:
        yield
    except ValueError as reason:
        raise ValueError(f"{key}: {reason}") from reason


def _check_sweep(key: str, sweep: Mapping[str, Any], configuration: Configuration) -> None:
    known = ", ".join(configuration["scenes"])
    for group in sweep["groups"]:
        if group not in configuration["scenes"]:
            raise ValueError(f"{key}.groups: unknown group {group!r}; choose from {known}")
    members = ensembles(configuration)
    own = (
        name
        for group in sweep["groups"]
        for each in members[group]
        for name, _ in each.scene.varied
    )
    axes = list(dict.fromkeys([*AXES, *(name for name in own if name not in TEXTS)]))
    if sweep["over"] not in axes:
        known = ", ".join(axes)
        raise ValueError(f"{key}.over: unknown axis {sweep['over']!r}; choose one of {known}")


def is_own(configuration: Configuration) -> bool:
    """Whether a study has scenes of one's own alone, without the paper's groups and figures."""
    return configuration.get("study") == "own"


def _check_ensemble(ensemble: Ensemble, setup: Setup) -> None:
    scene, ones = ensemble.scene, np.ones(ensemble.scene.shape)
    checked_surface(scene.contact, ones, ones, scene.is_periodic)
    own = setup.vary(dict(scene.varied))
    _check_draws(ensemble, own.material)
    for duration in (None, ensemble.duration):  # of its prelude, and of its realisations
        own.check_length(scene.contact, _threshold(scene, own.material), duration)
    if ensemble.duration is not None:
        count_samples(ensemble.duration, own.sample_interval)


def _check_for_figures(ensemble: Ensemble, group: str, setup: Setup) -> None:
    """Refuse scenes that the paper's figures and the tables of correlations cannot take."""
    scene, material = ensemble.scene, setup.vary(dict(ensemble.scene.varied)).material
    if group in _LEVELS and not scene.is_papers:
        raise ValueError(
            "its surfaces must be the paper's, square, with free edges and without files; "
            "others may be in a group of any other name"
        )
    if scene.level != _LEVELS.get(group, scene.level):
        raise ValueError(f"its scenes must be of level {_LEVELS[group]}, not {scene.level}")
    # Where nothing scatters one realisation is all there are, and no figure asks for its c(r).
    is_single = group not in _LEVELS and len(ensemble.seeds) == 1 and not _scatters(material)
    if scene.sides and len(ensemble.seeds) < _CORRELATED and not is_single:
        raise ValueError(
            f"correlations on pillars of {scene.n_p} blocks need {_CORRELATED} seeds or more"
        )


def _scatters(material: Material) -> bool:
    return material.mu_static_std > 0.0 or material.mu_dynamic_std > 0.0


def _threshold(scene: Scene, material: Material) -> float:
    """Largest coefficient that a file says, or the mean of those that are drawn."""
    known = None if scene.mu_static_field is None else scene.mu_static_field.values
    return material.mu_static if known is None else float(known[scene.contact].max())


def _check_draws(ensemble: Ensemble, material: Material) -> None:
    scene, seeds = ensemble.scene, ensemble.seeds
    if scene.is_drawn:
        check_draws(scene.shape, material)
    elif len(seeds) > 1:
        raise ValueError(f"seeds is {len(seeds)}, but nothing is drawn: leave it out, or say 1")


def _sentence(error: jsonschema.ValidationError) -> str:
    key = ".".join(str(part) for part in error.absolute_path) or "the configuration"
    if error.validator == "additionalProperties":
        known = ", ".join(error.schema["properties"])
        unknown = sorted(set(error.instance) - set(error.schema["properties"]))
        return f"{key} has the unknown key {unknown[0]!r}; it may hold {known}"
    if error.validator == "required":
        return f"{key}: {error.message}"
    meaning = error.schema.get("description")
    return f"{key} is not valid: {error.message}" + (f" ({meaning})" if meaning else "")


def ensembles(configuration: Configuration) -> dict[str, list[Ensemble]]:
    """Expand each group of scenes into its grids, by the group's name.

    A scene that several groups hold is one ensemble, with the largest number of seeds.

    Raises
    ------
    ValueError
        With the name of the group, where its lists do not fit together.
    """
    groups: dict[str, list[Ensemble]] = {}
    largest: dict[Scene, Ensemble] = {}
    for group, grids in configuration["scenes"].items():
        with _named(f"scenes.{group}"):
            parts = grids if isinstance(grids, list) else [grids or {}]
            groups[group] = [each for grid in parts for each in _expand(configuration, grid)]
            for ensemble in groups[group]:
                _keep_largest(largest, ensemble)
    return {
        group: list(dict.fromkeys(largest[each.scene] for each in members))
        for group, members in groups.items()
    }


def setup(configuration: Configuration) -> Setup:
    """Return how scenes are computed that have nothing of their own."""
    times = {key: configuration[key] for key in ("integrator", "step", "sample_interval")}
    with _named("material"):
        material = Material().vary(configuration["material"])
    return Setup(material, **times)


def for_figures(
    configuration: Configuration, groups: Mapping[str, list[Ensemble]]
) -> dict[str, list[Ensemble]]:
    """Ensembles that figures take by the names of groups: the paper's surfaces.

    The group `surfaces`, which is drawn for itself, has those of one's own as well. In a study of
    one's own there is no other group; it has each surface once in each direction.
    """
    if is_own(configuration):
        first: dict[Scene, Ensemble] = {}
        for each in chain.from_iterable(groups.values()):
            first.setdefault(replace(each.scene, varied=()), each)
        return {"surfaces": list(first.values())}
    return {
        group: [each for each in members if each.scene.is_papers or group == "surfaces"]
        for group, members in groups.items()
    }


def _keep_largest(largest: dict[Scene, Ensemble], ensemble: Ensemble) -> None:
    scene = ensemble.scene
    known = largest.setdefault(scene, ensemble)
    for key in MAPS:
        one, other = getattr(known.scene, key), getattr(scene, key)
        if one is not None and not np.array_equal(one.values, other.values, equal_nan=True):
            raise ValueError(f"{one.file} and {other.file} are both called {one}")
    if known.duration != ensemble.duration:
        raise ValueError(f"{scene} is given two durations")
    largest[scene] = max(known, ensemble, key=lambda either: len(either.seeds))


def _expand(configuration: Configuration, grid: Mapping[str, Any]) -> Iterator[Ensemble]:
    if not grid:
        return
    first, duration = configuration["first_seed"], grid.get("duration")
    n_p, n_s, *deeper = (grid.get(key, [0]) for key in LENGTHS)  # a flat surface has none
    seeds = grid.get("seeds", 1)
    counts = seeds if isinstance(seeds, list) else [seeds] * len(n_p)
    if len(counts) != len(n_p):
        raise ValueError(f"seeds lists {len(counts)} numbers for {len(n_p)} values of n_p")
    shapes = product(_sizes(configuration, grid), grid.get("n_rows", [0]))
    pillars, varied = zip(n_p, counts, strict=True), list(_varied(configuration, grid))
    maps = {constants: list(_maps(configuration, grid, constants)) for constants in varied}
    ways = product(shapes, pillars, n_s, product(*deeper), grid["direction"], varied)
    for (n, rows), (size, count), given, rest, direction, constants in ways:
        lengths = dict(zip(LENGTHS, (size, _gap(given, size), *rest), strict=True))
        how = {key: grid[key] for key in ("along_3", "edges") if key in grid}
        how |= {"direction": direction, "varied": constants, "n_rows": rows}
        for own in maps[constants]:
            scene = Scene(n, **lengths, **how, **own)
            yield Ensemble(scene, range(first, first + count), duration)


def _sizes(configuration: Configuration, grid: Mapping[str, Any]) -> list[int]:
    """N of a grid's scenes; 0 where a mask says it."""
    of_mask = "mask" in grid or "topography" in grid
    return grid.get("n_blocks", [0] if of_mask else [configuration["n_blocks"]])


def _maps(
    configuration: Configuration, grid: Mapping[str, Any], constants: Varied
) -> Iterator[dict[str, Any]]:
    """Each mask of a grid, if it has any, with the coefficients that files say."""
    own = {
        f"{name}_field": BlockMap.coefficients(Path(grid[name]))
        for name in ("mu_static", "mu_dynamic")
        if name in grid
    }
    masks = list(_masks(configuration, grid, constants))
    for one, other in combinations(masks, 2):
        if one == other:
            raise ValueError(f"masks {one.file} and {other.file} describe the same surface {one}")
    yield from ({"mask": mask} | own for mask in masks)
    if not masks:
        yield own


def _masks(
    configuration: Configuration, grid: Mapping[str, Any], constants: Varied
) -> Iterator[BlockMap]:
    cuts = {key: _listed(grid[key]) for key in ("bearing_area", "height") if key in grid}
    if "mask" in grid:
        if "topography" in grid or cuts:
            raise ValueError("mask cannot be given together with a topography or its cut")
        yield from (BlockMap.mask(Path(file)) for file in _listed(grid["mask"]))
    elif "topography" in grid:
        spacing = dict(constants).get("spacing", setup(configuration).material.spacing)
        folder, file = Path(configuration["results"], "surfaces"), Path(grid["topography"])
        for values in product(*cuts.values()):
            cut = Cut(file, float(spacing), **dict(zip(cuts, values, strict=True)))
            yield BlockMap.of_topography(cut, folder)
    elif cuts:
        raise ValueError(f"{next(iter(cuts))} needs a topography")


def _listed(given: Any) -> list[Any]:
    """Read what may be one value or a list of them."""
    return given if isinstance(given, list) else [given]


def _gap(given: int | str, n_p: int) -> int:
    """Read n_s, which may be given as a multiple or a part of n_p: "2n_p", "n_p/3"."""
    if not isinstance(given, str):
        return given
    times, parts = given.split("n_p")
    return int(times or 1) * n_p // int(parts.removeprefix("/") or 1)


def _varied(configuration: Configuration, grid: Mapping[str, Any]) -> Iterator[Varied]:
    """Each combination of the constants that a grid lists, without those that the study has."""
    law = as_law(configuration["material"].get("law", "coulomb"))
    own = law.constants if isinstance(law, LawFile) else {}
    study = {**dict(Material().items()), **own, **configuration["material"], **configuration}
    lists = {key: grid[key] for key in ("integrator", "step") if key in grid}
    lists |= grid.get("material", {})
    for values in product(*lists.values()):
        constants = dict(zip(lists, values, strict=True))
        yield tuple((key, value) for key, value in constants.items() if value != study.get(key))
