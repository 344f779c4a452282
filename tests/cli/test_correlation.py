"""springblock correlation."""

import shutil
from pathlib import Path

import pyarrow.parquet as pq
import pytest

from springblock.io.schemas import CORRELATION, CORRELATION_LENGTH

GROOVES = ("--n-p2", 3, "--n-s2", 1)


@pytest.fixture
def outputs(tmp_path):
    return ("--output-correlation", tmp_path / "c", "--output-length", tmp_path / "l")


@pytest.mark.parametrize(
    ("scene", "sides"),
    [
        (("--n-p", 6, "--n-s", 6), {"x", "y"}),
        (("--n-p", 7, "--n-s", 5, *GROOVES), {"x", "grooves"}),
        (("--n-p", 7, "--n-s", 5, *GROOVES, "--n-p3", 1, "--n-s3", 1, "--along-3", "x"), {"x"}),
    ],
)
def test_sides_and_edges_along_grooves_are_correlated_where_they_are_not_cut(
    springblock, batch, outputs, tmp_path, scene, sides
):
    springblock("correlation", batch(0, 2, *scene), *outputs)
    for name, schema in (("c", CORRELATION), ("l", CORRELATION_LENGTH)):
        table = pq.read_table(tmp_path / name)
        assert table.schema.names == schema.names
        assert set(table["side"].to_pylist()) == sides
        assert set(table["realisations"].to_pylist()) == {3}


def test_surfaces_without_sides_and_two_scenes_are_refused(
    springblock, batch, pillars, outputs, tmp_path
):
    flat = batch(0, 0)
    refusal = springblock("correlation", flat, *outputs, refused=True)
    assert ": no whole sides of 6 blocks or more" in refusal
    two = [shutil.copy(file, tmp_path / f"{i}.parquet") for i, file in enumerate((*pillars, flat))]
    refusal = springblock("correlation", *two, *outputs, refused=True)
    assert "several scenes: " in refusal
    for file in two:
        Path(file).unlink()
    assert list(tmp_path.iterdir()) == []
