"""Surfaces of any shape, with free edges or with opposite ones joined by springs."""

from dataclasses import astuple

import numpy as np
import pytest

from springblock import Material, compute_prelude, draw_friction, simulate
from springblock.accuracy import plain_rk4
from springblock.accuracy.kernels import UNDAMPED, spring_forces, swing
from springblock.accuracy.reference import solve
from springblock.accuracy.specimens import uniform
from springblock.simulation.energy import elastic_energy
from springblock.simulation.simulate import SimulationError
from springblock.solver import INTEGRATORS

PAPER = Material()
#: Loads a hundred times faster than the paper's: a run of 1500 steps shows all blocks let go.
FAST = Material(slider_velocity=5e-2)
RUN = {"material": FAST, "step": 2e-8, "sample_interval": 2e-7, "duration": 3e-5}
TINY = 1e-9  #: amplitude in l, which leaves springs linear
SHAPES = [(3, 3), (5, 8), (7, 13), (16, 3)]  #: rows with phantoms and without


def scattered(shape, share=1.0, seed=0):
    """Contact on a share of all blocks, and drawn coefficients."""
    n_y, n_x = shape
    mu_static, mu_dynamic = (mu[:n_y, :n_x] for mu in draw_friction(max(shape), seed))
    return np.random.default_rng(seed).random(shape) < share, mu_static, mu_dynamic


def rolled(fields, shift):
    return [np.roll(field, shift, axis=(-2, -1)) for field in fields]


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("amplitude", [1e-9, 1e-2, 0.2])
def test_a_periodic_lattice_feels_what_its_endless_repetition_feels(shape, amplitude, rng):
    """To the bit: springs across the edges are like all others, at any strain."""
    u = amplitude * rng.uniform(-1.0, 1.0, (2, *shape))
    n_y, n_x = shape
    endless = spring_forces(np.tile(u, (1, 3, 3)))[:, n_y : 2 * n_y, n_x : 2 * n_x]
    if amplitude == 1e-2:  # of some rows, here and there not the same ones, the series is left
        np.testing.assert_allclose(spring_forces(u, periodic=True), endless, rtol=0, atol=1e-14)
    else:
        np.testing.assert_array_equal(spring_forces(u, periodic=True), endless)


@pytest.mark.parametrize("band", [1, 2, 3, 4])
def test_no_bit_of_a_periodic_lattice_depends_on_the_rows_of_a_band(band, rng):
    u = 0.01 * rng.uniform(-1.0, 1.0, (2, 7, 13))
    np.testing.assert_array_equal(
        spring_forces(u, band, periodic=True), spring_forces(u, periodic=True)
    )


@pytest.mark.parametrize("axis", [0, 1])
def test_a_spring_across_the_edge_may_burst_alone(axis):
    """A stretch by a fifth everywhere, which the springs that close the lattice make up for."""
    u = np.zeros((2, 8, 8))
    u[axis] = 0.2 * np.mgrid[:8, :8][1 - axis]
    assert np.isfinite(spring_forces(u)).all()
    with pytest.raises(SimulationError, match="a spring in rows 0 to 8 has collapsed or burst"):
        spring_forces(u, periodic=True)


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("mode", [(1, 0), (0, 1), (2, 1), (3, 2)])
@pytest.mark.parametrize("polarisation", [0, 1])
def test_plane_waves_run_through_the_edges_of_an_oblong_lattice(integrator, mode, polarisation):
    """Each swings at omega² = (K_s + K_int D(k))/m, as in a lattice without edges.

    D(k) is that of section 2's springs: 2 (1 - cos k_x) for the axial ones along x, and
    e eᵀ (1 - cos k·e) for the diagonal ones. The exact solution of the scheme after 1000 steps.
    """
    n_y, n_x = 5, 12
    k_x, k_y = 2.0 * np.pi * mode[0] / n_x, 2.0 * np.pi * mode[1] / n_y
    both, mixed = 1.0 - np.cos(k_x) * np.cos(k_y), np.sin(k_x) * np.sin(k_y)
    matrix = [[2 * (1 - np.cos(k_x)) + both, mixed], [mixed, 2 * (1 - np.cos(k_y)) + both]]
    stiffness, axes = np.linalg.eigh(matrix)
    y, x = np.mgrid[:n_y, :n_x]
    start = TINY * np.multiply.outer(axes[:, polarisation], np.cos(k_x * x + k_y * y + 0.3))
    omega = np.sqrt((UNDAMPED.k_s + stiffness[polarisation] * UNDAMPED.k_int) / UNDAMPED.mass)
    step, steps = 2e-8, 1000
    if integrator == "leapfrog":
        half = np.arcsin(omega * step / 2.0)
        factor = np.cos((2 * steps + 1) * half) / np.cos(half)
    else:
        z = 1j * omega * step
        factor = ((1 + z + z**2 / 2 + z**3 / 6 + z**4 / 24) ** steps).real
    end = swing(start, steps, step, integrator, periodic=True)
    # the springs' second order is TINY, and accumulates over omega t = 300
    np.testing.assert_allclose(end, factor * start, rtol=0, atol=1000 * TINY * TINY)


