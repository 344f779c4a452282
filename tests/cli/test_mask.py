"""springblock mask: from a measured surface to the blocks in contact."""

import warnings

import numpy as np
import pytest

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # of what it imports
    pytest.importorskip("SurfaceTopography")


@pytest.fixture
def rough(tmp_path):
    """A map of 6 x 4 points that are 10 µm apart, higher and higher."""
    lines = ["# Channel: Main", "# Width: 60 µm", "# Height: 40 µm", "# Value units: nm"]
    lines += [" ".join(f"{6 * y + x}" for x in range(6)) for y in range(4)]
    (tmp_path / "rough.txt").write_text("\n".join(lines), encoding="utf-8")
    return tmp_path / "rough.txt"


def test_a_mask_is_cut_for_the_solver(springblock, rough, tmp_path):
    mask = tmp_path / "mask.npy"
    said = springblock("mask", rough, "--bearing-area", 0.25, "--output", mask)
    assert said == f"{mask}: 4 x 6 blocks, 25.0% in contact\n"
    np.testing.assert_array_equal(np.flatnonzero(np.load(mask)), range(18, 24))
    springblock("mask", rough, "--height", 2e-8, "--spacing", 2e-5, "--output", mask)
    np.testing.assert_array_equal(np.load(mask), [[0, 0, 0], [0, 1, 1]])


def test_a_cut_says_how_deep_it_goes(springblock, rough, tmp_path):
    refusal = springblock("mask", rough, "--output", tmp_path / "mask.npy", refused=True)
    assert "rough.txt is cut at either a bearing_area or a height" in refusal
    assert not (tmp_path / "mask.npy").exists()
