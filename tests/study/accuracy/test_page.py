"""Biases of ensembles against closed forms, and the page with what it is given."""

from itertools import product
from math import nan

import pytest

from springblock.io.identity import identity
from springblock.io.rows import limits, select
from springblock.model.defaults import PAPER_STEP, STEP
from springblock.model.scene import Scene
from springblock.study.accuracy.conventions import DELAY, LENGTH, MEANS, ORDERED, PLAIN, SCENES
from springblock.study.accuracy.page import STUDY_SEEDS, finest_bias, values
from springblock.study.accuracy.production import STEPS, UNITS
from springblock.study.pages import rendered
from studies import PAPER


def precision_rows():
    """Rows of the table `work_precision`; errors of the plain Runge-Kutta do not fall with h."""
    rows, methods = [], {"leapfrog": 1, "rk4": 4, PLAIN: 4}  # and their evaluations in a step
    for (i, scene), quantity, method in product(enumerate(SCENES, 1), (*ORDERED, "t_max"), methods):
        same = {"scene": scene, "quantity": quantity, "integrator": method}
        same |= {"realisations": 2, "n_blocks": 8}
        for step in (1e-9, min(STEPS), PAPER_STEP, 2.0 * PAPER_STEP):
            error = 0.1 * i * (1.0 if method == PLAIN else step / PAPER_STEP)
            own = {"comparison": "reference", "step": step, "error": error}
            rows.append(same | own | {"cpu_seconds": 1e-10 * i / step * methods[method]})
        rows.append(same | {"comparison": "order"} | limits("error", (2.0, 1.9, 2.1), "ci"))
    return rows


def production_rows(seeds=30):
    """Rows of the table `production`: biases of order two, and runs that cost 1e-8 s / step."""
    rows = []
    for scene, quantity, step in product(SCENES, (*MEANS, DELAY, LENGTH), STEPS):
        bias = 2.0 * (step / 8e-8) ** 2 * (step > min(STEPS))
        row = {"scene": scene, "quantity": quantity, "unit": UNITS.get(quantity, "s")}
        row |= {"n_blocks": 120, "step": step, "value": 80.0, "scale": 50.0, "deviation": 10.0}
        row |= limits("bias", (bias, 0.6 * bias, 1.4 * bias), "ci") | {"bias_error": 0.2 * bias}
        row |= {"realisations": seeds, "cpu_seconds": 1e-8 / step, "prelude_seconds": 0.5}
        if quantity != LENGTH or scene == "pillared":
            rows.append(row)
    return rows


def tables(precision=None, production=None):
    """Rows of the four tables behind the page; the energy balance nearly closes."""
    stability = [
        {"family": "size", "integrator": integrator, "parameter": n, "expected": outcome}
        | {"outcome": outcome, "relative_error": error, "energy_error": 0.1 * error}
        for integrator, n, outcome, error in (
            ("leapfrog", 1, "agrees", -2e-3),
            ("leapfrog", 9, "agrees", 1e-3),
            ("rk4", 1, "refused", nan),
        )
    ]
    realisations = [identity(Scene(120)) | {"energy_error": 1e-5}]
    return precision or precision_rows(), stability, realisations, production or production_rows()


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
    scenes = PAPER["scenes"]
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
    for line in (
        "| leapfrog | 1e-08 | 0.03 | 10 | 20 | 30 |",
        "| leapfrog | 2e-08 | 0.015 | 20 | 40 | 60 |",
        "| rk4 | 1e-08 | 0.12 | 10 | 20 | 30 |",
        "| rk4 | 2e-08 | 0.06 | 20 | 40 | 60 |",
        f"| {PLAIN} | 1e-08 | 0.12 | 10 | 20 | 30 |",
        f"| {PLAIN} | 2e-08 | 0.06 | 10 | 20 | 30 |",
    ):
        assert line in page


def test_the_page_is_refused_if_the_tables_contradict_it():
    rows = precision_rows()
    wanted = {"comparison": "reference", "integrator": PLAIN, "step": 2.0 * PAPER_STEP}
    (one,) = select(rows, **wanted, quantity="static_friction", scene="flat")
    one["error"] = 0.4
    with pytest.raises(ValueError, match=r"contradict “Plain Runge-Kutta"):
        written(precision=rows)
