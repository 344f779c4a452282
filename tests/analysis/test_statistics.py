"""Statistics of ensembles against samples and curves with known results."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.stats import bootstrap, t, ttest_ind

from springblock import Pattern
from springblock.analysis.statistics import (
    Interval,
    bootstrap_interval,
    bootstrap_weights,
    cut,
    difference_interval,
    events,
    interval_of_means,
    mean_interval,
    mean_of_rest,
    number,
    pillar_map,
    pillar_ring,
    prominence_of_mean,
    standard_error,
    whole_curve,
)
from springblock.simulation.peaks import prominence
from springblock.simulation.run import friction


def run(samples=21, normal_force=2.0):
    """A run of four blocks that detach one after another, one per sample."""
    detachments = np.zeros(samples, int)
    detachments[1:5] = 1
    return SimpleNamespace(
        time=0.5 * np.arange(samples),
        force=np.arange(samples, dtype=float),
        normal_force=normal_force,
        detachments=detachments,
        t_det=np.array([[0.5, 1.0], [1.5, 2.0]]),
    )


def test_intervals_are_as_wide_as_students_t(rng):
    sample = rng.normal(3.0, 2.0, 100)
    half = t.ppf(0.975, 99) * sample.std(ddof=1) / 10.0
    mean = sample.mean()
    assert tuple(mean_interval(sample)) == pytest.approx((mean, mean - half, mean + half))
    mean, low, high = mean_interval([[1.0, 2.0]])  # a single realisation
    np.testing.assert_array_equal(mean, [1.0, 2.0])
    assert np.isnan([low, high]).all()
    assert standard_error(np.ones((1, 2))).tolist() == [np.inf, np.inf]
    assert standard_error(np.array([1.0, 3.0])) == pytest.approx(1.0)


def test_the_interval_is_scipys_bca(rng):
    """From the same random numbers, for one sample and for several."""
    samples = rng.exponential(size=12), rng.normal(3.0, 1.0, 30)
    options = {"random_state": np.random.default_rng(0), "n_resamples": 2000, "method": "BCa"}
    found = bootstrap(
        samples, lambda one, two, axis: one.mean(axis) / two.mean(axis), **options
    ).confidence_interval
    assert interval_of_means(np.divide, samples)[1:] == pytest.approx(tuple(found), rel=1e-12)


def test_surfaces_are_compared_as_independent_samples(rng):
    first, second = rng.normal(3.0, 1.0, 220), rng.normal(1.0, 0.1, 20)
    found = difference_interval(first, second)
    low, high = ttest_ind(first, second, equal_var=False).confidence_interval()
    assert tuple(found) == pytest.approx((first.mean() - second.mean(), low, high))
    assert tuple(difference_interval([2.0, 2.0], [1.0, 1.0])) == (1.0, 1.0, 1.0)
    assert np.isnan(difference_interval([1.0, 2.0], [1.0]).low)


def test_curves_are_cut_to_the_shortest_run_or_end_with_the_longest():
    """A run that has ended has no force, and no block is left that could detach."""
    runs = [run(21), run(12, normal_force=4.0)]
    both = np.arange(12) / np.array([[2.0], [4.0]])
    time, forces = cut(runs, [friction(each) for each in runs])
    np.testing.assert_array_equal(time, 0.5 * np.arange(12))
    np.testing.assert_allclose(forces, both)
    curve = whole_curve(runs)
    np.testing.assert_array_equal(curve.time, runs[0].time)
    np.testing.assert_allclose(curve.friction[:, :12], both)
    assert np.isfinite(curve.friction[0]).all()
    assert np.isnan(curve.friction[1, 12:]).all()
    assert curve.detachments.sum(axis=1).tolist() == [100.0, 100.0]
    runs[1].time = 2.0 * runs[1].time
    with pytest.raises(ValueError, match="must have the same sample interval"):
        cut(runs, [friction(each) for each in runs])
    assert not curve.detachments[1, 12:].any()


def test_a_mean_is_taken_over_the_runs_that_have_not_ended(rng):
    """As long as half of them are left: three of five, and not two."""
    values = rng.normal(size=(5, 5))
    values[0, 2:] = values[1, 3:] = values[2, 4:] = np.nan
    mean, low, high = mean_of_rest(values)
    for part, whole in zip((mean, low, high), mean_interval(values[:, :2]), strict=True):
        np.testing.assert_array_equal(part[:2], whole)
    np.testing.assert_allclose(mean[2:4], [values[1:, 2].mean(), values[2:, 3].mean()])
    assert ((low < mean) & (mean < high))[:4].all()
    assert np.isnan([mean[4], low[4], high[4]]).all()
    assert np.isfinite(mean_of_rest(values[:4, 3:4])).all()  # exactly half: two of four


def test_bins_hold_whole_samples_and_every_detachment_once():
    edges, shares = whole_curve([run(12), run(12)]).binned(1.5)
    np.testing.assert_allclose(edges, [0.0, 1.5, 3.0, 4.5])  # two samples are left out
    np.testing.assert_allclose(shares, [[75.0, 25.0, 0.0]] * 2)
    edges, shares = whole_curve([run(12)]).binned(0.1)  # finer than the samples
    np.testing.assert_allclose(edges, 0.5 * np.arange(12))
    assert shares.sum() == 100.0


def test_a_pillar_is_the_mean_over_all_pillars(rng):
    """A block that never detaches is not left out of it."""
    pattern, place = Pattern.pillars(12, 4, 2), rng.random((4, 4))
    field = np.full((12, 12), np.nan)
    for i, (y, x) in enumerate(pattern.origins):
        field[y : y + 4, x : x + 4] = place + i - 1.5  # pillars differ, but for their mean
    runs = [SimpleNamespace(t_det=field, t_max=t_max) for t_max in (1.0, 2.0, 4.0)]
    times = pillar_map(runs, pattern)
    np.testing.assert_allclose(times, place / np.array([1.0, 2.0, 4.0])[:, None, None])
    field[pattern.origins[0][0], pattern.origins[0][1]] = np.nan
    assert np.isnan(pillar_map(runs, pattern)[:, 0, 0]).all()
    with pytest.raises(ValueError, match="no pillar"):
        pillar_map([], Pattern.flat(4))


@pytest.mark.parametrize("size", [1, 2, 5, 6])
def test_rings_hold_each_block_once(size):
    rings = [pillar_ring(size, depth) for depth in range((size + 1) // 2)]
    assert (sum(mask.astype(int) for ring in rings for mask in ring.values()) == 1).all()
    ring = pillar_ring(4, 0)  # sides are named after the axis that they run along
    assert np.argwhere(ring["y"]).tolist() == [[1, 0], [1, 3], [2, 0], [2, 3]]
    assert np.argwhere(ring["x"]).tolist() == [[0, 1], [0, 2], [3, 1], [3, 2]]


def test_the_prominence_of_a_mean_force_is_of_that_and_not_of_single_runs():
    """Peaks of runs at other times average out; a run that has ended counts with its last force."""

    def hill(place):
        return np.exp(-(((np.arange(200.0) - place) / 4.0) ** 2))

    forces = [hill(60 + 3 * k) + 0.95 * hill(120 - 3 * k) for k in range(9)]
    runs = [SimpleNamespace(force=f, normal_force=1.0, onset=slice(None)) for f in forces]
    found, mean = prominence_of_mean(runs), np.mean([run.force for run in runs], axis=0)
    assert float(found.mean) == pytest.approx(prominence(mean))
    assert found.low <= found.mean <= found.high
    assert found.mean < 0.95 * np.mean([prominence(run.force) for run in runs])


def test_the_bootstrap_takes_any_statistic_of_weights(rng):
    numerator, twice = rng.normal(3.0, 1.0, 50), np.full(50, 2.0)

    def ratio_to(denominator):
        return bootstrap_interval(lambda w: (w @ numerator) / (w @ denominator), 50)

    mean = bootstrap_interval(lambda w: w @ numerator, 50)
    assert tuple(ratio_to(twice)) == pytest.approx(tuple(part / 2.0 for part in mean))
    assert tuple(mean) == pytest.approx(tuple(mean_interval(numerator)), rel=0.02)
    assert tuple(ratio_to(4.0 * numerator)) == pytest.approx((0.25,) * 3)
    both = bootstrap_interval(lambda w: np.stack([w @ numerator, w @ twice], axis=1), 50)
    np.testing.assert_allclose(np.transpose(both)[0], mean)
    assert np.isnan(bootstrap_interval(lambda w: w @ [2.0, 3.0], 2).low)
    assert (bootstrap_weights(3).max(axis=1) < 1.0).all()  # one realisation has no variance


def test_rounding_does_not_move_the_limits_of_four_realisations(rng):
    """179 resamples hold each realisation once; BCa counts those that equal the sample."""
    values = rng.exponential(size=4)

    def rounded(weights):
        return (weights @ values) * np.resize([1.0, 1.0 - 1e-15, 1.0 + 1e-15], len(weights))

    exact = bootstrap_interval(lambda weights: weights @ values, 4)
    np.testing.assert_allclose(bootstrap_interval(rounded, 4), exact, rtol=1e-12)


def test_limits_are_percentiles_if_no_single_realisation_matters():
    """The median of equal numbers, but for a few: leaving out one changes nothing."""
    values = np.repeat([1.0, 5.0], [14, 6])

    def median(weights):
        ranked = np.cumsum(weights, axis=1)
        return values[np.argmax(ranked >= 0.5, axis=1)]

    resampled = median(bootstrap_weights(20))
    assert resampled.max() == 5.0
    expected = np.percentile(resampled, (2.5, 97.5))
    assert tuple(bootstrap_interval(median, 20)) == (1.0, *expected)


def test_an_event_ends_where_neighbours_detach_apart():
    times = np.array([[0.500, 0.504, 0.508, 0.600, 0.602], [0.5, 0.6, 0.7, 0.8, 0.9]])
    assert events(times).tolist() == events(times[:, ::-1]).tolist() == [2, 5]


def test_numbers_are_written_to_what_the_interval_leaves():
    assert number(Interval(0.12345, 0.1, 0.2)) == "0.12 [0.10, 0.20]"
    assert number(Interval(123.4, 110.0, 150.0), " µm") == "123 [110, 150] µm"
    assert number(Interval(-0.064, -0.13, 0.002)) == "-0.064 [-0.130, 0.002]"
    assert number(Interval(0.5, 0.0, 1.0)) == "0.5 [0.0, 1.0]"
    assert number(Interval(0.5, 0.5, 0.5), " µm") == "0.5 µm"
