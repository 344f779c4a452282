"""The compiled kernels, driven by hand: springs by themselves, and a lattice without friction."""

import numpy as np

from springblock.accuracy.surfaces import Array, uniform
from springblock.material import Material
from springblock.simulation import SimulationError
from springblock.solver import INTEGRATORS
from springblock.solver.lattice import Samples, prepare, unpadded
from springblock.solver.springs import (
    FORCE_X,
    FORCE_Y,
    Band,
    Springs,
    band_rows,
    forces_on_band,
    pitch,
    scratch,
    width,
)

UNDAMPED = Material(gamma=0.0)
#: Not 1, so that it would be missed; a power of 2, so that it rounds nothing.
STIFFNESS = 0.25
#: Springs and slider of a lattice by itself.
SPRINGS = Springs.of(STIFFNESS, 0.0), (0.0, 0.0)


def with_border(displacement: Array) -> list[Array]:
    """Lay a displacement (2, N, N) out as the kernels want it, its edges free of strain."""
    beyond = pitch(displacement.shape[-1]) - displacement.shape[-1] - 1
    return [np.pad(u, ((0, 0), (1, beyond)), mode="edge").ravel() for u in displacement]


def spring_forces(displacement: Array, band: int | None = None) -> Array:
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
        if broken:
            raise SimulationError(f"a spring in rows {start} to {stop} has collapsed or burst")
        found = [s[int(field) :][: (stop - start) * pitch(n)] for field in (FORCE_X, FORCE_Y)]
        forces.append(np.reshape(found, (2, -1, pitch(n)))[:, :, 1 : n + 1])
    return np.concatenate(forces, axis=1) / STIFFNESS


def rows(n: int, start: int, stop: int) -> Band:
    """Rows [start, stop) of N with a border, as the kernels want them."""
    return Band(*map(np.uint64, (start, stop, n, pitch(n), width(np.uint64(n)))))


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
    surface = uniform(n, 0.0, 0.0)
    state, constants = prepare(*surface, material, (0.0, 0.0), method, step)
    blocks = state.blocks
    blocks.static[:] = 0.0
    for field, u in zip((blocks.ux, blocks.uy), displacement, strict=True):
        unpadded(field, n)[:] = u
        field.reshape(n, -1)[:, n + 1 :] = u[:, -1:]
    done = method.advance(state, constants, 0, steps, steps, Samples.empty(1))[0]
    if done < steps:
        raise SimulationError(f"a spring has collapsed or burst in step {done}")
    return np.stack([unpadded(u, n) for u in (blocks.ux, blocks.uy)])
