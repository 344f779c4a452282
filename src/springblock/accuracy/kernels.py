"""The compiled kernels, driven by hand: springs by themselves, and a lattice without friction."""

import numpy as np

from springblock.accuracy.surfaces import Array, uniform
from springblock.material import Material
from springblock.realisation import SimulationError
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


def with_border(displacement: Array) -> list[Array]:
    """Lay a displacement (2, N, N) out as the kernels want it, its edges free of strain."""
    return [np.pad(u, 1, mode="edge")[1:-1].ravel() for u in displacement]


def spring_forces(displacement: Array, band: int | None = None) -> Array:
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
        if broken:
            raise SimulationError(f"a spring in rows {start} to {stop} has collapsed or burst")
        rows = [s[int(field) :][: (stop - start) * (n + 2)] for field in (FORCE_X, FORCE_Y)]
        forces.append(np.reshape(rows, (2, -1, n + 2))[:, :, 1 : n + 1])
    return np.concatenate(forces, axis=1) / STIFFNESS


def lattice_size(n: int) -> tuple[np.uint64, np.uint64]:
    """N and pitch, as the kernels want them."""
    return np.uint64(n), np.uint64(n + 2)


def swing(
    displacement: Array,
    steps: int,
    step: float,
    integrator: str = "leapfrog",
    material: Material = UNDAMPED,
) -> Array:
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
    done = method.advance(state, constants, 0, steps, steps, Samples.empty(1))[0]
    if done < steps:
        raise SimulationError(f"a spring has collapsed or burst in step {done}")
    return np.stack([unpadded(u, n) for u in (state.ux, state.uy)])
