"""What holds of any surface, material, law, edge, direction and step, mostly on random draws."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from springblock import (
    Material,
    Realisation,
    Setup,
    Surface,
    compute_prelude,
    draw_friction,
    simulate,
)
from springblock.model.material import LAWS
from springblock.model.scene import FIELDS
from springblock.solver.integrators import INTEGRATORS, limit
from springblock.study.accuracy.stability.cases import Pull

LOADING = 200  #: steps until a block without neighbours would detach
STEPS = 500
#: Units of constants by name.
UNITS = {name: each.metadata["unit"] for name, each in FIELDS.items()}


class Case(NamedTuple):
    """A surface, a setup and a direction."""

    surface: Surface
    setup: Setup
    direction: float

    def run(self, **options) -> Realisation:
        """Simulate some hundred steps, in which most blocks slip."""
        duration = STEPS * self.setup.step
        return simulate(self.surface, self.setup, self.direction, duration, **options)


def decades(least, most):
    """Numbers spread evenly over decades."""
    return st.floats(least, most).map(lambda exponent: 10.0**exponent)


@st.composite
def cases(draw, periodic=None) -> Case:
    """Draw a case whose springs stay within their range, and whose step is stable."""
    periodic = draw(st.booleans()) if periodic is None else periodic
    shape = draw(st.tuples(*2 * [st.integers(3 if periodic else 1, 9)]))
    seed = draw(st.integers(0, 10**6))
    contact = np.random.default_rng(seed).random(shape) < draw(st.floats(0.2, 1.0))
    assume(contact.any())
    law, spacing = draw(st.sampled_from(list(LAWS))), draw(decades(-6, -3))
    stiff = draw(decades(5, 12))  # Pa
    material = Material(
        youngs_modulus=stiff,
        pressure=stiff * draw(decades(-5, -2.5)),
        density=draw(decades(2, 4)),
        spacing=spacing,
        thickness=spacing * draw(decades(-0.5, 1)),
        mu_dynamic=draw(st.floats(0.2, 0.9)),
    )
    slip, rate = material.block_load / material.k_s, material.omega_min
    scales = {"m": slip, "m/s": slip * rate}
    material = replace(
        material,
        law=law,
        gamma=rate * draw(st.sampled_from([0.0, 1e-3, 0.1, 1.0])),
        **{name: 0.3 * scales[UNITS[name]] for name in [LAWS[law]] if name},
    )
    compiled = INTEGRATORS if law == "coulomb" or not periodic else ["leapfrog"]  # for other tests
    integrator = draw(st.sampled_from(list(compiled)))
    step = draw(st.floats(0.02, 0.2)) * limit(integrator, material)
    material = replace(material, slider_velocity=slip / (LOADING * step))
    surface = Surface(contact, *draw_friction(shape, seed, material), periodic=periodic)
    setup = Setup(material, integrator, step, sample_interval=step)
    return Case(surface, setup, draw(st.floats(0.0, 360.0)))


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


@given(cases())
def test_energy_closes(case):
    run, setup = case.run(), case.setup
    assert Pull(setup.integrator, setup.material, setup.step).keeps_energy(run)


@given(cases(), st.booleans())
def test_a_mirrored_surface_moves_as_the_mirror_image(case, across):
    """Along x or y, where the direction stays its own mirror image to the last bit."""
    towards, back = (0.0, 180.0) if across else (0.0, 0.0)
    flip = (lambda field: field[:, ::-1]) if across else (lambda field: field[::-1])
    run = case._replace(direction=towards).run()
    mirrored = Case(moved(case.surface, flip), case.setup, back)
    assert_moved(run, mirrored.run(), flip, (-1.0, 1.0) if across else (1.0, -1.0))


@pytest.mark.parametrize("periodic", [False, True])
def test_an_oblong_surface_turned_over_is_pulled_along_the_other_axis(integrator, periodic):
    """Sums are taken in another order, and rounding grows from one avalanche to the next."""
    setup = Setup(Material(slider_velocity=5e-2), integrator)
    surface = Surface.draw(np.ones((4, 11), bool), seed=1, periodic=periodic)
    run = simulate(surface, setup, "x", 6e-6)
    turned = simulate(moved(surface, np.transpose), setup, "y", 6e-6)
    assert np.isfinite(run.t_det).sum() > 20
    np.testing.assert_allclose(turned.t_det.T, run.t_det, rtol=1e-9)
    np.testing.assert_allclose(turned.force, run.force, rtol=1e-9)
    image, scale = run.displacement.transpose(0, 2, 1), np.abs(run.displacement).max()
    np.testing.assert_allclose(turned.displacement[::-1], image, rtol=0, atol=1e-9 * scale)


@given(cases(periodic=True), st.tuples(st.integers(0, 8), st.integers(0, 8)))
def test_a_periodic_surface_has_no_edges(case, shift):
    def roll(field):
        return np.roll(field, shift, axis=(0, 1))

    watched = {"snapshot_times": [250 * case.setup.sample_interval]}
    run = case.run(**watched)
    shifted = case._replace(surface=moved(case.surface, roll)).run(**watched)
    assert_moved(run, shifted, roll)
    np.testing.assert_array_equal(shifted.fields.stress, np.roll(run.fields.stress, shift, (2, 3)))


@given(cases(), st.integers(-20, 20))
def test_the_unit_of_mass_is_a_convention(case, power):
    """With E, rho and P multiplied, every force is, and no motion changes by one bit."""
    factor, of_paper = 2.0**power, case.setup.material
    scaled = {name: factor * getattr(of_paper, name) for name in ("youngs_modulus", "density")}
    material = replace(of_paper, **scaled, pressure=factor * of_paper.pressure)
    run, other = case.run(), case._replace(setup=replace(case.setup, material=material)).run()
    assert_moved(run, replace(other, force=other.force / factor), lambda field: field)
    assert other.energy.friction == factor * run.energy.friction


@given(cases(), st.integers(0, 8))
def test_a_larger_modulus_and_pressure_are_a_slower_slider(case, power):
    """With E and P multiplied by a, all is √a times faster than with v and gamma divided by √a."""
    root, setup, paper = 2.0**power, case.setup, case.setup.material
    larger = {name: root**2 * getattr(paper, name) for name in ("youngs_modulus", "pressure")}
    slower = {name: getattr(paper, name) / root for name in ("slider_velocity", "gamma")}
    slower["speed_scale"] = paper.speed_scale / root
    times = {name: getattr(setup, name) / root for name in ("step", "sample_interval")}
    slow = replace(setup, material=replace(paper, **slower))
    stiff = replace(setup, material=replace(paper, **larger), **times)
    run, other = (case._replace(setup=each).run() for each in (slow, stiff))
    np.testing.assert_array_equal(other.t_det * root, run.t_det)
    np.testing.assert_array_equal(other.force / root**2, run.force)
    np.testing.assert_array_equal(other.displacement, run.displacement)


@given(cases(), st.integers(1, STEPS // 10 - 1))
def test_no_bit_depends_on_prelude_or_snapshots(case, sample):
    surface, setup = case.surface, case.setup
    how = setup, case.direction, surface.periodic
    prelude = compute_prelude(surface.contact, *how, mu_static=surface.mu_static)
    watched = {"snapshot_times": [10 * sample * setup.sample_interval]}
    runs = [case.run(**options) for options in ({}, watched, watched | {"prelude": prelude})]
    for run in runs[1:]:
        for name in ("force", "t_det", "switches", "displacement", "velocity"):
            np.testing.assert_array_equal(getattr(run, name), getattr(runs[0], name))
        assert run.energy == runs[0].energy
    plain, skipping = runs[1].fields, runs[2].fields
    for name in ("displacement", "velocity", "stress"):
        np.testing.assert_array_equal(getattr(skipping, name), getattr(plain, name))
