"""The compiled kernels, driven by hand: springs by themselves, and a lattice without friction."""

import numpy as np

from springblock.accuracy.specimens import Array
from springblock.model.material import Material
from springblock.simulation.simulate import SimulationError
from springblock.solver.integrators import INTEGRATORS
from springblock.solver.lattice import Samples, close_edges, close_rows, prepare, unpadded
from springblock.solver.springs import (
    FORCE_X,
    FORCE_Y,
    Band,
    Grid,
    Springs,
    forces_on_band,
    scratch,
)

UNDAMPED = Material(gamma=0.0)
#: Not 1, so that it would be missed; a power of 2, so that it rounds nothing.
STIFFNESS = 0.25
#: Springs and slider of a lattice by itself.
SPRINGS = Springs.of(STIFFNESS, 0.0), (0.0, 0.0)


def spring_forces(displacement: Array, band: int | None = None, periodic: bool = False) -> Array:
    """Return F_int/(K_int l), (2, N_y, N_x), by the compiled bands, for displacements in l.

    Bands are of as many rows as the solver chooses, or of `band`.
    """
    grid = Grid.of(displacement.shape[1:], periodic)
    (n_y, n_x), pitch = grid.shape, int(grid.pitch)
    ux, uy = (np.zeros((n_y + periodic) * pitch) for _ in displacement)
    for field, u in zip((ux, uy), displacement, strict=True):
        unpadded(field, grid)[:] = u
    close_edges(ux, uy, grid)
    close_rows(ux, uy, grid)
    s, every_row = scratch(), np.ones(n_y + 1, bool)
    band = band or int(grid.band_rows)
    forces = []
    for start in range(0, n_y, band):
        stop = min(start + band, n_y)
        rows = Band(np.uint64(start), np.uint64(stop), grid)
        y, x = map(int, forces_on_band(ux, uy, rows, every_row, s, *SPRINGS))
        if x:  # counted from one
            raise SimulationError(f"a spring of block ({y}, {x - 1}) has collapsed or burst")
        found = [s[int(field) :][: (stop - start) * pitch] for field in (FORCE_X, FORCE_Y)]
        forces.append(np.reshape(found, (2, -1, pitch))[:, :, 1 : n_x + 1])
    return np.concatenate(forces, axis=1) / STIFFNESS


def swing(
    displacement: Array,
    steps: int,
    step: float,
    integrator: str = "leapfrog",
    material: Material = UNDAMPED,
    periodic: bool = False,
) -> Array:
    """Let a frictionless lattice go from `displacement` (2, N_y, N_x), in l, the slider at rest.

    Returns its displacement after so many steps.
    """
    method, shape = INTEGRATORS[integrator], displacement.shape[1:]
    surface = np.ones(shape, bool), np.zeros(shape), np.zeros(shape)
    state, constants = prepare(*surface, material, (0.0, 0.0), method, step, periodic=periodic)
    blocks, grid = state.blocks, constants.grid
    blocks.static[:] = 0.0
    for field, u in zip((blocks.ux, blocks.uy), displacement, strict=True):
        unpadded(field, grid)[:] = u
    close_edges(blocks.ux, blocks.uy, grid)
    done = method.advance(state, constants, 0, steps, steps, Samples.empty(1))[0]
    if done < steps:
        raise SimulationError(f"a spring has collapsed or burst in step {done}")
    return np.stack([unpadded(u, grid) for u in (blocks.ux, blocks.uy)])
