"""Significance of the differences between two studies."""

import numpy as np
import pyarrow as pa
import pytest
from scipy.special import ndtr

from springblock.analysis.comparison import Difference, compare, discrepancies, significant
from springblock.model.scene import Scene

OBSERVABLES = ("static_friction", "dynamic_friction", "t_max", "t_avg", "t_first")
SCENES = [Scene(12, 6, 6), Scene(12, 6, 6, direction="y")]


def realisations(rng, shift=0.0, k=10):
    """A table of made-up realisations; the static friction of pillars may be shifted."""
    rows = []
    for scene in SCENES:
        for seed in range(k):
            row = dict(zip(OBSERVABLES, rng.normal(1.0, 0.1, 5), strict=True))
            row["static_friction"] += shift * (scene.direction == "y")
            rows.append({**scene.row, "seed": seed, **row})
    return pa.Table.from_pylist(rows)


def test_studies_with_equal_true_values_seldom_differ_significantly(rng):
    """In 2 of 40 pairs at most, and four standard errors of that number."""
    pairs = [discrepancies(realisations(rng), realisations(rng)) for _ in range(40)]
    assert {len(found) for found in pairs} == {10}
    assert discrepancies(realisations(rng, k=1), realisations(rng)) == []  # it has no scatter
    assert sum(bool(significant(found)) for found in pairs) <= 2 + 4 * np.sqrt(2 * 0.95)


def test_a_mean_that_is_eight_errors_off_is_named(rng):
    error = 0.1 * np.sqrt(2 / 10)
    found = significant(discrepancies(realisations(rng), realisations(rng, shift=8 * error)))
    assert [str(each).partition(":")[0] for each in found] == [
        "static_friction of n_blocks = 12, level = 1, n_p = 6, n_s = 6, direction = y, n_rows = 12"
    ]


@pytest.mark.parametrize(("difference", "errors"), [(0.1, 0.5), (1.0, 5.0)])
def test_lengths_are_compared_by_their_limits(difference, errors):
    """Half widths of 0.28 and 0.28 are errors of 0.2 together."""
    half = 1.959964 * 0.2 / np.sqrt(2.0)
    tables = [
        pa.table({"side": ["x"], "l_c": [l_c], "ci_low": [l_c - half], "ci_high": [l_c + half]})
        for l_c in (3.0, 3.0 + difference)
    ]
    (found,) = discrepancies(*tables)
    assert found.p_value == pytest.approx(2.0 * ndtr(-errors), rel=1e-5)
    assert bool(significant([found])) == (errors > 2.0)
    assert discrepancies(tables[0], tables[0]) == []


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
