"""A lattice without friction or damping, by the compiled integrators driven by hand."""

import numpy as np
from numpy.typing import NDArray

from springblock.model.material import Material
from springblock.model.surface import Surface
from springblock.simulation.motion import SimulationError
from springblock.solver.integrators import INTEGRATORS
from springblock.solver.lattice import Samples, close_edges, prepare, unpadded
from springblock.solver.loop import advance

Array = NDArray[np.float64]

UNDAMPED = Material(gamma=0.0)


def swing(
    displacement: Array,
    steps: int,
    step: float,
    integrator: str = "leapfrog",
    periodic: bool = False,
) -> Array:
    """Let a frictionless lattice go from `displacement` (2, N_y, N_x), in l, the slider at rest.

    Returns its displacement after so many steps.
    """
    method, shape = INTEGRATORS[integrator], displacement.shape[1:]
    surface = Surface(np.ones(shape, bool), 0.0, 0.0, periodic)
    state, constants = prepare(surface, UNDAMPED, (0.0, 0.0), method, step)
    blocks, grid = state.blocks, constants.grid
    blocks.static[:] = 0.0
    for field, u in zip((blocks.ux, blocks.uy), displacement, strict=True):
        unpadded(field, grid)[:] = u
    close_edges(blocks.ux, blocks.uy, grid)
    done = advance(method, state, constants, 0, steps, steps, Samples.empty(1))[0]
    if done < steps:
        raise SimulationError(f"a spring has collapsed or burst in step {done}")
    return np.stack([unpadded(u, grid) for u in (blocks.ux, blocks.uy)])
