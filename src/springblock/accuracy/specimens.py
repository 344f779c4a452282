"""Specimens: surfaces to measure errors on. Contact, mu_static and mu_dynamic, (N, N) each."""

import numpy as np
from numpy.typing import NDArray

from springblock.model.asperities import draw_friction
from springblock.model.material import Material
from springblock.model.pattern import Pattern

Array = NDArray[np.float64]
Surface = tuple[NDArray[np.bool_], Array, Array]


def uniform(n: int, mu_static: float, mu_dynamic: float) -> Surface:
    """Return a flat surface without scatter."""
    return np.ones((n, n), bool), np.full((n, n), mu_static), np.full((n, n), mu_dynamic)


def drawn(pattern: Pattern, seed: int, material: Material | None = None) -> Surface:
    """Return a pattern with the scatter of `material`, by default the paper's."""
    return pattern.contact, *draw_friction(pattern.n_blocks, seed, material)


def flat(n: int, seed: int, material: Material | None = None) -> Surface:
    """Return a flat surface with the scatter of `material`, by default the paper's."""
    return drawn(Pattern.flat(n), seed, material)
