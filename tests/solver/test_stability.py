"""Which steps are stable, against the eigenvalues of one step of an oscillator."""

import math

import numpy as np
import pytest

from springblock import Material
from springblock.solver.integrators import INTEGRATORS, leapfrog_force_time, limit

MODES = 0.1, 2.0  # angular frequencies; damping makes the first one fast, too


def leapfrog_step(omega, h, gamma):
    """Matrix of one step of (u, w): a kick and a drift, with exact damping."""
    a, kick = math.exp(-gamma * h), -(omega**2) * leapfrog_force_time(h, gamma)
    return np.array([[1.0 + h * kick, h * a], [kick, a]])


def rk4_step(omega, h, gamma):
    """Matrix of one step of (u, v): the exponential of h A up to its fourth order."""
    h_a = h * np.array([[0.0, 1.0], [-(omega**2), -gamma]])
    terms = (np.linalg.matrix_power(h_a, n) / math.factorial(n) for n in range(5))
    return np.sum([*terms], axis=0)


#: By integrator: the matrix of one step, and omega h at the limit without damping.
STEP = {"leapfrog": leapfrog_step, "rk4": rk4_step}
REACH = {"leapfrog": 2.0, "rk4": math.sqrt(8.0)}


@pytest.mark.parametrize("name", INTEGRATORS)
@pytest.mark.parametrize("gamma", [0.0, 0.5, 10.0])
def test_a_step_is_stable_while_no_mode_grows(name, gamma):
    steps = np.arange(0.005, 6.0, 0.01)  # none at the limit itself
    matrices = [[STEP[name](omega, h, gamma) for omega in MODES] for h in steps]
    growth = abs(np.linalg.eigvals(matrices)).max(axis=(1, 2))
    told = [INTEGRATORS[name].is_stable(h, np.array(MODES), gamma) for h in steps]
    assert told == (growth < 1.0 + 1e-9).tolist()
    assert 0 < sum(told) < len(told)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_without_damping_the_limit_is_that_of_the_imaginary_axis(integrator):
    material = Material(gamma=0.0)
    reach = REACH[integrator] / material.omega_max
    assert limit(integrator, material) == pytest.approx(reach, rel=1e-9)


def test_overdamped_leapfrog_is_limited_by_its_springs_and_runge_kutta_by_the_fastest_decay():
    """Runge-Kutta is stable on the real axis from -2.785293563, where R = 1, to 0."""
    gamma = 10.0 * Material().omega_max
    material = Material(gamma=gamma)
    decay = gamma / 2.0 + math.sqrt(gamma**2 / 4.0 - material.omega_min**2)
    springs = 2.0 * gamma / material.omega_max**2
    assert limit("leapfrog", material) == pytest.approx(springs, rel=1e-9)
    assert limit("rk4", material) == pytest.approx(2.785293563 / decay, rel=1e-9)


def test_damping_shortens_the_time_for_which_a_force_acts():
    """(1 - exp(-γh))/γ is the integral of exp(-γt) over a step, h without damping."""
    assert leapfrog_force_time(0.1, 0.0) == 0.1
    assert leapfrog_force_time(0.1, 20.0) == pytest.approx((1.0 - math.exp(-2.0)) / 20.0)
