"""Statistics with intervals at several levels."""

import numpy as np
import pytest
from scipy.stats import t

from springblock.analysis.estimate import AnyOf, Estimate
from springblock.analysis.statistics import mean_interval


def test_many_findings_hold_together_as_often_as_one_does(rng):
    """Of thirty means that are zero, one or two miss it if each has its own 95 %."""
    misses = np.zeros(2)
    for sample in rng.normal(size=(300, 30, 12)):
        estimates = [Estimate.of(mean_interval(values), 12) for values in sample]
        for i, together in enumerate((1, 30)):
            limits = [estimate.limits(together) for estimate in estimates]
            misses[i] += any(not low < 0.0 < high for low, high in limits)
    assert misses[0] / 300 == pytest.approx(1.0 - 0.95**30, abs=0.08)
    assert misses[1] / 300 == pytest.approx(0.05, abs=0.04)  # 3 errors


def test_intervals_of_means_are_students_at_their_joint_level(rng):
    values = rng.normal(size=12)
    half = t.ppf(1.0 - 0.005, 11) * values.std(ddof=1) / np.sqrt(12)
    found = Estimate.of(mean_interval(values), 12).limits(5)
    assert found == pytest.approx((values.mean() - half, values.mean() + half))


def test_a_range_bounds_an_interval():
    share = Estimate(0.95, 0.92, 0.98, 20, bounds=(0.0, 1.0))
    assert share.limits(1000)[1] == 1.0
    assert share.limits(1000)[0] < 0.9


def test_what_has_no_scatter_is_as_wide_at_any_level():
    assert Estimate(0.1, 0.1, 0.1).limits(1000) == (0.1, 0.1)


def test_a_magnitude_may_be_as_large_as_the_further_end_of_its_interval():
    for (low, high), expected in (
        ((1.0, 3.0), (1.0, 3.0)),
        ((-3.0, -1.0), (1.0, 3.0)),
        ((-3.0, 1.0), (-1.0, 3.0)),
    ):
        found = abs(Estimate((low + high) / 2.0, low, high, 20))
        assert (found.ci_low, found.ci_high) == expected


def test_errors_of_the_same_runs_add_and_those_of_others_add_in_quadrature():
    """Each on its side: the difference is smallest for a small first and a large second value."""
    first, second = Estimate(5.0, 2.0, 6.0, 20), Estimate(1.0, 0.0, 5.0, 10)
    assert first.minus_paired(second) == Estimate(4.0, -3.0, 6.0, 10)
    apart = first - second
    limits = apart.ci_low, apart.ci_high
    assert (apart.value, *limits, apart.n) == pytest.approx((4.0, 4.0 - 5.0, 4.0 + 2.0**0.5, 10))


def test_an_estimate_divided_by_a_number_keeps_its_sample():
    assert Estimate(2.0, 1.0, 4.0, 20) / 2.0 == Estimate(1.0, 0.5, 2.0, 20)


def test_one_of_several_estimates_has_limits_that_enclose_those_of_each():
    """The distance between them is not a statistical error, and does not grow with the level."""
    small, large = Estimate(1.0, 0.5, 1.2, 20), Estimate(3.0, 2.0, 3.5, 20)
    either = AnyOf.these(small, large)
    for together in (1, 12):
        (low, _), (_, high) = small.limits(together), large.limits(together)
        assert either.limits(together) == (low, high)
