"""springblock table and compare: means, and differences between two tables."""

import csv

import numpy as np
import pyarrow.parquet as pq
import pytest
from scipy.stats import ttest_1samp, ttest_ind

from springblock import read
from springblock.analysis.statistics import mean_interval, number
from springblock.io.parquet import load


def written(file):
    with file.open(newline="") as lines:
        return list(csv.DictReader(lines))


def test_a_row_holds_the_mean_of_an_ensemble_with_its_interval(springblock, batch, tmp_path):
    faster = batch(0, 2, "--slider-velocity", "1e-3")
    output = tmp_path / "table.csv"
    said = springblock("table", batch(0, 2), faster, "--output", output)
    rows = written(output)
    assert [float(row["slider_velocity"]) for row in rows] == [5e-4, 1e-3]
    assert said.splitlines()[0].split() == [
        *("slider_velocity", "(m/s)", "runs", "static_friction", "t_max", "(µs)", "t_avg", "(µs)")
    ]
    for row, file in zip(rows, (batch(0, 2), faster), strict=True):
        values = np.array([run.t_max for run in read(file)])
        exact = ttest_1samp(values, 0.0).confidence_interval()
        assert row["runs"] == "3"
        assert float(row["t_max"]) == pytest.approx(values.mean(), rel=1e-14)
        limits = [float(row[f"t_max_{end}"]) for end in ("low", "high")]
        assert limits == pytest.approx(list(exact), rel=1e-10)
        assert number(mean_interval([run.static_friction for run in read(file)])) in said
        assert number(mean_interval(values), factor=1e6) in said


