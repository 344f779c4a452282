"""Differences between two tables, row by row and to the bit."""

from collections import Counter

import numpy as np
import pyarrow as pa

from springblock.io.schemas import SCENE

#: CPU times, which no second study repeats.
_MEASURED = "cpu_seconds", "prelude_seconds"
_KEYS = [*SCENE.names, "seed", "side", "r"]  #: columns by which rows are matched


def differences(first: pa.Table, second: pa.Table) -> list[str]:
    """Describe the differences of two tables, a line each; nothing if they are equal to the bit.

    Rows of the same scene, seed, side and distance are compared; where several share these, or in
    tables without them, in their order. CPU times are left out. Unequal columns are a ValueError.
    """
    if first.column_names != second.column_names:
        odd = sorted({*first.column_names} ^ {*second.column_names})
        raise ValueError(f"the tables differ in their columns: {', '.join(odd) or 'the order'}")
    places, others = _places(first), _places(second)
    common = [key for key in places if key in others]
    ours = first.take(pa.array([places[key] for key in common], pa.int64()))
    theirs = second.take(pa.array([others[key] for key in common], pa.int64()))
    rows = "1 row in both" if len(common) == 1 else f"{len(common) or 'no'} rows in both"
    for table, where in ((first, "first"), (second, "second")):
        if more := table.num_rows - len(common):
            rows += f", {more} only in the {where}"
    names = [name for name in first.column_names if name not in _MEASURED]
    found = [line for name in names if (line := _difference(name, ours[name], theirs[name]))]
    return [rows, *found] if found or first.num_rows + second.num_rows > 2 * len(common) else []


def _places(table: pa.Table) -> dict[tuple[str, int], int]:
    """Row number of each key: values of `_KEYS`, and how many rows before have the same."""
    rows = table.select([name for name in _KEYS if name in table.column_names]).to_pylist()
    places, before = {}, Counter[str]()
    for i, key in enumerate(map(str, rows)):
        places[key, before[key]] = i
        before[key] += 1
    return places


def _difference(name: str, first: pa.ChunkedArray, second: pa.ChunkedArray) -> str:
    """Describe the difference of a column in the rows that both tables have; "" without one."""
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
    how_many = "1 row differs" if rows == 1 else f"{rows} rows differ"
    size = f"by {largest:.3g} at most, or {relative:.3g} of the first"
    return f"  {name}: {how_many}, {size}" if rows else ""


def _arrays(column: pa.ChunkedArray) -> list[np.ndarray]:
    return [np.atleast_1d(value) for value in column.to_numpy()]
