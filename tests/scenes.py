"""Scenes that several tests share, and ways to drive the compiled kernels by hand."""

import numpy as np

from springblock import Material, Pattern, draw_friction
from springblock.solver import INTEGRATORS
from springblock.solver.lattice import Samples, prepare, unpadded
from springblock.solver.springs import (
    FORCE_X,
    FORCE_Y,
    band_rows,
    coefficients,
    forces_on_band,
    scratch,
)

UNDAMPED = Material(gamma=0.0)
#: Not 1, so that it would be missed; a power of 2, so that it rounds nothing.
STIFFNESS = 0.25
#: Stiffness, its polynomial, and the slider's stiffness and place, of a lattice by itself.
SPRINGS = (STIFFNESS, coefficients(STIFFNESS), 0.0, 0.0, 0.0)


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
    size, s, every_row = lattice_size(n), scratch(), np.ones(n + 1, bool)
    band = band or band_rows(n)
    forces = []
    for start in range(0, n, band):
        stop = min(start + band, n)
        between = np.uint64(start), np.uint64(stop)
        _, broken = forces_on_band(ux, uy, *between, every_row, size, s, *SPRINGS)
        assert broken == 0
        rows = [s[int(field) :][: (stop - start) * (n + 2)] for field in (FORCE_X, FORCE_Y)]
        forces.append(np.reshape(rows, (2, -1, n + 2))[:, :, 1 : n + 1])
    return np.concatenate(forces, axis=1) / STIFFNESS


def lattice_size(n):
    """N and pitch, as the kernels want them."""
    return np.uint64(n), np.uint64(n + 2)


def swing(displacement, steps, step, integrator="leapfrog", material=UNDAMPED):
    """Let a frictionless lattice go from `displacement` (2, N, N), in l, under a resting slider.

    Returns its displacement after so many steps.
    """
    method, n = INTEGRATORS[integrator], displacement.shape[-1]
    force_time = method.force_time(step, material.gamma)
    state, constants = prepare(
        *uniform(n, 0.0, 0.0), material, (0.0, 0.0), step, force_time, method.WORK_FIELDS
    )
    state.static[:] = 0.0
    for field, u in zip((state.ux, state.uy), displacement, strict=True):
        field.reshape(n, -1)[:, : n + 2] = np.pad(u, 1, mode="edge")[1:-1]
    assert method.advance(state, constants, 0, steps, steps, Samples.empty(1))[0] == steps
    return np.stack([unpadded(u, n) for u in (state.ux, state.uy)])
