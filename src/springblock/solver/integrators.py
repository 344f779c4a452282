"""The integrators by name, on one core or several.

An integrator is a module of this package that defines

    FORCE_EVALUATIONS           force evaluations per step,
    WORK_FIELDS                 number of work fields of a `State`,
    force_time(step, gamma)     time for which a force acts in one step, s,
    advance                     an `Advance` on one core,
    at_step(state, constants, steps)
                                velocity, (2, lattice) in l per step, after so many steps, and the
                                frictional heat so far.
"""

from functools import partial
from types import ModuleType
from typing import Any

from springblock.model.numbers import check_whole
from springblock.solver import leapfrog, parallel, rk4
from springblock.solver.lattice import Advance

INTEGRATORS: dict[str, ModuleType] = {"leapfrog": leapfrog, "rk4": rk4}


def on_cores(integrator: str, cores: Any) -> Advance:
    """Return `advance` for this number of cores; refuse numbers that it cannot use."""
    if check_whole("cores", cores) == 1:
        return INTEGRATORS[integrator].advance
    if integrator != "leapfrog":
        raise ValueError(f"cores must be 1 with {integrator}, not {cores}")
    return partial(parallel.advance, cores=cores)
