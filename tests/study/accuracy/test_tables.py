"""Tables of errors: biases and orders that are known, on few blocks, and reference solutions."""

from types import SimpleNamespace

import numpy as np
import pytest

from analysis.test_correlation import times
from benchmarks.reference import solve
from springblock import Pattern, Setup, Surface, simulate
from springblock.io.parquet import load
from springblock.model.defaults import STEP
from springblock.model.scene import Scene
from springblock.study.accuracy import production
from springblock.study.accuracy.conventions import DELAY, LENGTH, SCENES
from springblock.study.accuracy.production import STEPS, measure, of_length, of_mean
from springblock.study.accuracy.solutions import FILE, SMALL
from springblock.study.accuracy.stability.surfaces import COLUMNS, pulled_column
from springblock.study.accuracy.work_precision import SETTLED_STEPS, cost_of, horizon, orders_of


def test_the_bias_of_a_mean_is_what_was_added(rng):
    exact = rng.normal(7.0, 2.0, 50)
    found = of_mean(exact + 0.25, exact)
    assert found["bias"] == pytest.approx(0.25)
    assert found["bias_error"] == pytest.approx(0.0, abs=1e-12)
    assert found["deviation"] == pytest.approx(exact.std(ddof=1))
    assert found["value"] == pytest.approx(exact.mean() + 0.25)


def test_the_bias_of_a_length_is_told_where_sides_correlate_further():
    """The same noise at both steps, which is remembered further at one of them."""
    fine, coarse = (times(np.random.default_rng(3), 60, 9, 20, l_c) for l_c in (2.0, 3.0))
    found = of_length({5e-9: fine, STEP: coarse, 4e-8: fine})
    assert found[5e-9]["bias"] == found[4e-8]["bias"] == found[4e-8]["ci_high"] == 0.0
    assert found[STEP]["ci_low"] > 0.0
    assert found[STEP]["value"] - found[5e-9]["value"] == pytest.approx(found[STEP]["bias"])
    unpaired = found[STEP]["deviation"] / 60**0.5
    assert found[STEP]["bias_error"] < 0.7 * unpaired


def test_rows_hold_what_simulate_yields(monkeypatch):
    """On pillars so small that each run takes milliseconds."""
    pattern, setup = Pattern.pillars(12, 9, 3), Setup(sample_interval=1.6e-7)
    monkeypatch.setitem(production.PATTERNS, "pillared", pattern)
    rows = list(measure("production-pillared", 4, min(STEPS)))
    runs = [simulate(Surface.draw(pattern.contact, seed), setup) for seed in range(4)]
    found = {row["quantity"]: row for row in rows if row["step"] == STEP}
    assert found["t_max"]["value"] == pytest.approx(np.mean([run.t_max for run in runs]))
    delays = [run.t_max - run.t_avg for run in runs]
    assert found[DELAY]["value"] == pytest.approx(np.mean(delays))
    assert found[DELAY]["scale"] == pytest.approx(found["t_max"]["scale"])
    assert (found[LENGTH]["unit"], found[DELAY]["unit"]) == ("blocks", "s")


def test_coarser_steps_are_compared_with_the_finest_that_is_asked_for(monkeypatch):
    """With the same seeds, whose number is asked for, too."""
    monkeypatch.setitem(production.PATTERNS, "flat", Pattern.flat(4))
    rows = [*measure("production-flat", 3, 1e-8)]
    assert {row["step"] for row in rows} == {8e-8, 4e-8, 2e-8, 1e-8}
    assert all((row["bias"] == 0.0) == (row["step"] == 1e-8) for row in rows[:4])
    assert {row["realisations"] for row in rows} == {3}
    with pytest.raises(ValueError, match=r"^the finest step must be 1e-08 or 5e-09 s, not 2e-08$"):
        next(measure("production-flat", 3, STEP))


def test_scenes_are_those_of_the_study_and_steps_divide_the_sample_interval():
    grooves = Scene(120, 58, 62, 8, 2)
    for scene, wanted in zip(SCENES, (Scene(120), Scene(120, 20, 20), grooves), strict=True):
        assert (production.PATTERNS[scene].contact == wanted.pattern.contact).all()
    multiples = production.SAMPLE_INTERVAL / np.array(STEPS)
    assert multiples == pytest.approx(np.round(multiples))
    assert STEP in STEPS


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


def test_the_solutions_are_stored_in_a_small_file():
    runs = [(row["scene"], row["seed"]) for row in load(FILE).to_pylist()]
    assert runs == [(scene, seed) for scene, small in SMALL.items() for seed in range(small.seeds)]
    assert FILE.stat().st_size < 300_000


@pytest.mark.parametrize(("ratio", "strain"), COLUMNS)
def test_columns_move_as_stored(ratio, strain):
    surface, material, duration = pulled_column(ratio, strain)
    run = solve(surface, material, duration, sample_interval=duration)
    moved = run.displacement[0, ~surface.contact][0] / material.spacing
    assert moved == pytest.approx(COLUMNS[ratio, strain], rel=1e-9)
