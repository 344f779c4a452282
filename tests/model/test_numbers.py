"""Numbers given by users: their types and signs."""

import math

import numpy as np
import pytest

from springblock.model.numbers import check_real, check_whole


@pytest.mark.parametrize(
    ("check", "value", "sentence"),
    [
        *((check_whole, value, "a whole number") for value in (4.0, "4", None, True)),
        (check_whole, 0, "at least 1"),
        *((check_real, value, "a number") for value in ("1", None, True, 1j)),
        *((check_real, value, "finite and positive") for value in (0, -1.0, math.nan, math.inf)),
    ],
)
def test_other_numbers_are_refused_by_name(check, value, sentence):
    with pytest.raises((TypeError, ValueError)) as refusal:
        check("N", value)
    assert str(refusal.value) == f"N must be {sentence}, not {value!r}"


def test_numbers_of_numpy_become_those_of_python_and_zero_may_be_allowed():
    assert type(check_whole("N", np.int64(1))) is int
    assert type(check_real("step", np.int8(2))) is float
    assert check_whole("seed", 0, least=0) == check_real("gamma", 0, may_vanish=True) == 0


def test_a_whole_number_beyond_the_range_of_floats_is_not_finite():
    with pytest.raises(
        ValueError, match=r"gamma must be finite and zero or positive, not 10+\.\.\.0+$"
    ):
        check_real("gamma", 10**400, may_vanish=True)
