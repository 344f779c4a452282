"""One block on its spring, in closed form: damping, speed, coefficients, weakening and rest.

A block that slides forwards under Coulomb's law swings about mu_d + gamma v. Under the others it
lets go without a drop; friction then falls at the rate W = (mu_s - mu_d)/d_c along its way, or at
W = (mu_s - mu_d)/v_c with its speed.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import expm
from scipy.optimize import brentq

from springblock.accuracy.kernels import UNDAMPED, limit, limit_of_damping
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

SPEED, MU_STATIC, MU_DYNAMIC = 0.01, 1.0, 0.6
DROP = MU_STATIC - MU_DYNAMIC
MILLION, TENTH = 1_000_000, 100_000  #: steps at rest
DURING_SLIP = "spring force during the slip, F_n"
AFTER_SLIP = "spring force after the slip, F_n"


def pull_block(
    pull: Pull, until: float, mu_static: float = MU_STATIC, mu_dynamic: float = MU_DYNAMIC
) -> tuple[Realisation, float, float]:
    """Pull one block to a step's end after `until`; return the run, the force then, and the time.

    The force is that of the spring along the slide.
    """
    count = math.ceil(until / pull.h)
    run = pull.simulate(uniform(1, mu_static, mu_dynamic), count)
    length = pull.material.block_load / pull.material.k_s
    slid = pull.material.slider_velocity * run.time[-1]
    return run, float(slid - run.displacement[0, 0, 0]) / length, count * pull.h


def with_damping(gamma: float, speed: float) -> Material:
    """Return the paper's material with this gamma, 1/omega, under a slider of this speed."""
    return pulled_at(speed, replace(PAPER, gamma=gamma * PAPER.omega_min))


def in_steps_of(h: float, integrator: str, material: Material) -> Pull:
    """Pull `material` in steps of h, 1/omega."""
    return Pull(integrator, material, h / material.omega_min)


def swing(t: Array | float, gamma: float, start: tuple[float, float]) -> Array:
    """Return (x, x') at times t after `start` for x" + gamma x' + x = 0, (..., 2)."""
    return expm(np.multiply.outer(t, [[0.0, 1.0], [-1.0, -gamma]])) @ start


def frictions(integrator: str) -> Iterator[Case]:
    """Damping, speed and coefficients of friction."""
    case = partial(Case, "damping", integrator)
    for gamma in (0.0, 0.01, 0.1, 1.0, 2.0, 10.0, 100.0, 1e4):
        if gamma > 100.0 and integrator == "rk4":
            name = f"pillars with gamma = {gamma:g} omega at leapfrog's limit"
            material = replace(PAPER, gamma=gamma * PAPER.omega_min)
            limits = [limit_of_damping(scheme, material) for scheme in ("leapfrog", "rk4")]
            yield case(name, gamma, LARGEST, beyond_the_limit, (material, *limits), "refused")
        else:
            name = f"block with gamma = {gamma:g} omega"
            yield case(name, gamma, DURING_SLIP, force_while_slipping, (gamma,))
    case = partial(Case, "speed", integrator)
    for speed in (1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0):
        name = f"block at v = {speed:g} F_n omega/K_s"
        yield case(name, speed, AFTER_SLIP, force_after_slip, (speed,))
    case = partial(Case, "coefficients", integrator)
    for ratio in (0.3, 0.6, 0.99):
        name = f"block with mu_d = {ratio:g} mu_s"
        yield case(name, ratio, AFTER_SLIP, force_after_slip, (SPEED, ratio))
    yield case("block with mu_d = 0", 0.0, AFTER_SLIP, force_after_slip, (1e-3, 0.0, 0.1))
    for mu_static, mu_dynamic in ((1.0, 1.0), (1.0, 2.0), (0.0, 0.6)):
        name = f"block with mu_s = {mu_static:g}, mu_d = {mu_dynamic:g}"
        ratio = mu_dynamic / mu_static if mu_static else math.inf
        yield case(name, ratio, "greatest force, F_n", greatest_force, (mu_static, mu_dynamic))
    yield case("block without friction", math.nan, "path, F_n/K_s", path_without_friction)


