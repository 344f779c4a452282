"""One block on its spring: damping, speed, coefficients and weakening.

Forces are compared with those of `slip`, which integrates the equation of one block by itself.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from springblock.model.material import LAWS, Material
from springblock.model.numbers import Array
from springblock.model.surface import Surface
from springblock.solver.integrators import limit
from springblock.study.accuracy.stability.cases import (
    PAPER,
    UNDAMPED,
    Case,
    Outcome,
    Pull,
    pulled_at,
)
from springblock.study.accuracy.stability.surfaces import beyond_the_limit

SPEED = 0.01
ROUGH = 1.0, 0.6  #: mu_static and mu_dynamic
DROP = ROUGH[0] - ROUGH[1]
H = 0.02  #: step, unless a shorter one is needed
LONGEST = 50.0  #: of a slip
MILLION = 1_000_000  #: steps


def slip(
    material: Material, mu_static: float, mu_dynamic: float, longest: float = LONGEST
) -> tuple[Callable[[Array | float], Any], float]:
    """Integrate a slip from the release of the block to its stop, or for a time `longest`, 1/omega.

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
    # With a fast slider a missed stop leaves u' negative for a time of about (mu_s - mu_d)/v.
    steps = {"first_step": 1e-9, "max_step": 0.5 * drop / speed if drop else math.inf}
    accuracy = {"rtol": 1e-11, "atol": 1e-14, "events": stops, "dense_output": True}
    found = solve_ivp(motion, (0.0, longest), (0.0, 0.0), method, **steps, **accuracy)
    end = float(found.t[-1])
    return lambda time: found.sol(np.minimum(time, end))[0], end


def spring_force(
    integrator: str,
    material: Material,
    mu_static: float = ROUGH[0],
    mu_dynamic: float = ROUGH[1],
    h: float = H,
    after: float | None = None,
    slope: float = 0.0,
    late: float = 0.0,
) -> Outcome:
    """Compare the spring force at a time `after` the release, within `slope` h.

    By default it is compared after the stop, before the next slip: the stop adds an error of at
    most 4 v h, and the work of friction during weakening and the place of the stop one of about
    2 (mu_s - mu_d) h². The slip may begin `late`. The step is h, or half the largest stable step if
    this is smaller.
    """
    step = min(h / material.omega_min, 0.5 * limit(integrator, material))
    pull = Pull(integrator, material, step)
    path, lasts = slip(material, mu_static, mu_dynamic, (after or LONGEST) + pull.h)
    if after is None:
        drop = mu_static - mu_dynamic
        after = lasts + min(1.0, drop / pull.speed)
        slope = pull.speed * (4.0 + late / pull.h) + 2.0 * drop * pull.h
    release = max(mu_static, mu_dynamic) / pull.speed
    count = math.ceil((release + after) / pull.h)
    run = pull.simulate(Surface([[True]], mu_static, mu_dynamic), count)
    slid = material.slider_velocity * run.time[-1]
    force = float(slid - run.displacement[0, 0, 0]) * material.k_s / material.block_load
    closed_form = pull.speed * count * pull.h - float(path(count * pull.h - release))
    tolerance = slope * pull.h / abs(closed_form)
    return pull.judge(run, "spring force, F_n", force, closed_form, tolerance)


