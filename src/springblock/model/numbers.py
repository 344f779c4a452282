"""Arrays of numbers, and checks of numbers and names given by users."""

import math
from collections import Counter
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

REAL = int | float | np.integer | np.floating


def as_array(name: str, values: Any) -> Any:
    """Return values as a masked array; refuse those whose unit or dimensions it would lose."""
    more = {"unit", "units", "dims"}.intersection(dir(values))  # of astropy, pint and xarray
    if more:
        raise TypeError(f"{name} must be a plain array, without {more.pop()}")
    return np.ma.array(values)


def check_once(what: str, names: Iterable[Any]) -> None:
    """Refuse names of which one occurs twice, since the last would silently count."""
    for name, times in Counter(names).items():
        if times > 1:
            raise ValueError(f"{what}: {name!r} is given twice; remove one")


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
    if not (math.isfinite(value) and (value > 0.0 or (may_vanish and value == 0.0))):
        allowed = "zero or positive" if may_vanish else "positive"
        raise ValueError(f"{name} must be finite and {allowed}, not {value!r}")
    return float(value)
