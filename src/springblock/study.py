"""The study's configuration: checked, and expanded into scenes and batches of seeds."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import chain, product
from typing import Any

import jsonschema

from springblock.material import Material
from springblock.scene import LENGTHS, Scene
from springblock.setup import Setup

Configuration = Mapping[str, Any]

#: Groups that figures are drawn from, and the level of their scenes.
_LEVELS = {"flat": 0, "pillars": 1, "grooves": 2}
#: Realisations below which a correlation has no interval.
_CORRELATED = 3


@dataclass(frozen=True)
class Ensemble:
    """A scene, how often it is simulated, and for how long."""

    scene: Scene
    seeds: range
    duration: float | None  #: s; None until the scene has shown its peak

    def batches(self, size: int) -> Iterator[range]:
        """Split the seeds into whole batches of `size` and the rest one by one.

        A larger ensemble then contains the smaller one's batches, as long as both are whole.
        """
        whole = self.seeds[: len(self.seeds) // size * size]
        yield from (whole[i : i + size] for i in range(0, len(whole), size))
        yield from (range(seed, seed + 1) for seed in self.seeds[len(whole) :])


def check(configuration: Configuration, schema: Mapping[str, Any]) -> None:
    """Refuse a configuration that could not be computed, before anything is.

    Raises
    ------
    TypeError, ValueError
        With one sentence that names the key, what it holds and what it may hold.
    """
    validator = jsonschema.Draft202012Validator(schema)
    error = jsonschema.exceptions.best_match(validator.iter_errors(configuration))
    if error is not None:
        raise ValueError(_sentence(error))
    times = {key: configuration[key] for key in ("integrator", "step", "sample_interval")}
    setup = Setup(Material(**configuration["material"]), **times)
    for group, members in ensembles(configuration).items():
        for ensemble in members:
            try:
                _check_ensemble(ensemble, group, setup.sample_interval)
            except ValueError as reason:
                raise ValueError(f"scenes.{group}: {reason}") from reason
    for figure in ("figure_5", "figure_7"):
        shown = configuration["figures"][figure]["n_p"]
        if shown not in configuration["scenes"]["pillars"]["n_p"]:
            raise ValueError(
                f"figures.{figure}.n_p is {shown}, which scenes.pillars.n_p does not hold"
            )


def _check_ensemble(ensemble: Ensemble, group: str, sample_interval: float) -> None:
    scene = ensemble.scene
    _ = scene.pattern
    if scene.level != _LEVELS.get(group, scene.level):
        raise ValueError(f"its scenes must be of level {_LEVELS[group]}, not {scene.level}")
    if ensemble.duration is not None and ensemble.duration < sample_interval:
        raise ValueError(
            f"duration is {ensemble.duration!r} s, "
            f"less than one sample_interval of {sample_interval!r} s"
        )
    if scene.sides and len(ensemble.seeds) < _CORRELATED:
        raise ValueError(
            f"correlations on pillars of {scene.n_p} blocks need {_CORRELATED} seeds or more"
        )


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
    """Expand each group of scenes into its grid, by the group's name.

    A scene that several of them hold is one ensemble, with the largest number of seeds.

    Raises
    ------
    ValueError
        With the name of the group, where its lists do not fit together.
    """
    groups: dict[str, list[Ensemble]] = {}
    largest: dict[Scene, Ensemble] = {}
    for group, grid in configuration["scenes"].items():
        try:
            groups[group] = list(_expand(configuration, grid)) if grid else []
        except ValueError as reason:
            raise ValueError(f"scenes.{group}: {reason}") from reason
    for ensemble in chain(*groups.values()):
        scene = ensemble.scene
        known = largest.setdefault(scene, ensemble)
        if known.duration != ensemble.duration:
            raise ValueError(f"scenes: {scene.folder} is given two durations")
        largest[scene] = max(known, ensemble, key=lambda either: len(either.seeds))
    return {
        group: list(dict.fromkeys(largest[ensemble.scene] for ensemble in members))
        for group, members in groups.items()
    }


def _expand(configuration: Configuration, grid: Mapping[str, Any]) -> Iterator[Ensemble]:
    first = configuration["first_seed"]
    sizes = grid.get("n_blocks", [configuration["n_blocks"]])
    n_p, n_s, *deeper = (grid.get(key, [0]) for key in LENGTHS)  # a flat surface has none
    counts = grid["seeds"] if isinstance(grid["seeds"], list) else [grid["seeds"]] * len(n_p)
    if len(counts) != len(n_p):
        raise ValueError(f"seeds lists {len(counts)} numbers for {len(n_p)} values of n_p")
    pillars = zip(n_p, counts, strict=True)
    for n, (size, count), given, *rest in product(sizes, pillars, n_s, *deeper, grid["direction"]):
        gap = {"n_p/2": size // 2, "n_p": size, "2n_p": 2 * size}.get(given, given)
        scene = Scene(n, size, gap, *rest)
        yield Ensemble(scene, range(first, first + count), grid.get("duration"))
