"""Differences between two tables, row by row."""

import pyarrow as pa
import pytest

from springblock.analysis.comparison import differences


def test_rows_are_compared_by_what_they_describe_and_not_by_their_place():
    """Of three rows each, two have the same seed; one value of theirs is off by 0.5 in 2."""
    one = pa.table({"seed": [1, 2, 3], "t_max": [1.0, 2.0, 3.0]})
    other = pa.table({"seed": [4, 2, 1], "t_max": [9.0, 2.5, 1.0]})
    assert differences(one, other) == [
        "2 rows in both, 1 only in the first, 1 only in the second",
        "  t_max: 1 row differs, by 0.5 at most, or 0.25 of the first",
    ]
    assert "t_max: 3 rows differ" in differences(one.select(["t_max"]), other.select(["t_max"]))[1]
    with pytest.raises(ValueError, match="differ in their columns: seed"):
        differences(one, other.select(["t_max"]))
    assert not differences(one, one.take([2, 0, 1]))
    assert differences(one, one.slice(1)) == ["2 rows in both, 1 only in the first"]
    assert differences(one.slice(1), one) == ["2 rows in both, 1 only in the second"]


def test_rows_that_describe_the_same_are_compared_in_their_order():
    """Those of `work_precision` differ in other columns than scene and seed."""
    one = pa.table({"n_blocks": [8, 8, 9], "quantity": ["t_max", "t_avg", "t_max"]})
    assert not differences(one, one)
    assert not differences(one, one.take([2, 0, 1]))
    [_, apart] = differences(one, one.take([1, 0, 2]))
    assert "quantity: 2 rows differ" in apart
    assert differences(one, one.slice(0, 1)) == ["1 row in both, 2 only in the first"]


def test_curves_of_other_lengths_are_differences():
    one, other = (pa.table({"seed": [1], "force": [[0.0, 1.0][:n]]}) for n in (2, 1))
    [_, apart] = differences(one, other)
    assert "force: 1 row differs" in apart


def test_cpu_times_make_no_difference():
    """No study repeats them."""
    one, other = (
        pa.table({"error": [0.1], "cpu_seconds": [time], "prelude_seconds": [2.0 * time]})
        for time in (1.0, 1.1)
    )
    assert not differences(one, other)
