"""Stability of the integrators, in a module that compiles nothing."""

import math
from collections.abc import Callable

import numpy as np

from springblock.model.material import Material
from springblock.model.numbers import Array


def leapfrog_is_stable(step: float, omega: Array, gamma: float) -> bool:
    """Return whether no mode of angular frequency `omega` grows.

    A mode obeys u⁺ - (1 + a - c) u + a u⁻ = 0 with a = exp(-γh) and c = ω² h (1 - a)/γ. No root
    lies outside the unit circle if c < 2 (1 + a); without damping, if h < 2/ω.
    """
    c = np.asarray(omega) ** 2 * step * leapfrog_force_time(step, gamma)
    return bool(np.all(c < 2.0 * (1.0 + math.exp(-gamma * step))))


def leapfrog_force_time(step: float, gamma: float) -> float:
    """Time for which a force acts in one step, s: (1 - exp(-γh))/γ; h without damping.

    It is h also if γh is nearly subnormal, since subnormal numbers have fewer digits.
    """
    return -math.expm1(-gamma * step) / gamma if gamma * step > 1e-300 else step


def rk4_is_stable(step: float, omega: Array, gamma: float) -> bool:
    """Return whether no mode of frequency `omega` grows: |R(λh)| ≤ 1, λ² + γλ + ω² = 0."""
    root = np.sqrt(np.asarray(gamma * gamma / 4.0 - omega * omega, dtype=complex))
    z = step * np.concatenate([-gamma / 2.0 + root, -gamma / 2.0 - root])
    growth = np.abs(1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0))))
    return bool(np.all(growth <= 1.0 + 1e-12))


#: By integrator: (step, angular frequencies, gamma) -> whether no such mode grows.
IS_STABLE: dict[str, Callable[[float, Array, float], bool]] = {
    "leapfrog": leapfrog_is_stable,
    "rk4": rk4_is_stable,
}


def is_stable(integrator: str, step: float, material: Material) -> bool:
    """Return whether no mode of the lattice grows."""
    omega = np.linspace(material.omega_min, material.omega_max, 33)
    return IS_STABLE[integrator](step, omega, material.gamma)


def limit(integrator: str, material: Material) -> float:
    """Return the largest stable step, s, by bisection of `is_stable`."""
    stable, unstable = 0.0, 4.0 * (1.0 + material.gamma / material.omega_max) / material.omega_max
    for _ in range(50):
        middle = 0.5 * (stable + unstable)
        if is_stable(integrator, middle, material):
            stable = middle
        else:
            unstable = middle
    return stable
