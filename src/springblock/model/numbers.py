"""Arrays of numbers, and checks of numbers given by users."""

import math
import reprlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

REAL = int | float | np.integer | np.floating


def as_array(name: str, values: Any) -> np.ma.MaskedArray[Any, Any]:
    """Return values with their mask, if any; refuse those whose meaning an array would lose."""
    for more in ("unit", "units", "dims"):  # of pint, astropy and xarray
        if hasattr(values, more):
            raise TypeError(
                f"{name} must be a plain array, without {more} = {getattr(values, more)}"
            )
    array: np.ma.MaskedArray[Any, Any] = np.ma.array(values)
    return array


def is_finite(value: Any) -> bool:
    """Return whether a value is a real number, of Python or NumPy, that is finite as a float."""
    if isinstance(value, bool) or not isinstance(value, REAL):
        return False
    try:
        return math.isfinite(value)
    except OverflowError:  # a whole number of more than 308 digits
        return False


def check_whole(name: str, value: Any, least: int = 1) -> int:
    """Return a whole number as int; refuse other types and numbers below `least`."""
    if isinstance(value, bool) or not isinstance(value, int | np.integer):
        raise TypeError(f"{name} must be a whole number, not {value!r}")
    if value < least:
        raise ValueError(f"{name} must be at least {least}, not {value}")
    return int(value)


def check_real(name: str, value: Any, may_vanish: bool = False) -> float:
    """Return a number as float; refuse other types and numbers that are not finite and positive.

    Zero is accepted if the number `may_vanish`.
    """
    if isinstance(value, bool) or not isinstance(value, REAL):
        raise TypeError(f"{name} must be a number, not {value!r}")
    if not (is_finite(value) and (value > 0.0 or (may_vanish and value == 0.0))):
        allowed = "zero or positive" if may_vanish else "positive"
        raise ValueError(f"{name} must be finite and {allowed}, not {reprlib.repr(value)}")
    return float(value)
