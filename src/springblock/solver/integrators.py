"""What is known of the integrators without compiling them.

The kernels are in a module of the integrator's name. It defines a class `Work` of work arrays, with

    Work.of(state, constants)                 the work arrays of a call of the time loop, and
    take_step(work, state, constants, k)      a static method that takes step k and returns its
                                              `Totals`, the switches to sliding, and row and column
                                              (from 1) of a broken spring, column 0 if none is.
"""

import math
from collections.abc import Callable
from importlib import import_module
from types import ModuleType
from typing import NamedTuple

import numpy as np

from springblock.model.material import Material
from springblock.model.numbers import Array


class Integrator(NamedTuple):
    """Properties of an integrator."""

    name: str
    order: int  #: in h, without friction
    force_evaluations: int  #: per step
    rate: float  #: CPU seconds per block and step with all blocks moving, measured by `make bench`
    staggered: bool  #: whether velocities are known half a step before displacements
    keeps_state: bool  #: whether it runs with laws from files and without healing
    force_time: Callable[[float, float], float]  #: (h, gamma) -> time for which a force acts, s
    #: (h, angular frequencies, gamma) -> whether no such mode grows.
    is_stable: Callable[[float, Array, float], bool]

    @property
    def kernels(self) -> ModuleType:
        """Its module; the first use in a process loads machine code or compiles."""
        return import_module(f"springblock.solver.{self.name}")


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


LEAPFROG = Integrator(
    "leapfrog",
    order=2,
    force_evaluations=1,
    rate=4.5e-9,
    staggered=True,
    keeps_state=True,
    force_time=leapfrog_force_time,
    is_stable=leapfrog_is_stable,
)
RK4 = Integrator(
    "rk4",
    order=4,
    force_evaluations=4,
    rate=33e-9,
    staggered=False,
    keeps_state=False,
    force_time=lambda step, gamma: step,  # damping is a force
    is_stable=rk4_is_stable,
)
INTEGRATORS = {each.name: each for each in (LEAPFROG, RK4)}


def is_stable(integrator: str, step: float, material: Material) -> bool:
    """Return whether no mode of the lattice grows."""
    omega = np.linspace(material.omega_min, material.omega_max, 33)
    return INTEGRATORS[integrator].is_stable(step, omega, material.gamma)


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
