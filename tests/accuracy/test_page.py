"""Biases of ensembles against closed forms."""

from pathlib import Path

import pytest
import yaml

from springblock.accuracy.conventions import DELAY, LENGTH
from springblock.accuracy.page import STUDY_SEEDS, finest_bias

CONFIG = Path(__file__).parents[2] / "config/config.yaml"


def row(bias, error=0.0, scale=1.0, **columns):
    ends = {"ci_low": bias - 2.0 * error, "ci_high": bias + 2.0 * error}
    return {"bias": bias, "bias_error": error, "scale": scale, **ends, **columns}


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
    assert STUDY_SEEDS[DELAY] <= scenes["flat"]["seeds"]
