"""The compiled core: springs, friction, and the integrators behind one narrow interface."""

from springblock.solver import leapfrog, rk4
from springblock.solver.lattice import Integrator

INTEGRATORS: dict[str, Integrator] = {"leapfrog": leapfrog, "rk4": rk4}