def force_while_slipping(integrator: str, gamma: float) -> Outcome:
    """x = F - mu_d - gamma v swings or creeps back from mu_s with the slope v.

    Where damping is stiff within a step, the release shifts it by h at most.
    Runge-Kutta must resolve the damping; leapfrog integrates it exactly and needs not.
    """
    material = with_damping(gamma, SPEED)
    slow = max(1.0, gamma)  # time in which the force falls
    step = 1e-3 * slow / material.omega_min
    if integrator == "rk4":
        step = min(step, 0.5 * limit(integrator, material))
    pull = Pull(integrator, material, step)
    run, force, end = pull_block(pull, MU_STATIC / SPEED + slow)
    tau, far = end - MU_STATIC / SPEED, MU_DYNAMIC + gamma * SPEED
    closed_form = far + swing(tau, gamma, (MU_STATIC - far, SPEED))[0]
    steepest = max(abs(MU_STATIC - far) / slow, SPEED)
    return pull.judge(run, force, closed_form, 2.0 * steepest * pull.h / closed_form)


def force_after_slip(
    integrator: str, speed: float, mu_dynamic: float = MU_DYNAMIC, gamma: float = 0.0
) -> Outcome:
    """What the spring is left with, at any speed: 2 mu_d - mu_s without damping.

    Then, seen from the slider, the block leaves and arrives with -v, and the slip lasts
    2 (π - atan((mu_s - mu_d)/v)). With damping, the block is at rest when x' is v again. The
    stop is worth 4 v h at most, and misses the turning point by (mu_s - mu_d) h².
    """
    drop, far = MU_STATIC - mu_dynamic, mu_dynamic + gamma * speed
    pull = in_steps_of(min(0.02, 2e-3 / speed), integrator, with_damping(gamma, speed))
    lasts, closed_form = 2.0 * (math.pi - math.atan(drop / speed)), 2.0 * mu_dynamic - MU_STATIC
    if gamma:
        start = (MU_STATIC - far, speed)
        lasts = brentq(lambda t: swing(t, gamma, start)[1] - speed, 2.0, 5.0)
        closed_form = far + swing(lasts, gamma, start)[0]
    stop = MU_STATIC / speed + lasts
    before_the_next = stop + min(1.0, drop / speed)
    run, force, end = pull_block(pull, before_the_next, mu_dynamic=mu_dynamic)
    tolerance = (4.0 * speed * pull.h + drop * pull.h**2) / abs(closed_form)
    return pull.judge(run, force - speed * (end - stop), closed_form, tolerance)


def greatest_force(integrator: str, mu_static: float, mu_dynamic: float) -> Outcome:
    """With mu_s <= mu_d there is no drop: the block leaves at mu_d with v (1 - cos t).

    The force swings up by v, and is sampled in steps of h.
    """
    speed = 0.1
    pull = in_steps_of(2e-3, integrator, pulled_at(speed, UNDAMPED))
    count = math.ceil((mu_dynamic / speed + 6.0) / pull.h)
    run = pull.simulate(uniform(1, mu_static, mu_dynamic), count, every=1)
    closed_form = mu_dynamic + speed
    return pull.judge(run, run.static_friction, closed_form, 2.0 * speed * pull.h / closed_form)


def path_without_friction(integrator: str) -> Outcome:
    """mu_s = mu_d = 0: an oscillator under a moving slider, u = v (t - sin t).

    At first no force is there to let it go: it may start late by h.
    """
    speed, end = 0.1, 6.0
    pull = in_steps_of(0.01, integrator, pulled_at(speed, UNDAMPED))
    run, force, _ = pull_block(pull, end - pull.h / 2.0, 0.0, 0.0)
    value, path = speed * run.steps * pull.h - force, end - math.sin(end)
    return pull.judge(run, value, speed * path, 2.0 * pull.h / path)


def weakenings(integrator: str) -> Iterator[Case]:
    """Friction that weakens, from gently to within one step, and the limits of both laws."""
    case = partial(Case, "weakening", integrator)
    for rate in (0.1, 0.5, 0.7):
        name = f"block with slip weakening at {rate:g} K_s"
        yield case(name, rate, "spring force, F_n", force_while_creeping, (rate,))
    for rate in (1.5, 10.0, 1e2, 1e3, 1e4, 1e6, 1e12):
        name = f"block with slip weakening at {rate:g} K_s"
        yield case(name, rate, AFTER_SLIP, force_after_slip_weakening, (rate,))
    for rate in (1.0, 10.0, 1e2, 1e3, 1e6):
        name = f"block with velocity weakening at {rate:g} m omega"
        yield case(name, rate, AFTER_SLIP, force_after_velocity_weakening, (rate,))
    for rate in (1e-2, 1.0, 1e2, 1e4, 1e8):
        name = f"steady sliding with velocity weakening at {rate:g} m omega"
        yield case(name, rate, "force of steady sliding, F_n", force_of_steady_sliding, (rate,))
    for law in ("slip_weakening", "velocity_weakening"):
        name = f"{law} with {LAWS[law]} = 1e-300"
        yield case(name, math.inf, FRICTION, is_coulomb, (law,), "the same")


