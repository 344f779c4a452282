"""Where two tables of realisations or correlations differ: row by row, or in their means."""

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np
import pyarrow as pa

from springblock.io.rows import Row
from springblock.model.scene import COLUMNS

_KEYS = [*COLUMNS, "seed", "side", "r"]  #: what tells rows apart, where a table has it
_OBSERVABLES = ("static_friction", "dynamic_friction", "t_max", "t_avg", "t_first")
Key = tuple[tuple[str, object], ...]  #: names and values that tell rows apart
_LEVEL = 0.95  #: of all intervals of a table together


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
    places, others = _places(first), _places(second)
    common = [key for key in places if key in others]
    ours = first.take(pa.array([places[key] for key in common], pa.int64()))
    theirs = second.take(pa.array([others[key] for key in common], pa.int64()))
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


class Discrepancy(NamedTuple):
    """A value that two studies have found, and how often chance alone would set it so far apart."""

    name: str
    first: float
    second: float
    p_value: float  #: probability that two studies of one truth differ as much, or more

    def __str__(self) -> str:
        return f"{self.name}: {self.first:.5g} and {self.second:.5g}, p = {self.p_value:.1e}"


def discrepancies(first: pa.Table, second: pa.Table) -> list[Discrepancy]:
    """Values of the same scene in two tables whose difference has an interval.

    Means of realisations are compared by Welch's test (1947, doi:10.1093/biomet/34.1-2.28),
    values that have limits of 95 % by these, as if they were normal. Studies of the same seeds
    scatter less than the tests allow for.
    """
    columns = {*first.column_names} & {*second.column_names}
    if {"seed", *_OBSERVABLES} <= columns:
        return list(_means(first, second))
    value = next((name for name in ("correlation", "l_c") if name in columns), None)
    return list(_with_limits(first, second, value)) if value else []


def significant(found: list[Discrepancy]) -> list[Discrepancy]:
    """Those that differ by more than 95 % intervals of all of them together allow (Bonferroni)."""
    return [each for each in found if each.p_value < (1.0 - _LEVEL) / len(found)]


def _means(first: pa.Table, second: pa.Table) -> Iterator[Discrepancy]:
    from scipy.stats import ttest_ind  # slow to load

    ours, theirs = (_by_key(table, COLUMNS) for table in (first, second))
    for scene in [scene for scene in ours if scene in theirs]:
        for name in _OBSERVABLES:
            values = (np.array([row[name] for row in rows[scene]]) for rows in (ours, theirs))
            one, other = (sample[np.isfinite(sample)] for sample in values)
            if min(len(one), len(other)) > 1 and np.ptp([*one, *other]) > 0.0:
                p_value = ttest_ind(one, other, equal_var=False).pvalue
                what = f"{name} of {_in_words(scene)}"
                yield Discrepancy(what, one.mean(), other.mean(), float(p_value))


def _by_key(table: pa.Table, keys: Iterable[str]) -> dict[Key, list[Row]]:
    """Rows that hold the same values of these columns."""
    found: dict[Key, list[Row]] = {}
    for row in table.to_pylist():
        found.setdefault(tuple((name, row[name]) for name in keys), []).append(row)
    return found


def _with_limits(first: pa.Table, second: pa.Table, value: str) -> Iterator[Discrepancy]:
    from scipy.special import ndtr, ndtri

    keys = [name for name in _KEYS if name in first.column_names]
    ours, theirs = (_by_key(table, keys) for table in (first, second))
    for key in [key for key in ours if key in theirs]:
        one, other = ours[key][0], theirs[key][0]
        difference = one[value] - other[value]
        halves = [0.5 * (row["ci_high"] - row["ci_low"]) for row in (one, other)]
        error = np.hypot(*halves) / ndtri(0.5 + 0.5 * _LEVEL)
        if difference and np.isfinite(error) and error > 0.0:
            p_value = 2.0 * ndtr(-abs(difference) / error)
            yield Discrepancy(f"{value} of {_in_words(key)}", one[value], other[value], p_value)


def _in_words(key: Key) -> str:
    return ", ".join(f"{name} = {value}" for name, value in key if value not in (0, "", "free"))
