"""Parquet files are written whole or not at all, and hold the given values."""

import numpy as np
import pyarrow as pa
import pytest

from springblock.files import whole_file
from springblock.io.parquet import rows_to_table, write
from springblock.io.schemas import BATCH


def test_an_interrupted_file_leaves_nothing_behind(tmp_path):
    def interrupted():
        with whole_file(tmp_path / "a.parquet") as partial:
            partial.write_text("half")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert list(tmp_path.iterdir()) == []


def test_an_interrupted_file_does_not_harm_the_one_before(tmp_path):
    file = tmp_path / "a.parquet"
    file.write_text("before")
    with pytest.raises(ValueError, match="nothing was written"):
        write(rows_to_table([], BATCH), file, {})
    assert file.read_text() == "before"


def test_columns_equal_those_that_arrow_makes():
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
