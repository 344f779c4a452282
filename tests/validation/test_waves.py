"""Small oscillations of the frictionless lattice against closed forms.

Plane waves are exact in the bulk, not along a free edge, which lacks half of its diagonals. So
dispersion is checked where the edge is not felt (the force on inner blocks), and motion in time
where everything is edge: the eight modes of two by two blocks, known by symmetry alone. Their
amplitudes, TINY spacings, leave the springs linear.
"""

import numpy as np
import pytest

from springblock import Material
from springblock.accuracy.kernels import spring_forces, swing
from springblock.solver import INTEGRATORS

PAPER = Material(gamma=0.0)
TINY = 1e-9

# Blocks of a 2 x 2 lattice stand at (±1, ±1)/2. m omega² = K_s + c K_int; c follows from the
# springs that a mode strains: axial ones store K_int d²/2, diagonal ones K_int d²/4.
SX, SY = np.meshgrid([-1.0, 1.0], [-1.0, 1.0])
NIL, ALL = np.zeros((2, 2)), np.ones((2, 2))
PAIR_MODES = {
    "translation along x": ((ALL, NIL), 0.0),
    "translation along y": ((NIL, ALL), 0.0),
    "rotation": ((-SY, SX), 0.0),
    "shear": ((SY, SX), 1.0),
    "stretch": ((SX, -SY), 2.0),
    "bending along x": ((SX * SY, NIL), 2.0),
    "bending along y": ((NIL, SX * SY), 2.0),
    "breathing": ((SX, SY), 3.0),
}


def frequency(c, material=PAPER):
    return np.sqrt((material.k_s + c * material.k_int) / material.mass)


def leapfrog_factor(omega, step, steps):
    """Exact solution of the scheme, started with w = 0 half a step before t = 0.

    u_k = u_0 cos((k + 1/2) theta)/cos(theta/2), with sin(theta/2) = omega h/2.
    """
    half = np.arcsin(omega * step / 2.0)
    return np.cos((2 * steps + 1) * half) / np.cos(half)


def runge_kutta_factor(omega, step, steps):
    """Exact solution of the scheme: each step multiplies by the Taylor polynomial of exp(iωh)."""
    z = 1j * omega * step
    return ((1 + z + z**2 / 2 + z**3 / 6 + z**4 / 24) ** steps).real


EXACT = {"leapfrog": leapfrog_factor, "rk4": runge_kutta_factor}


def dynamical_matrix(kx, ky):
    """D(k)/K_int of the springs in the bulk: the sum of c_b e eᵀ (1 - cos k·e) over all eight."""
    cx, cy = np.cos(kx), np.cos(ky)
    both = 1.0 - cx * cy
    mixed = np.sin(kx) * np.sin(ky)
    return np.array([[2 * (1 - cx) + both, mixed], [mixed, 2 * (1 - cy) + both]])


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("mode", PAIR_MODES)
def test_each_mode_of_two_by_two_blocks_swings_at_its_own_frequency(mode, integrator):
    """After 1000 steps, over 25 periods, to the exact solution of the scheme."""
    shape, c = PAIR_MODES[mode]
    start = TINY * np.stack(shape)
    step, steps = 2e-8, 1000
    expected = start * EXACT[integrator](frequency(c), step, steps)
    end = swing(start, steps, step, integrator, PAPER)
    # the springs' second order is TINY, and accumulates over omega t = 300
    np.testing.assert_allclose(end, expected, rtol=0, atol=1000 * TINY * TINY)


@pytest.mark.parametrize(("integrator", "order"), [("leapfrog", 2), ("rk4", 4)])
def test_frequencies_converge_with_the_order_of_the_scheme(integrator, order):
    """Breathing for 4 periods against cos(omega t), or half a step later for leapfrog."""
    shape, c = PAIR_MODES["breathing"]
    start, omega = TINY * np.stack(shape), frequency(c)
    errors = []
    for steps in (200, 400, 800):
        step = 8.25 * np.pi / omega / steps
        lag = 0.5 if integrator == "leapfrog" else 0.0
        exact = np.cos(omega * step * (steps + lag))
        errors.append(abs(swing(start, steps, step, integrator)[0, 0, 0] / start[0, 0, 0] - exact))
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert orders == pytest.approx([order, order], abs=0.1)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_mode_dies_away_at_half_the_damping_frequency(integrator):
    """u = u_0 exp(-gamma t/2) cos(Omega t) + ..., Omega² = omega² - gamma²/4."""
    damped = Material(gamma=4e5)
    start, omega = np.full((2, 3, 3), TINY), frequency(0.0)
    step, steps = 2e-9, 2500
    ringing = np.sqrt(omega**2 - damped.gamma**2 / 4)
    time = step * (steps + (0.5 if integrator == "leapfrog" else 0.0))
    decay = np.exp(-damped.gamma * time / 2)
    phase = ringing * time
    exact = decay * (np.cos(phase) + damped.gamma / (2 * ringing) * np.sin(phase))
    end = swing(start, steps, step, integrator, damped)
    assert decay < 0.4
    # phase error omega t (omega h)²/24 of leapfrog, and its start by half a step
    np.testing.assert_allclose(end, start * exact, rtol=0, atol=TINY * (omega * step) ** 2 * 4)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_stability_is_told_where_it_ends(integrator):
    """Breathing of two by two blocks stays bounded below the limit, and grows above it."""
    shape, c = PAIR_MODES["breathing"]
    start, omega = 1e-3 * TINY * np.stack(shape), frequency(c)
    limit = {"leapfrog": 2.0, "rk4": np.sqrt(8.0)}[integrator] / omega
    is_stable = INTEGRATORS[integrator].is_stable
    for step, bounded in ((0.98 * limit, True), (1.02 * limit, False)):
        growth = np.abs(swing(start, 60, step, integrator) / start).max()
        assert is_stable(step, np.array([omega]), 0.0) == bounded
        # below, leapfrog may reach 1/cos(theta/2) = 5 times its start
        assert (growth < 10.0) == bounded


