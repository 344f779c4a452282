"""What must hold of surfaces whatever the numbers: symmetries, shapes and edges."""

import numpy as np
import pytest

from springblock import Material, Setup, Surface, simulate

PAPER = Material()
#: Loads a hundred times faster than the paper's: in 1500 steps all blocks detach.
FAST = Material(slider_velocity=5e-2)
LAWS = {"slip_weakening": {"slip_distance": 4e-7}, "velocity_weakening": {"speed_scale": 0.1}}


def oblong(shape, share=1.0, seed=0, periodic=False):
    """Contact on a share of all blocks, and drawn coefficients."""
    contact = np.random.default_rng(seed).random(shape) < share
    return Surface.draw(contact, seed, periodic=periodic)


def moved(surface, move):
    """The surface with each of its fields moved."""
    fields = (surface.contact, surface.mu_static, surface.mu_dynamic)
    return Surface(*map(move, fields), periodic=surface.periodic)


def assert_moved(run, other, move, signs=(1, 1)):
    """The other run is the first one moved, to the last bit; sums of force to rounding."""
    np.testing.assert_array_equal(other.t_det, move(run.t_det))
    for name in ("displacement", "velocity"):
        for sign, one, found in zip(signs, getattr(run, name), getattr(other, name), strict=True):
            np.testing.assert_array_equal(found, sign * move(one))
    np.testing.assert_array_equal(other.switches, run.switches)
    np.testing.assert_allclose(other.force, run.force, rtol=0, atol=1e-12 * run.force.max())


@pytest.mark.parametrize("periodic", [False, True])
def test_an_oblong_surface_turned_over_is_pulled_along_the_other_axis(integrator, periodic):
    """Sums are taken in another order, and rounding grows from one avalanche to the next."""
    surface = oblong((4, 11), seed=1, periodic=periodic)
    how = {"setup": Setup(FAST, integrator), "duration": 6e-6}
    run = simulate(surface, **how, direction="x")
    turned = simulate(moved(surface, np.transpose), **how, direction="y")
    assert np.isfinite(run.t_det).sum() > 20
    np.testing.assert_allclose(turned.t_det.T, run.t_det, rtol=1e-9)
    np.testing.assert_allclose(turned.force, run.force, rtol=1e-9)
    image, scale = run.displacement.transpose(0, 2, 1), np.abs(run.displacement).max()
    np.testing.assert_allclose(turned.displacement[::-1], image, rtol=0, atol=1e-9 * scale)
