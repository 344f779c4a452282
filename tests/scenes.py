"""Scenes that several tests share, and ways to drive the compiled kernels by hand."""

import numpy as np

from springblock import Material, Pattern, draw_friction
from springblock.solver import INTEGRATORS
from springblock.solver.lattice import Samples, prepare, unpadded
from springblock.solver.springs import (
    FORCE_X,
    FORCE_Y,
    Band,
    Springs,
    band_rows,
    forces_on_band,
    scratch,
)

UNDAMPED = Material(gamma=0.0)
#: Not 1, so that it would be missed; a power of 2, so that it rounds nothing.
STIFFNESS = 0.25
#: Springs and slider of a lattice by itself.
SPRINGS = Springs.of(STIFFNESS, 0.0), (0.0, 0.0)


def uniform(n, mu_static, mu_dynamic):
    """Contact and coefficients of a flat surface without scatter."""
    return np.ones((n, n), bool), np.full((n, n), mu_static), np.full((n, n), mu_dynamic)


def drawn(pattern, seed):
    """Contact and coefficients of a pattern with the paper's scatter."""
    return pattern.contact, *draw_friction(pattern.n_blocks, seed)


def flat(n, seed):
    """Contact and coefficients of a flat surface with the paper's scatter."""
    return drawn(Pattern.flat(n), seed)


def nailed(n):
    """One contact block in a corner, which never lets go: all other motion is smooth."""
    contact = np.zeros((n, n), bool)
    contact[0, 0] = True
    return contact, np.full((n, n), 1e9), np.zeros((n, n))


def with_border(displacement):
    """Lay a displacement (2, N, N) out as the kernels want it, its edges free of strain."""
    return [np.pad(u, 1, mode="edge")[1:-1].ravel() for u in displacement]


def spring_forces(displacement, band=None):
    """Return F_int/(K_int l), (2, N, N), by the compiled bands, for displacements in units of l.

    Bands are of as many rows as the solver chooses, or of `band`.
    """
    n = displacement.shape[-1]
    ux, uy = with_border(displacement)
    s, every_row = scratch(), np.ones(n + 1, bool)
    band = band or band_rows(n)
    forces = []
    for start in range(0, n, band):
        stop = min(start + band, n)
        _, broken = forces_on_band(ux, uy, rows(n, start, stop), every_row, s, *SPRINGS)
        assert broken == 0
        found = [s[int(field) :][: (stop - start) * (n + 2)] for field in (FORCE_X, FORCE_Y)]
        forces.append(np.reshape(found, (2, -1, n + 2))[:, :, 1 : n + 1])
    return np.concatenate(forces, axis=1) / STIFFNESS


def rows(n, start, stop):
    """Rows [start, stop) of N with a border, as the kernels want them."""
    return Band(*map(np.uint64, (start, stop, n, n + 2)))


def swing(displacement, steps, step, integrator="leapfrog", material=UNDAMPED):
    """Let a frictionless lattice go from `displacement` (2, N, N), in l, under a resting slider.

    Returns its displacement after so many steps.
    """
    method, n = INTEGRATORS[integrator], displacement.shape[-1]
    surface = uniform(n, 0.0, 0.0)
    state, constants = prepare(*surface, material, (0.0, 0.0), method, step)
    blocks = state.blocks
    blocks.static[:] = 0.0
    for field, u in zip((blocks.ux, blocks.uy), displacement, strict=True):
        field.reshape(n, -1)[:, : n + 2] = np.pad(u, 1, mode="edge")[1:-1]
    assert method.advance(state, constants, 0, steps, steps, Samples.empty(1))[0] == steps
    return np.stack([unpadded(u, n) for u in (blocks.ux, blocks.uy)])
