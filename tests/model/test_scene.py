"""Scenes: valid combinations of lengths, and the surfaces that they describe."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from springblock.io.identity import identity
from springblock.io.rows import scene_of
from springblock.io.schemas import SCENE
from springblock.model.blockmap import BlockMap
from springblock.model.scene import FIELDS, Scene, differing, expand

STRIPS = {"n_p": 58, "n_s": 62, "n_p2": 8, "n_s2": 2}
CUT = Scene(120, **STRIPS, n_p3=8, n_s3=2)
#: A surface of 2 x 3 blocks.
CORNER = BlockMap("corner-1a2b3c4d", np.array([[1, 1, 0], [0, 0, 0]], bool), Path("a corner.npy"))
OWN = Scene(mask=CORNER, edges="periodic")


def field(values):
    return BlockMap("strong-00000000", np.array(values, float), Path("strong.npy"))


STRONG = Scene(2, mu_static_field=field(np.ones((2, 2))), distribution="weibull")


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


def test_scenes_differ_in_the_constants_that_are_not_the_same():
    fast = Scene(9, slider_velocity=1e-3, gamma=0)
    assert differing(scene.values for scene in (Scene(9), fast)) == ["slider_velocity", "gamma"]
    assert fast == Scene(9, gamma=0.0, slider_velocity=1e-3) != Scene(9)
    assert Scene(9, n_rows=9, sample_interval=2e-7) == Scene(9)
    assert Scene(9, slider_velocity=5e-2).sample_interval == 2e-8  # for as many samples as it needs


@pytest.mark.parametrize(
    ("scene", "folder", "options"),
    [
        (
            CUT,
            "hierarchy-58-62-8-2-8-2-y-x",
            "--n-blocks 120 --n-p 58 --n-s 62 --n-p2 8 --n-s2 2 --n-p3 8 --n-s3 2 --along-3 y",
        ),
        (
            Scene(24, 4, 2, n_rows=12, direction="30"),
            "pillars-4-2-30",
            "--n-blocks 24 --n-p 4 --n-s 2 --direction 30 --n-rows 12",
        ),
        (
            Scene(9, step=1e-8, gamma=0, duration=2e-5, snapshot_times=[1e-5, 2e-5]),
            "flat-x-gamma-0.0-step-1e-08",
            "--n-blocks 9 --gamma 0.0 --step 1e-08 --duration 2e-05 --snapshot-times 1e-05,2e-05",
        ),
        (
            Scene(9, law="slip_weakening", slip_distance=1e-7),
            "flat-x-law-slip_weakening-slip_distance-1e-07",
            "--n-blocks 9 --law slip_weakening --slip-distance 1e-07",
        ),
        (
            OWN,  # named by its contents and read from its file
            "corner-1a2b3c4d-x",
            "--edges periodic --mask 'a corner.npy'",
        ),
        (
            STRONG,
            "flat-x-distribution-weibull",
            "--n-blocks 2 --mu-static-field strong.npy --distribution weibull",
        ),
    ],
)
def test_folders_options_and_rows_identify_a_scene(scene, folder, options):
    assert scene.folder == folder
    assert scene.options == options
    assert list(identity(scene)) == SCENE.names == ["level", *FIELDS]
    assert scene_of(identity(scene)) == scene


def test_a_grid_has_every_combination_in_the_order_of_the_fields():
    """n_s follows n_p, and of several laws each has only its own constants."""
    sizes = [
        (row["n_p"], row["n_s"]) for row in expand({"n_s": ["n_p", "n_p/2", 3], "n_p": [4, 6]})
    ]
    assert sizes == [(4, 4), (4, 2), (4, 3), (6, 6), (6, 3), (6, 3)]
    laws = {"slip_distance": [1e-8, 2e-8], "law": ["coulomb", "slip_weakening"]}
    rows = [(row["law"], row.get("slip_distance")) for row in expand(laws)]
    assert rows == [("coulomb", None)] * 2 + [("slip_weakening", 1e-8), ("slip_weakening", 2e-8)]
    file = Path(__file__).parents[2] / "config/examples/exponential_weakening.py"
    ways = [row.get("d_0") for row in expand({"d_0": [1e-8, 2e-8], "law": ["coulomb", str(file)]})]
    assert ways == [None, None, 1e-8, 2e-8]


def test_a_mask_replaces_the_pattern():
    assert (OWN.shape, OWN.level, OWN.sides, OWN.lengths) == ((2, 3), -1, (), {})
    assert OWN.contact is CORNER.values
    assert Scene(3, n_rows=2, edges="periodic") != OWN
    with pytest.raises(ValueError, match="mask corner-1a2b3c4d is not a pattern of pillars"):
        _ = OWN.pattern


def test_a_table_contains_only_the_name_of_a_mask():
    known = scene_of(identity(OWN))
    assert known == OWN
    assert (known.shape, known.mask.values) == ((2, 3), None)
    with pytest.raises(ValueError, match="mask corner-1a2b3c4d are not available, only its name"):
        _ = known.contact
    assert identity(OWN)["n_rows"] == 2
    assert identity(Scene(9))["n_rows"] == 9


def test_the_paper_has_squares_with_edges_whose_coefficients_are_drawn():
    field_of_ones = field(np.ones((4, 4)))
    assert all(s.is_papers for s in (Scene(4), CUT, Scene(4, n_rows=4), Scene(4, direction="30")))
    others = [OWN, Scene(4, n_rows=2), Scene(4, edges="periodic")]
    others += [Scene(4, mu_static_field=field_of_ones), Scene(4, mu_dynamic_field=field_of_ones)]
    assert not any(scene.is_papers for scene in others)


def test_coefficients_are_read_from_their_file_and_matter_in_contact_only():
    assert STRONG.files == ["strong.npy"]
    mask = replace(CORNER, values=np.array([[True, False]]))
    Scene(mask=mask, mu_static_field=field([[1.0, np.nan]]))
    with pytest.raises(ValueError, match="strong-00000000 must be finite and not negative"):
        Scene(mask=mask, mu_dynamic_field=field([[-1.0, 0.0]]))


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"n_blocks": 0}, "the surface has no size; give n_blocks or a mask"),
        ({"mask": CORNER}, "n_blocks and n_rows must be those of the mask, 3 and 2"),
        ({"mask": replace(CORNER, values=None), **STRIPS}, "mask cannot be combined with n_p, n_s"),
        ({"mask": replace(CORNER, values=None), "n_p2": 8}, "mask cannot be combined with n_p2"),
        ({"mu_static_field": field(np.ones((2, 3)))}, r"strong-00000000 must have the shape"),
        ({"n_p": 20}, "n_p = 20 needs n_s"),
        ({"n_s": 10}, "n_s = 10 needs n_p"),
        ({"n_p": 58, "n_s": 62, "n_p3": 8, "n_s3": 2}, "n_p3 = 8 needs n_p2"),
        (STRIPS | {"along_3": "x"}, "along_3 must be left out without n_p3, not 'x'"),
        ({"gamma": -1.0}, "Scene.gamma must be finite and zero or positive"),
        ({"edges": "open"}, "Scene.edges must be one of free, periodic, not 'open'"),
    ],
)
def test_invalid_scenes_are_refused(given, sentence):
    with pytest.raises(ValueError, match=f"^{sentence}"):
        Scene(**{"n_blocks": 120, **given})


def test_sides_are_whole_and_long_enough():
    scenes = Scene(120), Scene(120, 5, 5), Scene(120, 6, 6), Scene(120, **STRIPS), CUT
    assert [scene.sides for scene in scenes] == [(), (), ("x", "y"), ("x",), ()]
    assert Scene(20, n_p2=8, n_s2=2).sides == ()  # strips across the whole surface
