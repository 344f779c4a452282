"""springblock make."""

import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from springblock.io.parquet import load, write
from springblock.study.accuracy import stability
from springblock.study.accuracy.stability.cases import Case, Outcome
from springblock.study.results import TABLES, found
from study.accuracy.test_page import tables
from study.mechanism.test_page import TABLES as MECHANISM


@pytest.fixture
def stored(tmp_path):
    """Write rows as the table of a name; columns that they lack hold nothing."""

    def write_rows(name, rows):
        columns = pa.schema([(f.name, f.type) for f in found(TABLES[name].columns)])
        write(pa.Table.from_pylist(rows, columns), tmp_path / name, {})
        return tmp_path / name

    return write_rows


def test_too_few_or_too_many_inputs_are_refused(springblock, tmp_path):
    (text := tmp_path / "text").write_text("text")
    for name, files in (("mechanism-6", [text]), ("accuracy", [text]), ("mechanism_damped", [])):
        output = tmp_path / ("page.md" if name == "accuracy" else "table.parquet")
        words = ("make", name, *files, "--output", output)
        said = springblock(*words, refused=True)
        assert f"Error: {len(files)} files given; give " in said


@pytest.mark.parametrize("word", ["agrees", "drifts"])
def test_cases_are_written_if_each_comes_out_as_expected(springblock, word, tmp_path, monkeypatch):
    case = Case("size", "rk4", "nothing", 0.0, lambda _: Outcome(word))
    monkeypatch.setattr(stability, "all_cases", lambda: [case])
    output, refused = tmp_path / "table.parquet", word == "drifts"
    said = springblock("make", "stability", "--output", output, refused=refused)
    assert output.exists() == (not refused)
    assert ("nothing, rk4: expected 'agrees', not 'drifts'" in said) == refused


def test_models_on_small_pillars_become_a_table(springblock, tmp_path, monkeypatch):
    monkeypatch.setattr("springblock.study.mechanism.tables.SEEDS", 2)
    springblock("make", "mechanism-4", "--output", tmp_path / "table")
    rows = pq.read_table(tmp_path / "table").to_pylist()
    assert [row["seed"] for row in rows] == [0, 1]
    for row in rows:  # inertia lowers friction, and overshoot of single blocks is most of it
        assert row["overshooting"] == pytest.approx(row["simulation"], rel=0.02)
        assert row["simulation"] < 0.96 * row["quasi_static"]


def test_what_friction_depends_on_becomes_a_table_from_batches(springblock, batch, tmp_path):
    grooves = ("--n-p2", 4, "--n-s2", 2)
    batches = batch(0, 2, *grooves), batch(0, 2, *grooves, "--gamma", "1e6")
    output = tmp_path / "table.parquet"
    springblock("make", "sensitivities", *batches, "--output", output)
    rows = load(output).to_pylist()
    assert [(row["varied"], row["quantity"]) for row in rows] == [
        ("", "prominence_whole"),
        ("gamma", "prominence_whole"),
    ]


def test_a_page_whose_sentences_its_tables_contradict_is_not_written(springblock, stored, tmp_path):
    """Friction of the simulation is lowest on pillars of 20 and 6 blocks here."""
    files = [stored(name, rows) for name, rows in MECHANISM.items()]
    said = springblock("make", "mechanism", *files, "--output", tmp_path / "a.md", refused=True)
    assert "the tables contradict “Static friction is lowest on pillars of 20 (or 6)" in said
    assert not (tmp_path / "a.md").exists()


def test_four_tables_become_the_page_on_errors(springblock, batch, stored, tmp_path):
    precision, stability, _, production = tables()
    files = [stored("work_precision", precision), stored("stability", stability), batch(0, 0)]
    files.append(stored("production", production))
    springblock("make", "accuracy", *files, "--output", tmp_path / "page.md")
    assert "| 4e-08 | 0.25 | " in (tmp_path / "page.md").read_text(encoding="utf-8")
