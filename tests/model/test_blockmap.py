"""Masks and coefficients from files: valid and invalid contents."""

import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from springblock.model.blockmap import BlockMap, Cut

CORNER = np.array([[1, 1, 0], [0, 0, 0]], bool)  # in contact at the lower left


@pytest.fixture
def saved(tmp_path):
    """Save an array as .npy or as the image that looks like it, or bytes, and return the file."""

    def save(values, name="corner.npy", mode=None):
        file = tmp_path / name
        if isinstance(values, bytes):
            file.write_bytes(values)
        elif file.suffix == ".npy":
            np.save(file, values, allow_pickle=True)
        else:
            image = Image.fromarray(values)
            (image.convert(mode) if mode else image).save(file)
        return file

    return save


@pytest.mark.parametrize("mode", ["1", "L", "P", "RGB", "RGBA"])
def test_an_image_is_seen_upright_however_it_is_stored(saved, mode):
    """Its lowest row of pixels is the first row of blocks, y = 0."""
    mask = BlockMap.mask(saved(CORNER[::-1], f"{mode}.png", mode))
    np.testing.assert_array_equal(mask.values, CORNER)
    assert mask.values.dtype == bool


def test_an_image_is_seen_as_its_camera_was_held(tmp_path):
    """Stored a quarter turn to the left, which orientation 6 of EXIF turns back."""
    (exif := Image.Exif())[0x0112] = 6
    pixels = np.ascontiguousarray(np.rot90(CORNER[::-1]))
    Image.fromarray(pixels.astype(np.uint8) * 255).save(tmp_path / "a.png", exif=exif)
    np.testing.assert_array_equal(BlockMap.mask(tmp_path / "a.png").values, CORNER)


@pytest.mark.parametrize("kind", [bool, int, np.uint8, float])
def test_nonzero_values_are_in_contact(saved, kind):
    mask = BlockMap.mask(saved(3 * CORNER.astype(int).astype(kind)))
    np.testing.assert_array_equal(mask.values, CORNER)


def test_a_name_depends_on_the_contents_only(saved):
    """Eight digits of content: neither how a mask is stored nor its own digits change them.

    The digits of a mask that a study keeps are not repeated; those of a date are not taken for any.
    """
    first = BlockMap.mask(saved(CORNER, "a corner (1).npy"))
    assert first.name.startswith("a_corner__1_-")
    digits = first.name[-8:]
    assert BlockMap.mask(saved(CORNER[::-1], "corner.png")).name == f"corner-{digits}"
    assert BlockMap.mask(saved(CORNER, f"corner-{digits}.npy")).name == f"corner-{digits}"
    assert BlockMap.mask(saved(CORNER, "scan-20260101.npy")).name == f"scan-20260101-{digits}"
    assert BlockMap.mask(saved(~CORNER)).name != f"corner-{digits}"
    assert BlockMap.mask(saved(CORNER.reshape(3, 2))).name != f"corner-{digits}"
    assert BlockMap.mask(saved(CORNER)) == BlockMap(f"corner-{digits}")  # what tables know of it


def test_coefficients_are_read_as_they_are(saved):
    mu = BlockMap.coefficients(saved(np.array([[1, 2], [0, np.nan]])))
    np.testing.assert_array_equal(mu.values, [[1.0, 2.0], [0.0, np.nan]])


GREY = np.array([[0, 7, 128], [200, 201, 255]], np.uint8)
PINK = np.stack([GREY, GREY, 255 - GREY], axis=-1)
CLEAR = np.zeros((2, 2, 4), np.uint8)


@pytest.mark.parametrize(
    ("values", "name", "sentence"),
    [
        (GREY, "a.png", "black and white"),
        (PINK, "a.png", "black and white"),
        (CLEAR, "a.png", "black and white"),
        (GREY.astype(np.uint16) * 257, "a.png", "black and white picture of 1 or 8 bits"),
        (~CORNER & CORNER, "a.npy", "zeros and one other value"),
        (np.eye(2) * np.nan, "a.npy", "zeros and one other value"),
        (np.arange(9).reshape(3, 3), "a.npy", "zeros and one other value"),
        (np.array([["a", ""]]), "a.npy", "must hold numbers"),
        (np.array([[{}, 1]], object), "a.npy", "allow_pickle=False"),
        (b"cos\nsystem\n(S'touch trapped'\ntR.", "a.npy", "magic string"),  # a pickle
        (np.ones(3, bool), "a.npy", r"must hold numbers, \(N_y, N_x\), not bool \(3,\)"),
        (np.ones((1, 4097), bool), "a.npy", "at most 4096 x 4096 blocks"),
        (np.ones((0, 3), bool), "a.npy", "zeros and one other value"),
        (b"no image", "a.png", "cannot identify image file"),
        (b"P5 64 64 255 torn", "a.png", "truncated"),
    ],
)
def test_invalid_masks_are_refused_in_one_sentence(saved, values, name, sentence):
    file = saved(values, name)
    with pytest.raises(ValueError, match=sentence) as refusal:
        BlockMap.mask(file)
    assert str(refusal.value).startswith(str(file))
    assert "\n" not in str(refusal.value)


def test_a_file_of_several_pictures_is_refused(tmp_path):
    pictures = [Image.fromarray(mask.astype(np.uint8) * 255) for mask in (CORNER, ~CORNER)]
    pictures[0].save(tmp_path / "a.gif", save_all=True, append_images=pictures[1:])
    with pytest.raises(ValueError, match=r"a.gif: it must be one black and white picture"):
        BlockMap.mask(tmp_path / "a.gif")


def test_coefficients_are_real_numbers(saved):
    with pytest.raises(ValueError, match=r"corner.npy: it must hold numbers"):
        BlockMap.coefficients(saved(np.ones((2, 2), complex)))


@pytest.mark.parametrize("read", [BlockMap.mask, BlockMap.coefficients])
@pytest.mark.parametrize("name", ["absent.npy", "absent.png"])
def test_a_missing_file_is_refused(read, name):
    with pytest.raises(ValueError, match=rf"^{name}: .*No such file"):
        read(Path(name))


def test_without_the_reader_a_topography_is_refused(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "SurfaceTopography", None)
    (tmp_path / "rough.opd").touch()
    with pytest.raises(ValueError, match=r"pip install 'springblock\[topography\]'"):
        Cut(tmp_path / "rough.opd", 1e-5, bearing_area=0.5).mask()
    with pytest.raises(ValueError, match=r"^absent: .*No such file"):
        Cut(Path("absent"), 1e-5, bearing_area=0.5).mask()
