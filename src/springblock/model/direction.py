"""Sliding directions: along x, along y, or at an angle from x in degrees."""

import math

from springblock.model.numbers import REAL

_AXES = {"x": (1.0, 0.0), "y": (0.0, 1.0)}
#: Names of the angles, from -180 to 180 degrees, that could be written in two ways.
_NAMES = {0.0: "x", 90.0: "y", -180.0: "180"}


def normalised(direction: str | float) -> str:
    """Return the canonical form of a direction: "x", "y" or degrees from x, as "15".

    Whole turns are removed exactly, and an angle of 0 or 90 degrees becomes "x" or "y". Anything
    but "x", "y" and finite numbers, possibly as text, is refused with a ValueError.
    """
    if isinstance(direction, str) and direction in _AXES:
        return direction
    try:
        is_angle = not isinstance(direction, bool) and isinstance(direction, REAL | str)
        angle = float(direction) if is_angle else math.nan
    except (ValueError, OverflowError):
        angle = math.nan
    if not math.isfinite(angle):
        raise ValueError(f"direction must be 'x', 'y' or an angle in degrees, not {direction!r}")
    angle = math.remainder(angle, 360.0)
    return _NAMES.get(angle, repr(angle).removesuffix(".0"))


def degrees(direction: str) -> float:
    """Return the angle from x, in degrees, of a direction in the form of `normalised`."""
    return {"x": 0.0, "y": 90.0}[direction] if direction in _AXES else float(direction)


def heading(direction: str | float) -> tuple[float, float]:
    """Unit vector (x, y) of a sliding direction: "x", "y" or an angle from x in degrees."""
    name = normalised(direction)
    if name in _AXES:
        return _AXES[name]
    quarters, rest = divmod(float(name), 90.0)
    cosine, sine = math.cos(math.radians(rest)), math.sin(math.radians(rest))
    turns = ((cosine, sine), (-sine, cosine), (-cosine, -sine), (sine, -cosine))
    return turns[int(quarters) % 4]