def test_tables_filtered_with_pandas_are_read_and_contradicting_runs_refused(
    springblock, batch, tmp_path
):
    """They have lost the checksum and the version of the code."""
    filtered, other = tmp_path / "filtered.parquet", tmp_path / "other.parquet"
    runs = pq.read_table(batch(0, 2)).to_pandas()
    runs[runs.seed > 0].to_parquet(filtered)
    assert [run.seed for run in read(filtered)] == [1, 2]
    whole = springblock("table", batch(0, 2))
    assert springblock("table", batch(0, 2), filtered) == whole
    assert "pandas" not in springblock("info", filtered)
    faster = batch(0, 2, "--slider-velocity", "1e-3")
    picture = tmp_path / "a.png"
    springblock("plot", filtered, faster, "--over", "slider_velocity", "--output", picture)
    runs.assign(t_max=2.0 * runs.t_max).to_parquet(other)
    said = springblock("table", batch(0, 2), other, refused=True)
    assert "seed 0, differ: t_max is " in said
    content = filtered.read_bytes()
    filtered.write_bytes(content[: len(content) // 2])
    assert "is damaged, or not a table" in springblock("table", filtered, refused=True)


def test_realisations_are_gathered_by_any_name_and_count_once(springblock, batch, tmp_path):
    """A folder may hold them twice, beside other tables."""
    folder, output = tmp_path / "files", tmp_path / "by.parquet"
    folder.mkdir()
    pq.write_table(pq.read_table(batch(0, 2)).select(["seed"]), folder / "other.parquet")
    assert "no realisations found" in springblock("table", folder, refused=True)
    (folder / "._0.parquet").write_bytes(b"companion of another system")
    (folder / "empty.parquet").touch()
    assert "empty.parquet is empty or not a table" in springblock("table", folder, refused=True)
    (folder / "empty.parquet").unlink()
    for i, file in enumerate((batch(0, 2), batch(0, 2), batch(0, 2, "--gamma", "0"))):
        (folder / f"{i}.parquet").write_bytes(file.read_bytes())
    springblock("table", folder, "--by", "direction", "--of", "t_avg", "--output", output)
    (row,) = pq.read_table(output).to_pylist()
    assert row["direction"] == "x"
    assert row["runs"] == 6
    pairs = [read(folder / f"{i}.parquet") for i in (0, 2)]
    by_seed = np.mean([[run.t_avg for run in runs] for runs in pairs], axis=0)  # not independent
    exact = ttest_1samp(by_seed, 0.0).confidence_interval()
    assert [row["t_avg_low"], row["t_avg_high"]] == pytest.approx(list(exact), rel=1e-10)
    assert "by: unknown name 'speed'" in springblock("table", folder, "--by", "speed", refused=True)


def test_times_of_snapshots_are_text_in_csv(springblock, batch, tmp_path):
    output = tmp_path / "table.csv"
    watched = batch(0, 1, "--snapshot-times", "1e-4")
    springblock("table", batch(0, 1), watched, "--output", output)
    assert [row["snapshot_times"] for row in written(output)] == ["()", "(0.0001,)"]


@pytest.mark.parametrize(("seeds", "paired"), [((0, 2), True), ((0, 3), False), ((1, 3), False)])
def test_a_difference_is_paired_where_seeds_are_the_same(
    springblock, batch, tmp_path, seeds, paired
):
    """And has the interval of the t test for it."""
    slow, fast = batch(0, 2), batch(*seeds, "--slider-velocity", "1e-3")
    output = tmp_path / "changes.csv"
    said = springblock("compare", slow, fast, "--of", "static_friction", "--output", output)
    assert f"slider_velocity: 0.0005 in {slow}, 0.001 in {fast}" in said
    (row,) = written(output)
    assert row["difference"] == ("by seed" if paired else "of means")
    assert row["runs"] == f"3, {seeds[1] - seeds[0] + 1}"
    one, other = (np.array([run.static_friction for run in read(file)]) for file in (slow, fast))
    test = ttest_1samp(other - one, 0.0) if paired else ttest_ind(other, one, equal_var=False)
    exact = [other.mean() - one.mean(), *test.confidence_interval()]
    found = [float(row["static_friction" + end]) for end in ("", "_low", "_high")]
    assert found == pytest.approx(exact, rel=1e-9)
    springblock("table", slow, fast, "--changes", "--of", "static_friction", "--output", output)
    (same,) = written(output)
    assert (same["from"], same["to"]) == ("slider_velocity = 0.0005 m/s", "0.001")
    assert row.items() <= same.items()


def test_directions_are_compared_with_the_smallest_angle(springblock, batch, tmp_path):
    """Which is x: as text, 30 and 45 would come before it."""
    files = [batch(0, 1, "--direction", angle) for angle in ("45", "y", "x", "30", "-20")]
    output = tmp_path / "a.csv"
    springblock("table", *files, "--changes", "--of", "t_max", "--output", output)
    ends = [(row["from"], row["to"]) for row in written(output)]
    assert ends == [("direction = -20", angle) for angle in ("x", "30", "45", "y")]
    output = tmp_path / "a.parquet"  # whose columns have one type
    files.append(batch(0, 1, "--gamma", "6e3"))
    springblock("table", *files, "--changes", "--of", "t_max", "--output", output)
    assert load(output, ["to"])["to"].to_pylist() == ["x", "30", "45", "y", "6000.0"]
    said = springblock("table", *files)
    assert "45°" in said
    assert "warning" not in said
    assert "law coulomb" in springblock("table", batch(0, 1, "--n-p", 3, "--n-s", 3))


def test_a_weakening_law_is_compared_with_coulombs(springblock, batch, tmp_path):
    """Which weakens over no distance."""
    own = ("--law", "slip_weakening", "--slip-distance")
    runs = batch(0, 1), *(batch(0, 1, *own, d_c) for d_c in ("1e-8", "2e-8"))
    output = tmp_path / "a.csv"
    springblock("table", *runs, "--changes", "--of", "static_friction", "--output", output)
    rows = written(output)
    assert [row["from"] for row in rows] == 2 * ["slip_distance = 0.0 m"]
    friction = [np.mean([run.static_friction for run in read(file)]) for file in runs]
    exact = [other - friction[0] for other in friction[1:]]
    assert [float(row["static_friction"]) for row in rows] == pytest.approx(exact, rel=1e-9)
    said = springblock("compare", runs[0], runs[1])
    assert f"law: coulomb in {runs[0]}, slip_weakening" in said


def test_other_thresholds_are_not_paired_and_ensembles_of_one_side_are_named(
    springblock, batch, tmp_path
):
    """Nor are those drawn with another correlation, though mean and scatter are the same."""
    for other, named in (
        (("--mu-static", 0.9), "mu_static: 1.0 in"),
        (("--correlation-length", 2e-5), "correlation_length: 0.0 in"),
    ):
        said = springblock("compare", batch(0, 2), batch(0, 2, *other))
        assert named in said
        assert "of means" in said
    for i, file in enumerate((batch(0, 2), batch(0, 2, "--slider-velocity", "1e-3"))):
        (tmp_path / f"{i}.parquet").write_bytes(file.read_bytes())
    said = springblock("compare", tmp_path, batch(0, 2))
    assert f"only in {tmp_path}: " in said
    assert said.splitlines()[-1].split()[:2] == ["3,", "3"]
