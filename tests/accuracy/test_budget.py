"""Biases of ensembles, and the best step for a budget, against closed forms."""

from math import inf
from pathlib import Path

import numpy as np
import pytest
import yaml

from springblock.accuracy.budget import (
    STUDY_SEEDS,
    Bias,
    excess,
    finest_bias,
    spent,
    total_error,
)
from springblock.accuracy.conventions import DELAY, LENGTH
from springblock.model.defaults import STEP

CONFIG = Path(__file__).parents[2] / "config/config.yaml"
CURVATURE, DEVIATION, COST = 2e12, 5e-3, 1.6e-8  #: bias/h² in 1/s², of a run, CPU time x h in s²


def row(bias, error=0.0, scale=1.0, **columns):
    ends = {"ci_low": bias - 2.0 * error, "ci_high": bias + 2.0 * error}
    return {"bias": bias, "bias_error": error, "scale": scale, **ends, **columns}


def second_order(step, prelude=0.0):
    """A step whose bias falls with its square, and whose cost rises with its inverse."""
    costs = {"cpu_seconds": COST / step, "prelude_seconds": prelude}
    return row(CURVATURE * step**2, step=step, deviation=DEVIATION, quantity=LENGTH, **costs)


@pytest.mark.parametrize("seconds", [2.0, 20.0, 2000.0])
def test_at_the_best_step_the_bias_is_half_the_standard_error(seconds):
    """dE²/dh = 4 c² h³ - σ² a/(B h²) = 0, so that E = √5 c h²."""
    best = (DEVIATION**2 * COST / (4.0 * CURVATURE**2 * seconds)) ** 0.2
    errors = [
        total_error(second_order(step), seconds) for step in np.array([0.99, 1.0, 1.01]) * best
    ]
    assert errors[1] == min(errors) == pytest.approx(5.0**0.5 * CURVATURE * best**2)


def test_a_prelude_is_paid_once_and_a_realisation_at_least():
    alone, started = second_order(STEP), second_order(STEP, prelude=3.0)
    assert total_error(started, 23.0) == pytest.approx(total_error(alone, 20.0))
    assert total_error(started, 0.9 * spent(started, 1.0)) == inf


def test_errors_are_compared_for_the_cpu_time_of_the_study_at_the_default_step():
    rows = [second_order(step, prelude=1.0) for step in (STEP / 2.0, STEP, 2.0 * STEP)]
    seconds = 1.0 + 3.0 * STUDY_SEEDS[LENGTH] * COST / STEP
    errors = [total_error(each, seconds) for each in rows]
    assert list(excess(rows, fold=3.0).values()) == pytest.approx(np.divide(errors, min(errors)))


def test_a_bias_is_freed_of_its_own_scatter(rng):
    """b² is too large by error² on average; over many measurements nothing of it is left."""
    bias, error = 3e-3, 1e-3
    found = [Bias.of(row(b, error)).estimate ** 2 for b in rng.normal(bias, error, 4000)]
    assert np.mean(found) == pytest.approx(bias**2, rel=0.04)  # four standard errors
    assert Bias.of(row(-0.5, error=1.0, scale=2.0)) == Bias(0.0, 1.25)


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
