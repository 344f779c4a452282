"""Numbers in words."""

import numpy as np
import pytest

from springblock.analysis.statistics import Interval, number
from springblock.beyond.question import UNCHANGED, direction


def test_numbers_are_written_to_what_the_interval_leaves():
    assert number(Interval(*map(np.array, (0.12345, 0.1, 0.2)))) == "0.12 [0.10, 0.20]"
    assert number(Interval(*map(np.array, (123.4, 110.0, 150.0))), " µm") == "123 [110, 150] µm"
    assert number(Interval(*map(np.array, (-0.064, -0.13, 0.002)))) == "-0.064 [-0.130, 0.002]"
    assert number(Interval(*map(np.array, (0.5, 0.0, 1.0)))) == "0.5 [0.0, 1.0]"
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
