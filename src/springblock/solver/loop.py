"""The time loop, the same for all integrators."""

import numpy as np

from springblock.model.numbers import Array
from springblock.solver.compilation import kernel, method
from springblock.solver.integrators import Integrator
from springblock.solver.lattice import HEAT, Constants, Lattice, Samples, tally

#: (work, state, constants, k), see `integrators`.
take_step = method("take_step")


@kernel
def _loop(work, state, constants, first, steps, every, samples):
    switches = np.int64(0)
    for k in range(first, first + steps):
        totals, more, row, column = take_step(work, state, constants, k)
        if column > 0:
            return k - first, np.int64(row), np.int64(column) - 1
        switches += more
        switches = tally(state.ledger, samples, constants, totals, switches, k, first, every)
    return steps, np.int64(-1), np.int64(-1)


def advance(
    integrator: Integrator,
    state: Lattice,
    constants: Constants,
    first: int,
    steps: int,
    every: int,
    samples: Samples,
) -> tuple[int, int, int]:
    """Advance a state by `steps` steps from step `first` on, and sample after every `every` steps.

    Returns the number of steps taken, and row and column of a broken spring, -1 if none is.
    """
    work = integrator.kernels.Work.of(state, constants)
    return _loop(work, state, constants, first, steps, every, samples)


def at_step(
    integrator: Integrator, state: Lattice, constants: Constants, steps: int
) -> tuple[Array, float]:
    """Velocity (2, lattice) after `steps` steps, in l per step, and the frictional heat so far.

    If velocities are half a step earlier, both are means of the values before and after; those
    after are computed on a copy.
    """
    after = state
    if integrator.staggered:
        after = state.copy()
        advance(integrator, after, constants, steps, 1, 1, Samples.empty(1))
    before, blocks = state.blocks, after.blocks
    velocity = np.stack([before.vx + blocks.vx, before.vy + blocks.vy]) / 2.0
    return velocity, float(state.ledger[HEAT] + after.ledger[HEAT]) / 2.0
