"""Orders of convergence, of errors whose order is known."""

from types import SimpleNamespace

import numpy as np
import pytest

from springblock.model.defaults import STEP
from springblock.study.accuracy.work_precision import SETTLED_STEPS, cost_of, horizon, orders_of


def test_the_order_of_each_seed_is_told_whatever_the_sign_of_its_errors():
    seeds = np.array([1.0, -20.0, 300.0])
    found = {h: {"t_max": seeds * (h / STEP) ** np.array([1, 2, 3])} for h in SETTLED_STEPS}
    assert orders_of(SETTLED_STEPS, found, "t_max") == pytest.approx([1.0, 2.0, 3.0], abs=1e-3)


def test_one_slow_run_does_not_change_the_cost_of_a_realisation():
    """Steps are averaged, and the CPU time is the median."""
    runs = [
        (SimpleNamespace(steps=steps), time) for steps, time in ((10, 90.0), (20, 1.0), (60, 2))
    ]
    assert cost_of("leapfrog", runs) == (2.0, 30.0)
    assert cost_of("rk4", runs) == (2.0, 120.0)


def test_runs_part_where_the_first_of_two_detaches():
    """Blocks that never detach, or differ by less than 0.1 % of t_max, part nothing."""
    one = SimpleNamespace(t_max=100.0, t_det=np.array([[10.0, 60.0], [50.0, np.nan]]))
    other = SimpleNamespace(t_max=100.0, t_det=np.array([[10.09, 40.0], [45.0, 30.0]]))
    assert horizon(one, other) == horizon(other, one) == 40.0
    assert horizon(one, one) == np.inf
