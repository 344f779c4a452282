"""One block on its spring, finer than in the table of cases.

The block sticks until K_s v t = mu_s F_n. The release is found within its step, exactly, since the
force rises evenly before it. A sample at the end of that step does not know of it yet, and misses
up to (omega h)²/2 of the drop.

Where friction falls with the slip s, the block detaches without a drop:

    m s" = K_s v t + (W - K_s) s,    W = (mu_s - mu_d) F_n/d_c,

which grows as sinh for W > K_s, as t³ for W = K_s, and swings about a steady creep for W < K_s.
"""

import math
from dataclasses import replace

import numpy as np
import pytest

from specimens import flat, uniform
from springblock import Setup, simulate
from springblock.model.defaults import STEP
from springblock.study.accuracy.stability.cases import UNDAMPED
from springblock.study.accuracy.stability.one_block import slip

OMEGA = UNDAMPED.omega_min
LOAD = UNDAMPED.block_load
RATE = UNDAMPED.k_s * UNDAMPED.slider_velocity  #: N/s, of the force on a block at rest
STEPS = [2e-8, 5e-9]
FAST = replace(UNDAMPED, slider_velocity=5e-3)
DROP = 0.4 * LOAD
#: d_c at which W is K_s, and a v_c like the speeds of a slip.
EVEN, MIDST = DROP / UNDAMPED.k_s, 0.1
SLIP = replace(FAST, law="slip_weakening", slip_distance=0.75 * EVEN)
VELOCITY = replace(FAST, law="velocity_weakening", speed_scale=MIDST)


def release_time(mu, material=UNDAMPED):
    return mu * LOAD / (material.k_s * material.slider_velocity)


def pull(mu_static, mu_dynamic, integrator, *, after=0.0, step=1e-8, material=UNDAMPED):
    """Pull one block until so long after its release, sampling every step."""
    duration = release_time(max(mu_static, mu_dynamic), material) + after
    setup = Setup(material, integrator, step, sample_interval=step)
    return simulate(uniform(1, mu_static, mu_dynamic), setup, duration=duration)


@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("mu_static", [0.31, 1.0, 1.21])
def test_a_block_sticks_until_its_threshold_and_detaches_just_then(mu_static, step, integrator):
    run = pull(mu_static, 0.2, integrator, after=1e-7, step=step)
    assert run.t_first == pytest.approx(release_time(mu_static), rel=1e-14)
    stuck = run.time <= release_time(mu_static)
    np.testing.assert_allclose(run.force[stuck], RATE * run.time[stuck], rtol=1e-14)
    assert 0.0 < run.static_friction - mu_static <= RATE * step / LOAD


@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("gamma", [0.0, 5e5])
@pytest.mark.parametrize(("mu_static", "mu_dynamic"), [(0.8, 0.7), (1.0, 0.0)])
def test_the_slip_follows_an_accurate_integration(mu_static, mu_dynamic, gamma, step, integrator):
    """Throughout, and to second order in the step."""
    material = replace(UNDAMPED, gamma=gamma)
    path, lasts = slip(material, mu_static, mu_dynamic)
    how = {"after": lasts / OMEGA, "step": step, "material": material}
    run = pull(mu_static, mu_dynamic, integrator, **how)
    tau = run.time - release_time(mu_static)
    sliding = (tau > 0.0) & (tau < lasts / OMEGA - step)
    missed = 0.5 * (OMEGA * step) ** 2 * (mu_static - mu_dynamic) * LOAD
    exact = np.abs(RATE * run.time - LOAD * path(OMEGA * tau))[sliding]
    np.testing.assert_allclose(run.force[sliding], exact, rtol=0, atol=missed)


def test_a_block_with_mu_s_below_mu_d_does_not_flicker_among_others(integrator):
    """Its v (1 - cos omega t) touches zero once in each of the first few periods.

    Then damping keeps it away; a block that flickers detaches in every step, of which there are
    1500 before the others follow.
    """
    surface = flat(6, seed=3)
    surface.mu_static[2, 3], surface.mu_dynamic[2, 3] = 0.3, 0.6
    run = simulate(surface, Setup(integrator=integrator))
    assert abs(run.t_first - release_time(0.6)) <= STEP
    assert run.t_first == run.t_det[2, 3]
    others = np.delete(run.t_det, 2 * 6 + 3)
    assert others.min() - run.t_first > 1500 * STEP
    assert 1 <= run.switches[run.time < others.min()].sum() < 10


@pytest.mark.parametrize(
    ("material", "longest", "fastest"),
    [
        (replace(SLIP, slip_distance=EVEN / 8.0), 20.0, 9.0 * OMEGA**2),
        (SLIP, 20.0, 7.0 / 3.0 * OMEGA**2),
        (replace(SLIP, slip_distance=EVEN), 20.0, 2.0 * OMEGA**2),
        # creeps: seen before it comes to rest
        (replace(SLIP, slip_distance=2.0 * EVEN), 5.0 / math.sqrt(0.5), 1.5 * OMEGA**2),
        (VELOCITY, 5.5e-7 * OMEGA, (DROP / MIDST / FAST.mass) ** 2),  # in the midst of the slip
    ],
    ids=["d_c/8", "3/4 d_c", "d_c", "2 d_c", "velocity"],
)
def test_a_slip_grows_as_friction_weakens_against_the_spring(
    material, longest, fastest, integrator
):
    """Of second order in h; the bound is the square of the fastest rate, W/m + omega² or more."""
    release, (path, after) = release_time(1.0, material), slip(material, 1.0, 0.6, longest)
    if material.law == "slip_weakening":  # until friction has weakened
        weak = 0.98 * material.slip_distance * material.k_s / LOAD
        times = np.linspace(0.0, after, 4001)
        after = times[np.searchsorted(path(times), min(weak, path(after)))]
    errors = []
    for step in (5e-9, 1.25e-9):
        run = pull(1.0, 0.6, integrator, after=after / OMEGA, step=step, material=material)
        time, way = OMEGA * (run.time - release), run.time / release - run.force / LOAD
        on = (time > 0.0) & (time <= after)
        errors.append(np.abs(way - path(time))[on].max() / path(after))
    assert errors[0] < fastest * 5e-9**2
    assert errors[0] / errors[1] == pytest.approx(16.0, rel=0.15)  # but for terms of higher order


@pytest.mark.parametrize(("healing", "left"), [("instant", 1.0), ("none", 0.6)])
def test_a_block_that_has_stopped_detaches_at_the_strength_that_it_has_left(healing, left):
    """It slips further than d_c; the bound is the slider's pull between two samples."""
    material, step = replace(SLIP, healing=healing), 5e-9
    release = release_time(1.0, material)
    run = pull(1.0, 0.6, "leapfrog", after=2.0 * release, step=step, material=material)
    first, second = np.flatnonzero(run.switches)[:2]
    assert not run.switches[first + 1 : second].any()
    assert run.force[second] / LOAD == pytest.approx(left, abs=2.0 * step / release)
    assert abs(run.energy.relative_residual) < 1e-4
