"""Stability limits of both schemes, and their exact solutions for a lattice without friction."""

import math
from typing import Any

import numpy as np

from springblock.accuracy.specimens import Array
from springblock.model.material import Material
from springblock.solver.stability import IS_STABLE

#: Greatest stable omega h of a mode without damping.
STABLE = {"leapfrog": 2.0, "rk4": math.sqrt(8.0)}


def limit(integrator: str, material: Material) -> float:
    """Return the largest stable step, s, by bisection of the integrator's own criterion."""
    omega = np.linspace(material.omega_min, material.omega_max, 33)
    is_stable = IS_STABLE[integrator]
    stable, unstable = 0.0, 4.0 * (1.0 + material.gamma / material.omega_max) / material.omega_max
    for _ in range(50):
        middle = 0.5 * (stable + unstable)
        if is_stable(middle, omega, material.gamma):
            stable = middle
        else:
            unstable = middle
    return stable


def limit_of_damping(integrator: str, material: Material) -> float:
    """Return the largest stable step far overdamped, s.

    Leapfrog's omega² h/gamma stays below 2. In Runge-Kutta, the fastest decay of all, that of the
    lowest mode, stays within the real interval where |1 + z + z²/2 + z³/6 + z⁴/24| < 1.
    """
    gamma = material.gamma
    if integrator == "leapfrog":
        return 2.0 * gamma / material.omega_max**2
    decay = gamma / 2.0 + math.sqrt(gamma**2 / 4.0 - material.omega_min**2)
    return 2.785293563405282 / decay


def turn(phase: Array | float) -> Any:
    """Return a mode's factor per Runge-Kutta step: the Taylor polynomial of exp(i omega h)."""
    z = 1j * np.asarray(phase)
    return 1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0)))


def swing_factor(integrator: str, phase: float, taken: int) -> float:
    """Return a mode's amplitude after so many steps of phase omega h, from 1 at rest.

    Leapfrog is at rest half a step before: cos((k + 1/2) theta)/cos(theta/2), where
    sin(theta/2) = omega h/2; beyond its limit, theta is complex.
    """
    if integrator == "leapfrog":
        half = np.arcsin(complex(phase / 2.0))
        return float((np.cos((2 * taken + 1) * half) / np.cos(half)).real)
    return float((turn(phase) ** taken).real)


def path(integrator: str, phase: Array, taken: int) -> Array:
    """Return the displacement of modes (k,) of phase omega h, in steps of the slider.

    Exact solution of the schemes for u" = omega² (t - u), from u = u' = 0 at t = 0, time in steps:
    the straight line t, and the scheme's own oscillation about it.
    """
    if integrator == "leapfrog":  # sin(theta/2) = omega h/2; u = 0 also one step before
        theta = 2.0 * np.arcsin(phase / 2.0)
        return taken - 1.0 / np.sin(theta) * np.sin(taken * theta)
    return taken - (turn(phase) ** taken).imag / phase
