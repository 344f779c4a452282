"""Friction that weakens, from gently to within one step: one block under its slider.

A block lets go without a drop. Its friction then falls at the rate W = (mu_s - mu_d)/d_c along its
way, or at W = (mu_s - mu_d)/v_c with its speed.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from springblock.accuracy.kernels import UNDAMPED
from springblock.accuracy.stability.block import force_at_the_end, with_damping
from springblock.accuracy.stability.cases import Case, Family, Outcome
from springblock.accuracy.stability.pull import Pull, pulled_at
from springblock.accuracy.surfaces import uniform
from springblock.model.material import Material

SPEED, MU_STATIC, MU_DYNAMIC = 0.01, 1.0, 0.6
DROP = MU_STATIC - MU_DYNAMIC
Motion = Callable[[float], tuple[float, float]]  #: way and speed at a time after the release


def with_slip_weakening(rate: float, material: Material) -> Material:
    """`material` under this rate W."""
    distance = DROP / rate * material.block_load / material.k_s
    return replace(material, law="slip_weakening", slip_distance=distance)


def with_velocity_weakening(rate: float, material: Material) -> Material:
    """`material` under this rate W."""
    scale = DROP / rate * material.block_load / material.k_s * material.omega_min
    return replace(material, law="velocity_weakening", speed_scale=scale)


def while_weakening(rate: float) -> Motion:
    """s" = v t + (W - 1) s from rest: it grows as sinh, or swings about a steady creep."""
    k = math.sqrt(abs(rate - 1.0))
    grow, speed_up = (math.sinh, math.cosh) if rate > 1.0 else (math.sin, math.cos)

    def motion(t: float) -> tuple[float, float]:
        return SPEED / k**2 * abs(grow(k * t) / k - t), SPEED / k**2 * abs(speed_up(k * t) - 1.0)

    return motion


def force_while_creeping(integrator: str, rate: float) -> Outcome:
    """Friction falls more slowly than the spring: no slip. Seen before it comes to rest again."""
    material = with_slip_weakening(rate, pulled_at(SPEED, UNDAMPED))
    pull = Pull(integrator, material, 0.02 / material.omega_min)
    count = math.ceil((MU_STATIC / SPEED + 5.0 / math.sqrt(1.0 - rate)) / pull.h)
    run = pull.simulate(uniform(1, MU_STATIC, MU_DYNAMIC), count)
    t = count * pull.h - MU_STATIC / SPEED
    closed_form = MU_STATIC + SPEED * t - while_weakening(rate)(t)[0]
    tolerance = SPEED * t * pull.h**2 / closed_form
    return pull.judge(run, force_at_the_end(pull, run), closed_form, tolerance)


def force_after_weakening(integrator: str, rate: float) -> Outcome:
    """The way grows to d_c, and then the block swings under mu_d until it stops.

    What friction takes while it weakens, and where the block stops, is off by a share of
    (mu_s - mu_d) h². The time until it is weak is off by a share of (k h)²/4, k² = W - 1, and all
    of it is missed beyond k h = 2, where a block weakens at once.
    """
    material = with_slip_weakening(rate, pulled_at(SPEED, UNDAMPED))
    pull = Pull(integrator, material, 0.02 / material.omega_min)
    motion, k, far = while_weakening(rate), math.sqrt(rate - 1.0), DROP / rate
    weak = brentq(lambda t: motion(t)[0] - far, 0.0, 20.0 / k)
    force, rise = MU_STATIC + SPEED * weak - far, SPEED - motion(weak)[1]

    def swing(t: float) -> tuple[float, float]:
        over = force - MU_DYNAMIC
        return (
            over * math.cos(t) + rise * math.sin(t),
            rise * math.cos(t) - over * math.sin(t),
        )

    lasts = brentq(lambda t: swing(t)[1] - SPEED, 1.5, 5.0)
    stop, closed_form = MU_STATIC / SPEED + weak + lasts, MU_DYNAMIC + swing(lasts)[0]
    late = weak * min((k * pull.h) ** 2 / 4.0, 1.0)
    return _after_slip(pull, stop, closed_form, late)


def _after_slip(pull: Pull, stop: float, closed_form: float, late: float = 0.0) -> Outcome:
    """Compare the force on a block at rest with that at which it stopped."""
    count = math.ceil((stop + 1.0) / pull.h)
    run = pull.simulate(uniform(1, MU_STATIC, MU_DYNAMIC), count)
    value = force_at_the_end(pull, run) - SPEED * (count * pull.h - stop)
    tolerance = (SPEED * (4.0 * pull.h + late) + 2.0 * DROP * pull.h**2) / closed_form
    return pull.judge(run, value, closed_form, tolerance)


