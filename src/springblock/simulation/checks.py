"""Checks of types and times."""

import math
from collections.abc import Sequence
from typing import Any

from springblock.model.direction import REAL

#: Largest number of blocks times snapshots in a run: 6 GB of fields.
_MOST_IN_SNAPSHOTS = 2**27


def check_type(name: str, value: Any, kind: type) -> None:
    """Refuse a value of another type."""
    if not isinstance(value, kind):
        raise TypeError(f"{name} must be a {kind.__name__}, not {value!r}")


def check_positive(name: str, value: Any) -> None:
    """Refuse a time that is not finite and positive."""
    if isinstance(value, bool) or not isinstance(value, REAL):
        raise TypeError(f"{name} must be a number of seconds, not {value!r}")
    if not (math.isfinite(value) and value > 0.0):
        raise ValueError(f"{name} must be finite and positive, not {value!r}")


def whole_multiple(name: str, value: float, unit_name: str, unit: float) -> int:
    """Return `value` divided by `unit`; raise ValueError unless it is a whole number."""
    check_positive(name, value)
    ratio = value / unit
    count = round(ratio) if math.isfinite(ratio) else 0
    if count < 1 or abs(ratio - count) > 1e-6 * count:
        raise ValueError(f"{name} must be a multiple of {unit_name} = {unit!r} s, not {value!r} s")
    return count


def count_samples(duration: float, sample_interval: float) -> int:
    """Return the number of whole sample intervals within a positive duration; at least one."""
    if duration < sample_interval * (1.0 - 1e-9):
        raise ValueError(
            f"duration must be at least one sample_interval = {sample_interval!r} s, "
            f"not {duration!r} s"
        )
    return int(duration / sample_interval + 1e-6)


def snapshot_samples(
    times: Sequence[float], sample_interval: float, blocks: int, duration: float | None = None
) -> list[int]:
    """Return the number of sample intervals until each snapshot; times in s.

    Raises
    ------
    TypeError, ValueError
        If a time is no multiple of the sample interval, not later than the one before, or
        beyond the duration in s; or if the snapshots do not fit in memory.
    """
    name = "snapshot_times"
    samples = [whole_multiple(name, time, "sample_interval", sample_interval) for time in times]
    if samples != sorted(set(samples)):
        raise ValueError(f"{name} must be in ascending order, without repetition")
    if duration is not None:
        check_positive("duration", duration)
        if samples and samples[-1] > count_samples(duration, sample_interval):
            raise ValueError(f"{name} must lie within the duration of {duration!r} s")
    if len(times) * blocks > _MOST_IN_SNAPSHOTS:
        raise ValueError(
            f"{name} has {len(times)} times; of {blocks} blocks at most "
            f"{_MOST_IN_SNAPSHOTS // blocks} snapshots can be kept"
        )
    return samples
