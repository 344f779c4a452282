"""Surfaces of statements: those simulated, the cases they make, and their parts."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from operator import attrgetter
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from springblock.model.scene import Scene
from springblock.study.claims.rule import Case

T = TypeVar("T")
Mask = NDArray[np.bool_]

SMALLEST = 4  #: n_p of the smallest pillars with a stress distribution of their own, section 3.2
ALONG = "x"  #: the paper's sliding direction
PLAIN, SCALED = "exp(-r/l_c)", "A exp(-r/l_c)"  #: curves fitted to c_x(r)


def own_constants(table: Iterable[Scene], scene: Scene) -> dict[str, Any]:
    """Return the constants in which a scene differs from the first, which has the study's."""
    usual = next(iter(table)).constants
    return {name: value for name, value in scene.constants.items() if value != usual[name]}


def flat(table: Mapping[Scene, T]) -> dict[Scene, T]:
    """Return the flat surface with the study's constants, if it was simulated."""
    found = [scene for scene in table if not scene.level and not own_constants(table, scene)][:1]
    return {scene: table[scene] for scene in found}


def pillars(table: Mapping[Scene, T], smallest: int = SMALLEST) -> dict[Scene, T]:
    """Return scenes of square pillars with n_s = n_p and the study's constants, by n_p."""
    equal = [s for s in table if s.level == 1 and s.n_p == s.n_s > 0]
    found = [s for s in equal if s.n_p >= smallest and not own_constants(table, s)]
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


def case_of(scene: Scene, **more: Any) -> Case:
    """Return the case of a surface: the lengths of its pillars and pawls, and what else differs."""
    names = ("n_p", "n_p2", "n_s2", "n_p3", "along_3")
    return Case(**{name: getattr(scene, name) or None for name in names} | more)


def pillars_of(field: NDArray[Any], scene: Scene) -> list[NDArray[Any]]:
    """Return the parts of a field over the surface, (N, N), on each pillar, (n_p, n_p)."""
    return [field[y : y + scene.n_p, x : x + scene.n_p] for y, x in scene.pattern.origins]


def core(contact: Mask) -> Mask:
    """Return the contact blocks beside contact blocks alone; the surface's border is no edge."""
    from scipy.ndimage import binary_erosion  # slow to import

    return np.asarray(binary_erosion(contact, border_value=1))