def test_the_force_is_the_gradient_of_the_energy_of_a_periodic_lattice(rng):
    """dE/ds along a random direction d, by central differences: -ΣF·d, error of order s²."""
    u, d = rng.uniform(-1.0, 1.0, (2, 2, 4, 7))
    u = 1e-2 * u
    length, s = PAPER.spacing, 1e-5

    def energy(displacement):
        hung = 0.5 * PAPER.k_s * np.sum((length * displacement) ** 2)
        return elastic_energy(length * displacement, np.zeros(2), PAPER, periodic=True) - hung

    slope = (energy(u + s * d) - energy(u - s * d)) / (2 * s)
    work = -np.sum(spring_forces(u, periodic=True) * d) * PAPER.k_int * length**2
    assert slope == pytest.approx(work, rel=1e-8, abs=0)


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("shape", SHAPES)
def test_a_periodic_surface_without_scatter_moves_as_one_block(integrator, shape):
    """No spring between blocks is ever strained. The load of each is P l² but for its rounding."""
    alike = np.ones(shape, bool), np.full(shape, 1.0), np.full(shape, 0.6)
    run = simulate(*alike, **RUN, integrator=integrator, periodic=True)
    one = simulate(*uniform(1, 1.0, 0.6), **RUN, integrator=integrator)
    assert np.ptp(run.force) > 0.3 * run.normal_force  # it lets go
    for name in ("t_det", "displacement", "velocity"):
        found, expected = getattr(run, name), getattr(one, name)
        assert not np.ptp(found, axis=(-2, -1)).any()
        np.testing.assert_allclose(found[..., :1, :1], expected, rtol=1e-9, err_msg=name)
    blocks = np.prod(shape)
    assert run.normal_force == pytest.approx(blocks * one.normal_force, rel=1e-15)
    np.testing.assert_allclose(run.force, blocks * one.force, rtol=1e-9)
    np.testing.assert_allclose(astuple(run.energy), blocks * np.array(astuple(one.energy)), 1e-9)


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("share", [1.0, 0.6])
@pytest.mark.parametrize(
    ("shape", "shift"), [((5, 8), (1, 0)), ((7, 13), (3, 6)), ((16, 3), (9, 1))]
)
def test_no_bit_of_a_periodic_surface_depends_on_where_its_edges_are(
    integrator, share, shape, shift
):
    """Through all avalanches, releases within steps among them; sums of force to rounding."""
    surface = scattered(shape, share)
    how = {**RUN, "integrator": integrator, "direction": 20.0, "periodic": True}
    run, moved = simulate(*surface, **how), simulate(*rolled(surface, shift), **how)
    assert run.switches.sum() > np.isfinite(run.t_det).sum() > 0.9 * surface[0].sum()
    expected = rolled((run.t_det, run.displacement, run.velocity), shift)
    for one, other in zip(expected, (moved.t_det, moved.displacement, moved.velocity), strict=True):
        np.testing.assert_array_equal(one, other)
    np.testing.assert_array_equal(run.switches, moved.switches)
    np.testing.assert_allclose(run.force, moved.force, rtol=0, atol=1e-12 * run.force.max())


def test_nor_does_it_far_beyond_the_range_of_the_series():
    surface, how = scattered((7, 13)), {**RUN, "direction": 20.0, "periodic": True}
    how["material"] = Material(youngs_modulus=2e5, slider_velocity=5e-2)
    how["duration"] = 1e-4
    run, moved = simulate(*surface, **how), simulate(*rolled(surface, (3, 6)), **how)
    assert np.abs(np.diff(run.displacement)).max() > 0.05 * PAPER.spacing
    np.testing.assert_array_equal(*rolled((run.t_det,), (3, 6)), moved.t_det)
    np.testing.assert_array_equal(*rolled((run.displacement,), (3, 6)), moved.displacement)


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_an_oblong_surface_mirrored_across_the_slide_moves_as_its_mirror_image(
    integrator, periodic
):
    contact, *mu = scattered((6, 11), 0.8, seed=2)
    how = {**RUN, "integrator": integrator, "periodic": periodic}
    run, mirrored = (
        simulate(mask, *fields, **how)
        for mask, fields in ((contact, mu), (contact[::-1], [m[::-1] for m in mu]))
    )
    np.testing.assert_array_equal(mirrored.t_det, run.t_det[::-1])
    np.testing.assert_array_equal(mirrored.displacement[0], run.displacement[0, ::-1])
    np.testing.assert_array_equal(mirrored.displacement[1], -run.displacement[1, ::-1])


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_an_oblong_surface_turned_over_is_pulled_along_the_other_axis(integrator, periodic):
    """Sums are taken in another order, and rounding grows from one avalanche to the next."""
    surface = scattered((4, 11), seed=1)
    how = {**RUN, "integrator": integrator, "periodic": periodic, "duration": 6e-6}
    run = simulate(*surface, **how, direction="x")
    turned = simulate(*(field.T for field in surface), **how, direction="y")
    assert np.isfinite(run.t_det).sum() > 20
    np.testing.assert_allclose(turned.t_det.T, run.t_det, rtol=1e-9)
    np.testing.assert_allclose(turned.force, run.force, rtol=1e-9)


