"""One block on its spring, finer than in the table of cases.

The block sticks until K_s v t = mu_s F_n. The release is found within its step, exactly, since the
force rises evenly before it. A sample at the end of that step does not know of it yet, and misses
up to (omega h)²/2 of the drop.
"""

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


def release_time(mu):
    return mu * LOAD / RATE


def pull(mu_static, mu_dynamic, integrator, *, after=0.0, step=1e-8, material=UNDAMPED):
    """Pull one block until so long after its release, sampling every step."""
    duration = release_time(max(mu_static, mu_dynamic)) + after
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


@pytest.mark.parametrize("direction", [60.0, "y", 251.5])
def test_a_stuck_block_is_found_to_slide_in_time_in_any_direction(direction, integrator):
    """A row at rest is skipped for many steps, but no further than its weakest block allows."""
    setup, duration = Setup(integrator=integrator, sample_interval=1e-6), release_time(1.0) + 1e-6
    run = simulate(uniform(4, 1.0, 0.6), setup, direction, duration)
    assert run.t_det == pytest.approx(np.full((4, 4), release_time(1.0)), rel=1e-12)


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
