"""What must hold whatever the numbers: symmetries, rest, scaling, causality."""

from dataclasses import replace

import numpy as np
import pytest

from springblock import Material, Pattern, simulate
from springblock.accuracy.specimens import drawn, flat, uniform
from springblock.model.defaults import STEP

PAPER = Material()
INTEGRATORS = ["leapfrog", "rk4"]
LOAD = PAPER.block_load
SLIP = LOAD / PAPER.k_s  #: m, how far the slider goes until a block lets go
SQUARE = Pattern.pillars(12, 4, 2)
GROOVED = Pattern.pillars(12, 5, 1).grooved(2, 1, along="x")


def bits(*arrays):
    return [np.ascontiguousarray(array).tobytes() for array in arrays]


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("pattern", [Pattern.flat(8), SQUARE], ids=["flat", "pillars"])
def test_a_surface_mirrored_across_the_slide_moves_as_its_mirror_image(pattern, integrator):
    """To the last bit, through all avalanches: springs are summed alike from north and south."""
    contact, *mu = drawn(pattern, seed=3)
    run, mirrored = (
        simulate(contact, *fields, integrator=integrator, duration=1.8e-4)
        for fields in (mu, [m[::-1] for m in mu])
    )
    assert np.isfinite(run.t_det).any()
    assert bits(mirrored.t_det) == bits(run.t_det[::-1])
    np.testing.assert_array_equal(mirrored.displacement[0], run.displacement[0, ::-1])
    np.testing.assert_array_equal(mirrored.displacement[1], -run.displacement[1, ::-1])


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_surface_mirrored_along_the_slide_is_pulled_the_other_way(integrator):
    contact, *mu = drawn(SQUARE, seed=3)
    run = simulate(contact, *mu, integrator=integrator, duration=1.8e-4)
    turned = [m[:, ::-1] for m in mu]
    back = simulate(contact, *turned, direction=180, integrator=integrator, duration=1.8e-4)
    np.testing.assert_array_equal(back.t_det, run.t_det[:, ::-1])
    np.testing.assert_array_equal(back.displacement[0], -run.displacement[0, :, ::-1])
    # the force is a sum over columns, taken in the other order
    np.testing.assert_allclose(back.force, run.force, rtol=1e-12)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_surface_turned_by_ninety_degrees_is_pulled_along_y(integrator):
    """Transposed, the scene differs in the order of sums: to rounding before avalanches part."""
    pattern = Pattern.flat(8)
    contact, *mu = drawn(pattern, seed=3)
    run = simulate(contact, *mu, integrator=integrator)
    turned = simulate(contact.T, *(m.T for m in mu), direction="y", integrator=integrator)
    np.testing.assert_allclose(turned.t_det, run.t_det.T, rtol=1e-12)
    np.testing.assert_allclose(turned.force, run.force, rtol=1e-9)
    np.testing.assert_allclose(
        turned.displacement[::-1], run.displacement.transpose(0, 2, 1), rtol=0, atol=1e-9 * SLIP
    )


