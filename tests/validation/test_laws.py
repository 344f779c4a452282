"""Friction that weakens, finer than in the table of cases.

A block under a slider lets go at mu_s F_n without a drop. While friction falls along its way s,

    m s" = K_s v t + (W - K_s) s,    W = (mu_s - mu_d) F_n/d_c,

which grows as sinh for W > K_s, as t³ for W = K_s, and swings about a steady creep for W < K_s.
"""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from springblock import Material, Pattern, simulate
from springblock.accuracy.specimens import drawn, flat, uniform
from springblock.accuracy.stability.one_block import force_of_steady_sliding

FAST = Material(gamma=0.0, slider_velocity=5e-3)
MASS, K_S, LOAD, SPEED = FAST.mass, FAST.k_s, FAST.block_load, FAST.slider_velocity
OMEGA = FAST.omega_min
RELEASE = LOAD / (K_S * SPEED)
DROP = 0.4 * LOAD
#: d_c at which W is K_s, and a v_c like the speeds of a slip.
EVEN, MIDST = DROP / K_S, 0.1
SLIP = replace(FAST, law="slip_weakening", slip_distance=0.75 * EVEN)
VELOCITY = replace(FAST, law="velocity_weakening", speed_scale=MIDST)
LAWS = {"slip": SLIP, "velocity": VELOCITY}
#: A quarter of the step leaves a 16th of the error, but for terms of higher order.
COARSE, FINE = 5e-9, 1.25e-9
SECOND_ORDER = pytest.approx(16.0, rel=0.15)
SURFACE = flat(6, seed=6)  #: its blocks let go one after another


def pull(material, integrator, step, after, **options):
    """Pull one block until so long after its release, sampling every step."""
    how = {"material": material, "integrator": integrator, "step": step, "sample_interval": step}
    duration = math.ceil((RELEASE + after) / step) * step
    return simulate(*uniform(1, 1.0, 0.6), **how, duration=duration, **options)


def follow(material, longest):
    """Follow the block by DOP853 until d_c or for so long; returns the solution and its end."""
    distance = material.slip_distance if material.law == "slip_weakening" else math.inf

    def motion(t, state):
        way, speed = state
        weak = 1.0 - way / distance
        if material.law == "velocity_weakening":
            weak = 1.0 / (1.0 + max(speed, 0.0) / material.speed_scale)
        return speed, (K_S * (SPEED * t - way) + DROP - DROP * weak) / MASS

    def ends(t, state):
        return state[0] - 0.98 * distance

    ends.terminal = True
    accuracy = {"rtol": 1e-12, "atol": 1e-20, "first_step": 1e-12, "dense_output": True}
    solution = solve_ivp(motion, (0.0, longest), (0.0, 0.0), "DOP853", events=ends, **accuracy)
    return solution.sol, solution.t[-1]


@pytest.mark.parametrize(
    ("material", "longest", "fastest"),
    [
        (replace(SLIP, slip_distance=EVEN / 8.0), 20.0 / OMEGA, 9.0 * OMEGA**2),
        (SLIP, 20.0 / OMEGA, 7.0 / 3.0 * OMEGA**2),
        (replace(SLIP, slip_distance=EVEN), 20.0 / OMEGA, 2.0 * OMEGA**2),
        # creeps: seen before it comes to rest
        (replace(SLIP, slip_distance=2.0 * EVEN), 5.0 / OMEGA / math.sqrt(0.5), 1.5 * OMEGA**2),
        (VELOCITY, 5.5e-7, (DROP / MIDST / MASS) ** 2),  # in the midst of the slip
    ],
    ids=["d_c/8", "3/4 d_c", "d_c", "2 d_c", "velocity"],
)
def test_a_slip_grows_as_friction_weakens_against_the_spring(
    material, longest, fastest, integrator
):
    """To second order in h; the bound is the square of the fastest rate, W/m + omega² or more."""
    exact, after = follow(material, longest)
    far, errors = exact(after)[0], []
    for step in (COARSE, FINE):
        run = pull(material, integrator, step, after)
        t, way = run.time - RELEASE, SPEED * run.time - run.force / K_S
        on = (t > 0.0) & (t <= after)
        errors.append(np.abs(way[on] - exact(t[on])[0]).max() / far)
    assert errors[0] < fastest * COARSE**2
    assert errors[0] / errors[1] == SECOND_ORDER


