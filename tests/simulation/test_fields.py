"""Stress, slip and state of blocks at chosen times, from equations solved by hand."""

import numpy as np
import pytest

from springblock import Material, Pattern, Setup, Surface, draw_friction, simulate
from springblock.simulation.fields import BlockState
from springblock.solver.integrators import INTEGRATORS

PAPER = Material()
ONE = Surface([[True]], mu_static=1.0, mu_dynamic=0.6)
LOADING = 400e-6 / 3  #: s, mu_s F_n/(K_s v) with mu_s = 1
STEP = 2e-8
#: s, three times while the block slides, which it does for half of 2π/√(K_s/m) = 0.8 µs.
SAMPLE = 4e-8
SLIDING = SAMPLE * (LOADING // SAMPLE + np.array([2, 4, 6]))


def threshold(material=PAPER):
    """mu_s F_n/l² of a block of a flat surface with mu_s = 1, Pa."""
    return material.block_load / material.spacing**2


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_block_bears_what_the_slider_pulls_until_it_slides(integrator):
    """To rounding: at rest τ l² = K_s v t, which is what F_mot is without neighbours."""
    thick = Material(thickness=1.5 * PAPER.thickness)
    times = np.array([2e-5, 1e-4, LOADING // 2e-7 * 2e-7])
    run = simulate(ONE, Setup(thick, integrator), duration=2e-4, snapshot_times=times)
    pull = thick.k_s * thick.slider_velocity * times / thick.spacing**2
    np.testing.assert_allclose(run.fields.stress[:, 0, 0, 0], pull, rtol=1e-12)
    assert not run.fields.stress[:, 1].any()
    assert not run.fields.slip.any()
    assert (run.fields.state == BlockState.STUCK).all()


@pytest.mark.parametrize(
    ("integrator", "law", "mu", "distance"),
    [
        ("rk4", {}, lambda slip, speed: 0.6, np.inf),
        (
            "leapfrog",
            {"law": "slip_weakening", "slip_distance": 1e-7},
            lambda slip, speed: 0.6 + 0.4 * np.maximum(1.0 - slip / 1e-7, 0.0),
            1e-7,
        ),
        (
            "leapfrog",
            {"law": "velocity_weakening", "speed_scale": 0.1},
            lambda slip, speed: 0.6 + 0.4 / (1.0 + speed / 0.1),
            np.inf,
        ),
        (
            "leapfrog",
            {"law": "config/examples/exponential_weakening.py"},
            lambda slip, speed: 0.6 + 0.4 * np.exp(-slip / 2e-8),
            2e-8,
        ),
    ],
    ids=["coulomb", "slip_weakening", "velocity_weakening", "file"],
)
def test_a_block_that_slides_bears_the_friction_of_its_law(integrator, law, mu, distance):
    """To rounding; where friction weakens over a distance of slip, to the slip of half a step."""
    setup = Setup(Material(**law), integrator, sample_interval=SAMPLE)
    fields = simulate(ONE, setup, "y", duration=1.4e-4, snapshot_times=SLIDING).fields
    assert (fields.state == BlockState.SLIDING).all()
    slip, speed = fields.displacement[:, 1, 0, 0], fields.velocity[:, 1, 0, 0]
    assert (np.diff(slip) > 0.0).all()
    np.testing.assert_array_equal(fields.slip[:, 0, 0], slip)
    expected, half_a_step = threshold() * mu(slip, speed), 0.5 * STEP * speed.max()
    tolerance = max(half_a_step / distance, 1e-9)
    np.testing.assert_allclose(fields.stress[:, 1, 0, 0], expected, rtol=tolerance)
    np.testing.assert_array_equal(fields.shear_stress, np.hypot(*np.moveaxis(fields.stress, 1, 0)))


@pytest.mark.parametrize(
    ("integrator", "periodic"), [(name, each.staggered) for name, each in INTEGRATORS.items()]
)
def test_stress_stays_within_friction_and_follows_the_motion(integrator, periodic):
    """At rest up to mu_s F_n/l², sliding mu_d F_n/l² along v.

    Without staggered velocities a detachment is noticed one step later, when neighbours have added
    to F_mot.
    """
    contact = Pattern.pillars(24, 4, 4).contact
    mu_static, mu_dynamic = draw_friction(24, seed=1)
    surface = Surface(contact, mu_static, mu_dynamic, periodic)
    fast = Material(slider_velocity=5e-2)
    how = {"duration": 4e-6, "snapshot_times": 2e-7 * np.arange(12, 16)}
    fields = simulate(surface, Setup(fast, integrator), direction=30, **how).fields
    load = threshold(fast) * contact.size / np.count_nonzero(contact)
    stuck, sliding = (fields.state == each for each in (BlockState.STUCK, BlockState.SLIDING))
    assert min(np.count_nonzero(stuck), np.count_nonzero(sliding)) > 50
    strength = load * np.maximum(mu_static, mu_dynamic)
    moved = np.abs(fields.velocity).max() * STEP  # in one step, at most
    later = (fast.k_s + 6.0 * fast.k_int) * moved / fast.spacing**2
    late = 1e-9 * load if INTEGRATORS[integrator].staggered else later
    assert (fields.shear_stress - strength)[stuck].max() < late
    velocity, stress = (np.moveaxis(field, 1, -1) for field in (fields.velocity, fields.stress))
    way = velocity[sliding] / np.linalg.norm(velocity[sliding], axis=-1, keepdims=True)
    friction = (load * np.broadcast_to(mu_dynamic, sliding.shape))[sliding]
    np.testing.assert_allclose(stress[sliding], friction[:, None] * way, rtol=1e-12)
    assert not fields.stress[..., ~contact].any()
    assert np.isnan(fields.slip[:, ~contact]).all()
    assert (fields.state[:, ~contact] == BlockState.FREE).all()


def test_what_the_slider_pulls_with_goes_into_stress_damping_and_inertia():
    """ΣF_s = Σ τ l² + m Σ (dv/dt + γ v); central differences are off by (ω h)²/6 of dv/dt."""
    surface = Surface.draw(Pattern.pillars(12, 4, 2).contact, seed=0)
    times = 2e-5 + STEP * np.arange(-1, 2)
    run = simulate(surface, Setup(sample_interval=STEP), duration=3e-5, snapshot_times=times)
    pull = run.force[round(2e-5 / STEP)]
    before, now, after = run.fields.velocity[:, 0].sum(axis=(1, 2))
    acceleration = (after - before) / (2.0 * STEP)
    borne = run.fields.stress[1, 0].sum() * PAPER.spacing**2
    moved = PAPER.mass * (acceleration + PAPER.gamma * now)
    coarse = (PAPER.omega_max * STEP) ** 2 / 6.0
    assert abs(pull - borne) > 1e-4 * pull  # blocks without contact do move
    assert pull - borne == pytest.approx(moved, rel=coarse)
