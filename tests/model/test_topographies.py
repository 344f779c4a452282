"""Contact masks from measured topographies, where SurfaceTopography is installed to read them."""

import warnings
from contextlib import nullcontext
from shlex import split
from types import SimpleNamespace

import numpy as np
import pytest

from springblock.model.blockmap import BlockMap, Cut

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # of what it imports
    SurfaceTopography = pytest.importorskip("SurfaceTopography")  # not in `make test-versions`


HEIGHTS = np.arange(12.0).reshape(3, 4)  # nm, points 10 µm apart; [y, x]
HEAD = "# Width: 40 µm\n# Height: 30 µm\n# Value units: nm\n"


def written(folder, heights=HEIGHTS, head=HEAD):
    """A height map as Gwyddion writes it, a line for each y."""
    rows = "\n".join("\t".join(map(str, row)) for row in heights)
    file = folder / "rough.txt"
    file.write_text(f"# Channel: Main\n{head}{rows}\n", encoding="utf-8")
    return file


def topography(heights, unit="µm"):
    return SurfaceTopography.Topography(heights.T, (40.0, 30.0), unit=unit)


@pytest.fixture
def opened(tmp_path, monkeypatch):
    """Return a file that opens as these measurements, in channels a and b."""

    def open_as(*measured):
        channels = [
            SimpleNamespace(
                name=name, index=i, dim=m.dim, physical_sizes=m.physical_sizes, unit=m.unit
            )
            for i, (name, m) in enumerate(zip("ab", measured, strict=False))
        ]
        reader = SimpleNamespace(
            channels=channels,
            default_channel=channels[0],
            topography=lambda channel_index: measured[channel_index],
        )
        monkeypatch.setattr(SurfaceTopography, "open_topography", lambda file: nullcontext(reader))
        return written(tmp_path)

    return open_as


def test_its_highest_blocks_are_in_contact(tmp_path):
    file = written(tmp_path)
    for count in (1, 3, 6, 12):
        contact = Cut(file, 1e-5, bearing_area=count / 12).mask()
        np.testing.assert_array_equal(np.flatnonzero(contact), range(12 - count, 12))


@pytest.mark.parametrize(
    ("spacing", "x", "y"),
    [
        (1e-5, range(4), range(3)),
        (2e-5, [1, 3], [1]),  # centres at 10 and 30 µm: where the second and fourth point begin
        (5e-6, np.repeat(range(4), 2), np.repeat(range(3), 2)),
        (1.5e-5, [0, 2], [0, 2]),  # and half a block left over along x
    ],
)
def test_a_block_has_the_height_at_its_centre(tmp_path, spacing, x, y):
    contact = Cut(written(tmp_path), spacing, height=6e-9).mask()
    np.testing.assert_array_equal(contact, HEIGHTS[np.ix_(y, x)] >= 6)


def test_plain_text_and_lists_of_points_need_a_unit_and_a_matrix_its_size(tmp_path):
    """A matrix of heights in nm, 4 x 3 pixels, 40000 nm wide, and the same as x, y and height."""
    y, x = np.indices(HEIGHTS.shape)
    matrix, points = tmp_path / "rough.txt", tmp_path / "rough.xyz"
    np.savetxt(matrix, HEIGHTS)
    np.savetxt(points, np.column_stack([1e4 * x.ravel(), 1e4 * y.ravel(), HEIGHTS.ravel()]))
    how = {"height": 6e-9, "unit": "nm"}
    for cut in (Cut(matrix, 1e-5, size=4e4, **how), Cut(points, 1e-5, **how)):
        np.testing.assert_array_equal(cut.mask(), HEIGHTS >= 6)


