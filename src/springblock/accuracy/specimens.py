"""Specimens: surfaces to measure errors on."""

import numpy as np
from numpy.typing import NDArray

from springblock.model.material import Material
from springblock.model.pattern import Pattern
from springblock.model.surface import Surface

Array = NDArray[np.float64]


def uniform(n: int, mu_static: float, mu_dynamic: float) -> Surface:
    """Return a flat surface without scatter."""
    return Surface(np.ones((n, n), bool), mu_static, mu_dynamic)


def drawn(pattern: Pattern, seed: int, material: Material | None = None) -> Surface:
    """Return a pattern with the scatter of `material`, by default the paper's."""
    return Surface.draw(pattern.contact, seed, material)


def flat(n: int, seed: int, material: Material | None = None) -> Surface:
    """Return a flat surface with the scatter of `material`, by default the paper's."""
    return drawn(Pattern.flat(n), seed, material)
