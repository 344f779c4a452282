"""The study's configuration: checked, and expanded into scenes and batches of seeds."""

import hashlib
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from typing import Any

import jsonschema

from springblock.material import Material
from springblock.realisation import check_times
from springblock.scene import Scene

Configuration = Mapping[str, Any]


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
    material = Material(**configuration["material"])
    times = (configuration["integrator"], configuration["step"], configuration["sample_interval"])
    check_times(material, *times)
    for group, members in ensembles(configuration).items():
        for ensemble in members:
            try:
                _ = ensemble.scene.pattern
            except ValueError as reason:
                raise ValueError(f"scenes.{group}: {reason}") from reason
            if ensemble.duration is not None and ensemble.duration < times[2]:
                raise ValueError(
                    f"scenes.{group}.duration is {ensemble.duration!r} s, "
                    f"less than one sample_interval of {times[2]!r} s"
                )
    shown = configuration["figures"]["figure_5"]["n_p"]
    if shown not in configuration["scenes"]["pillars"]["n_p"]:
        raise ValueError(f"figures.figure_5.n_p is {shown}, which scenes.pillars.n_p does not hold")


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
    """Expand each group of scenes into its grid, by the group's name."""
    return {
        group: list(_expand(configuration, grid)) for group, grid in configuration["scenes"].items()
    }


def _expand(configuration: Configuration, grid: Mapping[str, Any]) -> Iterator[Ensemble]:
    first = configuration["first_seed"]
    seeds = range(first, first + grid["seeds"])
    lengths = [_values(grid, key) for key in ("n_p", "n_s", "n_p2", "n_s2")]
    sizes = grid.get("n_blocks", [configuration["n_blocks"]])
    for n, n_p, n_s, n_p2, n_s2, direction in product(sizes, *lengths, grid["direction"]):
        spacing = {"n_p": n_p, "n_p/2": n_p // 2}.get(n_s, n_s)
        scene = Scene(n, n_p, spacing, n_p2, n_s2, str(direction))
        yield Ensemble(scene, seeds, grid.get("duration"))


def _values(grid: Mapping[str, Any], key: str) -> list[Any]:
    """Values of one axis of the grid; a flat surface has no lengths."""
    return grid.get(key, [0])


def configuration_digest(configuration: Configuration) -> str:
    """Digest of all that decides about the results; 16 hexadecimal digits."""
    text = json.dumps(configuration, sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:16]
