"""Textures have the area, symmetry and size of their lengths, whatever the lattice."""

import math

import numpy as np
import pytest

from springblock import Texture
from springblock.model.scene import Scene
from springblock.model.texture import KINDS

FEATURE, PITCH = 8e-5, 1.5e-4
HEXAGON = math.sqrt(3.0) / 2.0
SHARES = {
    ("discs", "square"): math.pi / 4.0 * (FEATURE / PITCH) ** 2,
    ("discs", "hexagonal"): math.pi / 4.0 * (FEATURE / PITCH) ** 2 / HEXAGON,
    ("holes", "hexagonal"): 1.0 - math.pi / 4.0 * (FEATURE / PITCH) ** 2 / HEXAGON,
    ("squares", "square"): (FEATURE / PITCH) ** 2,
    ("pits", "square"): 1.0 - (FEATURE / PITCH) ** 2,
    ("lamellae", "square"): FEATURE / PITCH,
}


@pytest.mark.parametrize(("kind", "arrangement"), SHARES)
def test_the_contact_fraction_tends_to_that_of_the_lengths(kind, arrangement):
    made = Texture(kind, FEATURE, PITCH, 1.2e-3, 2.5e-6, arrangement)
    assert made.contact.mean() == pytest.approx(SHARES[kind, arrangement], rel=0.01)


@pytest.mark.parametrize("kind", KINDS)
def test_a_texture_is_its_own_mirror_image(kind):
    contact = Texture(kind, FEATURE, PITCH, 6e-4, 5e-6).contact
    np.testing.assert_array_equal(contact, contact[::-1])
    np.testing.assert_array_equal(contact, contact[:, ::-1])


def test_a_side_is_that_of_the_nearest_whole_periods():
    """Of 150 µm along x and 260 µm along y in 1.2 mm: eight, and five."""
    made = Texture("holes", FEATURE, PITCH, 1.2e-3, 5e-6, "hexagonal")
    assert made.shape == (round(5 * 2.0 * HEXAGON * 30), 8 * 30)
    assert Texture("holes", FEATURE, PITCH, 1.3e-3, 5e-6).shape == (270, 270)


def test_neighbours_in_a_hexagonal_array_are_one_pitch_apart():
    (one, other) = Texture("discs", FEATURE, PITCH, 1e-3, 5e-6, "hexagonal").period.centres
    assert math.dist(one, other) == pytest.approx(PITCH)


def test_a_scene_has_the_blocks_of_its_texture_and_can_be_made_from_its_row():
    scene = Scene(texture="holes", feature=FEATURE, pitch=PITCH, width=6e-4, spacing=5e-6)
    assert (scene.n_blocks, scene.level) == (120, -1)
    assert Scene(**dict(scene.items())) == scene
    assert "--n-blocks" not in scene.options
    made = Texture("holes", FEATURE, PITCH, 6e-4, 5e-6)
    np.testing.assert_array_equal(scene.contact, made.contact)
    assert "holes of 8e-05 m at 0.00015 m, 0.0006 x 0.0006 m" in repr(made)


@pytest.mark.parametrize(
    ("changed", "sentence"),
    [
        (
            {"spacing": 4e-5},
            "gaps between them, 7e-05 m, have fewer than 4 blocks of 4e-05 m; choose",
        ),
        ({"pitch": 8.5e-5}, "gaps between them, 5e-06 m, have fewer than 4 blocks"),
        ({"pitch": 8e-5}, "features of 8e-05 m at a pitch of 8e-05 m overlap"),
        ({"width": 0.0}, "a texture needs width, a length in m, not 0"),
        ({"width": 0.5}, "the surface has 99990 blocks a side; choose at most 4096"),
        ({"n_p": 4, "n_s": 4}, "texture cannot be combined with n_p, n_s"),
        ({"texture": ""}, "feature needs texture: discs, holes"),
        ({"texture": "dots"}, "kind must be one of discs, holes"),
        ({"n_blocks": 100}, "must be those of the texture, 120 and 120, not 100 and 100"),
    ],
)
def test_textures_that_cannot_be_made_are_refused(changed, sentence):
    usual = {"texture": "holes", "feature": FEATURE, "pitch": PITCH, "width": 6e-4}
    with pytest.raises(ValueError, match=sentence.replace("(", r"\(")):
        Scene(**(usual | {"spacing": 5e-6} | changed))
