"""Scenes: which lengths belong together, and what follows from them."""

import numpy as np
import pytest

from springblock.scene import COLUMNS, Scene
from springblock.tables import SCENE

STRIPS = {"n_p": 58, "n_s": 62, "n_p2": 8, "n_s2": 2}
CUT = Scene(120, **STRIPS, n_p3=8, n_s3=2)


def test_a_third_level_cuts_the_strips_across():
    assert CUT.level == 3
    strips, cut = Scene(120, **STRIPS).pattern.contact, CUT.pattern.contact
    (rows, columns) = (np.flatnonzero(cut.any(axis=axis)) for axis in (1, 0))
    np.testing.assert_array_equal(rows, columns)  # as deep along x as along y
    np.testing.assert_array_equal(rows[:10], [31, 32, 33, 34, 35, 36, 37, 38, 41, 42])
    assert cut.sum() == 48**2
    assert not cut[~strips].any()


def test_folders_and_options_name_every_level():
    assert CUT.folder == (
        "n_blocks=120/level=3/n_p=58/n_s=62/n_p2=8/n_s2=2/n_p3=8/n_s3=2/direction=x"
    )
    assert CUT.arguments.endswith("--n-p2 8 --n-s2 2 --n-p3 8 --n-s3 2 --direction x")
    assert Scene(9, direction="30").folder == "n_blocks=9/level=0/direction=30"


def test_a_row_of_a_table_names_its_scene():
    assert set(COLUMNS) == set(SCENE.names)
    assert Scene.from_row(CUT.row | {"seed": 3}) == CUT


@pytest.mark.parametrize(
    ("lengths", "sentence"),
    [
        ({"n_p": 20}, "n_p = 20 needs n_s"),
        ({"n_s": 10}, "n_s = 10 needs n_p"),
        ({"n_p2": 8, "n_s2": 2}, "n_s2 = 2 needs n_p"),
        ({"n_p": 58, "n_s": 62, "n_p3": 8, "n_s3": 2}, "n_s3 = 2 needs n_p2"),
        (STRIPS | {"n_s3": 2}, "n_s3 = 2 needs n_p3"),
    ],
)
def test_lengths_without_those_they_need_are_refused(lengths, sentence):
    with pytest.raises(ValueError, match=f"^{sentence}$"):
        Scene(120, **lengths)


@pytest.mark.parametrize(
    ("scene", "sides"),
    [
        (Scene(120), ()),
        (Scene(120, 5, 5), ()),
        (Scene(120, 6, 6), ("x", "y")),
        (Scene(120, **STRIPS), ("x",)),
        (CUT, ()),
    ],
)
def test_sides_are_whole_and_long_enough(scene, sides):
    assert scene.sides == sides
