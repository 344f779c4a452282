"""Biases of ensembles against closed forms, and the page with what they are given."""

from pathlib import Path

import pytest
import yaml

from precision import precision_rows, production_rows, tables
from springblock.io.rows import select
from springblock.model.defaults import PAPER_STEP, STEP
from springblock.study.accuracy.conventions import DELAY, LENGTH, PLAIN
from springblock.study.accuracy.page import STUDY_SEEDS, finest_bias, values
from springblock.study.pages import rendered

CONFIG = Path(__file__).parents[3] / "config/config.yaml"


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


def written(**some):
    return rendered("accuracy/page.md", **values(*tables(**some)))


def test_values_have_a_statistical_and_a_numerical_error():
    length = values(*tables())["errors"][LENGTH, "pillared"]
    half = 2.045 * 10.0 / 30**0.5  # Student's t with 29 degrees of freedom
    assert length.value == pytest.approx((80.0, 80.0 - half, 80.0 + half), rel=1e-4)
    # of a scale of 50: 1.4 times 2/16 at the default, and 1.4 times 2/64 at twice the finest step
    assert length.numerical == pytest.approx(1.4 * (2.0 / 16.0 + 2.0 / 64.0))
    assert length.largest == pytest.approx(length.numerical / 50.0 * 100.0)
    assert length.scatter == pytest.approx(20.0 / 60**0.5)  # %, of a deviation of 20 %


def test_each_step_has_its_cost_and_the_bias_of_the_surface_where_it_is_largest():
    rows = production_rows()
    (worst,) = select(rows, scene="grooved", quantity="t_avg", step=2.0 * STEP)
    worst |= {"bias": -1.0, "ci_low": -1.4, "ci_high": -0.6}
    for row in select(rows, scene="flat", step=STEP):
        row["cpu_seconds"] = 0.7
    found = values(*tables(production=rows))
    assert [each["step"] for each in found["of_steps"]] == [8e-8, 4e-8, 2e-8, 1e-8, 5e-9]
    coarse, default = found["of_steps"][1:3]
    assert coarse["biases"][2] == pytest.approx((-2.0, -2.8, -1.2))
    assert (coarse["seconds"], default["seconds"]) == (0.25, 0.7)
    assert found["double"].scene == "grooved"
    assert found["double"].change == pytest.approx(2.25)


def test_conclusions_belong_to_the_study_with_the_most_seeds():
    """With 30 seeds the page has the same tables; with 60 it says what they show."""
    rows = production_rows(seeds=60)
    for row in rows:
        row["deviation"] *= 10.0 if (row["scene"], row["quantity"]) == ("grooved", "t_max") else 0.1
    whole = written(production=rows)
    assert "Use the default" in whole
    assert whole.count("\n|") == written().count("\n|")
    assert "Use the default" not in written()


def test_extreme_cases_of_a_family_are_one_line():
    """With the largest error of each integrator that has one."""
    assert "| N | 1 to 9 | agrees 2, refused 1 | 0.002; – | 0.0002; – |" in written()


def test_methods_are_compared_at_the_paper_s_step_and_the_default():
    page = written()
    for method in ("leapfrog", "rk4", PLAIN):
        for step in ("1e-08", "2e-08"):
            assert f"| {method} | {step} | 0.02 | 10 | 10 | 10 |" in page


def test_the_page_is_refused_if_the_tables_contradict_it():
    rows = precision_rows()
    (one,) = select(
        rows, integrator=PLAIN, step=2 * PAPER_STEP, quantity="static_friction", scene="flat"
    )
    one["error"] = 0.4
    with pytest.raises(ValueError, match=r"contradict “Plain Runge-Kutta"):
        written(precision=rows)
