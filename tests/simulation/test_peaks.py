"""Load peaks of curves with known ones, and beside those that SciPy finds."""

import numpy as np
import pytest
from scipy.signal import find_peaks, peak_prominences

from springblock import Pattern, Setup, Surface, simulate
from springblock.simulation.peaks import both_peaks, prominence, width


def hill(x, place, height, width=4.0):
    return height * np.exp(-(((x - place) / width) ** 2))


def two_peaks(lesser, valley):
    """Five samples of a force of 2 N at most, with peaks at 1 and 3."""
    return 2.0 * np.array([0.0, 1.0, valley, lesser, 0.0])


X = np.arange(100.0)


@pytest.mark.parametrize(
    ("curve", "peaks"),
    [
        (hill(X, 40, 1.0) + hill(X, 60, 0.95), (40, 60)),
        (hill(X, 40, 1.0) + hill(X, 70, 0.8), None),  # a wave of sliding
        (X + 1.5 * np.sin(X), None),  # small waves of loading
        (two_peaks(lesser=0.901, valley=0.5), (1, 3)),  # nine tenths of the largest force
        (two_peaks(lesser=0.899, valley=0.5), None),
        (two_peaks(lesser=0.95, valley=0.9399), (1, 3)),  # a hundredth above the valley
        (two_peaks(lesser=0.95, valley=0.9401), None),
    ],
)
def test_two_load_peaks_are_found_at_the_maxima_of_the_force(curve, peaks):
    found = both_peaks(curve)
    assert (found and (found.first, found.second)) == peaks


def test_of_several_load_peaks_the_two_most_prominent_count():
    places = [(100, 0.64), (220, 0.62), (300, 0.65), (345, 0.645)]
    hills = [hill(np.arange(500.0), place, height, width=15.0) for place, height in places]
    assert both_peaks(sum(hills))[::2] == (100, 300)
    assert 240 < both_peaks(hills[1] + hills[2]).valley < 280
    assert both_peaks(hills[2]) is None


@pytest.mark.parametrize("end", [[0.1], [], [1.2, 1.3, 1.3]], ids=["drop", "none", "rise"])
def test_prominences_are_those_of_scipy(rng, end):
    """Of rough onsets, which rise from zero; they drop at the end, break off, or rise again."""
    for _ in range(50):
        rough = 1.0 + 0.05 * np.cumsum(rng.standard_normal(100)) / 10.0
        curve = np.concatenate([np.linspace(0.0, rough[0], 20), rough, end])
        peaks, _ = find_peaks(curve, height=0.9 * curve.max())
        prominences = peak_prominences(curve, peaks)[0]
        prominences[curve[peaks] == curve.max()] = curve.max()  # wherever the curve ends
        expected = np.sort(prominences)[::-1] / curve.max()
        found = [prominence(curve, rank) for rank in (1, 2, 3, 4)]
        np.testing.assert_array_equal(found, [*expected, 0.0, 0.0, 0.0, 0.0][:4])


def test_a_peak_may_last_and_of_equal_ones_the_first_is_the_highest():
    """SciPy counts neither as higher, and both as prominent."""
    flat_topped = np.array([0.0, 10.0, 10.0, 9.5, 9.8, 9.8, 9.8, 9.0, 9.0, 9.7])
    assert prominence(flat_topped) == pytest.approx(0.03)
    assert both_peaks(flat_topped) == (1, 3, 4)
    equal = np.array([0.0, 10.0, 9.0, 10.0, 0.0])
    assert [prominence(equal, rank) for rank in (1, 2)] == pytest.approx([1.0, 0.1])
    assert prominence(np.array([0.0, 1.0, 2.0])) == 0.0  # it still rises
    assert prominence(np.array([0.0, 9.4, 5.0, 10.0, 8.0])) == pytest.approx(0.44)  # cut short
    assert prominence(np.ones(5)) == 0.0


def test_the_width_is_of_nine_tenths_of_the_largest_force():
    assert width(two_peaks(lesser=0.95, valley=0.5)) == 2  # across the valley
    assert width(np.array([0.0, 0.89, 0.9, 1.0, 0.91, 0.5])) == 2


def test_a_flat_surface_slides_in_one_step():
    flat = simulate(Surface.draw(Pattern.flat(12), 0), Setup(), progress=False)
    assert flat.prominence < 0.01
    assert np.isnan(flat.t_quiet)
    under_load = flat.time[flat.onset][flat.force[flat.onset] >= 0.9 * flat.force.max()]
    assert flat.t_width == pytest.approx(np.ptp(under_load))
