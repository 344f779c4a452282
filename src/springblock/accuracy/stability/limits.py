"""Limits of what is computed: the stability limit, and numbers beyond floating point."""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import cache, partial
from typing import Any

import numpy as np
from scipy.sparse.linalg import LinearOperator, eigsh

from springblock.accuracy.kernels import UNDAMPED, spring_forces, swing
from springblock.accuracy.specimens import Array, drawn, flat
from springblock.accuracy.stability.cases import (
    FRICTION,
    PAPER,
    SEED,
    Case,
    Family,
    Outcome,
    Pull,
    compared,
    pulled_at,
    refusal,
    release,
)
from springblock.accuracy.stability.schemes import STABLE, limit_of_damping, swing_factor
from springblock.model.material import Material
from springblock.model.pattern import Pattern
from springblock.simulation.run import Realisation

LARGEST = "omega_max times the largest step"
#: Avalanches on pillars excite the highest modes.
PILLARS = Pattern.pillars(8, 2, 2)
SYRUP = Material(gamma=10.0 * PAPER.omega_max, slider_velocity=5e-3)
#: Ten times the paper's pressure, on a quarter of the blocks: they slip by 0.27 l.
HEAVY = pulled_at(1e-3, replace(PAPER, pressure=10.0 * PAPER.pressure))


def steps(integrator: str) -> Iterator[Case]:
    """Steps up to the stability limit and beyond, without damping and far overdamped."""
    case = Family("step", integrator).case
    for share in (0.05, 0.1, 0.2, 0.5, 0.8, 0.9, 0.95, 0.99):
        name = f"pillars at {share:.0%} of the limit"
        yield case(name, share, FRICTION, near_the_limit, PAPER, share, expected="stable")
    edge = STABLE[integrator] / PAPER.omega_max
    for share in (1.001, 1.01, 1.5, 10.0):
        name, arguments = f"pillars at {share:g} times the limit", (PAPER, share * edge, edge)
        yield case(name, share, LARGEST, beyond_the_limit, *arguments, expected="refused")
    name, share = "strained pillars at 99% of the limit", 0.99
    yield case(name, share, FRICTION, near_the_limit, HEAVY, share, expected="stable")
    name = "overdamped pillars at 99% of the limit"
    yield case(name, share, FRICTION, near_the_limit_of_damping, share, expected="bounded")
    edge = limit_of_damping(integrator, SYRUP)
    name, share = "overdamped pillars at 1.01 times the limit", 1.01
    arguments = (SYRUP, share * edge, edge)
    yield case(name, share, LARGEST, beyond_the_limit, *arguments, expected="refused")
    for share, expected in ((0.99, "bounded"), (1.01, "grows")):
        name, quantity = f"highest mode at {share:.0%} of its limit", "amplitude after 30 steps"
        yield case(name, share, quantity, swing_of_the_highest_mode, share, expected=expected)


def pull_pillars(pull: Pull) -> Realisation:
    """Pull until all pillars have slipped, sampled as in the paper."""
    return pull.simulate(drawn(PILLARS, SEED), every=max(1, round(2e-7 / pull.step)))


def near_the_limit(integrator: str, material: Material, share: float) -> Outcome:
    """Judge the energy balance, where too long a step shows first."""
    pull = Pull.at(share, integrator, material)
    run = pull_pillars(pull)
    residual = run.energy.relative_residual
    bounded = abs(residual) <= pull.may_miss(run, int(PILLARS.contact.sum()))
    return Outcome("stable" if bounded else "drifts", residual, run.static_friction)


def near_the_limit_of_damping(integrator: str, share: float) -> Outcome:
    """Compare static friction with that at a fifth of the limit; overdamped, blocks only creep.

    It may be off by what the slider adds in a step, v h, and that is much for leapfrog.
    Energy is not asked for. Runge-Kutta's ledger takes the heat of damping from the velocities of
    the stages, which overshoot beyond gamma h = 1: close to the limit it books many times too much.
    """
    pull = Pull.at(share, integrator, SYRUP)
    run, fine = (pull_pillars(p) for p in (pull, Pull.at(0.2, integrator, SYRUP)))
    closed_form = fine.static_friction
    tolerance = pull.step / release(SYRUP, 1.0) / closed_form
    words, residual = ("bounded", "disagrees"), run.energy.relative_residual
    return compared(run.static_friction, closed_form, tolerance, words, residual)


def beyond_the_limit(integrator: str, material: Material, step: float, largest: float) -> Outcome:
    """Read the limit in the refusal: four digits, found by bisection to 1e-4; both in s."""
    try:
        pull_pillars(Pull(integrator, material, step))
    except ValueError as error:
        named, unit = float(str(error).split("less than ")[1].split()[0]), 1.0 / material.omega_max
        return compared(named / unit, largest / unit, 1e-3, ("refused", "names another limit"))
    return Outcome("accepted")


