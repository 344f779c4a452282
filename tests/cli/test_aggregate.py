"""springblock aggregate and correlation."""

import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from springblock.analysis.comparison import differences
from springblock.io.parquet import write
from springblock.io.schemas import CORRELATION, CORRELATION_LENGTH

GROOVES = ("--n-p2", 3, "--n-s2", 1)


@pytest.fixture
def outputs(tmp_path):
    return ("--output-correlation", tmp_path / "c", "--output-length", tmp_path / "l")


def test_a_large_energy_residual_is_reported(springblock, batch, tmp_path):
    table = pq.read_table(batch(0, 0))
    where = table.schema.get_field_index("energy_error")
    write(table.set_column(where, "energy_error", pa.array([0.25])), tmp_path / "bad", {})
    said = springblock("aggregate", tmp_path / "bad", "--output", tmp_path / "a")
    assert said.startswith("warning: energy residual 2.5e-01 at n_blocks = 12, seed = 0")


def test_batches_and_order_change_no_bit_of_a_table(springblock, batch, outputs, tmp_path):
    """One batch of three runs, or three of one in the other order."""
    scene, tables = ("--n-p", 6, "--n-s", 6), []
    for seeds in ([(0, 2)], [(2, 2), (1, 1), (0, 0)]):
        files = [batch(*each, *scene) for each in seeds]
        springblock("aggregate", *files, "--output", tmp_path / "a")
        springblock("correlation", *files, *outputs)
        tables.append([pq.read_table(tmp_path / name) for name in "acl"])
    assert not any(differences(one, two) for one, two in zip(*tables, strict=True))


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


def test_surfaces_without_sides_and_two_scenes_are_refused(springblock, batch, outputs, tmp_path):
    flat, pillars = batch(0, 0), batch(0, 2, "--n-p", 6, "--n-s", 6)
    refusal = springblock("correlation", flat, *outputs, refused=True)
    assert ": no whole sides of 6 blocks or more" in refusal
    assert "several scenes: " in springblock("correlation", pillars, flat, *outputs, refused=True)
    assert list(tmp_path.iterdir()) == []
