"""Surfaces for tests, and all bits of a run on one."""

import numpy as np

from springblock import Material, Pattern, Realisation, Surface


def uniform(n: int, mu_static: float, mu_dynamic: float) -> Surface:
    """Return a flat surface of n x n blocks without scatter."""
    return Surface([[True] * n] * n, mu_static, mu_dynamic)


def drawn(pattern: Pattern, seed: int, material: Material | None = None) -> Surface:
    """Return a pattern with the scatter of `material`, by default the paper's."""
    return Surface.draw(pattern.contact, seed, material)


def flat(n: int, seed: int) -> Surface:
    """Return a flat surface of n x n blocks with the paper's scatter."""
    return drawn(Pattern.flat(n), seed)


def bits(run: Realisation) -> tuple[object, ...]:
    """Return all bits of a run."""
    values = [*vars(run).values(), *vars(run.fields).values()]
    arrays = (value.tobytes() for value in values if isinstance(value, np.ndarray))
    return *arrays, run.energy, run.steps
