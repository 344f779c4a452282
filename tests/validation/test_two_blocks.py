"""Two columns of two blocks: one held fast, the other free to move.

By symmetry about the x axis the free blocks move by (a, b) and (a, -b). The axial spring to the
neighbour at rest, the one between them (strained by 2b), and a diagonal at 45 degrees each give
K_int a, 2 K_int b and K_int (a - b)/4, so that with K_s = K_int

    m (a", b") = K_s (v t, 0) - K_int M (a, b),    M = ((9/4, -1/4), (-1/4, 13/4)).
"""

import numpy as np
import pytest

from springblock import Material, simulate

GENTLE = Material(gamma=0.0, slider_velocity=5e-9, pressure=0.5)  #: strains of 1e-7: linear
INTEGRATORS = ["leapfrog", "rk4"]
VALUES, MODES = np.linalg.eigh([[2.25, -0.25], [-0.25, 3.25]])
OMEGAS = np.sqrt(VALUES * GENTLE.k_int / GENTLE.mass)


def follow(time, waited=0.0):
    """Displacement (a, b) of the free blocks, at rest until `waited`, at times (k,) after it.

    Each mode's coordinate follows its own slider: v (waited + t - waited cos - sin/omega)/value.
    """
    phase = np.multiply.outer(OMEGAS, time)
    ramp = waited + time - waited * np.cos(phase) - np.sin(phase) / OMEGAS[:, None]
    shares = MODES[0] / VALUES  # of a force along x
    return GENTLE.slider_velocity * MODES @ (shares[:, None] * ramp)


def columns(left, right):
    """Two columns with a coefficient each."""
    return np.array([[left, right], [left, right]])


@pytest.mark.parametrize(("integrator", "order"), [("leapfrog", 2), ("rk4", 4)])
def test_a_free_column_beside_a_fixed_one_follows_its_two_modes(integrator, order):
    """Phase errors are omega t (omega h)²/24 of leapfrog and omega t (omega h)⁴/120 of rk4."""
    step, times = 5e-9, [4e-7, 1.2e-6, 3e-6]
    run = simulate(
        columns(True, False),
        columns(1e9, 0.0),
        columns(0.0, 0.0),
        material=GENTLE,
        integrator=integrator,
        step=step,
        duration=3e-6,
        snapshot_times=times,
    )
    assert not run.snapshots[:, :, :, 0].any()
    a, b = follow(np.array(times))
    moved = run.snapshots[:, :, :, 1]
    lag = OMEGAS[-1] * times[-1] * (OMEGAS[-1] * step) ** order / {2: 24, 4: 120}[order]
    tolerance = GENTLE.slider_velocity / OMEGAS[0] * lag
    np.testing.assert_allclose(moved[:, 0], np.stack([a, a], axis=1), rtol=0, atol=tolerance)
    np.testing.assert_allclose(moved[:, 1], np.stack([b, -b], axis=1), rtol=0, atol=tolerance)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_weak_column_lets_go_at_its_threshold_and_swings_about_its_new_place(integrator):
    """At rest there is no spring force but the slider's: t = mu_s F_n/(K_s v). Without dynamic
    friction, the weak column then follows its modes; late by a step at most."""
    step, swing = 1e-9, 1.5e-7
    threshold = 0.5 * GENTLE.block_load
    waited = threshold / (GENTLE.k_s * GENTLE.slider_velocity)
    run = simulate(
        columns(True, True),
        columns(1e9, 0.5),
        columns(0.0, 0.0),
        material=GENTLE,
        integrator=integrator,
        step=step,
        sample_interval=step,
        duration=waited + swing,
    )
    assert np.isnan(run.t_det[:, 0]).all()
    assert (run.t_det[:, 1] == run.t_first).all()
    assert abs(run.t_first - waited) <= step
    times = run.time[-1] - waited + np.array([-step, 0.0])
    (_, a), (slower_b, b) = follow(times, waited)
    fastest = GENTLE.slider_velocity * waited * OMEGAS[-1]
    moved = run.displacement[:, :, 1]
    np.testing.assert_allclose(moved[0], [a, a], rtol=0, atol=fastest * step)
    np.testing.assert_allclose(moved[1], [b, -b], rtol=0, atol=2 * (b - slower_b))


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_columns_of_equal_strength_are_one_block(integrator):
    """All four let go at once, no spring between them is ever strained, and they slide alike."""
    ones = np.ones((2, 2), bool)
    four = simulate(ones, 1.0 * ones, 0.6 * ones, integrator=integrator, duration=1.34e-4)
    one = simulate(
        ones[:1, :1],
        1.0 * ones[:1, :1],
        0.6 * ones[:1, :1],
        integrator=integrator,
        duration=1.34e-4,
    )
    assert (four.t_det == one.t_det).all()
    np.testing.assert_array_equal(four.displacement, one.displacement * np.ones((2, 2, 2)))
    np.testing.assert_allclose(four.force, 4 * one.force, rtol=1e-12)
