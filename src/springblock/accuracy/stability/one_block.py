"""One block on its spring: damping, speed, coefficients, weakening and rest.

Forces are compared with those of `slip`, which integrates the equation of one block by itself.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from springblock.accuracy.kernels import UNDAMPED, limit_of_damping
from springblock.accuracy.specimens import Array, uniform
from springblock.accuracy.stability.cases import (
    FRICTION,
    LARGEST,
    PAPER,
    ROUNDING,
    Case,
    Outcome,
    Pull,
    pulled_at,
)
from springblock.accuracy.stability.limits import beyond_the_limit
from springblock.model.material import LAWS, Material
from springblock.simulation.run import Realisation
from springblock.solver.stability import limit

SPEED = 0.01
ROUGH = 1.0, 0.6  #: mu_static and mu_dynamic
DROP = ROUGH[0] - ROUGH[1]
H = 0.02  #: step where nothing asks for a shorter one
LONGEST = 50.0  #: of a slip
MILLION, TENTH = 1_000_000, 100_000  #: steps at rest
DURING_SLIP = "spring force during the slip, F_n"
AFTER_SLIP = "spring force after the slip, F_n"


def slip(
    material: Material, mu_static: float, mu_dynamic: float, longest: float = LONGEST
) -> tuple[Callable[[Array | float], Any], float]:
    """Follow a slip from the release of the block until it stops, or for so long, 1/omega.

    Returns the path, F_n/K_s, as a function of the time since the release, and the duration of
    the slip. Integrates m u" = K_s (v t - u) - mu F_n - gamma m u', with the friction of the law.
    """
    omega, unit = material.omega_min, material.block_load / material.k_s
    gamma, speed = material.gamma / omega, material.slider_velocity / (unit * omega)
    drop = max(mu_static - mu_dynamic, 0.0)

    def friction(path: float, velocity: float) -> float:
        if material.law == "slip_weakening":
            return mu_dynamic + drop * max(1.0 - path * unit / material.slip_distance, 0.0)
        if material.law == "velocity_weakening":
            scale = material.speed_scale / (unit * omega)
            return mu_dynamic + drop / (1.0 + max(velocity, 0.0) / scale)
        return mu_dynamic

    def motion(time: float, state: Array) -> tuple[float, float]:
        path, velocity = state
        pull = max(mu_static, mu_dynamic) + speed * time - path
        return velocity, pull - friction(path, velocity) - gamma * velocity

    def stops(time: float, state: Array) -> float:
        return float(state[1])

    stops.terminal, stops.direction = True, -1.0  # type: ignore[attr-defined]
    # Far overdamped, the equation is stiff.
    method = "Radau" if gamma > 100.0 else "DOP853"
    # Under a fast slider v is negative for about (mu_s - mu_d)/v only, if the stop is missed.
    steps = {"first_step": 1e-9, "max_step": 0.5 * drop / speed if drop else math.inf}
    accuracy = {"rtol": 1e-11, "atol": 1e-14, "events": stops, "dense_output": True}
    found = solve_ivp(motion, (0.0, longest), (0.0, 0.0), method, **steps, **accuracy)
    end = float(found.t[-1])
    return lambda time: found.sol(np.minimum(time, end))[0], end


def pull_block(
    pull: Pull, until: float, mu_static: float, mu_dynamic: float
) -> tuple[Realisation, float, float]:
    """Pull one block to a step's end after `until`; return the run, the force then, and the time.

    The force is that of the spring along the slide.
    """
    count = math.ceil(until / pull.h)
    run = pull.simulate(uniform(1, mu_static, mu_dynamic), count)
    length = pull.material.block_load / pull.material.k_s
    slid = pull.material.slider_velocity * run.time[-1]
    return run, float(slid - run.displacement[0, 0, 0]) / length, count * pull.h


def during_slip(
    integrator: str,
    material: Material,
    h: float,
    after: float,
    slope: float,
    mu_static: float = ROUGH[0],
    mu_dynamic: float = ROUGH[1],
) -> Outcome:
    """Compare the force so long `after` the release; it may be off by `slope` h.

    The step is h, but no more than half the stable one.
    """
    pull = in_steps_of(h, integrator, material)
    release = max(mu_static, mu_dynamic) / pull.speed
    run, force, end = pull_block(pull, release + after, mu_static, mu_dynamic)
    path, _ = slip(material, mu_static, mu_dynamic, end - release)
    closed_form = pull.speed * end - float(path(end - release))
    return pull.judge(run, force, closed_form, slope * pull.h / abs(closed_form))


def after_slip(
    integrator: str, material: Material, mu_dynamic: float = ROUGH[1], h: float = H
) -> Outcome:
    """Compare the force that the spring is left with, before the next slip.

    The stop is worth 4 v h at most. What friction takes while it weakens, and where the block
    stops, is off by some (mu_s - mu_d) h². A slip that grows at the rate k, k² = W/K_s - 1,
    begins late by a share of (k h)²/4, and beyond k h = 2, where a block weakens at once, by all
    of the time until it is weak.
    """
    pull, mu_static = in_steps_of(h, integrator, material), ROUGH[0]
    speed, drop = pull.speed, mu_static - mu_dynamic
    path, lasts = slip(material, mu_static, mu_dynamic)
    stop = mu_static / speed + lasts
    late = 0.0
    if material.law == "slip_weakening":
        distance = material.slip_distance * material.k_s / material.block_load
        weak = brentq(lambda time: path(time) - distance, 0.0, lasts)
        late = weak * min((drop / distance - 1.0) * pull.h**2 / 4.0, 1.0)
    run, force, end = pull_block(pull, stop + min(1.0, drop / speed), mu_static, mu_dynamic)
    closed_form = speed * stop - float(path(lasts))
    tolerance = (speed * (4.0 * pull.h + late) + 2.0 * drop * pull.h**2) / abs(closed_form)
    return pull.judge(run, force - speed * (end - stop), closed_form, tolerance)


def with_damping(gamma: float, speed: float) -> Material:
    """Return the paper's material with this gamma, 1/omega, under a slider of this speed."""
    return pulled_at(speed, replace(PAPER, gamma=gamma * PAPER.omega_min))