@pytest.mark.parametrize(
    ("shape", "periodic"), [((3, 7), False), ((1, 9), False), ((8, 2), False), ((3, 5), True)]
)
@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_detachment_times_of_oblong_surfaces_are_those_of_the_reference(
    shape, periodic, integrator
):
    """An independent solution, event by event; releases lie within their steps of 5e-9 s."""
    how = {"material": Material(slider_velocity=5e-3), "sample_interval": 2e-8}
    how |= {"duration": 1.188e-5, "periodic": periodic}
    surface = scattered(shape, seed=6)
    exact = solve(*surface, **how)
    run = simulate(*surface, **how, integrator=integrator, step=5e-9)
    assert np.isfinite(exact.t_det).sum() >= 4
    np.testing.assert_allclose(run.t_det, exact.t_det, rtol=0, atol=5e-9 / 2)
    np.testing.assert_allclose(run.force, exact.force, rtol=0, atol=1e-3 * exact.force.max())


def test_an_oblong_surface_is_loaded_as_by_plain_runge_kutta():
    """Until the first block lets go, on a surface some of whose blocks are free.

    The leapfrog is wrong by (omega h)²/24 of what oscillates, the other finds it a step too late.
    """
    surface, step = scattered((4, 9), share=0.6), 1e-8
    how = {"duration": 1.33e-4, "sample_interval": 2e-7, "step": step}
    plain, run = plain_rk4.solve(*surface, **how), simulate(*surface, **how)
    assert np.nanargmin(run.t_det) == np.nanargmin(plain.t_det)
    assert abs(run.t_first - np.nanmin(plain.t_det)) < step
    before, off = run.time < run.t_first, (PAPER.omega_max * step) ** 2 / 24
    np.testing.assert_allclose(run.force[before], plain.force[before], rtol=off)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_the_ledger_of_a_periodic_surface_closes_to_second_order(integrator):
    """One block is nailed down, all other motion is smooth: halving h quarters the residual."""
    contact = np.zeros((4, 7), bool)
    contact[0, 6] = True
    surface = contact, np.full((4, 7), 1e9), np.zeros((4, 7))
    how = {"integrator": integrator, "duration": 8e-6, "sample_interval": 4e-8, "periodic": True}
    residuals = [
        simulate(*surface, **how, step=step).energy.relative_residual
        for step in (1e-8, 5e-9, 2.5e-9)
    ]
    assert abs(residuals[0]) < (PAPER.omega_max * 1e-8) ** 2
    assert np.divide(residuals[:-1], residuals[1:]) == pytest.approx([4.0, 4.0], rel=0.1)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_run_from_the_prelude_of_a_periodic_surface_is_the_run_from_zero(integrator):
    surface = scattered((6, 11), share=0.7, seed=5)
    how = {"material": Material(slider_velocity=5e-3), "integrator": integrator, "periodic": True}
    prelude = compute_prelude(surface[0], **how)
    assert prelude.samples.max() > 0
    run, plain = simulate(*surface, **how, prelude=prelude), simulate(*surface, **how)
    for name in ("time", "force", "switches", "t_det", "displacement", "velocity"):
        np.testing.assert_array_equal(getattr(run, name), getattr(plain, name), err_msg=name)
    assert run.energy == plain.energy
    with pytest.raises(ValueError, match="prelude belongs to another scene"):
        simulate(*surface, **{**how, "periodic": False}, prelude=prelude)


def test_preludes_tell_shapes_apart():
    surface = scattered((6, 8), share=0.7, seed=5)
    turned = [field.reshape(8, 6) for field in surface]  # the same blocks in another order
    with pytest.raises(ValueError, match="prelude belongs to another scene"):
        simulate(*turned, FAST, prelude=compute_prelude(surface[0], FAST))
