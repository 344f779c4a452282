"""What both schemes do exactly to a lattice without friction, at small strains."""

import math
from typing import Any

import numpy as np

from springblock.accuracy.surfaces import Array
from springblock.model.material import Material
from springblock.solver import INTEGRATORS

#: Greatest stable omega h of a mode without damping.
STABLE = {"leapfrog": 2.0, "rk4": math.sqrt(8.0)}


def limit(integrator: str, material: Material) -> float:
    """Largest stable step, s, by bisection of the integrator's own criterion."""
    omega = np.linspace(material.omega_min, material.omega_max, 33)
    is_stable = INTEGRATORS[integrator].is_stable
    stable, unstable = 0.0, 4.0 * (1.0 + material.gamma / material.omega_max) / material.omega_max
    for _ in range(50):
        middle = 0.5 * (stable + unstable)
        if is_stable(middle, omega, material.gamma):
            stable = middle
        else:
            unstable = middle
    return stable


def limit_of_damping(integrator: str, material: Material) -> float:
    """Largest stable step far overdamped, s.

    Leapfrog's omega² h/gamma stays below 2. In Runge-Kutta, the fastest decay of all, that of the
    lowest mode, stays within the real interval where |1 + z + z²/2 + z³/6 + z⁴/24| < 1.
    """
    gamma = material.gamma
    if integrator == "leapfrog":
        return 2.0 * gamma / material.omega_max**2
    decay = gamma / 2.0 + math.sqrt(gamma**2 / 4.0 - material.omega_min**2)
    return 2.785293563405282 / decay


def turn(phase: Array | float) -> Any:
    """Factor of a mode per Runge-Kutta step: the Taylor polynomial of exp(i omega h)."""
    z = 1j * np.asarray(phase)
    return 1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0)))


def path(integrator: str, phase: Array, taken: int) -> Array:
    """Displacement of modes (k,) of phase omega h after so many steps; one is the slider's step.

    Exact solution of the schemes for u" = omega² (t - u), from u = u' = 0 at t = 0, time in steps:
    the straight line t, and the scheme's own oscillation about it.
    """
    if integrator == "leapfrog":  # sin(theta/2) = omega h/2; u = 0 also one step before
        theta = 2.0 * np.arcsin(phase / 2.0)
        return taken - 1.0 / np.sin(theta) * np.sin(taken * theta)
    return taken - (turn(phase) ** taken).imag / phase