def in_steps_of(h: float, integrator: str, material: Material) -> Pull:
    """Pull `material` in steps of h, 1/omega, but of no more than half the stable step."""
    return Pull(
        integrator, material, min(h / material.omega_min, 0.5 * limit(integrator, material))
    )


def frictions(integrator: str) -> Iterator[Case]:
    """Damping, speed and coefficients of friction."""
    case = partial(Case, "damping", integrator)
    for gamma in (0.0, 0.01, 0.1, 1.0, 2.0, 10.0, 100.0, 1e4):
        material = with_damping(gamma, SPEED)
        if gamma > 100.0 and integrator == "rk4":
            name = f"pillars with gamma = {gamma:g} omega at leapfrog's limit"
            limits = [limit_of_damping(scheme, material) for scheme in ("leapfrog", "rk4")]
            yield case(name, gamma, LARGEST, beyond_the_limit, (material, *limits), "refused")
        else:
            slow = max(1.0, gamma)  # time in which the force falls
            steepest = max(abs(DROP - gamma * SPEED) / slow, SPEED)
            name, times = f"block with gamma = {gamma:g} omega", (1e-3 * slow, slow, 2.0 * steepest)
            yield case(name, gamma, DURING_SLIP, during_slip, (material, *times))
    case = partial(Case, "speed", integrator)
    for speed in (1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0):
        name = f"block at v = {speed:g} F_n omega/K_s"
        material, h = pulled_at(speed, UNDAMPED), min(H, 2e-3 / speed)
        yield case(name, speed, AFTER_SLIP, after_slip, (material, ROUGH[1], h))
    case = partial(Case, "coefficients", integrator)
    for ratio, material in (
        (0.0, with_damping(0.1, 1e-3)),  # without damping it would swing back to -mu_s
        *((ratio, pulled_at(SPEED, UNDAMPED)) for ratio in (0.3, 0.6, 0.99)),
    ):
        name = f"block with mu_d = {ratio:g} mu_s"
        yield case(name, ratio, AFTER_SLIP, after_slip, (material, ratio))
    # Without a drop the block leaves at mu_d with v (1 - cos t), and may start late by a step.
    speed = 0.1
    how = pulled_at(speed, UNDAMPED), 2e-3, 6.0, 2.0 * speed
    for mu_static, mu_dynamic in ((1.0, 1.0), (1.0, 2.0), (0.0, 0.6), (0.0, 0.0)):
        name = f"block with mu_s = {mu_static:g}, mu_d = {mu_dynamic:g}"
        ratio = mu_dynamic / mu_static if mu_static else math.inf
        yield case(name, ratio, DURING_SLIP, during_slip, (*how, mu_static, mu_dynamic))


def weakenings(integrator: str) -> Iterator[Case]:
    """Friction that weakens, from gently to within one step, and the limits of both laws."""
    case = partial(Case, "weakening", integrator)
    for rate in (0.1, 0.5, 0.7):
        name, after = f"block with slip weakening at {rate:g} K_s", 5.0 / math.sqrt(1.0 - rate)
        # Its creep is of second order in h, and seen before it comes to rest again.
        arguments = weakening("slip_weakening", rate), H, after, SPEED * after * H
        yield case(name, rate, DURING_SLIP, during_slip, arguments)
    for law, unit, rates in (
        ("slip_weakening", "K_s", (1.5, 10.0, 1e2, 1e3, 1e4, 1e6, 1e12)),
        ("velocity_weakening", "m omega", (1.0, 10.0, 1e2, 1e3, 1e6)),
    ):
        for rate in rates:
            name = f"block with {law.replace('_', ' ')} at {rate:g} {unit}"
            yield case(name, rate, AFTER_SLIP, after_slip, (weakening(law, rate),))
    for rate in (1e-2, 1.0, 1e2, 1e4, 1e8):
        name = f"steady sliding with velocity weakening at {rate:g} m omega"
        yield case(name, rate, "force of steady sliding, F_n", force_of_steady_sliding, (rate,))
    for law in ("slip_weakening", "velocity_weakening"):
        name = f"{law} with {LAWS[law]} = 1e-300"
        yield case(name, math.inf, FRICTION, is_coulomb, (law,), "the same")


