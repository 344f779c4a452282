"""Statistics of several ensembles, and their intervals."""

import numpy as np
import pytest

from beyond.made_up import ensemble
from springblock.analysis.correlation import side_times
from springblock.analysis.statistics import Interval
from springblock.beyond.question import number, power
from springblock.beyond.resampling import SideLength, difference, interval, lowest, means
from springblock.model.scene import Scene


def test_the_lowest_point_of_a_parabola_lies_between_the_places():
    places = np.array([1.0, 3.0, 10.0, 60.0])
    best = np.array([2.0, 4.0, 20.0])
    heights = (np.log(places) - np.log(best)[:, None]) ** 2
    np.testing.assert_allclose(lowest(places, heights), best)


def test_a_curve_that_only_falls_is_lowest_at_its_end():
    places = np.array([1.0, 2.0, 4.0])
    np.testing.assert_allclose(lowest(places, -places), 4.0)
    np.testing.assert_allclose(lowest(places, places), 1.0)


def test_intervals_cover_as_often_as_they_say():
    """95 of 100, within three standard errors of a count, and wider ones for fewer runs."""
    rng = np.random.default_rng(1)
    hits, trials, true = 0, 200, 0.5
    for _ in range(trials):
        samples = rng.normal(1.5, 1.0, 20), rng.normal(1.0, 0.5, 30)
        found = difference(*samples)
        hits += bool(found.low <= true <= found.high)
    assert 0.95 - 3.0 * np.sqrt(0.95 * 0.05 / trials) - 0.02 < hits / trials < 0.995


def test_two_runs_have_no_interval():
    found = interval([np.arange(2.0)], lambda sample, axis: sample.mean(axis=axis))
    assert found.mean == 0.5
    assert np.isnan(found.low)
    assert number(found) == "0.5 [no interval]"


def test_every_ensemble_is_resampled_by_itself():
    """The interval of a sum is that of its only varying part."""
    samples = np.zeros(5), np.random.default_rng(0).standard_normal(20)

    def total(*drawn, axis):
        return means(drawn, axis).sum(axis=-1)

    both = interval(samples, total)
    alone = interval(samples[1:], total)
    assert both.high - both.low == pytest.approx(alone.high - alone.low, rel=0.15)


@pytest.mark.parametrize("length", [2.0, 5.0])
def test_a_correlation_length_is_found_again(length):
    scene = Scene(80, 20, 20)
    fit = SideLength(side_times(ensemble(scene, length=length, runs=40), scene.pattern, "x"), 6)
    found = fit.interval
    assert found.low < length < found.high
    assert found.high - found.low < length


def test_numbers_are_written_to_what_the_interval_leaves():
    assert number(Interval(*map(np.array, (0.12345, 0.1, 0.2)))) == "0.12 [0.10, 0.20]"
    assert number(Interval(*map(np.array, (123.4, 110.0, 150.0))), " µm") == "123 [110, 150] µm"


@pytest.mark.parametrize(
    ("limits", "meaning"),
    [
        ((-0.2, 0.2), "unchanged"),
        ((0.8, 1.2), "proportional"),
        ((0.2, 0.8), "in part"),
        ((-0.5, 1.5), "unchanged or proportional, which is not settled"),
        ((-0.8, -0.2), "the other way"),
        ((1.1, 1.4), "by another power"),
        ((0.5, 1.0), "proportional"),
    ],
)
def test_an_exponent_means_what_its_interval_holds(limits, meaning):
    low, high = map(np.array, limits)
    assert power(Interval((low + high) / 2.0, low, high)) == meaning
