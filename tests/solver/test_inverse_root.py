"""1/√x without a root and a division, against 40 digits."""

import mpmath
import numpy as np
import pytest

from springblock.solver.compilation import kernel
from springblock.solver.inverse_root import inverse_root

SMALLEST, LARGEST = np.finfo(float).smallest_normal, np.finfo(float).max


@kernel
def fill(found, x):
    """Compute it as the integrators do, in a vectorised loop."""
    for i in range(len(x)):
        found[i] = inverse_root(x[i])


def inverse_roots(x):
    found = np.empty_like(x)
    fill(found, x)
    return found


def units_off(x):
    """Distance from 1/√x in units in the last place."""
    with mpmath.workdps(40):
        exact = [1 / mpmath.sqrt(mpmath.mpf(float(each))) for each in x]
        off = [mpmath.mpf(float(y)) - e for y, e in zip(inverse_roots(x), exact, strict=True)]
    return np.abs(np.array(off, float)) / np.spacing(np.array(exact, float))


def test_normal_numbers_are_exact_to_rounding():
    """The last step rounds three times, each by half a unit at most; its own error is far below.

    Two octaves in detail: the others have the same digits, since the first estimate is exact in the
    exponent.
    """
    others = np.geomspace(SMALLEST, LARGEST / 2.0, 2049)
    x = np.concatenate([np.geomspace(1.0, 4.0, 5000), others, [SMALLEST, LARGEST]])
    assert units_off(x).max() <= 1.5


@pytest.mark.parametrize("x", [0.0, 5e-324, 1e-310, 2e-308])
def test_subnormal_numbers_give_a_finite_value_below_the_root(x):
    found = inverse_roots(np.array([x]))[0]
    assert 1e153 < found < 1e155
    assert found * np.sqrt(x) <= 1.0 + 1e-12


def test_infinity_counts_as_the_largest_number_and_nan_stays_nan():
    """For so fast a block the direction does not matter, and friction removes almost nothing."""
    infinite, unknown = inverse_roots(np.array([np.inf, np.nan]))
    assert 0.0 < infinite < 1e-153
    assert np.isnan(unknown)
