"""Parquet files are written whole or not at all, and hold the given values."""

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
