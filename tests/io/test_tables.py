"""Parquet files: whole or not at all, and true to what was put in."""

import numpy as np
import pyarrow as pa
import pytest

from springblock import draw_friction, simulate
from springblock.cli.simulate import batch_row
from springblock.files import whole_file
from springblock.io.parquet import read, rows_to_table, write
from springblock.io.records import read_records
from springblock.io.schemas import BATCH, SUMMARY
from springblock.model.scene import Scene
from springblock.simulation.setup import Setup

SCENE = Scene(n_blocks=6, n_p=2, n_s=1)


@pytest.fixture(scope="module")
def run():
    return simulate(SCENE.pattern.contact, *draw_friction(6, 3), duration=2e-6)


def test_a_stored_realisation_reads_back_to_the_bit(run, tmp_path):
    file = tmp_path / "a.parquet"
    write(rows_to_table([batch_row(SCENE, Setup(), 3, run)], BATCH), file, {})
    (record,) = read_records([file])
    assert (record.scene, record.seed) == (SCENE, 3)
    for name in ("force", "detachments", "switches", "t_det"):
        assert (
            getattr(record, name).tobytes()
            == getattr(run, name).astype(getattr(record, name).dtype).tobytes()
        )
    assert record.time == pytest.approx(run.time, rel=1e-15)
    assert (record.t_max, record.static_friction) == (run.t_max, run.static_friction)


def test_an_interrupted_file_leaves_nothing_behind(tmp_path):
    def interrupted():
        with whole_file(tmp_path / "a.parquet") as partial:
            partial.write_text("half")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert list(tmp_path.iterdir()) == []


def test_an_interrupted_file_does_not_harm_the_one_before(run, tmp_path):
    file = tmp_path / "a.parquet"
    file.write_text("before")
    with pytest.raises(ValueError, match="nothing to write"):
        write(rows_to_table([], BATCH), file, {})
    assert file.read_text() == "before"


def test_a_file_without_a_column_is_named(tmp_path):
    file = tmp_path / "a.parquet"
    write(pa.table({"level": [1]}), file, {})
    with pytest.raises(ValueError, match=r"a.parquet lacks the column 'n_p'"):
        read([file], SUMMARY)


def test_same_seed_same_bytes(tmp_path):
    contents = []
    for name in ("a", "b"):
        run = simulate(SCENE.pattern.contact, *draw_friction(6, 3), duration=2e-6)
        write(rows_to_table([batch_row(SCENE, Setup(), 3, run)], BATCH), tmp_path / name, {})
        contents.append((tmp_path / name).read_bytes())
    assert contents[0] == contents[1]


def test_columns_are_those_that_arrow_itself_would_make():
    kinds = {"text": pa.string(), "flag": pa.bool_(), "count": pa.int8(), "length": pa.float64()}
    kinds |= {f"{name}s": pa.list_(kind) for name, kind in kinds.items() if name != "text"}
    rows = [
        {"text": "", "flag": True, "count": -1, "length": np.nan, "flags": [True, False] * 9},
        {"text": "ü, €", "flag": False, "count": 7, "length": 2, "flags": []},
    ]
    for row, (counts, lengths) in zip(rows, [([], [0.5]), (range(3), [])], strict=True):
        row |= {"counts": np.array(counts, dtype=np.int8), "lengths": np.array(lengths)}
    schema = pa.schema(kinds)
    ours, theirs = rows_to_table(rows, schema), pa.Table.from_pylist(rows, schema)
    ours.validate(full=True)
    assert ours.drop("length").equals(theirs.drop("length"))
    assert np.array_equal(ours["length"], theirs["length"], equal_nan=True)
    assert rows_to_table([], schema).equals(pa.Table.from_pylist([], schema))
