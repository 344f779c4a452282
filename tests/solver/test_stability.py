"""Which steps are stable, against the eigenvalues of one step of an oscillator."""

import math

import numpy as np
import pytest

from springblock.solver.stability import IS_STABLE, leapfrog_force_time

OMEGA = 2.0


def leapfrog_step(h, gamma):
    """Matrix of one step of (u, w): a kick and a drift, with exact damping."""
    a, kick = math.exp(-gamma * h), -(OMEGA**2) * leapfrog_force_time(h, gamma)
    return np.array([[1.0 + h * kick, h * a], [kick, a]])


def rk4_step(h, gamma):
    """Matrix of one step of (u, v): the exponential of h A up to its fourth order."""
    h_a = h * np.array([[0.0, 1.0], [-(OMEGA**2), -gamma]])
    terms = (np.linalg.matrix_power(h_a, n) / math.factorial(n) for n in range(5))
    return np.sum([*terms], axis=0)


@pytest.mark.parametrize(("name", "step"), [("leapfrog", leapfrog_step), ("rk4", rk4_step)])
@pytest.mark.parametrize("gamma", [0.0, 0.5, 4.0, 10.0])  # none, weak, critical, beyond
def test_a_step_is_stable_while_no_mode_grows(name, step, gamma):
    steps = np.linspace(0.01, 2.5, 250)
    growth = [abs(np.linalg.eigvals(step(h, gamma))).max() for h in steps]
    told = [IS_STABLE[name](h, np.array([0.1, OMEGA]), gamma) for h in steps]
    assert told == [factor < 1.0 + 1e-9 for factor in growth]
    assert 0 < sum(told) < len(told)


def test_damping_shortens_the_time_for_which_a_force_acts():
    """(1 - exp(-γh))/γ is the integral of exp(-γt) over a step, h without damping."""
    assert leapfrog_force_time(0.1, 0.0) == 0.1
    assert leapfrog_force_time(0.1, 20.0) == pytest.approx((1.0 - math.exp(-2.0)) / 20.0)
