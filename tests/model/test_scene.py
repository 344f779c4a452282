"""Scenes: valid combinations of lengths, and the surfaces that they describe."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from springblock.io.schemas import SCENE
from springblock.model.blockmap import BlockMap
from springblock.model.scene import COLUMNS, Scene

STRIPS = {"n_p": 58, "n_s": 62, "n_p2": 8, "n_s2": 2}
CUT = Scene(120, **STRIPS, n_p3=8, n_s3=2)
#: A surface of 2 x 3 blocks.
CORNER = BlockMap("corner-1a2b3c4d", np.array([[1, 1, 0], [0, 0, 0]], bool), Path("a corner.npy"))
OWN = Scene(mask=CORNER, edges="periodic")


def field(values):
    return BlockMap("strong-00000000", np.array(values, float), Path("strong.npy"))


STRONG = Scene(2, mu_static_field=field(np.ones((2, 2))), varied={"distribution": "weibull"})


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


def test_varied_constants_belong_to_a_scene():
    fast = Scene(9, varied={"step": "1e-8", "gamma": 0})
    assert fast.varied == (("gamma", 0.0), ("step", 1e-8))
    assert fast == Scene(9, varied=(("step", 1e-8), ("gamma", 0.0)))
    assert fast != Scene(9)


@pytest.mark.parametrize(
    ("scene", "folder", "options"),
    [
        (
            CUT,
            "n_blocks-120/level-3/n_p-58/n_s-62/n_p2-8/n_s2-2/n_p3-8/n_s3-2/along_3-y/direction-x",
            "--n-p2 8 --n-s2 2 --n-p3 8 --n-s3 2 --along-3 y --direction x",
        ),
        (
            Scene(24, 4, 2, n_rows=12, direction="30"),
            "n_blocks-24/n_rows-12/level-1/n_p-4/n_s-2/direction-30",
            "--n-blocks 24 --n-rows 12 --n-p 4 --n-s 2 --direction 30",
        ),
        (
            Scene(9, varied={"step": "1e-8", "gamma": 0}),
            "n_blocks-9/level-0/gamma-0.0/step-1e-08/direction-x",
            "--vary gamma=0.0 --vary step=1e-08 --direction x",
        ),
        (
            Scene(9, varied={"slip_distance": "1e-7", "law": "slip_weakening"}),
            "n_blocks-9/level-0/law-slip_weakening/slip_distance-1e-07/direction-x",
            "--vary law=slip_weakening --vary slip_distance=1e-07 --direction x",
        ),
        (
            OWN,  # named by its contents and read from its file
            "n_blocks-3/n_rows-2/mask-corner-1a2b3c4d/edges-periodic/direction-x",
            "--mask 'a corner.npy' --edges periodic --direction x",
        ),
        (
            STRONG,
            "n_blocks-2/level-0/mu_static_field-strong-00000000/distribution-weibull/direction-x",
            "--mu-static strong.npy --vary distribution=weibull --direction x",
        ),
    ],
)
def test_folders_options_and_rows_identify_a_scene(scene, folder, options):
    assert scene.folder == folder
    assert scene.arguments.endswith(options)
    assert Scene.from_row(scene.row) == scene
    assert set(scene.row) == set(COLUMNS) == set(SCENE.names)


def test_a_mask_replaces_the_pattern():
    assert (OWN.shape, OWN.level, OWN.sides, OWN.lengths) == ((2, 3), -1, (), {})
    assert OWN.contact is CORNER.values
    assert Scene(3, n_rows=2, edges="periodic") != OWN
    with pytest.raises(ValueError, match="mask corner-1a2b3c4d is not a pattern of pillars"):
        _ = OWN.pattern


def test_a_table_contains_only_the_name_of_a_mask():
    known = Scene.from_row(OWN.row)
    assert known == OWN
    assert (known.shape, known.mask.values) == ((2, 3), None)
    with pytest.raises(ValueError, match="mask corner-1a2b3c4d are not available, only its name"):
        _ = known.contact
    assert OWN.row["n_rows"] == 2
    assert Scene(9).row["n_rows"] == 9


def test_the_paper_has_squares_with_edges_whose_coefficients_are_drawn():
    field_of_ones = field(np.ones((4, 4)))
    assert all(s.is_papers for s in (Scene(4), CUT, Scene(4, n_rows=4), Scene(4, direction="30")))
    others = [OWN, Scene(4, n_rows=2), Scene(4, edges="periodic")]
    others += [Scene(4, mu_static_field=field_of_ones), Scene(4, mu_dynamic_field=field_of_ones)]
    assert not any(scene.is_papers for scene in others)


def test_coefficients_are_read_from_their_file_and_matter_in_contact_only():
    assert STRONG.files == {"mu_static_field": Path("strong.npy")}
    mask = replace(CORNER, values=np.array([[True, False]]))
    Scene(mask=mask, mu_static_field=field([[1.0, np.nan]]))
    with pytest.raises(ValueError, match="strong-00000000 must be finite and not negative"):
        Scene(mask=mask, mu_dynamic_field=field([[-1.0, 0.0]]))


ONES = field(np.ones((120, 120)))


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"mask": CORNER}, "n_blocks and n_rows must be those of the mask, 3 and 2"),
        ({"mask": replace(CORNER, values=None), **STRIPS}, "mask cannot be combined with n_p, n_s"),
        ({"mask": replace(CORNER, values=None), "n_p2": 8}, "mask cannot be combined with n_p2"),
        ({"mu_static_field": field(np.ones((2, 3)))}, r"strong-00000000 must have the shape"),
        ({"mu_static_field": ONES, "varied": {"mu_static_std": 0.3}}, "mu_static_std cannot be"),
        (
            dict.fromkeys(["mu_static_field", "mu_dynamic_field"], ONES)
            | {"varied": {"distribution": "weibull"}},
            "distribution cannot be varied",
        ),
        ({"n_p": 20}, "n_p = 20 needs n_s"),
        ({"n_s": 10}, "n_s = 10 needs n_p"),
        ({"n_p": 58, "n_s": 62, "n_p3": 8, "n_s3": 2}, "n_p3 = 8 needs n_p2"),
        (STRIPS | {"along_3": "x"}, "along_3 must be left out without n_p3, not 'x'"),
        ({"varied": {"a-b": 1}}, "unknown constant 'a-b'; choose from youngs_modulus, .*, step"),
        ({"varied": {"direction": 30}}, "direction is not a constant"),
        ({"varied": {"gamma": "much"}}, "gamma must be a number, not 'much'"),
    ],
)
def test_invalid_scenes_are_refused(given, sentence):
    with pytest.raises(ValueError, match=f"^{sentence}"):
        Scene(120, **given)


def test_sides_are_whole_and_long_enough():
    scenes = Scene(120), Scene(120, 5, 5), Scene(120, 6, 6), Scene(120, **STRIPS), CUT
    assert [scene.sides for scene in scenes] == [(), (), ("x", "y"), ("x",), ()]
    assert Scene(20, n_p2=8, n_s2=2).sides == ()  # strips across the whole surface
