"""Runs of different constants are kept apart in whatever way a command reads several."""

import pyarrow.parquet as pq
import pytest

PILLARS = ("--n-blocks", 12, "--n-p", 6, "--n-s", 6)


@pytest.fixture(scope="module")
def batches(springblock, tmp_path_factory):
    """Batches of two scenes that differ in one constant."""
    files = [tmp_path_factory.mktemp("studies") / name for name in "ab"]
    for file, other in zip(files, ((), ("--slider-velocity", 1e-3)), strict=True):
        springblock("simulate", *PILLARS, *other, "--last-seed", 2, "--output", file)
    return files


def test_a_figure_refuses_scenes_that_it_cannot_tell_apart(springblock, batches, tmp_path):
    picture = ("--output", tmp_path / "a.png")
    said = springblock("figure", "figure_6", *batches, *picture, refused=True)
    assert "n_p = 6 is not unique: scenes differ in slider_velocity; give one of them" in said
    assert list(tmp_path.iterdir()) == []


def test_a_table_holds_both(springblock, batches, tmp_path):
    springblock("aggregate", *batches, "--output", tmp_path / "table")
    table = pq.read_table(tmp_path / "table")
    assert table["slider_velocity"].to_pylist() == [5e-4] * 3 + [1e-3] * 3
    said = springblock("aggregate", *batches, batches[0], "--output", tmp_path / "a", refused=True)
    assert "both hold seed 0 of n_blocks = 12, n_p = 6, n_s = 6" in said
