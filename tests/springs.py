"""Forces of the springs between blocks, by the compiled bands."""

import numpy as np

from springblock.simulation.motion import SimulationError
from springblock.solver.lattice import close_edges, close_rows, unpadded
from springblock.solver.springs import (
    FORCE_X,
    FORCE_Y,
    Band,
    Grid,
    Scratch,
    Springs,
    forces_on_band,
)

#: Not 1, so that it would be missed; a power of 2, so that it rounds nothing.
STIFFNESS = 0.25
#: Springs and slider of a lattice by itself.
SPRINGS = Springs.of(STIFFNESS, 0.0), (0.0, 0.0)


def spring_forces(displacement, band=None, periodic=False):
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
    s, every_row = Scratch.empty(), np.ones(n_y + 1, bool)
    band = band or int(grid.band_rows)
    forces = []
    for start in range(0, n_y, band):
        stop = min(start + band, n_y)
        rows = Band(np.uint64(start), np.uint64(stop), grid)
        y, x = map(int, forces_on_band(ux, uy, rows, every_row, s, *SPRINGS))
        if x:  # counted from one
            raise SimulationError(f"a spring of block ({y}, {x - 1}) has collapsed or burst")
        found = [s.force[int(field) :][: (stop - start) * pitch] for field in (FORCE_X, FORCE_Y)]
        forces.append(np.reshape(found, (2, -1, pitch))[:, :, 1 : n_x + 1])
    return np.concatenate(forces, axis=1) / STIFFNESS