@pytest.mark.parametrize("rate", [1e-2, 1.0, 1e4])
def test_steady_sliding_takes_the_force_of_its_speed_to_rounding(rate, integrator):
    assert abs(force_of_steady_sliding(integrator, rate).relative_error) < 1e-11


def test_a_block_heals_as_it_comes_to_rest(integrator):
    """The next slip begins at mu_s F_n again, and takes as much from the spring."""
    run = pull(SLIP, integrator, 5e-9, 2.5 * RELEASE)
    slips = np.flatnonzero(run.switches)
    assert len(slips) >= 3
    rise, within = K_S * SPEED * 5e-9, 2.0 * (OMEGA * 5e-9) ** 2 * DROP
    np.testing.assert_allclose(run.force[slips - 1], LOAD, rtol=0, atol=2.0 * rise)
    lowest = [run.force[one:other].min() for one, other in itertools.pairwise(slips)]
    np.testing.assert_allclose(lowest, lowest[0], rtol=0, atol=2.0 * rise + within)
    assert lowest[0] > 0.2 * LOAD + DROP / 50.0  # without weakening it would fall to 2 mu_d - mu_s


def test_the_heat_of_a_slip_is_that_of_mu_d_and_half_the_drop_over_d_c(integrator):
    run = pull(SLIP, integrator, 2.5e-9, 1.5e-6)
    assert not run.velocity.any()
    heat = 0.6 * LOAD * run.displacement[0, 0, 0] + 0.5 * DROP * SLIP.slip_distance
    assert run.energy.friction == pytest.approx(heat, rel=(OMEGA * 2.5e-9) ** 2, abs=0)


@pytest.mark.parametrize("law", LAWS)
def test_the_ledger_closes_to_second_order_as_friction_weakens(law, integrator):
    coarse, fine = (
        abs(pull(LAWS[law], integrator, step, 5.5e-7).energy.relative_residual)
        for step in (COARSE, FINE)
    )
    assert coarse < (OMEGA * COARSE) ** 2
    assert coarse / fine > 14.0


@pytest.mark.parametrize(("law", "after"), [("coulomb", 2e-7), ("slip", 6e-7), ("velocity", 6e-7)])
@pytest.mark.parametrize("direction", ["y", 37.0, 180, 251.5])
def test_friction_is_the_same_in_all_directions(direction, integrator, law, after):
    """The slip along any heading is that along x; the block moves along the heading alone.

    Differences of a rounding have grown over some 1,300 steps, and in a slip that begins without a
    drop by a hundredfold.
    """
    material, rounding = LAWS.get(law, FAST), 1e-10 if law == "coulomb" else 1e-8
    along_x = pull(material, integrator, 1e-8, after)
    turned = pull(material, integrator, 1e-8, after, direction=direction)
    np.testing.assert_allclose(turned.force, along_x.force, rtol=0, atol=rounding * LOAD)
    ux, uy = turned.displacement[:, 0, 0]
    path = along_x.displacement[0, 0, 0]
    angle = np.radians(90.0 if direction == "y" else direction)
    assert path > 0.0
    assert np.cos(angle) * ux + np.sin(angle) * uy == pytest.approx(path, rel=rounding, abs=0)
    assert np.sin(angle) * ux - np.cos(angle) * uy == pytest.approx(0.0, abs=rounding * path)


def test_friction_that_never_weakens_is_one_coefficient(integrator):
    """Both laws then have mu = mu_s for good."""
    laws = replace(SLIP, slip_distance=1e300), replace(VELOCITY, speed_scale=1e300)
    runs = [simulate(*SURFACE, law, integrator=integrator, duration=2e-5) for law in laws]
    np.testing.assert_array_equal(runs[0].t_det, runs[1].t_det)
    contact, mu_static, _ = SURFACE
    plain = simulate(contact, mu_static, mu_static, FAST, duration=2e-5)
    assert runs[0].static_friction == pytest.approx(plain.static_friction, rel=1e-4)


@pytest.mark.parametrize("law", LAWS)
def test_the_first_detachment_is_coulombs(law, integrator):
    """But for what its neighbours have moved within that step, as Runge-Kutta sees them."""
    surface = drawn(Pattern.pillars(12, 4, 2), 1)
    run, plain = (
        simulate(*surface, replace(material, gamma=5e3), integrator=integrator)
        for material in (LAWS[law], FAST)
    )
    slack = {"leapfrog": 0.0, "rk4": (OMEGA * 2e-8) ** 2 * 2e-8}[integrator]
    assert run.t_first == pytest.approx(plain.t_first, rel=0, abs=slack)
