"""Where static friction is lowest, and where else it may be."""

import numpy as np

from springblock.analysis.lowest import lowest


def test_the_lowest_mean_is_listed_with_those_that_do_not_differ_significantly():
    """Two of 20 runs differ by less than they scatter, the third by far more."""
    noise = np.random.default_rng(0).standard_normal((3, 20))
    noise -= noise.mean(axis=1, keepdims=True)
    samples = {2: 1.0 + noise[0], 6: 0.9 + noise[1], 20: 4.0 + noise[2]}
    found = lowest(samples)
    assert (found.place, found.alike) == (6, [2, 6])
    assert str(found) == "6 (or 2)"


def test_sizes_within_the_numerical_bias_of_the_lowest_friction_are_candidates():
    """Equal realisations have no statistical error; friction has a bias of up to 0.001."""
    exact = {2: np.full(2, 0.6511), 6: np.full(2, 0.65), 20: np.full(2, 0.6509)}
    assert str(lowest(exact)) == "6 (or 20)"


def test_a_single_realisation_excludes_no_size():
    """It has no interval."""
    assert str(lowest({6: np.array([0.65, 0.65]), 20: np.array([0.70])})) == "6 (or 20)"
