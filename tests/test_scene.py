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


def test_a_third_level_may_follow_the_grooves():
    """Pawls of 18 blocks are divided once more, into 8 and 8."""
    wide = Scene(120, 58, 62, 18, 2, 8, 2, along_3="x")
    assert wide.sides == ("x",)
    narrow = Scene(120, **STRIPS)  # 8 and 2 all through, as these levels come to
    np.testing.assert_array_equal(wide.pattern.contact, narrow.pattern.contact)


def test_grooves_may_cross_the_whole_surface():
    """With margins of half a groove, as pillars have them."""
    bare = Scene(20, n_p2=8, n_s2=2)
    assert (bare.level, bare.sides) == (1, ())
    contact = bare.pattern.contact
    np.testing.assert_array_equal(np.flatnonzero(~contact.any(axis=1)), [0, 9, 10, 19])
    assert contact[1:9].all()


def test_constants_of_its_own_belong_to_a_scene():
    fast = Scene(9, varied={"step": "1e-8", "gamma": 0})
    assert fast.varied == (("gamma", 0.0), ("step", 1e-8))
    assert fast == Scene.from_row(fast.row) == Scene(9, varied=(("step", 1e-8), ("gamma", 0.0)))
    assert fast.folder == "n_blocks=9/level=0/gamma=0.0/step=1e-08/direction=x"
    assert fast.arguments.endswith("--vary gamma=0.0 --vary step=1e-08")
    assert fast != Scene(9)


def test_a_law_is_text_among_the_constants():
    weak = Scene(9, varied={"slip_distance": "1e-7", "law": "slip_weakening"})
    assert weak == Scene.from_row(weak.row)
    assert weak.folder == ("n_blocks=9/level=0/law=slip_weakening/slip_distance=1e-07/direction=x")
    assert weak.arguments.endswith("--vary law=slip_weakening --vary slip_distance=1e-07")


def test_folders_and_options_name_every_level():
    assert CUT.folder == (
        "n_blocks=120/level=3/n_p=58/n_s=62/n_p2=8/n_s2=2/n_p3=8/n_s3=2/along_3=y/direction=x"
    )
    assert CUT.arguments.endswith("--n-p2 8 --n-s2 2 --n-p3 8 --n-s3 2 --along-3 y --direction x")
    assert Scene(9, direction="30").folder == "n_blocks=9/level=0/direction=30"


def test_a_row_of_a_table_names_its_scene():
    assert set(COLUMNS) == set(SCENE.names)
    assert Scene.from_row(CUT.row | {"seed": 3}) == CUT


@pytest.mark.parametrize(
    ("lengths", "sentence"),
    [
        ({"n_p": 20}, "n_p = 20 needs n_s"),
        ({"n_s": 10}, "n_s = 10 needs n_p"),
        ({"n_p2": 8}, "n_p2 = 8 needs n_s2"),
        ({"n_p": 58, "n_s": 62, "n_p3": 8, "n_s3": 2}, "n_p3 = 8 needs n_p2"),
        (STRIPS | {"n_s3": 2}, "n_s3 = 2 needs n_p3"),
        (STRIPS | {"along_3": "x"}, "along_3 must be left out without n_p3, not 'x'"),
        (STRIPS | {"n_p3": 8, "n_s3": 2, "along_3": "z"}, "along_3 must be 'x' or 'y', not 'z'"),
        ({"varied": {"speed": 1}}, "'speed' is no constant; there are youngs_modulus, .*, step"),
        ({"varied": {"gamma": "much"}}, "gamma must be a number, not 'much'"),
    ],
)
def test_what_does_not_make_a_scene_is_refused(lengths, sentence):
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
