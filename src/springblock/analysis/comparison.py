"""Differences between two tables of realisations or correlations, by row or in their means."""

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np
import pyarrow as pa

from springblock.analysis.ensembles import OBSERVABLES
from springblock.io.rows import Row
from springblock.model.scene import COLUMNS

_KEYS = [*COLUMNS, "seed", "side", "r"]  #: columns that identify a row
Key = tuple[tuple[str, object], ...]  #: names and values that identify a row
_LEVEL = 0.95  #: joint confidence level of all comparisons of a table


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
    differences = [_difference(name, ours[name], theirs[name]) for name in first.column_names]
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
    """A value in two studies, and the probability that chance alone makes them differ as much."""

    name: str
    first: float
    second: float
    p_value: float  #: probability of a difference at least as large, if the true values agree

    def __str__(self) -> str:
        return f"{self.name}: {self.first:.5g} and {self.second:.5g}, p = {self.p_value:.1e}"


def discrepancies(first: pa.Table, second: pa.Table) -> list[Discrepancy]:
    """Return the values of each scene in two tables, with the p-value of their difference.

    Means of realisations are compared by Welch's test (1947, doi:10.1093/biomet/34.1-2.28), values
    with 95 % limits by these, as if they were normally distributed. Studies of the same seeds
    differ less than the tests assume.
    """
    columns = {*first.column_names} & {*second.column_names}
    if {"seed", *OBSERVABLES} <= columns:
        return list(_means(first, second))
    value = next((name for name in ("correlation", "l_c") if name in columns), None)
    return list(_with_limits(first, second, value)) if value else []


def significant(found: list[Discrepancy]) -> list[Discrepancy]:
    """Return the significant differences, at a joint level of 95 % (Bonferroni)."""
    return [each for each in found if each.p_value < (1.0 - _LEVEL) / len(found)]


def _means(first: pa.Table, second: pa.Table) -> Iterator[Discrepancy]:
    from scipy.stats import ttest_ind  # slow to load

    ours, theirs = (_by_key(table, COLUMNS) for table in (first, second))
    for scene in [scene for scene in ours if scene in theirs]:
        for name in OBSERVABLES:
            values = (np.array([row[name] for row in rows[scene]]) for rows in (ours, theirs))
            one, other = (sample[np.isfinite(sample)] for sample in values)
            if min(len(one), len(other)) > 1 and np.ptp([*one, *other]) > 0.0:
                p_value = ttest_ind(one, other, equal_var=False).pvalue
                what = f"{name} of {_in_words(scene)}"
                yield Discrepancy(what, one.mean(), other.mean(), float(p_value))


def _by_key(table: pa.Table, keys: Iterable[str]) -> dict[Key, list[Row]]:
    """Group rows by the values of these columns."""
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