@cache
def highest_mode(n: int) -> tuple[float, Array]:
    """Return the largest m omega²/K_int of the actual springs, and its mode (2, N, N)."""
    tiny, size = 1e-9, 2 * n * n

    def pull_back(mode: Array) -> Array:
        return -spring_forces(tiny * mode.reshape(2, n, n)).ravel() / tiny

    start = np.random.default_rng(SEED).standard_normal(size)
    springs = LinearOperator((size, size), matvec=pull_back, dtype=float)
    values, modes = eigsh(springs, k=1, which="LA", v0=start, tol=1e-9)
    return float(values[0]), modes[:, 0].reshape(2, n, n)


def limit_of_the_springs(n: int) -> Outcome:
    """A finite lattice has a mode close to (π, 0), and none beyond; it is off by some (π/N)²."""
    omega = math.sqrt((PAPER.k_s + PAPER.k_int * highest_mode(n)[0]) / PAPER.mass)
    value, tolerance = omega / PAPER.omega_max, (math.pi / n) ** 2
    word = "just below" if value <= 1.0 else "elsewhere"
    return compared(value, 1.0, tolerance, (word, "elsewhere"))


def swing_of_the_highest_mode(integrator: str, share: float) -> Outcome:
    """Compare the highest mode of 8 x 8 blocks, by the compiled loop, with the scheme's factor.

    From 1e-9 spacings it grows to 2e-5, and is non-linear by the square of that.
    """
    taken, tiny = 30, 1e-9
    eigenvalue, mode = highest_mode(8)
    omega = math.sqrt((UNDAMPED.k_s + UNDAMPED.k_int * eigenvalue) / UNDAMPED.mass)
    phase = share * STABLE[integrator]
    value = float(np.vdot(mode, swing(tiny * mode, taken, phase / omega, integrator))) / tiny
    # leapfrog starts from rest half a step before, and so below its amplitude
    bound = 1.0
    if integrator == "leapfrog":
        bound /= abs(np.cos(np.arcsin(complex(phase / 2.0))))
    word = "bounded" if abs(value) <= bound else "grows"
    closed_form = swing_factor(integrator, phase, taken)
    return compared(value, closed_form, 1e-6, (word, "disagrees"))


def highest_mode_case() -> Case:
    """Return the case of the springs by themselves, where no step is taken."""
    name, n = "highest mode of 32 x 32 blocks", 32
    attempt = partial(limit_of_the_springs, n)
    return Case(name, "step", "both", 1.0, "just below", "frequency, omega_max", attempt)


def overflows(integrator: str) -> Iterator[Case]:
    """Thresholds and constants that are no numbers, and sliders too fast to follow."""
    case, none = Family("overflow", integrator).case, "none"
    for value in (math.nan, math.inf, -1.0):
        name = f"mu_s = {value} in one block"
        yield case(name, value, none, refused_threshold, value, expected="refused")
    for key, value in (("pressure", math.nan), ("slider_velocity", math.inf), ("spacing", 0.0)):
        name, arguments = f"{key} = {value}", (f"Material.{key} must be finite", {key: value})
        yield case(name, value, none, refused_constants, *arguments, expected="refused")
    for what, derived, changes in (
        ("stiffness", "k_int", {"youngs_modulus": 1e308, "thickness": 1e5}),
        ("mass", "mass", {"density": 1e308, "spacing": 1e3}),
        ("load", "block_load", {"pressure": 1e308, "spacing": 1e10, "thickness": 1e10}),
    ):
        reason = f"Material.{derived} beyond floating point"
        name = f"{what} beyond the largest float"
        yield case(name, 1e308, none, refused_constants, reason, changes, expected="refused")
    for name, n, speed in (
        ("speed whose energy overflows", 1, 1e160),
        ("largest speed", 1, 1e308),
        ("speed that tears the springs", 3, 1e160),
    ):
        yield case(name, speed, none, failing_speed, n, speed, expected="raises")


def ten_steps(integrator: str, n: int, mu_static: float = 1.0, **changes: Any) -> Realisation:
    """Take ten steps of the paper's surface with one other threshold and other constants."""
    contact, thresholds, mu_dynamic = flat(n, SEED)
    thresholds[0, 0] = mu_static
    pull = Pull(integrator, replace(PAPER, **changes), 2e-8)
    return pull.simulate((contact, thresholds, mu_dynamic), 10)


def refused_threshold(integrator: str, value: float) -> Outcome:
    """Expect a refusal before any step."""
    return refusal(lambda: ten_steps(integrator, 3, value), "mu_static must be finite")


def refused_constants(integrator: str, reason: str, changes: dict[str, float]) -> Outcome:
    """Expect a refusal before any step."""
    return refusal(lambda: ten_steps(integrator, 3, **changes), reason)


def failing_speed(integrator: str, n: int, speed: float) -> Outcome:
    """Expect an error that names the time."""
    run = partial(ten_steps, integrator, n, slider_velocity=speed)
    return refusal(run, "at t = ", during_run=True)
