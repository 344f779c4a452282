"""Rest: a million steps, and one step more."""

import math
from collections.abc import Iterator

import numpy as np

from springblock.accuracy.kernels import UNDAMPED
from springblock.accuracy.stability.cases import Case, Family, Outcome
from springblock.accuracy.stability.pull import PAPER, ROUNDING, Pull, pulled_at
from springblock.accuracy.surfaces import uniform


def stuck(integrator: str, count: int) -> Outcome:
    """Nothing moves by one bit, and the force is K_s v t N²."""
    pull = Pull.at(0.2, integrator, PAPER)
    run = pull.simulate(uniform(2, 1e9, 0.6), count)
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
    moved = np.abs(run.displacement[:, 1, 1]).max() > 0.0 or np.isfinite(run.t_det[1, 1])
    slipped = np.count_nonzero(np.isfinite(run.t_det)) == 8
    residual = run.energy.relative_residual
    kept = abs(residual) <= pull.may_miss(run, 9)
    word = "at rest" if slipped and kept and not moved else "moves"
    return Outcome(word, residual)


def held_after_slip(integrator: str, count: int) -> Outcome:
    """Between two slips a block does not move by one bit."""
    pull = Pull.at(0.1, integrator, UNDAMPED)
    speed, every = 0.7 / (count * pull.h), count // 100  # 0.8/v lie between
    pull = pull.with_speed(speed)
    landed = math.ceil((1.0 / speed + 10.0) / (every * pull.h)) * every
    steps = np.array([landed, landed + count])
    run = pull.simulate(uniform(1, 1.0, 0.6), steps[1], every, snapshot_times=steps * pull.step)
    before, after = run.snapshots[:, 0, 0, 0] * pull.material.k_s / pull.material.block_load
    word = "at rest" if before > 0.0 and run.switches.sum() == 1 else "moves"
    return pull.judge(run, after, before, 0.0, word)


def threshold_reached(integrator: str, count: int, excess: float) -> Outcome:
    """After `count` steps the force K_s v t is 1 + excess times the threshold; then one more."""
    pull = Pull.at(0.2, integrator, UNDAMPED)
    pull = pull.with_speed(1.0 / (count * pull.h))
    run = pull.simulate(uniform(1, 1.0 / (1.0 + excess), 0.6), count + 1)
    residual = run.energy.relative_residual
    if not (np.isfinite(run.t_first) and run.displacement.any()):
        return Outcome("at rest", residual)
    return Outcome("lets go", residual, run.t_first / pull.step, count, 1.0 / count)


def stick_slip_forever(integrator: str, count: int) -> Outcome:
    """The force saws between mu_s and 2 mu_d - mu_s: its mean is mu_d, but for the first rise."""
    speed, mu_dynamic = 0.01, 0.6
    pull = Pull(integrator, pulled_at(speed, UNDAMPED), 0.02 / UNDAMPED.omega_min)
    run = pull.simulate(uniform(1, 1.0, mu_dynamic), count, every=20)
    cycles = speed * count * pull.h / 0.8
    return pull.judge(run, run.force.mean() / run.normal_force, mu_dynamic, 1.0 / cycles)


def cases(integrator: str) -> Iterator[Case]:
    """Stuck, stuck between slips, slipping again and again, and at the threshold."""
    case, at_rest, none = Family("rest", integrator).case, "at rest", "none"
    million, tenth = 1_000_000, 100_000
    name = "stuck for a million steps"
    yield case(name, million, at_rest, "force, P l² N²", stuck, million)
    long = million if integrator == "leapfrog" else tenth
    name = f"stuck among others that slip for {long} steps"
    yield case(name, long, at_rest, none, stuck_among_others, long)
    name = f"stuck between two slips for {tenth} steps"
    yield case(name, tenth, at_rest, "displacement, F_n/K_s", held_after_slip, tenth)
    name = "sticking and slipping for a million steps"
    yield case(name, million, "agrees", "mean force, F_n", stick_slip_forever, million)
    first = "first detachment, steps"
    for excess, word, expected in ((-1e-12, "missed", at_rest), (1e-12, "passed", "lets go")):
        name = f"threshold {word} by 1e-12 after {tenth} steps"
        yield case(name, tenth, expected, first, threshold_reached, tenth, excess)
