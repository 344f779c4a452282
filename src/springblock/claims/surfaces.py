"""Surfaces of statements: those simulated, the cases they make, and their parts."""

from collections.abc import Mapping
from dataclasses import replace
from operator import attrgetter
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from springblock.claims.rule import Case
from springblock.mechanism.elasticity import Layer
from springblock.model.material import Material
from springblock.model.numbers import Array
from springblock.model.scene import Scene

T = TypeVar("T")
Mask = NDArray[np.bool_]

SMALLEST = 4  #: n_p of the smallest pillars with a stress distribution of their own, section 3.2
ALONG = "x"  #: the paper's sliding direction


def flat(table: Mapping[Scene, T]) -> dict[Scene, T]:
    """Return the flat surface with the study's constants, if it was simulated."""
    found = [scene for scene in table if not scene.level and not scene.varied][:1]
    return {scene: table[scene] for scene in found}


def pillars(table: Mapping[Scene, T], smallest: int = SMALLEST) -> dict[Scene, T]:
    """Return scenes of square pillars with n_s = n_p and the study's constants, by n_p."""
    equal = [s for s in table if s.level == 1 and s.n_p == s.n_s > 0 and not s.varied]
    found = [s for s in equal if s.n_p >= smallest]
    return {scene: table[scene] for scene in sorted(found, key=attrgetter("n_p"))}


def grooved(table: Mapping[Scene, T], level: int = 2) -> dict[Scene, T]:
    """Return scenes of grooved pillars of a level that slide along x, by their lengths.

    Level 1 has grooves from edge to edge of the surface, without pillars.
    """
    found = [s for s in table if s.level == level and s.n_p2 and s.direction == ALONG]
    found = [s for s in found if s.n_p or level == 1]
    found.sort(key=lambda s: (s.n_blocks, s.n_p, s.n_p2, s.n_s2, s.n_p3))
    return {scene: table[scene] for scene in found}


def across(scene: Scene) -> Scene:
    """Return the same surface, slid along y."""
    return replace(scene, direction="y")


def slid_both_ways(table: Mapping[Scene, T], level: int = 2) -> dict[Scene, T]:
    """Return the scenes of `grooved` that were also slid across their grooves."""
    return {s: found for s, found in grooved(table, level).items() if across(s) in table}


def with_and_without_grooves(table: Mapping[Scene, T]) -> list[tuple[Scene, Scene]]:
    """Return grooved pillars of level 2 with the same pillars without grooves."""
    pairs = ((scene, replace(scene, n_p2=0, n_s2=0)) for scene in grooved(table))
    return [(scene, plain) for scene, plain in pairs if plain in table]


def case_of(scene: Scene) -> Case:
    """Return the case of a surface: the lengths of its pillars and pawls."""
    names = ("n_p", "n_p2", "n_s2", "n_p3", "along_3")
    return Case(**{name: getattr(scene, name) or None for name in names})


def in_files(*scenes: Scene, folder: str = "realisations") -> str:
    """Name the folders that hold the realisations of these scenes, or these surfaces."""
    return "; ".join(f"{folder}/{scene.folder}" for scene in scenes)


def in_rows(table: str, scene: Scene, **more: str | int) -> str:
    """Name rows of a table of correlations of this scene."""
    keys = {"N": scene.n_blocks, **scene.names, "direction": scene.direction, **more}
    return f"tables/{table}: {', '.join(f'{key} = {value}' for key, value in keys.items())}"


def pillars_of(field: NDArray[Any], scene: Scene) -> list[NDArray[Any]]:
    """Return the parts of a field over the surface, (N, N), on each pillar, (n_p, n_p)."""
    size = scene.n_p
    return [field[y : y + size, x : x + size] for y, x in scene.pattern.origins]


def from_edge(size: int) -> NDArray[np.intp]:
    """Return the distance of each block of a square from its edge, (size, size)."""
    from_end = np.minimum(np.arange(size), np.arange(size)[::-1])
    return np.minimum.outer(from_end, from_end)


def core(contact: Mask) -> Mask:
    """Return the contact blocks whose four neighbours are in contact.

    The border of the surface is no edge: the layer ends there, and nothing pulls on its blocks.
    """
    from scipy.ndimage import binary_erosion  # slow to import

    return np.asarray(binary_erosion(contact, border_value=1))


def elastic_forces(scene: Scene, material: Material) -> Array:
    """Return the tangential force on each block before the first detachment, (2, N_y, N_x).

    The layer is then in static equilibrium under the pull of the slider; forces follow from its
    linear elasticity and do not depend on the thresholds. Components along the sliding direction, x
    or y, and across it, over the mean of the modulus; NaN off contact.
    """
    contact = scene.contact if scene.direction == "x" else scene.contact.T
    forces = np.full((2, *contact.shape), np.nan)
    forces[:, contact] = Layer(contact, material).pull.reshape(2, -1)
    forces /= np.nanmean(np.hypot(*forces))
    return forces if scene.direction == "x" else forces.transpose(0, 2, 1)