def weakening(integrator: str, law: str, rate: float, material: Material | None = None) -> Pull:
    """Pull under a law whose friction falls at this rate W, in steps of 0.02."""
    material = material or pulled_at(SPEED, UNDAMPED)
    constant = DROP / rate * material.block_load / material.k_s
    if law == "velocity_weakening":
        constant *= material.omega_min
    weak: dict[str, Any] = {"law": law, LAWS[law]: constant}
    return in_steps_of(0.02, integrator, replace(material, **weak))


def force_while_creeping(integrator: str, rate: float) -> Outcome:
    """Friction falls more slowly than the spring: s" = v t - (1 - W) s swings about a creep.

    There is no slip; seen before it comes to rest again.
    """
    pull = weakening(integrator, "slip_weakening", rate)
    k = math.sqrt(1.0 - rate)
    run, force, end = pull_block(pull, MU_STATIC / SPEED + 5.0 / k)
    t = end - MU_STATIC / SPEED
    closed_form = MU_STATIC + SPEED * t - SPEED / k**2 * (t - math.sin(k * t) / k)
    return pull.judge(run, force, closed_form, SPEED * t * pull.h**2 / closed_form)


def force_after_slip_weakening(integrator: str, rate: float) -> Outcome:
    """The way, s" = v t + (W - 1) s, grows to d_c; then the block swings under mu_d and stops.

    What friction takes while it weakens, and where the block stops, is off by a share of
    (mu_s - mu_d) h². The time until it is weak is off by a share of (k h)²/4, k² = W - 1, and all
    of it is missed beyond k h = 2, where a block weakens at once.
    """
    pull = weakening(integrator, "slip_weakening", rate)
    k, far = math.sqrt(rate - 1.0), DROP / rate
    weak = brentq(lambda t: SPEED / k**2 * (math.sinh(k * t) / k - t) - far, 0.0, 20.0 / k)
    over = MU_STATIC + SPEED * weak - far - MU_DYNAMIC
    rise = SPEED - SPEED / k**2 * (math.cosh(k * weak) - 1.0)
    lasts = brentq(lambda t: rise * math.cos(t) - over * math.sin(t) - SPEED, 1.5, 5.0)
    closed_form = MU_DYNAMIC + (over * math.cos(lasts) + rise * math.sin(lasts))
    late = weak * min((k * pull.h) ** 2 / 4.0, 1.0)
    return after_weakening(pull, MU_STATIC / SPEED + weak + lasts, closed_form, late)


def force_after_velocity_weakening(integrator: str, rate: float) -> Outcome:
    """Beside DOP853; near its stop the block feels mu_s again."""
    pull = weakening(integrator, "velocity_weakening", rate)
    scale = DROP / rate

    def motion(t: float, state: tuple[float, float]) -> tuple[float, float]:
        way, speed = state
        friction = MU_DYNAMIC + DROP / (1.0 + max(speed, 0.0) / scale)
        return speed, MU_STATIC + SPEED * t - way - friction

    def stops(t: float, state: tuple[float, float]) -> float:
        return state[1]

    stops.terminal, stops.direction = True, -1.0  # type: ignore[attr-defined]
    accuracy = {"rtol": 1e-11, "atol": 1e-13, "first_step": 1e-3 / max(rate, 1.0)}
    solution = solve_ivp(motion, (0.0, 50.0), (0.0, 0.0), "DOP853", events=stops, **accuracy)
    closed_form = float(MU_STATIC + SPEED * solution.t[-1] - solution.y[0, -1])
    return after_weakening(pull, MU_STATIC / SPEED + float(solution.t[-1]), closed_form)


