"""springblock make."""

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from mechanism import chapter
from precision import precision_rows, production_rows
from springblock.accuracy import solutions, stability
from springblock.accuracy.conventions import PAPER_STEP, PLAIN
from springblock.accuracy.stability.cases import Case, Outcome
from springblock.accuracy.work_precision import rows_of
from springblock.io.parquet import load, write
from springblock.io.rows import select
from springblock.mechanism.surfaces import TABLES
from springblock.model.defaults import STEP
from springblock.report.dictionary import kinds


def as_table(name, rows):
    """Rows as the table of this name; columns that they lack hold nothing."""
    return pa.Table.from_pylist(rows, pa.schema([(f.name, f.type) for f in kinds()[name][1]]))


def test_too_few_or_too_many_inputs_are_refused(springblock, tmp_path):
    (text := tmp_path / "text").write_text("text")
    for name, files in (("stability", [text]), ("accuracy", [text]), ("collect", [])):
        words = ("make", name, *files, "--output", tmp_path / "output")
        assert f"Error: {name}: {len(files)} files given; give " in springblock(
            *words, refused=True
        )


@pytest.mark.parametrize("word", ["agrees", "drifts"])
def test_cases_are_written_if_each_comes_out_as_expected(springblock, word, tmp_path, monkeypatch):
    case = Case("size", "rk4", "nothing", 0.0, "none", lambda _: Outcome(word))
    monkeypatch.setattr(stability, "all_cases", lambda: [case])
    output, refused = tmp_path / "table.parquet", word == "drifts"
    said = springblock("make", "stability", "--output", output, refused=refused)
    assert output.exists() == (not refused)
    assert ("nothing, rk4: expected 'agrees', not 'drifts'" in said) == refused


def test_reference_solutions_that_have_changed_are_refused(springblock, tmp_path, monkeypatch):
    """They are written, so that they can replace those of the package."""
    found = solutions.stored()
    words = ("make", "reference", "--output", tmp_path / "table")
    monkeypatch.setattr(solutions, "solve_all", lambda: found)
    springblock(*words)
    found[3]["static_friction"] *= 1.001
    monkeypatch.setattr(solutions, "stored", lambda: load(solutions.FILE).to_pylist())
    said = springblock(*words, refused=True)
    assert "flat, seed 3: static_friction differs from the stored solution" in said
    assert load(tmp_path / "table").to_pylist()[3]["static_friction"] == found[3]["static_friction"]


def test_models_on_small_pillars_become_a_table(springblock, tmp_path, monkeypatch):
    monkeypatch.setattr("springblock.mechanism.tables.SEEDS", 2)
    springblock("make", "mechanism-4", "--output", tmp_path / "table")
    rows = pq.read_table(tmp_path / "table").to_pylist()
    assert [row["seed"] for row in rows] == [0, 1]
    for row in rows:  # inertia lowers friction, and overshoot of single blocks is most of it
        assert row["overshooting"] == pytest.approx(row["simulation"], rel=0.02)
        assert row["simulation"] < 0.96 * row["quasi_static"]


def test_the_tables_of_the_mechanism_become_a_page(springblock, tmp_path):
    parts = (chapter.rows(), chapter.variants())
    files = [tmp_path / str(number) for number in range(len(parts))]
    for name, file, found in zip(TABLES, files, parts, strict=True):
        write(as_table(name, found), file, {})
    springblock("make", "mechanism", *files, "--output", tmp_path / "page")
    text = " ".join((tmp_path / "page").read_text().split())
    assert "20 (or 6)" in text


def test_an_error_is_the_root_mean_square_over_realisations():
    errors = {"t_max": np.array([3.0, 4.0])}
    (row,) = rows_of("reference", "flat", "rk4", 1e-8, errors)
    assert row["error"] == pytest.approx(12.5**0.5)


@pytest.fixture
def page(springblock, batch, tmp_path):
    """Write the page on errors from these tables; return its text."""

    def written(precision=precision_rows(), production=production_rows()):  # noqa: B008
        stability = [{"family": "size", "expected": "agrees", "outcome": "agrees"}] * 3
        tables = {"work_precision": precision, "stability": stability, "production": production}
        for name, rows in tables.items():
            write(as_table(name, rows), tmp_path / name, {})
        files = (tmp_path / "work_precision", tmp_path / "stability", batch(0, 0))
        output = ("--output", tmp_path / "page.md")
        springblock("make", "accuracy", *files, tmp_path / "production", *output)
        return (tmp_path / "page.md").read_text(encoding="utf-8")

    return written


