"""Where two tables of realisations or correlations differ, row by row."""

from typing import NamedTuple

import numpy as np
import pyarrow as pa

from springblock.scene import COLUMNS

_KEYS = [*COLUMNS, "seed", "side", "r"]  #: what tells rows apart, where a table has it


class Difference(NamedTuple):
    """How a column of two tables differs, over the rows that both have."""

    column: str
    rows: int  #: in which it differs, NaN being equal to NaN
    largest: float  #: modulus of the difference; NaN where it is not a number
    relative: float  #: largest modulus over the modulus of the first; NaN as well


class Comparison(NamedTuple):
    """How two tables differ."""

    both: int  #: rows that both have
    first: int  #: rows that only the first has
    second: int
    differences: list[Difference]  #: of columns that are not the same to the bit

    @property
    def same(self) -> bool:
        """Whether both hold the same, to the bit."""
        return not (self.first or self.second or self.differences)


def compare(first: pa.Table, second: pa.Table) -> Comparison:
    """Compare rows of the same scene, seed, side and distance; without such columns, by place.

    Raises
    ------
    ValueError
        Where the columns are not the same.
    """
    if first.column_names != second.column_names:
        odd = sorted({*first.column_names} ^ {*second.column_names})
        raise ValueError(f"they hold other columns: {', '.join(odd) or 'in another order'}")
    places = [_places(table) for table in (first, second)]
    common = [key for key in places[0] if key in places[1]]
    rows = zip((first, second), places, strict=True)
    ours, theirs = (table.take([place[key] for key in common]) for table, place in rows)
    differences = [_difference(name, ours[name], theirs[name]) for name in first.column_names]
    return Comparison(
        len(common),
        first.num_rows - len(common),
        second.num_rows - len(common),
        [difference for difference in differences if difference.rows],
    )


def _places(table: pa.Table) -> dict[tuple[object, ...], int]:
    """Row of each key."""
    keys = [name for name in _KEYS if name in table.column_names]
    if not keys:
        return {(i,): i for i in range(table.num_rows)}
    rows = zip(*(table[name].to_pylist() for name in keys), strict=True)
    return {key: i for i, key in enumerate(rows)}


def _difference(name: str, first: pa.ChunkedArray, second: pa.ChunkedArray) -> Difference:
    rows, largest, relative = 0, 0.0, 0.0
    for one, other in zip(first, second, strict=True):
        a, b = (np.atleast_1d(np.asarray(_values(value))) for value in (one, other))
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


def _values(value: pa.Scalar) -> object:
    is_list = isinstance(value, pa.ListScalar)
    return value.values.to_numpy(zero_copy_only=False) if is_list else value.as_py()