def weakening(law: str, rate: float, material: Material | None = None) -> Material:
    """Return a material whose friction falls at this rate W."""
    material = material or pulled_at(SPEED, UNDAMPED)
    constant = DROP / rate * material.block_load / material.k_s
    if law == "velocity_weakening":
        constant *= material.omega_min
    weak: dict[str, Any] = {"law": law, LAWS[law]: constant}
    return replace(material, **weak)


def force_of_steady_sliding(integrator: str, rate: float) -> Outcome:
    """Damped, a block follows the slider in the end: mu(v) + gamma v, to rounding."""
    gamma, speed = 2.0, 0.1
    material = weakening("velocity_weakening", rate, with_damping(gamma, speed))
    pull = in_steps_of(H, integrator, material)
    run, force, _ = pull_block(pull, ROUGH[0] / speed + 100.0, *ROUGH)
    closed_form = ROUGH[1] + DROP / (1.0 + speed * rate / DROP) + gamma * speed
    return pull.judge(run, force, closed_form, 1e-11)


def is_coulomb(integrator: str, law: str) -> Outcome:
    """In the limit both laws are Coulomb's: static friction, beside it.

    Leapfrog's is so to the bit; Runge-Kutta turns slow blocks at once, which Coulomb's do not.
    """
    plain = Pull(integrator, pulled_at(SPEED, UNDAMPED), 2e-8)
    weak: dict[str, Any] = {"law": law, LAWS[law]: 1e-300}
    pull = replace(plain, material=replace(plain.material, **weak))
    run, exact = (each.simulate(uniform(3, *ROUGH)) for each in (pull, plain))
    word = "the same" if np.array_equal(run.t_det, exact.t_det) else "differs"
    return pull.judge(run, run.static_friction, exact.static_friction, 0.0, word)


def rests(integrator: str) -> Iterator[Case]:
    """A million steps at rest, between slips or at the threshold, and one step more."""
    case = partial(Case, "rest", integrator)
    yield case("stuck for a million steps", MILLION, "force, P l² N²", stuck, expected="at rest")
    name = "sticking and slipping for a million steps"
    yield case(name, MILLION, "mean force, F_n", stick_slip_forever)
    for excess, word, expected in ((-1e-12, "missed", "at rest"), (1e-12, "passed", "lets go")):
        name, first = f"threshold {word} by 1e-12 after {TENTH} steps", "first detachment, steps"
        yield case(name, TENTH, first, threshold_reached, (excess,), expected)


def stuck(integrator: str) -> Outcome:
    """Nothing moves by one bit, and the force is K_s v t N²."""
    pull = Pull.at(0.2, integrator, PAPER)
    run = pull.simulate(uniform(2, 1e9, 0.6), MILLION)
    closed_form = 4.0 * PAPER.k_s * PAPER.slider_velocity * run.time[-1] / run.normal_force
    moved = run.displacement.any() or run.velocity.any() or run.switches.any()
    word = "moves" if moved else "at rest"
    return pull.judge(run, run.static_friction, closed_form, ROUNDING, word)


def threshold_reached(integrator: str, excess: float) -> Outcome:
    """After many steps the force K_s v t is 1 + excess times the threshold; then one more."""
    pull = Pull.at(0.2, integrator, UNDAMPED)
    pull = pull.with_speed(1.0 / (TENTH * pull.h))
    run = pull.simulate(uniform(1, 1.0 / (1.0 + excess), 0.6), TENTH + 1)
    residual = run.energy.relative_residual
    if not (np.isfinite(run.t_first) and run.displacement.any()):
        return Outcome("at rest", residual)
    return Outcome("lets go", residual, run.t_first / pull.step, TENTH, 1.0 / TENTH)


def stick_slip_forever(integrator: str) -> Outcome:
    """The force saws between mu_s and 2 mu_d - mu_s: its mean is mu_d, but for the first rise."""
    pull = in_steps_of(H, integrator, pulled_at(SPEED, UNDAMPED))
    run = pull.simulate(uniform(1, *ROUGH), MILLION, every=20)
    cycles = SPEED * MILLION * pull.h / 0.8
    return pull.judge(run, run.force.mean() / run.normal_force, ROUGH[1], 1.0 / cycles)
