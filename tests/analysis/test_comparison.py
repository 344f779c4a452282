"""Differences between two tables, row by row."""

import pyarrow as pa
import pytest

from springblock.analysis.comparison import Difference, compare


def test_rows_are_compared_by_what_they_describe_and_not_by_their_place():
    """Of three rows each, two have the same seed; one value of theirs is off by 0.5 in 2."""
    one = pa.table({"seed": [1, 2, 3], "t_max": [1.0, 2.0, 3.0]})
    other = pa.table({"seed": [4, 2, 1], "t_max": [9.0, 2.5, 1.0]})
    found = compare(one, other)
    assert (found.both, found.first, found.second, found.same) == (2, 1, 1, False)
    assert found.differences == [Difference("t_max", rows=1, largest=0.5, relative=0.25)]
    assert compare(one.select(["t_max"]), other.select(["t_max"])).differences[0].rows == 3
    with pytest.raises(ValueError, match="differ in their columns: seed"):
        compare(one, other.select(["t_max"]))
    assert compare(one, one.take([2, 0, 1])).same
    assert not compare(one, one.slice(1)).same


def test_cpu_times_make_no_difference():
    """No study repeats them."""
    one, other = (
        pa.table({"error": [0.1], "cpu_seconds": [time], "prelude_seconds": [2.0 * time]})
        for time in (1.0, 1.1)
    )
    assert compare(one, other).same
