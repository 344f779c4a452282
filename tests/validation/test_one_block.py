"""A single block on its spring: stick and slip in closed form, and the pairs that reduce to it.

The block sticks until K_s v t = mu_s F_n. From then on, with tau = t - t_1, the spring force
follows F'' + gamma F' + omega² (F - F_inf) = 0, where F_inf = mu_d F_n + gamma m v, from
F = mu_s F_n with slope K_s v, until the block comes to rest.

The release is found within its step, exactly, since the force rises evenly before it. A sample at
the end of that step does not know of it yet, and misses up to (omega h)²/2 of the drop.
"""

import math
from dataclasses import replace

import numpy as np
import pytest

from springblock import Material, simulate
from springblock.accuracy.specimens import uniform

INTEGRATORS = ["leapfrog", "rk4"]
UNDAMPED = Material(gamma=0.0)
OMEGA = UNDAMPED.omega_min
LOAD = UNDAMPED.block_load
RATE = UNDAMPED.k_s * UNDAMPED.slider_velocity  #: N/s, of the force on a block at rest
STEPS = [2e-8, 1e-8, 5e-9]


def release_time(mu):
    return mu * LOAD / RATE


def pull(mu_static, mu_dynamic, *, after=0.0, step=1e-8, n=1, **options):
    """Pull until so long after the release, sampling every step."""
    duration = release_time(max(mu_static, mu_dynamic)) + after
    scene = uniform(n, mu_static, mu_dynamic)
    settings = {"material": UNDAMPED, **options}
    return simulate(*scene, step=step, sample_interval=step, duration=duration, **settings)


def slip(tau, mu_static, mu_dynamic, gamma):
    """Spring force at tau after the release, while the block slides forwards."""
    far = mu_dynamic * LOAD + gamma * UNDAMPED.mass * UNDAMPED.slider_velocity
    start = mu_static * LOAD - far
    ringing = math.sqrt(OMEGA**2 - gamma**2 / 4)
    swing = (RATE + gamma / 2 * start) / ringing
    decay = np.exp(-gamma / 2 * tau)
    return far + decay * (start * np.cos(ringing * tau) + swing * np.sin(ringing * tau))


