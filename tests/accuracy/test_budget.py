"""The best step for a budget, against closed forms."""

from math import inf
from pathlib import Path

import numpy as np
import pytest
import yaml

from springblock.accuracy.budget import (
    STUDY_SEEDS,
    Bias,
    Choice,
    best,
    choices,
    finest_bias,
    halving,
    study_budget,
)
from springblock.accuracy.conventions import DELAY, LENGTH
from springblock.model.defaults import STEP

CONFIG = Path(__file__).parents[2] / "config/config.yaml"
CURVATURE, DEVIATION, COST = 2e12, 5e-3, 1.6e-8  #: bias/h² in 1/s², of a run, CPU time x h in s²
STEPS = np.geomspace(1e-9, 1e-6, 3001)  #: 0.2 % apart


def second_order(step, prelude=0.0, bias=CURVATURE):
    """A step whose bias falls with its square, and whose cost rises with its inverse."""
    return Choice(float(step), bias * step**2, DEVIATION, COST / step, prelude)


def row(bias, error=0.0, scale=1.0, **columns):
    ends = {"ci_low": bias - 2.0 * error, "ci_high": bias + 2.0 * error}
    return {"bias": bias, "bias_error": error, "scale": scale, **ends, **columns}


@pytest.mark.parametrize("budget", [2.0, 20.0, 2000.0])
def test_at_the_best_step_the_bias_is_half_the_standard_error(budget):
    """dE²/dh = 4 c² h³ - σ² a/(B h²) = 0."""
    chosen = best([second_order(step) for step in STEPS], budget)
    exact = (DEVIATION**2 * COST / (4.0 * CURVATURE**2 * budget)) ** 0.2
    assert chosen.step == pytest.approx(exact, rel=2e-3)
    standard_error = DEVIATION / chosen.seeds(budget) ** 0.5
    assert chosen.bias == pytest.approx(standard_error / 2.0, rel=1e-2)
    assert chosen.error(budget) == pytest.approx(5.0**0.5 * CURVATURE * exact**2, rel=1e-4)


def test_half_the_error_costs_4_times_the_time_or_with_a_bias_of_order_two_5_7_times():
    assert halving([second_order(STEP, bias=0.0)], 20.0) == pytest.approx(4.0)
    assert halving([second_order(step) for step in STEPS], 20.0) == pytest.approx(2**2.5, rel=1e-3)


def test_a_prelude_is_paid_once():
    """Four times the seeds, but no second prelude."""
    alone, started = second_order(STEP, bias=0.0), second_order(STEP, prelude=3.0, bias=0.0)
    assert started.error(23.0) == pytest.approx(alone.error(20.0))
    assert halving([started], 23.0) == pytest.approx((3.0 + 4.0 * 20.0) / 23.0)


def test_a_cost_is_that_of_the_error_and_infinite_below_the_bias():
    step = second_order(4e-8, prelude=1.0)
    assert step.cost(step.error(30.0)) == pytest.approx(30.0)
    assert step.cost(step.bias) == inf
    assert step.error(0.9 * step.spent(1.0)) == inf
    assert step.cost(1.0) == step.spent(1.0)  # no less than a realisation


def test_a_bias_is_freed_of_its_own_scatter(rng):
    """b² is too large by error² on average; over many measurements nothing of it is left."""
    bias, error = 3e-3, 1e-3
    found = [Bias.of(row(b, error)).estimate ** 2 for b in rng.normal(bias, error, 4000)]
    assert np.mean(found) == pytest.approx(bias**2, rel=0.04)  # four standard errors


def test_a_bias_that_is_not_told_from_zero_has_an_upper_limit_alone():
    assert Bias.of(row(0.5, error=1.0)) == Bias(0.0, 0.0, 2.5)
    estimate, low, high = Bias.of(row(-4.0, error=1.0, scale=2.0))
    assert (low, high) == (1.0, 3.0)
    assert low < estimate < 2.0


def test_choices_are_shares_of_the_scale_finest_first():
    costs = {"cpu_seconds": 0.5, "prelude_seconds": 1.0, "deviation": 4.0}
    rows = [
        row(b, scale=8.0, step=h, quantity=LENGTH, **costs) for h, b in ((STEP, 2.0), (5e-9, 0))
    ]
    finest, default = choices(rows)
    assert (finest.step, finest.bias) == (5e-9, 0.0)
    assert default == Choice(STEP, 0.25, 0.5, 0.5, 1.0)
    assert study_budget(rows) == 1.0 + STUDY_SEEDS[LENGTH] * 0.5


def test_the_bias_of_the_finest_step_is_told_at_first_order_and_covered_at_second():
    """c h^p, measured against itself at 5e-9 s: c h at p = 1, three times c h² at p = 2."""
    for p, factor in ((1, 1.0), (2, 3.0)):
        rows = [row(h**p - 5.0**p, scale=2.0, step=h) for h in (20.0, 10.0, 5.0)]
        assert finest_bias(rows) == pytest.approx(factor * 5.0**p / 2.0)
    assert finest_bias([row(0.0, step=5.0), row(-4.0, error=1.0, step=10.0)]) == 6.0


def test_budgets_are_those_of_the_study():
    scenes = yaml.safe_load(CONFIG.read_text())["scenes"]
    pillars = dict(zip(scenes["pillars"]["n_p"], scenes["pillars"]["seeds"], strict=True))
    assert STUDY_SEEDS[LENGTH] == pillars[20]
    assert STUDY_SEEDS["static_friction"] == STUDY_SEEDS[DELAY] == pillars[10]
    assert all(STUDY_SEEDS[DELAY] <= scenes[name]["seeds"] for name in ("flat", "size_flat"))