@pytest.mark.parametrize(
    "wave", [(0.1, 0.0), (np.pi, 0.0), (np.pi, np.pi), (0.7, -2.1), (2.9, 1.3)]
)
@pytest.mark.parametrize("polarisation", [(1.0, 0.0), (0.0, 1.0)])
def test_plane_waves_feel_the_dynamical_matrix(wave, polarisation):
    """F_int = -D(k) u on every inner block."""
    x, y = np.meshgrid(np.arange(6), np.arange(6))
    wave_form = TINY * np.cos(wave[0] * x + wave[1] * y + 0.4)
    u = np.multiply.outer(np.array(polarisation), wave_form)
    expected = -np.einsum("ij,jyx->iyx", dynamical_matrix(*wave), u)
    inner = np.s_[:, 1:-1, 1:-1]
    np.testing.assert_allclose(spring_forces(u)[inner], expected[inner], rtol=0, atol=20 * TINY**2)


def test_the_highest_frequency_belongs_to_the_wave_that_alternates_along_one_axis():
    """m omega_max² = K_s + 6 K_int at k = (π, 0), over the whole Brillouin zone."""
    k = np.linspace(0.0, np.pi, 41)
    matrices = np.array([[dynamical_matrix(kx, ky) for kx in k] for ky in k])
    highest = np.linalg.eigvalsh(matrices)[..., -1]
    assert highest.max() == pytest.approx(6.0, rel=1e-14)
    assert highest[0, -1] == pytest.approx(6.0, rel=1e-14)
    assert PAPER.omega_max == pytest.approx(frequency(6.0), rel=1e-14)


@pytest.mark.parametrize("n", [2, 5])
def test_no_mode_of_a_finite_lattice_leaves_the_band(n):
    """The stiffness matrix, column by column from unit displacements, has three free motions."""
    units = np.eye(2 * n * n).reshape(-1, 2, n, n)
    stiffness = -np.array([spring_forces(TINY * unit).ravel() for unit in units]) / TINY
    np.testing.assert_allclose(stiffness, stiffness.T, rtol=0, atol=20 * TINY)
    eigenvalues = np.linalg.eigvalsh((stiffness + stiffness.T) / 2)
    np.testing.assert_allclose(eigenvalues[:3], 0.0, atol=100 * TINY)
    assert eigenvalues[3] > 0.01
    assert eigenvalues[-1] <= 6.0
    if n == 2:
        expected = sorted(c for _, c in PAIR_MODES.values())
        np.testing.assert_allclose(eigenvalues, expected, rtol=0, atol=100 * TINY)


@pytest.mark.parametrize("angle", [0.0, 17.0, 45.0, 80.0])
def test_long_waves_travel_at_the_speed_of_sound_in_a_sheet(angle):
    """c_L = √(E/(rho (1 - nu²))) along the wave, c_T = √(G/rho) across, in any direction.

    m omega² = -F/u of a polarised wave on the middle block of three by three, where it peaks.
    """
    k = 1e-3  # corrections are of order k²
    direction = np.radians(angle) + np.array([0.0, np.pi / 2.0])
    along, across = np.cos(direction), np.sin(direction)
    x, y = np.meshgrid([-1, 0, 1], [-1, 0, 1])
    wave_form = TINY * np.cos(k * (along[0] * x + across[0] * y))
    stiffness = []
    for polarisation in np.stack([along, across], axis=1):
        force = spring_forces(np.multiply.outer(polarisation, wave_form))[:, 1, 1]
        stiffness.append(-force @ polarisation / TINY * PAPER.k_int)
    speeds = np.sqrt(np.array(stiffness) / PAPER.mass) / (k / PAPER.spacing)
    modulus = PAPER.youngs_modulus / PAPER.density
    expected = [np.sqrt(modulus / (1 - 1 / 9)), np.sqrt(3 / 8 * modulus)]
    np.testing.assert_allclose(speeds, expected, rtol=k**2)