def force_after_slip(integrator: str, rate: float) -> Outcome:
    """Under velocity weakening, beside DOP853; near its stop the block feels mu_s again."""
    material = with_velocity_weakening(rate, pulled_at(SPEED, UNDAMPED))
    pull, scale = Pull(integrator, material, 0.02 / material.omega_min), DROP / rate

    def motion(t: float, state: tuple[float, float]) -> tuple[float, float]:
        way, speed = state
        friction = MU_DYNAMIC + DROP / (1.0 + max(speed, 0.0) / scale)
        return speed, MU_STATIC + SPEED * t - way - friction

    def stops(t: float, state: tuple[float, float]) -> float:
        return state[1]

    stops.terminal, stops.direction = True, -1.0  # type: ignore[attr-defined]
    accuracy = {"rtol": 1e-11, "atol": 1e-13, "first_step": 1e-3 / max(rate, 1.0)}
    solution = solve_ivp(motion, (0.0, 50.0), (0.0, 0.0), "DOP853", events=stops, **accuracy)
    closed_form = MU_STATIC + SPEED * solution.t[-1] - solution.y[0, -1]
    return _after_slip(pull, MU_STATIC / SPEED + float(solution.t[-1]), float(closed_form))


def force_of_steady_sliding(integrator: str, rate: float) -> Outcome:
    """Damped, a block follows the slider in the end: mu(v) + gamma v, but for a last swing."""
    gamma, speed = 2.0, 0.1
    material = with_velocity_weakening(rate, pulled_at(speed, with_damping(gamma)))
    pull = Pull(integrator, material, 0.02 / material.omega_min)
    count = math.ceil((MU_STATIC / speed + 100.0) / pull.h)
    run = pull.simulate(uniform(1, MU_STATIC, MU_DYNAMIC), count)
    closed_form = MU_DYNAMIC + DROP / (1.0 + speed * rate / DROP) + gamma * speed
    return pull.judge(run, force_at_the_end(pull, run), closed_form, 1e-9)


def is_coulomb(integrator: str, law: str, least: float) -> Outcome:
    """In the limit both laws are Coulomb's: static friction, beside it.

    Leapfrog's is so to the bit; Runge-Kutta turns slow blocks at once, which Coulomb's do not.
    """
    limit: dict[str, Any] = {"law": law, LIMITS[law]: least}
    pulls = [
        Pull(integrator, pulled_at(SPEED, material), 2e-8)
        for material in (replace(UNDAMPED, **limit), UNDAMPED)
    ]
    run, plain = (pull.simulate(uniform(3, MU_STATIC, MU_DYNAMIC)) for pull in pulls)
    word = "the same" if np.array_equal(run.t_det, plain.t_det) else "differs"
    return pulls[0].judge(run, run.static_friction, plain.static_friction, 0.0, word)


LIMITS = {"slip_weakening": "slip_distance", "velocity_weakening": "speed_scale"}


def cases(integrator: str) -> Iterator[Case]:
    """Both laws over their rates, and their limits."""
    case, agrees = Family("weakening", integrator).case, "agrees"
    for rate in (0.1, 0.5, 0.7):
        name = f"block with slip weakening at {rate:g} K_s"
        yield case(name, rate, agrees, "spring force, F_n", force_while_creeping, rate)
    left = "spring force after the slip, F_n"
    for rate in (1.5, 10.0, 1e2, 1e3, 1e4, 1e6, 1e12):
        name = f"block with slip weakening at {rate:g} K_s"
        yield case(name, rate, agrees, left, force_after_weakening, rate)
    for rate in (1.0, 10.0, 1e2, 1e3, 1e6):
        name = f"block with velocity weakening at {rate:g} m omega"
        yield case(name, rate, agrees, left, force_after_slip, rate)
    steady = "force of steady sliding, F_n"
    for rate in (1e-2, 1.0, 1e2, 1e4, 1e8):
        name = f"steady sliding with velocity weakening at {rate:g} m omega"
        yield case(name, rate, agrees, steady, force_of_steady_sliding, rate)
    for law, constant in LIMITS.items():
        name, friction = f"{law} with {constant} = 1e-300", "static friction"
        yield case(name, math.inf, "the same", friction, is_coulomb, law, 1e-300)
