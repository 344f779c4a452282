"""The stability limit: steps up to it and beyond, and the highest modes that set it."""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import cache, partial

import numpy as np
from scipy.sparse.linalg import LinearOperator, eigsh

from springblock.accuracy import kernels
from springblock.accuracy.kernels import UNDAMPED, spring_forces
from springblock.accuracy.specimens import Array, drawn
from springblock.accuracy.stability.cases import (
    FRICTION,
    LARGEST,
    PAPER,
    SEED,
    Case,
    Outcome,
    Pull,
    compared,
    named_after,
    pulled_at,
    release,
)
from springblock.model.material import Material
from springblock.model.pattern import Pattern
from springblock.simulation.run import Realisation

#: Avalanches on pillars excite the highest modes.
PILLARS = Pattern.pillars(8, 2, 2)
SYRUP = Material(gamma=10.0 * PAPER.omega_max, slider_velocity=5e-3)
#: Ten times the paper's pressure, on a quarter of the blocks: they slip by 0.27 l.
HEAVY = pulled_at(1e-3, replace(PAPER, pressure=10.0 * PAPER.pressure))
TINY = 1e-9  #: spacings, far within the linear range of the springs


def steps(integrator: str) -> Iterator[Case]:
    """Steps up to the stability limit and beyond, without damping and far overdamped."""
    case = partial(Case, "step", integrator)
    for share in (0.05, 0.1, 0.2, 0.5, 0.8, 0.9, 0.95, 0.99):
        name = f"pillars at {share:.0%} of the limit"
        yield case(name, share, FRICTION, near_the_limit, (PAPER, share), "stable")
    edge = kernels.STABLE[integrator] / PAPER.omega_max
    for share in (1.001, 1.01, 1.5, 10.0):
        name, arguments = f"pillars at {share:g} times the limit", (PAPER, share * edge, edge)
        yield case(name, share, LARGEST, beyond_the_limit, arguments, "refused")
    name, share = "strained pillars at 99% of the limit", 0.99
    yield case(name, share, FRICTION, near_the_limit, (HEAVY, share), "stable")
    name = "overdamped pillars at 99% of the limit"
    yield case(name, share, FRICTION, near_the_limit_of_damping, (share,), "bounded")
    edge = kernels.limit_of_damping(integrator, SYRUP)
    name, share = "overdamped pillars at 1.01 times the limit", 1.01
    yield case(name, share, LARGEST, beyond_the_limit, (SYRUP, share * edge, edge), "refused")
    for share, expected in ((0.99, "bounded"), (1.01, "grows")):
        name, quantity = f"highest mode at {share:.0%} of its limit", "amplitude after 30 steps"
        yield case(name, share, quantity, swing_of_the_highest_mode, (share,), expected)


def pull_pillars(pull: Pull) -> Realisation:
    """Pull until all pillars have slipped, sampled as in the paper."""
    return pull.simulate(drawn(PILLARS, SEED), every=max(1, round(2e-7 / pull.step)))


def near_the_limit(integrator: str, material: Material, share: float) -> Outcome:
    """Judge the energy balance, where too long a step shows first."""
    pull = Pull.at(share, integrator, material)
    run = pull_pillars(pull)
    word = "stable" if pull.keeps_energy(run) else "drifts"
    return Outcome(word, run.energy.relative_residual, run.static_friction)


def near_the_limit_of_damping(integrator: str, share: float) -> Outcome:
    """Compare static friction with that at a fifth of the limit; overdamped, blocks only creep.

    It may be off by what the slider adds in a step, v h, and that is much for leapfrog.
    Energy is not asked for. Runge-Kutta's ledger takes the heat of damping from the velocities of
    the stages, which overshoot beyond gamma h = 1: close to the limit it books many times too much.
    """
    pull = Pull.at(share, integrator, SYRUP)
    run, fine = (pull_pillars(p) for p in (pull, Pull.at(0.2, integrator, SYRUP)))
    closed_form = fine.static_friction
    tolerance = pull.step / release(SYRUP) / closed_form
    residual = run.energy.relative_residual
    return compared(run.static_friction, closed_form, tolerance, "bounded", residual)


def beyond_the_limit(integrator: str, material: Material, step: float, largest: float) -> Outcome:
    """Read the limit in the refusal: four digits, found by bisection to 1e-4; both in s."""
    try:
        pull_pillars(Pull(integrator, material, step))
    except ValueError as error:
        named, unit = named_after("less than ", error), 1.0 / material.omega_max
        return compared(named / unit, largest / unit, 1e-3, "refused")
    return Outcome("accepted")


@cache
def highest_mode(n: int) -> tuple[float, Array]:
    """Return the largest m omega²/K_int of the actual springs, and its mode (2, N, N)."""
    size = 2 * n * n

    def pull_back(mode: Array) -> Array:
        return -spring_forces(TINY * mode.reshape(2, n, n)).ravel() / TINY

    start = np.random.default_rng(SEED).standard_normal(size)
    springs = LinearOperator((size, size), matvec=pull_back, dtype=float)
    values, modes = eigsh(springs, k=1, which="LA", v0=start, tol=1e-9)
    return float(values[0]), modes[:, 0].reshape(2, n, n)


def limit_of_the_springs(_: str, n: int) -> Outcome:
    """A finite lattice has a mode close to (π, 0), and none beyond; it is off by some (π/N)²."""
    omega = math.sqrt((PAPER.k_s + PAPER.k_int * highest_mode(n)[0]) / PAPER.mass)
    value = omega / PAPER.omega_max
    word = "just below" if value <= 1.0 else "above"
    return compared(value, 1.0, (math.pi / n) ** 2, word)


HIGHEST_MODE = Case(
    "step",
    "both",
    "highest mode of 32 x 32 blocks",
    1.0,
    "frequency, omega_max",
    limit_of_the_springs,
    (32,),
    "just below",
)


def swing_of_the_highest_mode(integrator: str, share: float) -> Outcome:
    """Compare the highest mode of 8 x 8 blocks, by the compiled loop, with the scheme's factor.

    From 1e-9 spacings it grows to 2e-5, and is non-linear by the square of that.
    """
    taken, (eigenvalue, mode) = 30, highest_mode(8)
    omega = math.sqrt((UNDAMPED.k_s + UNDAMPED.k_int * eigenvalue) / UNDAMPED.mass)
    phase = share * kernels.STABLE[integrator]
    swung = kernels.swing(TINY * mode, taken, phase / omega, integrator)
    value = float(np.vdot(mode, swung)) / TINY
    # leapfrog starts from rest half a step before, and so below its amplitude
    bound = 1.0
    if integrator == "leapfrog":
        bound /= abs(np.cos(np.arcsin(complex(phase / 2.0))))
    word = "bounded" if abs(value) <= bound else "grows"
    return compared(value, kernels.swing_factor(integrator, phase, taken), 1e-6, word)
