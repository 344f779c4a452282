"""The frictionless lattice: its elasticity, waves against closed forms, and periodic edges.

Plane waves are exact in the bulk and on a periodic lattice, not along a free edge, which lacks half
of its diagonals. Amplitudes of TINY spacings leave the springs linear.
"""

import numpy as np
import pytest

from benchmarks.swing import UNDAMPED, swing
from solver.test_stability import STEP
from springblock import Material
from springblock.simulation.simulate import SimulationError
from springs import spring_forces

PAPER = Material()
TINY = 1e-9
NU = 1.0 / 3.0


def frequency(c):
    return np.sqrt((UNDAMPED.k_s + c * UNDAMPED.k_int) / UNDAMPED.mass)


def dynamical_matrix(kx, ky):
    """D(k)/K_int of the springs in the bulk: the sum of c_b e eᵀ (1 - cos k·e) over all eight."""
    cx, cy = np.cos(kx), np.cos(ky)
    both = 1.0 - cx * cy
    mixed = np.sin(kx) * np.sin(ky)
    return np.array([[2 * (1 - cx) + both, mixed], [mixed, 2 * (1 - cy) + both]])


@pytest.mark.parametrize("mode", [(1, 0), (0, 1), (2, 1), (3, 2)])
@pytest.mark.parametrize("polarisation", [0, 1])
def test_plane_waves_run_through_the_edges_of_an_oblong_lattice(integrator, mode, polarisation):
    """Each swings at m omega² = K_s + K_int D(k), by the matrix of one step of the scheme."""
    n_y, n_x = 5, 12
    kx, ky = 2.0 * np.pi * mode[0] / n_x, 2.0 * np.pi * mode[1] / n_y
    values, axes = np.linalg.eigh(dynamical_matrix(kx, ky))
    y, x = np.mgrid[:n_y, :n_x]
    start = TINY * np.multiply.outer(axes[:, polarisation], np.cos(kx * x + ky * y + 0.3))
    step, steps = 2e-8, 1000  # over 25 periods
    end = swing(start, steps, step, integrator, periodic=True)
    mode_step = STEP[integrator](frequency(values[polarisation]), step, 0.0)
    exact = start * np.linalg.matrix_power(mode_step, steps)[0, 0]  # from rest
    # the springs' second order is TINY, and accumulates over omega t = 300
    np.testing.assert_allclose(end, exact, rtol=0, atol=1000 * TINY * TINY)


def test_the_highest_frequency_belongs_to_the_wave_that_alternates_along_one_axis():
    """m omega_max² = K_s + 6 K_int at k = (π, 0), over the whole Brillouin zone."""
    k = np.linspace(0.0, np.pi, 41)
    matrices = np.array([[dynamical_matrix(kx, ky) for kx in k] for ky in k])
    highest = np.linalg.eigvalsh(matrices)[..., -1]
    assert highest.max() == pytest.approx(6.0, rel=1e-14)
    assert highest[0, -1] == pytest.approx(6.0, rel=1e-14)
    assert UNDAMPED.omega_max == pytest.approx(frequency(6.0), rel=1e-14)


def test_no_mode_of_a_finite_lattice_leaves_the_band():
    """The stiffness matrix, column by column from unit displacements, has three free motions."""
    n = 5
    units = np.eye(2 * n * n).reshape(-1, 2, n, n)
    stiffness = -np.array([spring_forces(TINY * unit).ravel() for unit in units]) / TINY
    np.testing.assert_allclose(stiffness, stiffness.T, rtol=0, atol=20 * TINY)
    eigenvalues = np.linalg.eigvalsh((stiffness + stiffness.T) / 2)
    np.testing.assert_allclose(eigenvalues[:3], 0.0, atol=100 * TINY)
    assert eigenvalues[3] > 0.01
    assert eigenvalues[-1] <= 6.0


def traction(strain):
    """Return sigma_xx and sigma_xy, Pa, of the bulk, uniformly strained, across the x axis.

    It is the sum of F_int over all blocks on the left of a cut. A free edge lacks half of its
    diagonals: what N + 1 rows carry more than N is a row of the bulk.
    """
    cuts = []
    for n in (8, 9):
        u = np.einsum("ij,jyx->iyx", strain, np.stack(np.meshgrid(np.arange(n), np.arange(n))))
        cuts.append(spring_forces(u)[:, :, : n // 2].sum(axis=(1, 2)))
    return PAPER.k_int / PAPER.thickness * (cuts[1] - cuts[0])


@pytest.mark.parametrize("angle", [0.0, 20.0, 45.0, 70.0])
@pytest.mark.parametrize("principal", [(1.0, 0.0), (1.0, 1.0), (1.0, -1.0), (1.0, -NU), (-NU, 1.0)])
def test_the_lattice_is_an_isotropic_sheet_in_plane_stress(angle, principal):
    """Hooke's law with E and nu = 1/3 holds whichever way the principal strains are turned."""
    cosine, sine = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    turn = np.array([[cosine, -sine], [sine, cosine]])
    strain = TINY * turn @ np.diag(principal) @ turn.T
    (xx, xy), (_, yy) = strain
    modulus = PAPER.youngs_modulus
    exact = modulus / (1 - NU**2) * (xx + NU * yy), modulus / (1 + NU) * xy
    # second order in the strain, and the rounding of a difference of sums of 40 forces
    np.testing.assert_allclose(traction(strain), exact, rtol=0, atol=1e-8 * modulus * TINY)


@pytest.mark.parametrize("shape", [(3, 3), (5, 8), (16, 3)])
@pytest.mark.parametrize("amplitude", [1e-9, 1e-2, 0.2])
def test_a_periodic_lattice_feels_what_its_endless_repetition_feels(shape, amplitude, rng):
    """To the bit: springs across the edges are like all others, at any strain."""
    u = amplitude * rng.uniform(-1.0, 1.0, (2, *shape))
    n_y, n_x = shape
    endless = spring_forces(np.tile(u, (1, 3, 3)))[:, n_y : 2 * n_y, n_x : 2 * n_x]
    # of some rows at 1e-2, here and there not the same ones, the series is left
    rounding = 1e-14 if amplitude == 1e-2 else 0.0
    np.testing.assert_allclose(spring_forces(u, periodic=True), endless, rtol=0, atol=rounding)


@pytest.mark.parametrize("axis", [0, 1])
def test_a_spring_across_the_edge_may_burst_alone(axis):
    """A stretch by a fifth everywhere, which the springs that close the lattice make up for."""
    u = np.zeros((2, 8, 8))
    u[axis] = 0.2 * np.mgrid[:8, :8][1 - axis]
    assert np.isfinite(spring_forces(u)).all()
    with pytest.raises(SimulationError, match="has collapsed or burst"):
        spring_forces(u, periodic=True)