@pytest.mark.parametrize(
    ("detrend", "trend"),
    [("plane", lambda x, y: 30 * x - 7 * y + 2), ("quadratic", lambda x, y: 9 * x**2 - 4 * x * y)],
)
def test_a_trend_does_not_decide_the_contact(tmp_path, detrend, trend):
    """Islands that no quadratic surface resembles, 1 nm high on a trend of some 100 nm."""
    y, x = np.indices((12, 16))
    islands = (x // 2 + y // 2) % 2 == 0
    file = written(tmp_path, islands + trend(x, y))
    cut = {"spacing": 2.5e-6, "bearing_area": 0.5}
    np.testing.assert_array_equal(Cut(file, **cut, detrend=detrend).mask(), islands)
    assert (Cut(file, **cut).mask() != islands).any()


def test_heights_come_from_the_channel_that_is_named(opened):
    file = opened(topography(HEIGHTS), topography(-HEIGHTS))
    for channel, highest in ((None, 11), ("a", 11), ("b", 0)):
        contact = Cut(file, 1e-5, bearing_area=1 / 12, channel=channel).mask()
        assert np.flatnonzero(contact) == [highest]
    with pytest.raises(ValueError, match=r"channel must be one of \['a', 'b'\], not 'c'"):
        Cut(file, 1e-5, bearing_area=0.5, channel="c").mask()


def test_options_of_the_command_are_those_of_the_cut(springblock, tmp_path):
    file, mask = written(tmp_path, HEIGHTS**2), tmp_path / "mask.npy"
    cut = Cut(file, 1e-5, height=0.0, channel="Main", detrend="plane")
    springblock("mask", file, *split(cut.arguments), "--output", mask)
    np.testing.assert_array_equal(np.load(mask), cut.mask())


@pytest.mark.parametrize(
    ("bearing_area", "near"), [(1 / 12, 0.25), (0.5, 0.75), (0.01, 0.25), (1.0, 0.75)]
)
def test_a_bearing_area_that_no_level_gives_is_refused(opened, bearing_area, near):
    """Three blocks are equally high, six lower, and three were not measured."""
    heights = np.repeat([[2.0, 1.0, 1.0, np.nan]], 3, axis=0)
    file = opened(topography(np.ma.masked_invalid(heights)))
    with pytest.raises(ValueError, match=rf"bearing_area, for instance {near}, or a height$"):
        Cut(file, 1e-5, bearing_area=bearing_area).mask()
    assert Cut(file, 1e-5, bearing_area=near).mask().mean() == near


def test_a_name_has_all_that_a_cut_was_made_with(tmp_path):
    """Levels to the last digit, so that no two have one name."""
    file = written(tmp_path)
    how = [{"bearing_area": 0.5}, {"height": 1.23456789e-9}, {"height": 1.2345678e-9}]
    how.append({"channel": "Main", "detrend": "plane", "bearing_area": 1})
    names = [BlockMap.of_topography(Cut(file, 1e-5, **each), tmp_path).name[:-9] for each in how]
    levels = ["0.5", "1.23456789e-09", "1.2345678e-09", "Main_plane_1.0"]
    assert names == [f"rough_{level}" for level in levels]


def test_jobs_read_what_was_cut(tmp_path):
    cut = Cut(written(tmp_path), 1e-5, bearing_area=0.5)
    mask = BlockMap.of_topography(cut, tmp_path)
    assert mask.name.startswith("rough_0.5-")
    np.save(mask.file, mask.values)
    assert BlockMap.mask(mask.file) == mask


@pytest.mark.parametrize(
    ("head", "how", "sentence"),
    [
        ("", {"height": 1e-9}, "how large the map is; give size and unit"),
        ("", {"height": 1e-9, "size": 40.0}, "a unit of length; or give unit"),
        (HEAD, {"height": 1e-9, "size": 40.0}, "its size is .*; leave out size = 40.0"),
        (HEAD, {"height": 1e-9, "unit": "nm"}, "its unit is .*; leave out unit = nm"),
        ("# Width: 40 µm\n# Height: 30 µm\n", {"height": 1e-9}, "a unit of length"),
        (HEAD, {"height": 1.0}, "no block reaches the height of 1.0 m"),
        (HEAD, {"height": 1e-9, "spacing": 1.0}, "spacing must put 1 to 4096 blocks on each side"),
        (HEAD, {"height": 1e-9, "spacing": 1e-12}, "spacing must put"),
        (HEAD, {"height": 1e-9, "spacing": 0.0}, "spacing must put"),
        (HEAD, {}, "either a bearing_area"),
        (HEAD, {"height": 1e-9, "bearing_area": 0.5}, "either a bearing_area"),
        (HEAD, {"bearing_area": 0.0}, "bearing_area in .0, 1."),
        (HEAD, {"bearing_area": 30}, "bearing_area in .0, 1."),
    ],
)
def test_invalid_cuts_are_refused(tmp_path, head, how, sentence):
    file = written(tmp_path, head=head)
    with pytest.raises(ValueError, match=sentence):
        Cut(file, **{"spacing": 1e-5, **how}).mask()


@pytest.mark.parametrize(
    ("measured", "sentence"),
    [
        # as an atomic force microscope may leave them
        (topography(HEIGHTS, unit="V"), "Unit 'V'"),
        (topography(np.ma.masked_all((3, 4))), "no height puts a share of 0.5"),
        (SurfaceTopography.UniformLineScan(HEIGHTS[0], 4e-5, unit="m"), "map of heights"),
    ],
)
def test_what_is_no_map_of_heights_is_refused(opened, measured, sentence):
    with pytest.raises(ValueError, match=rf"rough.txt.* {sentence}"):
        Cut(opened(measured), 1e-5, bearing_area=0.5).mask()


@pytest.mark.parametrize("name", ["rough.txt", "rough.xyz"])
def test_other_files_are_refused_in_one_sentence(tmp_path, name):
    file = tmp_path / name
    file.write_text("no heights at all")
    with pytest.raises(ValueError, match=rf"^\S+{name}") as refusal:
        Cut(file, 1e-5, bearing_area=0.5).mask()
    assert "\n" not in str(refusal.value)


def test_blocks_without_a_height_are_not_in_contact(opened):
    """And the bearing area counts all blocks: half of them are the six highest."""
    holes = opened(topography(np.ma.masked_greater(HEIGHTS, 9)))
    contact = Cut(holes, 1e-5, bearing_area=0.5).mask()
    np.testing.assert_array_equal(np.flatnonzero(contact), range(4, 10))


def test_whatever_a_reader_fails_with_is_one_sentence(tmp_path, monkeypatch):
    monkeypatch.setattr(SurfaceTopography, "open_topography", lambda file: {}["scan"])
    with pytest.raises(ValueError, match=r"rough.txt: 'scan'"):
        Cut(written(tmp_path), 1e-5, bearing_area=0.5).mask()
