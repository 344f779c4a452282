"""Sliding directions: canonical names, unit vectors and invalid values."""

import math

import numpy as np
import pytest

from springblock.model.direction import degrees, heading, normalised
from springblock.model.scene import Scene

RIGHT = {"x": (1, 0), "y": (0, 1), "-90": (0, -1), "180": (-1, 0)}


@pytest.mark.parametrize(
    ("name", "others"),
    [
        ("x", [0, -0.0, "0.0", 360]),
        ("y", [90, "90.0", 450, np.int64(-270)]),
        ("-90", [-90, 270.0]),
        ("180", [180, -180, 540]),
        ("15", [15, 15.0, "15.0", 375, np.float64(-345.0)]),
        ("22.5", [22.5, "22.50"]),
        ("135", [135.0, -225]),
        ("-135", [225, "-135.0"]),
        ("-1", [np.int64(359)]),
    ],
)
def test_a_direction_has_one_name_and_one_unit_vector_exact_at_right_angles(name, others):
    assert {normalised(direction) for direction in (name, *others)} == {name}
    assert {Scene(4, direction=direction) for direction in others} == {Scene(4, direction=name)}
    (vector,) = {heading(direction) for direction in (name, degrees(name), *others)}
    angle = math.radians(degrees(name))
    assert vector == pytest.approx((math.cos(angle), math.sin(angle)), rel=1e-14, abs=1e-15)
    assert vector == RIGHT.get(name, vector)
    assert math.hypot(*vector) == pytest.approx(1.0, rel=1e-15)


@pytest.mark.parametrize(
    "direction",
    ["up", "", None, True, np.True_, b"15", np.array([15.0]), 10**400, "nan", -math.inf],
)
def test_invalid_directions_are_refused_by_name(direction):
    with pytest.raises(ValueError, match="direction must be 'x', 'y' or a") as refusal:
        normalised(direction)
    assert str(refusal.value).endswith(f"not {direction!r}")
