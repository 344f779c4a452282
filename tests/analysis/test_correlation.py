"""Correlation along the sides of pillars, against fields whose correlation is known."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from springblock import Pattern
from springblock.analysis.correlation import (
    Correlation,
    amplitude,
    fit_length,
    fit_tail,
    groove_times,
    misfits,
    references,
    side_times,
)
from springblock.analysis.statistics import bootstrap_weights

MIDDLE = 4e-4  #: s, mean detachment time of the fields below
SPREAD = 1e-6  #: s


def times(rng, k, pillars, size, l_c):
    """Detachment times along sides, (k, pillars, 2, size), whose c(r) is exp(-r/l_c).

    Noise that forgets all but a share q of its last value: an AR(1) process.
    """
    q = np.exp(-1.0 / l_c) if l_c else 0.0
    noise = rng.standard_normal((k, pillars, 2, size))
    for x in range(1, size):
        noise[..., x] = q * noise[..., x - 1] + np.sqrt(1.0 - q**2) * noise[..., x]
    return MIDDLE + SPREAD * noise


@pytest.fixture
def decaying(rng):
    """Sides with a correlation length of three blocks."""
    return times(rng, 60, 9, 20, 3.0)


def test_a_known_length_is_found(decaying):
    found = Correlation(decaying)
    length = found.length()
    assert length.last == 6  # n_p/3
    error = found.resampled[:, 1:7].std(axis=0)
    assert length.fitted.mean == fit_length(found.mean[None, 1:7], error)[0]  # from r = 1
    for estimate in (length.fitted, length.tail):
        assert estimate.low < 3.0 < estimate.high
        assert estimate.high - estimate.low < 1.5
    assert length.amplitude.low < 1.0 < length.amplitude.high
    exact = np.exp(-np.arange(len(found.mean)) / 3.0)
    assert (found.interval.low <= exact + 1e-12).all()
    assert (found.interval.high >= exact - 1e-12).all()


def test_all_sides_of_twenty_blocks_or_more_have_the_same_range(rng):
    sides = {size: Correlation(times(rng, 12, 2, size, 3.0)) for size in (6, 12, 20, 60)}
    assert {size: side.last for size, side in sides.items()} == {6: 2, 12: 4, 20: 6, 60: 6}


def test_a_correlation_that_levels_off_has_a_small_amplitude(rng):
    """A shift of all blocks of a realisation does not decay."""
    shift = SPREAD * rng.standard_normal((400, 1, 1, 1))
    assert Correlation(times(rng, 400, 4, 20, 1.0) + shift).length().amplitude.high < 1.0


def test_sides_that_detach_as_a_whole_have_an_infinite_length(rng):
    whole = np.broadcast_to(SPREAD * rng.standard_normal((5, 2, 2, 1)), (5, 2, 2, 20))
    found = Correlation(whole).length()
    assert np.isinf([found.fitted, found.tail]).all()
    assert found.amplitude.mean == 1.0


def test_the_definition_word_by_word(rng):
    t = times(rng, 5, 2, 10, 2.0)
    c = np.zeros(5)
    for r in range(5):
        for pillar, side, x0, step in np.ndindex(2, 2, 2, 2):
            x = x0 + 4  # the two blocks in the middle of ten
            one, two = t[:, pillar, side, x], t[:, pillar, side, x + (r if step else -r)]
            c[r] += np.mean(one * two) - np.mean(one) * np.mean(two)
    np.testing.assert_allclose(Correlation(t).mean, c / c[0], rtol=1e-4)


def test_a_resample_is_the_correlation_of_the_realisations_drawn(decaying):
    weights = bootstrap_weights(60)[3]
    drawn = np.repeat(decaying, np.rint(60 * weights).astype(int), axis=0)
    resample = Correlation(decaying).weighted(weights[None])[0]
    np.testing.assert_allclose(resample, Correlation(drawn).mean, rtol=1e-10)


def test_intervals_have_about_their_nominal_coverage(rng, monkeypatch):
    monkeypatch.setattr("springblock.analysis.statistics._RESAMPLES", 500)  # quicker
    hits, lengths, trials = 0, 0, 50
    for _ in range(trials):
        found = Correlation(times(rng, 40, 2, 12, 2.0))
        hits += found.interval.low[2] < np.exp(-1.0) < found.interval.high[2]
        fitted = found.length().fitted
        lengths += fitted.low < 2.0 < fitted.high
    assert hits / trials == pytest.approx(0.94, abs=0.06)
    assert lengths / trials == pytest.approx(0.94, abs=0.06)


@pytest.mark.parametrize(
    ("size", "expected"),
    [(6, [2, 3]), (7, [3]), (20, range(8, 12)), (60, range(24, 36))],
)
def test_references_are_the_central_fifth(size, expected):
    assert references(size).tolist() == list(expected)


def test_exact_curves_give_exact_lengths():
    r, error = np.arange(1, 7), np.linspace(0.05, 0.1, 6)
    curves = np.exp(-r / np.array([0.5, 3.0, 40.0])[:, None])
    between = np.geomspace(2.9, 3.1, 20)  # lengths between those of the grid
    for estimate in (fit_length, fit_tail):
        np.testing.assert_allclose(estimate(curves, error), [0.5, 3.0, 40.0], rtol=2e-3)
        found = estimate(np.exp(-r / between[:, None]), error)
        np.testing.assert_allclose(found, between, rtol=1e-4)
    np.testing.assert_allclose(fit_tail(0.6 * curves, error), [0.5, 3.0, 40.0], rtol=2e-3)
    np.testing.assert_allclose(amplitude(0.6 * curves, error, np.array([0.5, 3.0, 40.0])), 0.6)
    assert fit_length(-curves, error).tolist() == pytest.approx([0.1, 0.1, 0.1])
    assert (fit_tail(-curves, error) < 0.11).all()  # no anticorrelation is fitted
    assert (amplitude(-curves, error, np.array([0.5, 3.0, 40.0])) == 0.0).all()
    assert np.isnan(fit_tail(curves[:, :2], error[:2])).all()
    assert np.isfinite(fit_tail(curves[:, :3], error[:3])).all()
    for estimate in (fit_length, fit_tail):  # no decay: the longest length
        assert estimate(np.ones((1, 6)), error)[0] == pytest.approx(1000.0, rel=0.03)


def test_distances_count_by_their_inverse_variance():
    """No exponential passes through these three points; another weighting gives another length."""
    r, curve, error = np.arange(1, 4), np.array([0.8, 0.3, 0.3]), np.array([0.02, 0.1, 0.3])

    def least_squares(length):
        decay, weight = np.exp(-r / length), error**-2
        return (weight * curve) @ decay / (weight @ decay**2)

    for fit, scale in ((fit_length, lambda length: 1.0), (fit_tail, least_squares)):

        def misfit(length, scale=scale):
            return np.sum(((curve - scale(length) * np.exp(-r / length)) / error) ** 2)

        best = minimize_scalar(misfit, bounds=(0.5, 20.0)).x
        assert fit(curve[None], error)[0] == pytest.approx(best, rel=1e-3)
    assert amplitude(curve[None], error, np.array([2.0])) == pytest.approx(least_squares(2.0))


def test_sides_are_the_outer_rows_and_columns_of_the_pillars():
    pattern = Pattern.pillars(24, 6, 6)
    y, x = np.mgrid[:24.0, :24.0]
    run = SimpleNamespace(t_det=100.0 * y + x)
    along_x, along_y = (side_times([run, run], pattern, side) for side in "xy")
    assert along_x.shape == along_y.shape == (2, 4, 2, 6)
    second, last = 1, 1  # the second pillar starts at y = 3, x = 15
    assert along_x[0, second, last].tolist() == [800.0 + x for x in range(15, 21)]
    assert along_y[0, second, 0].tolist() == [100.0 * y + 15.0 for y in range(3, 9)]


def test_edges_of_grooves_are_the_rows_beside_them():
    """Rows 2-3, 5-6 and 8-9 of a pillar are in contact; its sides along y are cut."""
    pattern = Pattern.pillars(24, 8, 4).grooved(2, 1, along="x")
    y, x = np.mgrid[:24.0, :24.0]
    run = SimpleNamespace(t_det=100.0 * y + x)
    edges = groove_times([run, run], pattern)
    assert edges.shape == (2, 4, 4, 8)
    assert edges[0, 1, :, 0].tolist() == [314.0, 514.0, 614.0, 814.0]
    assert edges[0, 1, 0].tolist() == [300.0 + x for x in range(14, 22)]
    assert side_times([run], pattern, "x").shape == (1, 4, 2, 8)
    with pytest.raises(ValueError, match="along y are not all in contact"):
        side_times([run], pattern, "y")
    run.t_det[3, 14] = np.nan
    with pytest.raises(ValueError, match="beside a groove never detached"):
        groove_times([run], pattern)
    with pytest.raises(ValueError, match="no uncut pawls along x"):
        groove_times([run], Pattern.pillars(24, 8, 4))


def test_too_few_or_equal_realisations_are_refused(decaying):
    run = SimpleNamespace(t_det=np.full((24, 24), np.nan))
    with pytest.raises(ValueError, match="never detached"):
        side_times([run], Pattern.pillars(24, 6, 6), "x")
    with pytest.raises(ValueError, match="at least 3 realisations, not 2"):
        Correlation(decaying[:2])
    with pytest.raises(ValueError, match="is not defined"):
        Correlation(np.full((5, 1, 2, 6), MIDDLE))


def test_each_kind_of_curve_fits_itself_best():
    r = np.arange(1.0, 7.0)
    curves = np.exp(-r / 3.0), (1.0 + r) ** -0.5, np.maximum(0.0, 1.0 - r / 8.0)
    for kind, distances in enumerate(zip(*misfits(0.7 * np.array(curves)), strict=True)):
        assert np.argmin(distances) == kind
        assert distances[kind] < 5e-3  # lengths are tried 3.5 % apart
