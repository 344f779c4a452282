"""Statistics of several ensembles, and their intervals."""

import numpy as np
import pytest

from springblock.analysis.statistics import Interval
from springblock.beyond.question import UNCHANGED, direction, number
from springblock.beyond.resampling import interval


def test_intervals_cover_as_often_as_they_say():
    """95 of 100, within three standard errors of a count, and wider ones for fewer runs."""
    rng = np.random.default_rng(1)
    hits, trials, true = 0, 200, 0.5
    for _ in range(trials):
        samples = rng.normal(1.5, 1.0, 20), rng.normal(1.0, 0.5, 30)
        found = interval(samples, lambda one, other, axis: one.mean(axis) - other.mean(axis))
        hits += bool(found.low <= true <= found.high)
    assert 0.95 - 3.0 * np.sqrt(0.95 * 0.05 / trials) - 0.02 < hits / trials < 0.995


def test_two_runs_have_no_interval():
    found = interval([np.arange(2.0)], np.mean)
    assert found.mean == 0.5
    assert np.isnan(found.low)
    assert number(found) == "0.5 [no interval]"


def test_every_ensemble_is_resampled_by_itself():
    """The interval of a sum is that of its only varying part."""
    samples = np.zeros(5), np.random.default_rng(0).standard_normal(20)
    both = interval(samples, lambda one, other, axis: one.mean(axis) + other.mean(axis))
    alone = interval(samples[1:], np.mean)
    assert both.high - both.low == pytest.approx(alone.high - alone.low, rel=0.15)


def test_numbers_are_written_to_what_the_interval_leaves():
    assert number(Interval(*map(np.array, (0.12345, 0.1, 0.2)))) == "0.12 [0.10, 0.20]"
    assert number(Interval(*map(np.array, (123.4, 110.0, 150.0))), " µm") == "123 [110, 150] µm"
    assert number(Interval(*map(np.array, (0.5, 0.5, 0.5))), " µm") == "0.5 µm"


@pytest.mark.parametrize(
    ("last", "meaning"),
    [
        ((0.2, 1.2), "decreases"),
        ((1.8, 2.8), "increases"),
        ((0.5, 1.1), "decreases"),
        ((1.0, 1.6), UNCHANGED),
    ],
)
def test_values_change_where_the_interval_of_their_difference_excludes_zero(last, meaning):
    """Where intervals overlap slightly, that of the difference excludes zero nevertheless."""
    low, high = map(np.array, last)
    first = Interval(*map(np.array, (1.5, 1.0, 2.0)))
    assert direction(first, Interval((low + high) / 2.0, low, high)) == meaning