def test_the_page_gives_each_value_both_errors(page):
    text = page()
    # t(29) = 2.045 times 10/30^0.5; 1.4 times a bias of 2/16
    assert "| decay length |  | 80.0 ± 3.7 ± 0.2 (blocks) |  |" in text
    assert "| t_max | 80000000 ± " in text  # 80 s in µs
    assert "| static friction | 80.0 ± 3.7 ± 0.2 | 80.0 ± 3.7 ± 0.2 | 80.0 ± 3.7 ± 0.2 |" in text
    # of a scale of 50: 1.4 times 2/64 at twice the finest step; 20 % over 20 seeds
    assert "| +0.250 [+0.150, +0.350] ± 0.087 (4.47) |" in text


def test_the_page_says_what_each_step_costs_and_what_it_biases_most(page):
    """Each on the surface where it is largest; 20 % over 20 seeds are 4.47 %."""
    rows = production_rows()
    (worst,) = select(rows, scene="grooved", quantity="t_avg", step=2.0 * STEP)
    worst |= {"bias": -2.0, "ci_low": -2.8, "ci_high": -1.2}
    worst |= {name: 0.5 * worst[name] for name in ("bias", "ci_low", "ci_high")}
    for row in select(rows, scene="flat", step=STEP):
        row["cpu_seconds"] = 0.7
    text = page(production=rows)
    lines = text[text.index("| step (s) |") :].splitlines()[2:8]
    assert [line.split(" | ")[0] for line in lines] == [
        *("| 8e-08", "| 4e-08", "| **2e-08**, default", "| 1e-08", "| 5e-09"),
        "| error of 20 seeds",
    ]
    usual = "+1.000 [+0.600, +1.400]"
    assert lines[1] == f"| 4e-08 | 0.25 | {usual} | {usual} | -2.000 [-2.800, -1.200] |"
    assert lines[2].startswith("| **2e-08**, default | 0.7 | +0.250 [+0.150, +0.350] | ")
    assert lines[4] == "| 5e-09 | 2 | 0 | 0 | 0 |"
    assert lines[5].endswith("|  | 4.47 to 4.47 | 4.47 to 4.47 | 4.47 to 4.47 |")
    said = " ".join(text.split())
    assert "4e-08 s takes 36 % of its CPU time, but changes t_avg by up to 2.25 %," in said
    assert "which is 0.5 standard errors of a mean over 20 seeds." in said
    assert "at 8e-08 s static friction, t_max and t_avg are biased by up to 4.0 %" in said


def test_the_page_begins_with_the_largest_errors(page):
    """Of one quantity in one scene: 3 times its own interval, and what the finest step adds."""
    rows = production_rows()
    (worst,) = select(rows, scene="grooved", quantity="t_max", step=STEP)
    worst["ci_high"] *= 3.0
    worst["deviation"] *= 2.0
    opening = " ".join(page(production=rows).split("This page is written")[0].split())
    largest = "0.44 % (static friction), 1.14 % (t_max), 0.44 % (t_avg), 0.44 % (decay length)"
    errors = "4.47 % (static friction), 8.94 % (t_max), 4.47 % (t_avg), 2.58 % (decay length)"
    assert largest in opening
    assert errors in opening


def test_the_page_shows_the_errors_of_plain_runge_kutta_and_where_it_finds_no_error(page):
    rows = precision_rows()
    of_plain = select(rows, integrator=PLAIN, step=PAPER_STEP, quantity="static_friction")
    select(of_plain, scene="grooved")[0]["error"] = 0.3
    of_default = select(rows, comparison="reference", integrator="leapfrog", step=STEP)
    select(of_default, quantity="t_max", scene="flat")[0]["error"] = 0.0
    text = page(precision=rows)
    assert "10.0 % (flat), 10.0 % (pillared), 30.0 % (grooved)" in text
    assert "10.0 % (flat), 10.0 % (pillared), 10.0 % (grooved)" in text
    assert "| t_max | 0 | 1.0e-01 | 1.0e-01 |\n" in text


def test_questions_beyond_the_paper_are_answered_where_they_were_simulated(
    springblock, batch, tmp_path
):
    page = tmp_path / "beyond.md"
    grooves = [batch(0, 2, "--n-p2", 4, "--n-s2", 2, "--direction", way) for way in "xy"]
    springblock("make", "beyond", *grooves, "--output", page)
    text = page.read_text(encoding="utf-8")
    assert "| 0 | 2 | 4 | " in text  # load peaks