def slip_duration(drop):
    """Time from release to rest without damping, for drop = mu_s - mu_d.

    The velocity v (1 - cos omega tau) + V sin omega tau, V = drop F_n omega/K_s, returns to zero
    at tan(omega tau/2) = -V/v: a half period, and v/V of the next.
    """
    peak = drop * LOAD * OMEGA / UNDAMPED.k_s
    return 2.0 * (math.pi - math.atan(peak / UNDAMPED.slider_velocity)) / OMEGA


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("mu_static", [0.31, 1.0, 1.21])
def test_a_block_sticks_until_its_threshold_and_lets_go_just_then(mu_static, step, integrator):
    run = pull(mu_static, 0.2, after=1e-7, step=step, integrator=integrator)
    assert run.t_first == pytest.approx(release_time(mu_static), rel=1e-14)
    stuck = run.time <= release_time(mu_static)
    np.testing.assert_allclose(run.force[stuck], RATE * run.time[stuck], rtol=1e-14)
    assert 0.0 < run.static_friction - mu_static <= RATE * step / LOAD


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("gamma", [0.0, 5e5])
@pytest.mark.parametrize(("mu_static", "mu_dynamic"), [(1.0, 0.6), (0.8, 0.7), (1.0, 0.0)])
def test_the_slip_follows_its_closed_form(mu_static, mu_dynamic, gamma, step, integrator):
    damped = replace(UNDAMPED, gamma=gamma)
    half_period = math.pi / math.sqrt(OMEGA**2 - gamma**2 / 4)
    run = pull(
        mu_static,
        mu_dynamic,
        after=half_period,
        step=step,
        integrator=integrator,
        material=damped,
    )
    tau = run.time - release_time(mu_static)
    sliding = (tau > 0.0) & (tau < half_period - step)
    exact = np.abs(slip(tau[sliding], mu_static, mu_dynamic, gamma))
    missed = 0.5 * (OMEGA * step) ** 2 * (mu_static - mu_dynamic) * LOAD
    np.testing.assert_allclose(run.force[sliding], exact, rtol=0, atol=missed)


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize(("mu_static", "mu_dynamic"), [(1.0, 0.6), (0.8, 0.7)])
def test_the_force_falls_to_twice_mu_d_less_mu_s(mu_static, mu_dynamic, step, integrator):
    """Seen from the slider, the block leaves and arrives with velocity -v: what the spring loses
    is friction's work, so (mu_s² - F²)/2 = mu_d (mu_s - F), whatever the slider's velocity.

    The release overshoots mu_s F_n by K_s v h at most, and a step holds the stop, at which the
    block would go on or back by (mu_s - mu_d) F_n h²/m.
    """
    drop = (mu_static - mu_dynamic) * LOAD
    duration = slip_duration(mu_static - mu_dynamic)
    run = pull(mu_static, mu_dynamic, after=2 * duration, step=step, integrator=integrator)
    slipped = run.time > release_time(mu_static) + step
    lowest = int(np.argmin(np.where(slipped, run.force, np.inf)))
    expected = (2 * mu_dynamic - mu_static) * LOAD
    tolerance = 2 * RATE * step + drop * (OMEGA * step) ** 2
    assert run.force[lowest] == pytest.approx(expected, abs=tolerance)
    # late by a step at its start, and found to a step at its end
    assert run.time[lowest] - release_time(mu_static) == pytest.approx(duration, abs=2 * step)
    # then it sticks for good: the force rises as before
    stuck = np.diff(run.force[lowest + 2 :])
    np.testing.assert_allclose(stuck, RATE * step, rtol=1e-9)  # differences of 1e-6 N
    assert run.switches.sum() == 1


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_slips_follow_each_other_at_equal_drops(integrator):
    """From 2 mu_d - mu_s the force rises to mu_s again: a period of 2 (mu_s - mu_d) F_n/(K_s v)
    at rest and one slip."""
    period = release_time(2 * 0.4) + slip_duration(0.4)
    run = pull(1.0, 0.6, after=3.5 * period, integrator=integrator, step=5e-9)
    releases = run.time[np.flatnonzero(run.switches)]
    assert len(releases) == 4
    # each minimum is missed by (mu_s - mu_d) F_n (omega h)², which takes time to be made up for
    missed = 0.4 * LOAD * (OMEGA * 5e-9) ** 2 / RATE
    np.testing.assert_allclose(np.diff(releases), period, rtol=0, atol=missed + 3 * 5e-9)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_block_without_dynamic_friction_is_caught_at_the_far_end(integrator):
    """mu_d = 0: it swings through to -mu_s F_n, less what damping took, and is held there."""
    damped = replace(UNDAMPED, gamma=2e5)
    half_period = math.pi / math.sqrt(OMEGA**2 - damped.gamma**2 / 4)
    run = pull(1.0, 0.0, after=3 * half_period, integrator=integrator, material=damped)
    assert run.switches.sum() == 1
    assert not run.velocity.any()
    turned = slip(half_period, 1.0, 0.0, damped.gamma)
    slider = UNDAMPED.slider_velocity * run.time[-1]
    held = UNDAMPED.k_s * (slider - run.displacement[0, 0, 0])
    pulled_since = RATE * 2 * half_period
    missed = RATE * 1e-8 + LOAD * (OMEGA * 1e-8) ** 2  # by a step at the release, and at the stop
    assert held - pulled_since == pytest.approx(turned, abs=missed)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_block_with_mu_s_below_mu_d_lets_go_once_and_follows_the_slider(integrator):
    """It starts at mu_d F_n, not at mu_s F_n, with v (1 - cos omega tau): without a drop."""
    run = pull(0.3, 0.61, after=2e-5, integrator=integrator, material=Material())
    assert run.t_first == pytest.approx(release_time(0.61), rel=1e-14)
    assert run.switches.sum() == 1
    ripple = RATE / OMEGA
    beside = np.abs(run.force[run.time > run.t_first] - 0.61 * LOAD)
    assert beside.max() < 1.01 * ripple + RATE * 1e-8  # let go a step late, and sampled in steps


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("direction", ["y", 37.0, 180, 251.5])
def test_friction_is_the_same_in_all_directions(direction, integrator):
    """The slip along any heading is that along x; the block moves along the heading alone.

    Differences of a rounding have grown over some 13,000 steps.
    """
    along_x = pull(1.0, 0.6, after=2e-7, integrator=integrator)
    turned = pull(1.0, 0.6, after=2e-7, integrator=integrator, direction=direction)
    np.testing.assert_allclose(turned.force, along_x.force, rtol=0, atol=1e-10 * LOAD)
    ux, uy = turned.displacement[:, 0, 0]
    path = along_x.displacement[0, 0, 0]
    angle = np.radians(90.0 if direction == "y" else direction)
    assert np.cos(angle) * ux + np.sin(angle) * uy == pytest.approx(path, rel=1e-10, abs=0)
    assert np.sin(angle) * ux - np.cos(angle) * uy == pytest.approx(0.0, abs=1e-10 * path)
