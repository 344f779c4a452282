"""Coulomb's law in one step of time: what friction leaves of a block's trial velocity."""

import numpy as np
import pytest
from numba import njit

from springblock.solver.friction import coulomb

STATIC, DYNAMIC = 1.0, 0.6


@njit(error_model="numpy")  # as in the integrators: dividing by zero is no error there
def after(w, v, f, static=STATIC, dynamic=DYNAMIC):
    """Velocity that friction leaves of the trial velocity w, after v and under F_mot = f."""
    new_x, new_y, _, _ = coulomb(w[0], w[1], v[0], v[1], f[0], f[1], static, dynamic)
    return new_x, new_y


def released(force, static=STATIC, dynamic=DYNAMIC):
    """Velocity after the first step of a block at rest, under a force at an angle."""
    f = (0.8 * force, -0.6 * force)
    return after(f, (0.0, 0.0), f, static, dynamic)


@pytest.mark.parametrize("force", [0.0, 0.3, 0.6, 0.61, 1.0 - 1e-15])
def test_static_friction_holds_a_block_up_to_its_threshold(force):
    assert released(force) == (0.0, 0.0)


@pytest.mark.parametrize("force", [1.0 + 1e-12, 1.5, 40.0])
def test_beyond_the_threshold_dynamic_friction_takes_its_part(force):
    speed = force - DYNAMIC
    assert released(force) == pytest.approx((0.8 * speed, -0.6 * speed), rel=1e-14, abs=0)


@pytest.mark.parametrize("force", [0.05, 0.3, 0.59])
def test_a_block_with_mu_s_below_mu_d_stays_until_mu_d(force):
    """Let go at mu_s, it would come to rest in the same instant: no flicker."""
    assert released(force, static=0.05) == (0.0, 0.0)


def test_a_block_with_mu_s_below_mu_d_leaves_gently():
    speed = np.hypot(*released(0.6 + 1e-9, static=0.05))
    assert speed == pytest.approx(1e-9, rel=1e-6, abs=0)  # a difference of numbers near 0.6


def test_without_friction_nothing_is_taken():
    assert after((1e-9, 2e-9), (-1.0, 0.0), (3.0, 0.0), 0.0, 0.0) == (1e-9, 2e-9)


@pytest.mark.parametrize("force", [(9.0, 0.0), (-9.0, 0.0), (0.0, 9.0)])
def test_a_block_slower_than_one_step_of_friction_stops_exactly(force):
    """|w| <= mu_d F_n h/m: friction cannot do more than stop it, whatever the force."""
    assert after((0.36, -0.48), (0.5, -0.5), force) == (0.0, 0.0)


@pytest.mark.parametrize("before", [0.5, 1.0, 3.0])
def test_a_faster_block_loses_one_step_of_friction(before):
    v = (0.6 * before, -0.8 * before)
    speed = 2.0 - DYNAMIC
    kept = after((1.2, -1.6), v, (0.0, 0.0))
    assert kept == pytest.approx((0.6 * speed, -0.8 * speed), rel=1e-14, abs=0)


def test_a_block_that_turns_back_sticks():
    """At the instant of rest within the step, F_mot is within the static threshold."""
    assert after((-0.7, 0.1), (0.2, 0.0), (-0.9, 0.1)) == (0.0, 0.0)


def test_a_block_that_is_torn_back_slides_on():
    """F_mot exceeds the static threshold at the instant of rest: there is nothing to hold it."""
    assert after((-0.8, 0.0), (0.2, 0.0), (-1.01, 0.0)) == pytest.approx(
        (-0.2, 0.0), rel=1e-14, abs=0
    )


def test_a_block_that_turns_aside_slides_on():
    assert np.hypot(*after((0.1, 1.2), (0.2, 0.0), (0.1, 0.9))) > 0.0


def test_friction_opposes_motion_and_never_exceeds_its_law(rng):
    """For any motion and force: a sliding block loses mu_d F_n h/m, against its velocity.

    It stops only where that would be too much, or where it turns back.
    """
    motions = rng.normal(scale=[[1.0], [1.0], [2.0]], size=(1000, 3, 2))
    w, v, _ = motions.transpose(1, 0, 2)
    kept = np.array([after(*motion) for motion in motions])
    sliding = kept.any(axis=1)
    assert 100 < sliding.sum() < 900
    taken = w - kept
    np.testing.assert_allclose(np.hypot(*taken[sliding].T), DYNAMIC, rtol=1e-13)
    assert (np.sum(taken * w, axis=1) >= 0.0).all()
    turned = np.sum(w * v, axis=1) <= 0.0
    assert (turned | (np.hypot(*w.T) <= DYNAMIC))[~sliding].all()


def test_friction_opposes_the_mean_velocity_of_a_block_that_slides_on(rng):
    """A block that turns aside feels it neither half a step early nor half a step late."""
    motions = rng.normal(scale=[[1.0], [1.0], [2.0]], size=(1000, 3, 2))
    w, v, _ = motions.transpose(1, 0, 2)
    kept = np.array([after(*motion) for motion in motions])
    on = kept.any(axis=1) & (np.sum(w * v, axis=1) > 0.0)
    assert on.sum() > 100
    taken, mean = (w - kept)[on], 0.5 * (v + kept)[on]
    across = taken[:, 0] * mean[:, 1] - taken[:, 1] * mean[:, 0]
    np.testing.assert_allclose(across, 0.0, atol=1e-13)
    assert (np.sum(taken * mean, axis=1) > 0.0).all()
