"""Sliding directions: the one way to write each, and what is none."""

import numpy as np
import pytest
from click.testing import CliRunner

from springblock.cli import main
from springblock.model.direction import degrees, heading, normalised
from springblock.model.scene import Scene


@pytest.mark.parametrize(
    ("name", "others"),
    [
        ("x", [0, -0.0, "0.0", 360]),
        ("y", [90, "90.0", 450, np.int64(-270)]),
        ("15", [15, 15.0, "15.0", 375, np.float64(-345.0)]),
        ("22.5", [22.5, "22.50"]),
        ("-90", [-90, 270.0]),
        ("180", [180, -180, 540]),
    ],
)
def test_a_direction_is_written_in_one_way(name, others):
    assert {normalised(direction) for direction in (name, *others)} == {name}
    assert {heading(direction) for direction in others} == {heading(name)}
    assert heading(degrees(name)) == heading(name)
    assert {Scene(4, direction=direction) for direction in others} == {Scene(4, direction=name)}


@pytest.mark.parametrize("direction", ["up", "diag", "", "nan", "inf", "-inf"])
def test_what_is_no_direction_is_refused_by_name(direction, tmp_path):
    seeds = ["--first-seed", "0", "--last-seed", "0", "--output", str(tmp_path / "a.parquet")]
    scene = ["--n-blocks", "4", "--direction", direction]
    outcome = CliRunner().invoke(main, ["simulate", *scene, *seeds])
    *_, sentence = outcome.output.splitlines()
    assert outcome.exit_code == 2
    assert "'--direction': direction must be 'x', 'y' or a" in sentence
    assert sentence.endswith(f"not {direction!r}")
