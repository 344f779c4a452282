"""Steps up to the stability limit and beyond, without damping and far overdamped."""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import cache, partial

import numpy as np
from scipy.sparse.linalg import LinearOperator, eigsh

from springblock.accuracy.kernels import UNDAMPED, spring_forces, swing
from springblock.accuracy.stability.cases import FRICTION, LARGEST, Case, Family, Outcome, compared
from springblock.accuracy.stability.pull import PAPER, SEED, Pull, pulled_at, release
from springblock.accuracy.stability.schemes import STABLE, limit_of_damping, turn
from springblock.accuracy.surfaces import Array, drawn
from springblock.model.material import Material
from springblock.model.pattern import Pattern
from springblock.simulation.run import Realisation

#: Avalanches on pillars excite the highest modes.
PILLARS = Pattern.pillars(8, 2, 2)
SHARES = (0.05, 0.1, 0.2, 0.5, 0.8, 0.9, 0.95, 0.99)
BEYOND = (1.001, 1.01, 1.5, 10.0)
SYRUP = Material(gamma=10.0 * PAPER.omega_max, slider_velocity=5e-3)
#: Ten times the paper's pressure, on a quarter of the blocks: they slip by 0.27 l.
HEAVY = pulled_at(1e-3, replace(PAPER, pressure=10.0 * PAPER.pressure))


def pull_pillars(pull: Pull) -> Realisation:
    """Until all pillars have slipped, sampled as in the paper."""
    return pull.simulate(drawn(PILLARS, SEED), every=max(1, round(2e-7 / pull.step)))


def near_the_limit(integrator: str, material: Material, share: float) -> Outcome:
    """Too long a step shows in the energy first."""
    pull = Pull.at(share, integrator, material)
    run = pull_pillars(pull)
    residual = run.energy.relative_residual
    bounded = abs(residual) <= pull.may_miss(run, int(PILLARS.contact.sum()))
    return Outcome("stable" if bounded else "drifts", residual, run.static_friction)


def near_the_limit_of_damping(integrator: str, share: float) -> Outcome:
    """Static friction beside that at a fifth of the limit; overdamped, blocks only creep.

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
    """The message names the limit in four digits, found by bisection to 1e-4; both in s."""
    try:
        pull_pillars(Pull(integrator, material, step))
    except ValueError as error:
        named, unit = float(str(error).split("less than ")[1].split()[0]), 1.0 / material.omega_max
        return compared(named / unit, largest / unit, 1e-3, ("refused", "names another limit"))
    return Outcome("accepted")


@cache
def highest_mode(n: int) -> tuple[float, Array]:
    """Largest m omega²/K_int of the actual springs, and its mode (2, N, N)."""
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
    """The highest mode of 8 x 8 blocks alone, by the compiled loop, beside the scheme's factor.

    From 1e-9 spacings it grows to 2e-5, and is non-linear by the square of that.
    """
    steps, tiny = 30, 1e-9
    eigenvalue, mode = highest_mode(8)
    omega = math.sqrt((UNDAMPED.k_s + UNDAMPED.k_int * eigenvalue) / UNDAMPED.mass)
    phase = share * STABLE[integrator]
    value = float(np.vdot(mode, swing(tiny * mode, steps, phase / omega, integrator))) / tiny
    if integrator == "leapfrog":  # from rest half a step before: cos((k + 1/2) theta)
        half = np.arcsin(complex(phase / 2.0))
        closed_form = float((np.cos((2 * steps + 1) * half) / np.cos(half)).real)
        bound = 1.0 / abs(np.cos(half))
    else:
        closed_form, bound = float((turn(phase) ** steps).real), 1.0
    word = "bounded" if abs(value) <= bound else "grows"
    return compared(value, closed_form, 1e-6, (word, "disagrees"))


def lattice_case() -> Case:
    """The springs by themselves, where no step is taken."""
    name, n = "highest mode of 32 x 32 blocks", 32
    attempt = partial(limit_of_the_springs, n)
    return Case(name, "step", "both", 1.0, "just below", "frequency, omega_max", attempt)


def cases(integrator: str) -> Iterator[Case]:
    """Up to the limit and beyond."""
    case = Family("step", integrator).case
    for share in SHARES:
        name = f"pillars at {share:.0%} of the limit"
        yield case(name, share, "stable", FRICTION, near_the_limit, PAPER, share)
    edge = STABLE[integrator] / PAPER.omega_max
    for share in BEYOND:
        name, limits = f"pillars at {share:g} times the limit", (share * edge, edge)
        yield case(name, share, "refused", LARGEST, beyond_the_limit, PAPER, *limits)
    name, share = "strained pillars at 99% of the limit", 0.99
    yield case(name, share, "stable", FRICTION, near_the_limit, HEAVY, share)
    name = "overdamped pillars at 99% of the limit"
    yield case(name, share, "bounded", FRICTION, near_the_limit_of_damping, share)
    edge = limit_of_damping(integrator, SYRUP)
    name, share = "overdamped pillars at 1.01 times the limit", 1.01
    yield case(name, share, "refused", LARGEST, beyond_the_limit, SYRUP, share * edge, edge)
    for share, expected in ((0.99, "bounded"), (1.01, "grows")):
        name, what = f"highest mode at {share:.0%} of its limit", "amplitude after 30 steps"
        yield case(name, share, expected, what, swing_of_the_highest_mode, share)
