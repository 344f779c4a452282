"""Checks of surfaces and times."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from springblock.model.direction import REAL
from springblock.model.pattern import MAX_BLOCKS

Array = NDArray[np.float64]

#: Least number of blocks per side with periodic edges: with fewer, a block would be its own
#: neighbour, or a neighbour of another one twice.
_SHORTEST_PERIOD = 3
#: Blocks times snapshots that a run keeps at most: 6 GB of fields.
_MOST_IN_SNAPSHOTS = 2**27


def checked_surface(
    contact: ArrayLike, mu_static: ArrayLike, mu_dynamic: ArrayLike, periodic: Any = False
) -> tuple[NDArray[np.bool_], Array, Array]:
    """Return contact and coefficients, (N_y, N_x) each, the latter zero outside the contact.

    The contact may consist of 0 and 1, and a coefficient may be one number for all blocks.

    Raises
    ------
    TypeError, ValueError
        If a shape, type or value is not valid, with the reason.
    """
    mask = _as_mask(contact)
    if mask.ndim != 2:
        raise ValueError(f"contact must have the shape (N_y, N_x), not {mask.shape}")
    if max(mask.shape) > MAX_BLOCKS:
        raise ValueError(
            f"contact has the shape {mask.shape}; a side may have at most {MAX_BLOCKS} blocks"
        )
    if not isinstance(periodic, bool):
        raise TypeError(f"periodic must be True or False, not {periodic!r}")
    if periodic and min(mask.shape) < _SHORTEST_PERIOD:
        raise ValueError(
            f"contact has the shape {mask.shape}; with periodic edges each side must have at least "
            f"{_SHORTEST_PERIOD} blocks"
        )
    if not mask.any():
        raise ValueError("contact is False everywhere; at least one block must be in contact")
    fields = []
    for name, values in (("mu_static", mu_static), ("mu_dynamic", mu_dynamic)):
        mu = np.asarray(values)
        if mu.dtype.kind not in "iuf":
            raise TypeError(f"{name} must be an array of real numbers, not of {mu.dtype}")
        if mu.ndim == 0:
            mu = np.broadcast_to(mu, mask.shape)
        if mu.shape != mask.shape:
            raise ValueError(f"{name} must have the shape {mask.shape} of contact, not {mu.shape}")
        in_contact = mu[mask]
        if not (np.isfinite(in_contact) & (in_contact >= 0.0)).all():
            raise ValueError(f"{name} must be finite and not negative on all blocks in contact")
        fields.append(np.where(mask, mu, 0.0).astype(float))
    return mask, fields[0], fields[1]


def _as_mask(contact: ArrayLike) -> NDArray[np.bool_]:
    """Return contact as an array of bool, converted from 0 and 1 if necessary."""
    mask = np.asarray(contact)
    if mask.dtype == np.bool_:
        return mask
    if mask.dtype.kind not in "iu":
        raise TypeError(f"contact must be an array of bool, or of 0 and 1, not of {mask.dtype}")
    other = mask[(mask != 0) & (mask != 1)]
    if other.size:
        raise ValueError(f"contact must hold bool, or 0 and 1, not {other[0]}")
    return mask.astype(bool)


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
    """Sample intervals until each of the snapshots in s, of a surface of so many blocks.

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
