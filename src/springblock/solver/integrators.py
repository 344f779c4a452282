"""The integrators by name, on one core or several."""

from functools import partial
from typing import Any

from springblock.solver import leapfrog, parallel, rk4
from springblock.solver.lattice import Advance, Integrator

INTEGRATORS: dict[str, Integrator] = {"leapfrog": leapfrog, "rk4": rk4}


def on_cores(integrator: str, cores: Any) -> Advance:
    """Return `Integrator.advance` for this number of cores.

    Raises
    ------
    TypeError, ValueError
        If `cores` is not a positive whole number, or more than the integrator can use.
    """
    if isinstance(cores, bool) or not isinstance(cores, int):
        raise TypeError(f"cores must be a whole number, not {cores!r}")
    if cores < 1:
        raise ValueError(f"cores must be at least 1, not {cores}")
    if cores == 1:
        return INTEGRATORS[integrator].advance
    if integrator != "leapfrog":
        raise ValueError(f"cores must be 1 with {integrator}, not {cores}")
    return partial(parallel.advance, cores=cores)
