"""Parquet files are written whole or not at all, and hold the given values."""

import pyarrow as pa
import pytest

from springblock.files import whole_file
from springblock.io.parquet import rows_to_table, write
from springblock.io.schemas import BATCH


def test_a_file_that_is_not_written_whole_leaves_the_one_before(tmp_path):
    file = tmp_path / "a.parquet"
    file.write_text("before")

    def interrupted():
        with whole_file(file) as partial:
            partial.write_text("half")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    with pytest.raises(ValueError, match="nothing was written"):
        write(rows_to_table([], BATCH), file, {})
    assert [each.read_text() for each in tmp_path.iterdir()] == ["before"]


def test_more_numbers_than_a_column_of_lists_can_place_are_refused():
    """Their offsets have 32 bits, and would wrap."""
    with pytest.raises(ValueError, match="a column holds no 2147483648 numbers; give fewer runs"):
        rows_to_table([{"force": range(2**31)}], pa.schema([BATCH.field("force")]))