def frictions(integrator: str) -> Iterator[Case]:
    """Yield cases of damping, speed and coefficients of friction."""
    case = partial(Case, "damping", integrator)
    for gamma in (0.0, 0.01, 0.1, 1.0, 2.0, 10.0, 100.0, 1e4):
        material = with_damping(gamma, SPEED)
        share = limit("leapfrog", material) / limit(integrator, material)
        if gamma > 100.0 and share > 1.0:  # damping is not exact, and limits the step
            name = f"pillars with gamma = {gamma:g} omega at leapfrog's limit"
            attempt = partial(beyond_the_limit, material=material, share=share)
            yield case(name, gamma, attempt, "refused")
        else:
            slow = max(1.0, gamma)  # time during which the force falls
            steepest = max(abs(DROP - gamma * SPEED) / slow, SPEED)
            compared = partial(spring_force, h=1e-3 * slow, after=slow, slope=2.0 * steepest)
            attempt = partial(compared, material=material)
            yield case(f"block with gamma = {gamma:g} omega", gamma, attempt)
    case = partial(Case, "speed", integrator)
    for speed in (1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0):
        material, h = pulled_at(speed, UNDAMPED), min(H, 2e-3 / speed)
        attempt = partial(spring_force, material=material, h=h)
        yield case(f"block at v = {speed:g} F_n omega/K_s", speed, attempt)
    case = partial(Case, "coefficients", integrator)
    for ratio, material in (
        (0.0, with_damping(0.1, 1e-3)),  # without damping the force would swing to -mu_s
        *((ratio, pulled_at(SPEED, UNDAMPED)) for ratio in (0.3, 0.6, 0.99)),
    ):
        attempt = partial(spring_force, material=material, mu_dynamic=ratio)
        yield case(f"block with mu_d = {ratio:g} mu_s", ratio, attempt)
    name = "sticking and slipping for a million steps"
    yield case(name, ROUGH[1] / ROUGH[0], stick_slip_forever)
    # Without a drop the velocity is v (1 - cos t); the block may start one step late.
    speed = 0.1
    material = pulled_at(speed, UNDAMPED)
    compared = partial(spring_force, material=material, h=2e-3, after=6.0, slope=2.0 * speed)
    for mu_static, mu_dynamic in ((1.0, 1.0), (1.0, 2.0), (0.0, 0.6), (0.0, 0.0)):
        name = f"block with mu_s = {mu_static:g}, mu_d = {mu_dynamic:g}"
        ratio = mu_dynamic / mu_static if mu_static else math.inf
        attempt = partial(compared, mu_static=mu_static, mu_dynamic=mu_dynamic)
        yield case(name, ratio, attempt)


def with_damping(gamma: float, speed: float) -> Material:
    """Return the paper's material with this gamma, 1/omega, under a slider of this speed."""
    return pulled_at(speed, replace(PAPER, gamma=gamma * PAPER.omega_min))


def weakenings(integrator: str) -> Iterator[Case]:
    """Yield cases of friction that weakens within a slip or, like Coulomb's law, within a step."""
    case = partial(Case, "weakening", integrator)
    for law, unit, rates in (
        ("slip_weakening", "K_s", (1.5, 10.0, 1e2, 1e3, 1e4, 1e6, 1e12, 1e100)),
        ("velocity_weakening", "m omega", (1.0, 10.0, 1e2, 1e3, 1e6, 1e100)),
    ):
        for rate in rates:
            name = f"block with {law.replace('_', ' ')} at {rate:g} {unit}"
            # Slip grows as v/k³ sinh(k t), k² = rate, by exp(2) per step at 1e4 K_s: it may begin
            # late by the time, 1/omega, in which it reaches d_c = (mu_s - mu_d)/k².
            growth = math.sqrt(rate)
            late = math.asinh(DROP * growth / SPEED) / growth if rate == 1e4 else 0.0
            attempt = partial(spring_force, material=weakening(law, rate), late=late)
            yield case(name, rate, attempt)


def weakening(law: str, rate: float) -> Material:
    """Return a material whose friction decreases at this rate, K_s or m omega."""
    material = pulled_at(SPEED, UNDAMPED)
    constant = DROP / rate * material.block_load / material.k_s
    if law == "velocity_weakening":
        constant *= material.omega_min
    weak: dict[str, Any] = {"law": law, LAWS[law]: constant}
    return replace(material, **weak)


def stick_slip_forever(integrator: str) -> Outcome:
    """Compare the mean force with mu_d; it varies between mu_s and 2 mu_d - mu_s."""
    material = pulled_at(SPEED, UNDAMPED)
    pull = Pull(integrator, material, H / material.omega_min)
    run = pull.simulate(Surface([[True]], *ROUGH), MILLION, every=20)
    cycles = SPEED * MILLION * pull.h / (2.0 * DROP)
    mean = run.force.mean() / run.normal_force
    return pull.judge(run, "mean force, F_n", mean, ROUGH[1], 1.0 / cycles)
