"""One block on its spring, which has closed forms: damping, speed and coefficients of friction."""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq

from springblock.accuracy.kernels import UNDAMPED
from springblock.accuracy.stability.cases import LARGEST, Case, Family, Outcome
from springblock.accuracy.stability.pull import PAPER, Pull, pulled_at
from springblock.accuracy.stability.schemes import limit, limit_of_damping
from springblock.accuracy.stability.step import beyond_the_limit
from springblock.accuracy.surfaces import Array, uniform
from springblock.model.material import Material
from springblock.simulation.run import Realisation


def force_at_the_end(pull: Pull, run: Realisation) -> float:
    """Spring force on the one block, along the slide."""
    length = pull.material.block_load / pull.material.k_s
    end = pull.material.slider_velocity * run.time[-1]
    return float(end - run.displacement[0, 0, 0]) / length


def with_damping(gamma: float) -> Material:
    """The paper's material with this gamma, 1/omega."""
    return replace(PAPER, gamma=gamma * PAPER.omega_min)


def damped(gamma: float) -> Array:
    """Motion of (x, x') for x" + gamma x' + x = 0."""
    return np.array([[0.0, 1.0], [-1.0, -gamma]])


def force_while_slipping(integrator: str, gamma: float) -> Outcome:
    """x = F - mu_d - gamma v swings or creeps back from mu_s with the slope v.

    Where damping is stiff within a step, the release shifts it by h at most.
    Runge-Kutta must resolve the damping; leapfrog integrates it exactly and needs not.
    """
    speed, mu_static, mu_dynamic = 0.01, 1.0, 0.6
    material = pulled_at(speed, with_damping(gamma))
    slow = max(1.0, gamma)  # time in which the force falls
    step = 1e-3 * slow / material.omega_min
    if integrator == "rk4":
        step = min(step, 0.5 * limit(integrator, material))
    pull = Pull(integrator, material, step)
    count = math.ceil((mu_static / speed + slow) / pull.h)
    run = pull.simulate(uniform(1, mu_static, mu_dynamic), count)
    tau, far = count * pull.h - mu_static / speed, mu_dynamic + gamma * speed
    x = expm(tau * damped(gamma)) @ [mu_static - far, speed]
    closed_form, steepest = far + x[0], max(abs(mu_static - far) / slow, speed)
    tolerance = 2.0 * steepest * pull.h / closed_form
    return pull.judge(run, force_at_the_end(pull, run), closed_form, tolerance)


def force_after_slip(
    integrator: str, speed: float, mu_static: float, mu_dynamic: float, gamma: float = 0.0
) -> Outcome:
    """What the spring is left with, at any speed: 2 mu_d - mu_s without damping.

    Then, seen from the slider, the block leaves and arrives with -v, and the slip lasts
    2 (π - atan((mu_s - mu_d)/v)). With damping, the block is at rest when x' is v again. The
    stop is worth 4 v h at most, and misses the turning point by (mu_s - mu_d) h².
    """
    drop, far = mu_static - mu_dynamic, mu_dynamic + gamma * speed
    material = pulled_at(speed, with_damping(gamma))
    pull = Pull(integrator, material, min(0.02, 2e-3 / speed) / material.omega_min)
    lasts, closed_form = 2.0 * (math.pi - math.atan(drop / speed)), 2.0 * mu_dynamic - mu_static
    if gamma:
        start = [mu_static - far, speed]
        lasts = brentq(lambda t: (expm(t * damped(gamma)) @ start)[1] - speed, 2.0, 5.0)
        closed_form = far + (expm(lasts * damped(gamma)) @ start)[0]
    stop = mu_static / speed + lasts
    count = math.ceil((stop + min(1.0, drop / speed)) / pull.h)  # before it lets go again
    run = pull.simulate(uniform(1, mu_static, mu_dynamic), count)
    value = force_at_the_end(pull, run) - speed * (count * pull.h - stop)
    tolerance = (4.0 * speed * pull.h + drop * pull.h**2) / abs(closed_form)
    return pull.judge(run, value, closed_form, tolerance)


def greatest_force(integrator: str, mu_static: float, mu_dynamic: float) -> Outcome:
    """With mu_s <= mu_d there is no drop: the block leaves at mu_d with v (1 - cos t).

    The force swings up by v, and is sampled in steps of h.
    """
    speed = 0.1
    material = pulled_at(speed, UNDAMPED)
    pull = Pull(integrator, material, 2e-3 / material.omega_min)
    count = math.ceil((mu_dynamic / speed + 6.0) / pull.h)
    run = pull.simulate(uniform(1, mu_static, mu_dynamic), count, every=1)
    closed_form = mu_dynamic + speed
    tolerance = 2.0 * speed * pull.h / closed_form
    return pull.judge(run, run.static_friction, closed_form, tolerance)


def path_without_friction(integrator: str) -> Outcome:
    """mu_s = mu_d = 0: an oscillator under a moving slider, u = v (t - sin t).

    At first no force is there to let it go: it may start late by h.
    """
    speed, end = 0.1, 6.0
    material = pulled_at(speed, UNDAMPED)
    pull = Pull(integrator, material, 0.01 / material.omega_min)
    run = pull.simulate(uniform(1, 0.0, 0.0), round(end / pull.h))
    value = speed * run.steps * pull.h - force_at_the_end(pull, run)
    path = end - math.sin(end)
    return pull.judge(run, value, speed * path, 2.0 * pull.h / path)


def cases(integrator: str) -> Iterator[Case]:
    """Everything that has a closed form."""
    case, agrees = Family("damping", integrator).case, "agrees"
    for gamma in (0.0, 0.01, 0.1, 1.0, 2.0, 10.0, 100.0, 1e4):
        if gamma > 100.0 and integrator == "rk4":
            name = f"pillars with gamma = {gamma:g} omega at leapfrog's limit"
            material = with_damping(gamma)
            limits = (limit_of_damping(scheme, material) for scheme in ("leapfrog", "rk4"))
            yield case(name, gamma, "refused", LARGEST, beyond_the_limit, material, *limits)
            continue
        name, force = f"block with gamma = {gamma:g} omega", "spring force during the slip, F_n"
        yield case(name, gamma, agrees, force, force_while_slipping, gamma)
    case, left = Family("speed", integrator).case, "spring force after the slip, F_n"
    for speed in (1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0):
        name = f"block at v = {speed:g} F_n omega/K_s"
        yield case(name, speed, agrees, left, force_after_slip, speed, 1.0, 0.6)
    case = Family("coefficients", integrator).case
    for ratio in (0.3, 0.6, 0.99):
        name = f"block with mu_d = {ratio:g} mu_s"
        yield case(name, ratio, agrees, left, force_after_slip, 0.01, 1.0, ratio)
    yield case("block with mu_d = 0", 0.0, agrees, left, force_after_slip, 1e-3, 1.0, 0.0, 0.1)
    for mu in ((1.0, 1.0), (1.0, 2.0), (0.0, 0.6)):
        mu_static, mu_dynamic = mu
        name = f"block with mu_s = {mu_static:g}, mu_d = {mu_dynamic:g}"
        ratio = mu_dynamic / mu_static if mu_static else math.inf
        yield case(name, ratio, agrees, "greatest force, F_n", greatest_force, *mu)
    path = "path, F_n/K_s"
    yield case("block without friction", math.nan, agrees, path, path_without_friction)
