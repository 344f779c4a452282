"""The random surface: one static and one dynamic friction coefficient per block."""

import numpy as np
from numpy.typing import NDArray

from springblock.material import Material


def _standard_normal(name: str, seed: int, n_blocks: int) -> NDArray[np.float64]:
    """Draw (N, N) standard normals from the stream `name` of this seed."""
    sequence = np.random.SeedSequence(seed, spawn_key=tuple(name.encode()))
    return np.random.Generator(np.random.PCG64(sequence)).standard_normal((n_blocks, n_blocks))


def draw_friction(
    n_blocks: int, seed: int, material: Material | None = None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Draw the microscopic coefficients mu_static and mu_dynamic, each (N, N), indexed [y, x].

    Both are Gaussian (section 2 of the paper), from two independent streams that depend on the
    seed and their own name alone. Every block gets its draw, in contact or not: all patterns of
    one N see the same asperities.

    A negative draw would make friction push and becomes zero. With the paper's standard
    deviations that needs ten of them; with a standard deviation of half the mean it happens to
    2.3 % of the blocks and raises the mean by 0.4 %. A draw with mu_static < mu_dynamic is kept
    as drawn: a block that lets go under less than its dynamic friction comes to rest in the
    same instant, so that it detaches for good at mu_dynamic (see `springblock.solver.friction`).

    Raises
    ------
    TypeError, ValueError
        Where the seed is not a whole number from zero up.
    """
    if isinstance(seed, bool) or not isinstance(seed, int | np.integer):
        raise TypeError(f"a seed must be a whole number, not {seed!r}")
    if seed < 0:
        raise ValueError(f"a seed must be zero or positive, not {seed}")
    material = material or Material()
    mu_static = material.mu_static + material.mu_static_std * _standard_normal(
        "mu_static", seed, n_blocks
    )
    mu_dynamic = material.mu_dynamic + material.mu_dynamic_std * _standard_normal(
        "mu_dynamic", seed, n_blocks
    )
    return np.maximum(mu_static, 0.0), np.maximum(mu_dynamic, 0.0)
