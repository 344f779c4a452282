"""The compiled core: springs, friction, and the two integrators behind one narrow interface.

An integrator is a module with

    FORCE_EVALUATIONS   per step
    WORK_FIELDS         lattice-sized fields that it keeps for itself
    is_stable(step, omega, gamma)           whether no mode of these frequencies grows
    force_time(step, gamma)                 how long a force acts in one step
    advance(state, constants, first, steps, every, samples)
    at_step(state, constants, steps)        velocity and friction's heat at the last step
"""

from springblock.solver import leapfrog, rk4

INTEGRATORS = {"leapfrog": leapfrog, "rk4": rk4}
