"""Differences between two tables, row by row and to the bit."""

from typing import NamedTuple

import numpy as np
import pyarrow as pa

from springblock.model.scene import COLUMNS

#: CPU times, which no second study repeats.
_MEASURED = "cpu_seconds", "prelude_seconds"
_KEYS = [*COLUMNS, "seed", "side", "r"]  #: columns that identify a row


class Difference(NamedTuple):
    """Difference of a column in the rows that two tables have in common."""

    column: str
    rows: int  #: number of rows in which it differs; NaN equals NaN
    largest: float  #: largest absolute difference; NaN if the values are not numbers
    relative: float  #: largest difference relative to the first value; likewise


class Comparison(NamedTuple):
    """Differences of two tables."""

    both: int  #: number of rows in both tables
    first: int  #: number of rows in the first table only
    second: int
    differences: list[Difference]  #: columns that are not equal to the bit

    @property
    def same(self) -> bool:
        """Whether both tables are equal to the bit."""
        return not (self.first or self.second or self.differences)


def compare(first: pa.Table, second: pa.Table) -> Comparison:
    """Compare rows of the same scene, seed, side and distance; without such columns, by position.

    CPU times are left out.

    Raises
    ------
    ValueError
        If the columns are not the same.
    """
    if first.column_names != second.column_names:
        odd = sorted({*first.column_names} ^ {*second.column_names})
        raise ValueError(f"the tables differ in their columns: {', '.join(odd) or 'the order'}")
    places, others = _places(first), _places(second)
    common = [key for key in places if key in others]
    ours = first.take(pa.array([places[key] for key in common], pa.int64()))
    theirs = second.take(pa.array([others[key] for key in common], pa.int64()))
    names = [name for name in first.column_names if name not in _MEASURED]
    differences = [_difference(name, ours[name], theirs[name]) for name in names]
    return Comparison(
        len(common),
        first.num_rows - len(common),
        second.num_rows - len(common),
        [difference for difference in differences if difference.rows],
    )


def _places(table: pa.Table) -> dict[tuple[object, ...], int]:
    """Row number of each key."""
    keys = [name for name in _KEYS if name in table.column_names]
    if not keys:
        return {(i,): i for i in range(table.num_rows)}
    rows = zip(*(table[name].to_pylist() for name in keys), strict=True)
    return {key: i for i, key in enumerate(rows)}


def _difference(name: str, first: pa.ChunkedArray, second: pa.ChunkedArray) -> Difference:
    rows, largest, relative = 0, 0.0, 0.0
    for a, b in zip(_arrays(first), _arrays(second), strict=True):
        if a.shape == b.shape and np.array_equal(a, b, equal_nan=a.dtype.kind == "f"):
            continue
        rows += 1
        if a.shape != b.shape or a.dtype.kind not in "fiu":
            largest = relative = np.nan
            continue
        apart = np.abs(a.astype(float) - b.astype(float))
        largest = max(largest, float(np.nanmax(apart, initial=0.0)))
        with np.errstate(divide="ignore", invalid="ignore"):
            relative = max(relative, float(np.nanmax(apart / np.abs(a), initial=0.0)))
    return Difference(name, rows, largest, relative)


def _arrays(column: pa.ChunkedArray) -> list[np.ndarray]:
    return [np.atleast_1d(value) for value in column.to_numpy()]