def after_weakening(pull: Pull, stop: float, closed_form: float, late: float = 0.0) -> Outcome:
    """Compare the force on a block at rest with that at which it stopped."""
    run, force, end = pull_block(pull, stop + 1.0)
    tolerance = (SPEED * (4.0 * pull.h + late) + 2.0 * DROP * pull.h**2) / closed_form
    return pull.judge(run, force - SPEED * (end - stop), closed_form, tolerance)


def force_of_steady_sliding(integrator: str, rate: float) -> Outcome:
    """Damped, a block follows the slider in the end: mu(v) + gamma v, but for a last swing."""
    gamma, speed = 2.0, 0.1
    material = with_damping(gamma, speed)
    pull = weakening(integrator, "velocity_weakening", rate, material)
    run, force, _ = pull_block(pull, MU_STATIC / speed + 100.0)
    closed_form = MU_DYNAMIC + DROP / (1.0 + speed * rate / DROP) + gamma * speed
    return pull.judge(run, force, closed_form, 1e-9)


def is_coulomb(integrator: str, law: str) -> Outcome:
    """In the limit both laws are Coulomb's: static friction, beside it.

    Leapfrog's is so to the bit; Runge-Kutta turns slow blocks at once, which Coulomb's do not.
    """
    plain = Pull(integrator, pulled_at(SPEED, UNDAMPED), 2e-8)
    weak: dict[str, Any] = {"law": law, LAWS[law]: 1e-300}
    pull = replace(plain, material=replace(plain.material, **weak))
    run, exact = (each.simulate(uniform(3, MU_STATIC, MU_DYNAMIC)) for each in (pull, plain))
    word = "the same" if np.array_equal(run.t_det, exact.t_det) else "differs"
    return pull.judge(run, run.static_friction, exact.static_friction, 0.0, word)


def rests(integrator: str) -> Iterator[Case]:
    """A million steps at rest, between slips or at the threshold, and one step more."""
    case = partial(Case, "rest", integrator)
    yield case("stuck for a million steps", MILLION, "force, P l² N²", stuck, expected="at rest")
    long = MILLION if integrator == "leapfrog" else TENTH
    name = f"stuck among others that slip for {long} steps"
    yield case(name, long, "none", stuck_among_others, (long,), "at rest")
    name, moved = f"stuck between two slips for {TENTH} steps", "displacement, F_n/K_s"
    yield case(name, TENTH, moved, held_after_slip, expected="at rest")
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


def stuck_among_others(integrator: str, count: int) -> Outcome:
    """The middle one of nine is held for good; the others slip past several times, and ring."""
    pull = Pull.at(0.2, integrator, UNDAMPED)
    pull = pull.with_speed(4.0 / (count * pull.h))
    contact, mu_static, mu_dynamic = uniform(3, 1.0, 0.6)
    mu_static[1, 1] = 1e9
    run = pull.simulate((contact, mu_static, mu_dynamic), count)
    moved = run.displacement[:, 1, 1].any() or np.isfinite(run.t_det[1, 1])
    slipped = np.count_nonzero(np.isfinite(run.t_det)) == 8
    word = "at rest" if slipped and pull.keeps_energy(run) and not moved else "moves"
    return Outcome(word, run.energy.relative_residual)


def held_after_slip(integrator: str) -> Outcome:
    """Between two slips a block does not move by one bit."""
    pull = Pull.at(0.1, integrator, UNDAMPED)
    speed, every = 0.7 / (TENTH * pull.h), TENTH // 100  # 0.8/v lie between
    pull = pull.with_speed(speed)
    landed = math.ceil((1.0 / speed + 10.0) / (every * pull.h)) * every
    steps = np.array([landed, landed + TENTH])
    run = pull.simulate(uniform(1, 1.0, 0.6), steps[1], every, snapshot_times=steps * pull.step)
    before, after = run.snapshots[:, 0, 0, 0] * pull.material.k_s / pull.material.block_load
    word = "at rest" if before > 0.0 and run.switches.sum() == 1 else "moves"
    return pull.judge(run, after, before, 0.0, word)


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
    pull = in_steps_of(0.02, integrator, pulled_at(SPEED, UNDAMPED))
    run = pull.simulate(uniform(1, MU_STATIC, MU_DYNAMIC), MILLION, every=20)
    cycles = SPEED * MILLION * pull.h / 0.8
    return pull.judge(run, run.force.mean() / run.normal_force, MU_DYNAMIC, 1.0 / cycles)