def test_a_grooved_surface_turned_with_its_slide_is_loaded_alike():
    contact, *mu = drawn(GROOVED, seed=3)
    run = simulate(contact, *mu, duration=1e-4)
    turned = simulate(contact.T, *(m.T for m in mu), direction="y", duration=1e-4)
    np.testing.assert_allclose(turned.force, run.force, rtol=1e-12)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_stuck_block_does_not_move_by_one_bit_in_a_million_steps(integrator):
    steps = 1_000_000 if integrator == "leapfrog" else 250_000  # a million force evaluations
    run = simulate(
        *uniform(2, 1e9, 0.6),
        integrator=integrator,
        duration=steps * STEP,
        sample_interval=steps * STEP / 100,
    )
    assert run.steps == steps
    assert not run.displacement.any()
    assert not run.velocity.any()
    assert not run.switches.any()
    np.testing.assert_allclose(
        run.force, 4 * PAPER.k_s * PAPER.slider_velocity * run.time, rtol=1e-12
    )


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_blocks_that_have_not_detached_have_not_moved(integrator):
    """In the middle of the avalanches, stuck next to sliding."""
    contact, *mu = flat(12, seed=3)
    run = simulate(contact, *mu, integrator=integrator, duration=1.07e-4)
    waiting = np.isnan(run.t_det)
    assert 0 < waiting.sum() < contact.sum()
    assert not run.displacement[:, waiting].any()
    assert not run.velocity[:, waiting].any()
    assert run.displacement[0, ~waiting].all()


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_surface_without_scatter_lets_go_as_one(integrator):
    """No spring between blocks is ever strained: N² times one block, sideways nothing."""
    many, one = (
        simulate(*uniform(n, 1.0, 0.6), integrator=integrator, duration=1.4e-4) for n in (6, 1)
    )
    np.testing.assert_allclose(many.t_det, one.t_det[0, 0], rtol=1e-14)
    assert np.unique(many.displacement[0]).size == 1
    assert not many.displacement[1].any()
    np.testing.assert_allclose(many.displacement[0], one.displacement[0, 0, 0], rtol=1e-12)
    np.testing.assert_allclose(many.force, 36 * one.force, rtol=1e-12)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_until_the_first_detachment_a_flat_surface_is_one_spring(integrator):
    """F = N² K_s v t, and the first to go is the block with the lowest threshold."""
    contact, mu_static, mu_dynamic = flat(8, seed=2)
    run = simulate(contact, mu_static, mu_dynamic, integrator=integrator)
    rate = PAPER.k_s * PAPER.slider_velocity
    before = run.time <= run.t_first
    np.testing.assert_allclose(run.force[before], 64 * rate * run.time[before], rtol=1e-12)
    assert run.t_det.argmin() == mu_static.argmin()
    assert abs(run.t_first - mu_static.min() * LOAD / rate) <= STEP


def test_until_the_first_detachment_the_seed_does_not_matter():
    """Not by one bit: while nothing slides, no coefficient enters the motion."""
    first, second = (simulate(*drawn(SQUARE, seed), duration=1.8e-4) for seed in (1, 2))
    same = first.time <= min(first.t_first, second.t_first)
    assert same.sum() > 200
    assert bits(first.force[same]) == bits(second.force[same])
    assert bits(first.force) != bits(second.force)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_the_unit_of_mass_is_a_convention(integrator):
    """E, rho and P four times as large: every force is, and no motion changes, to the last bit."""
    heavy = replace(PAPER, youngs_modulus=4e7, density=4800.0, pressure=2e5)
    run, scaled = (
        simulate(*drawn(SQUARE, 3), material=m, integrator=integrator, duration=1.8e-4)
        for m in (PAPER, heavy)
    )
    assert bits(scaled.t_det, scaled.displacement) == bits(run.t_det, run.displacement)
    assert bits(scaled.force) == bits(4.0 * run.force)
    assert scaled.energy.friction == 4.0 * run.energy.friction


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_the_contact_alone_bears_the_load(integrator):
    """One block in contact lets go at mu_s P l² N²: static friction does not ask for its area.

    All others hang on the slider and, through their springs, on this one. Slowly pulled, they are
    in balance, but for the swing that the slider's start has left: K_s v/omega each.
    """
    contact = np.zeros((6, 6), bool)
    contact[2, 3] = True
    run = simulate(contact, *uniform(6, 0.2, 0.1)[1:], integrator=integrator)
    swing = PAPER.k_s * PAPER.slider_velocity / PAPER.omega_min
    assert run.static_friction == pytest.approx(0.2, abs=2 * swing / LOAD)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_block_with_mu_s_below_mu_d_does_not_flicker_among_others(integrator):
    """It lets go at mu_d F_n and then follows its slider with v (1 - cos omega t).

    This touches zero once in each of the first few periods, until damping keeps it away; a block
    that flickers lets go in every step, of which there are 1500 before the others follow.
    """
    contact, mu_static, mu_dynamic = flat(6, seed=3)
    mu_static[2, 3], mu_dynamic[2, 3] = 0.3, 0.6
    run = simulate(contact, mu_static, mu_dynamic, integrator=integrator)
    assert abs(run.t_first - 0.6 * LOAD / (PAPER.k_s * PAPER.slider_velocity)) <= STEP
    assert run.t_first == run.t_det[2, 3]
    others = np.delete(run.t_det, 2 * 6 + 3)
    assert others.min() - run.t_first > 1500 * STEP
    assert 1 <= run.switches[run.time < others.min()].sum() < 10
