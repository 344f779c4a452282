"""A film of one run: what is to be seen when, and files that others can read."""

import numpy as np
import pytest
from imageio_ffmpeg import count_frames_and_secs
from matplotlib.colors import to_rgb
from PIL import Image, ImageSequence

from specimens import drawn
from springblock import Pattern, Realisation, Surface, animate, simulate
from springblock.plotting import film
from springblock.plotting.maps import painted
from springblock.plotting.style import VERMILION

PILLARS = Pattern.pillars(12, 4, 2)


@pytest.fixture(scope="module")
def run() -> Realisation:
    return simulate(drawn(PILLARS, 1), duration=2e-4)


@pytest.fixture
def brief(monkeypatch):
    """Films of fewer frames, which take less time to draw."""
    monkeypatch.setattr(film, "FRAMES", 24)


def test_a_film_begins_before_the_first_detachment_and_ends_after_the_last(run):
    times = film.moments(run)
    assert len(times) == film.FRAMES
    assert 0.0 < times[0] < run.t_first
    assert np.nanmax(run.t_det) < times[-1] <= run.time[-1]
    assert run.t_first - times[0] < 0.2 * (times[-1] - times[0])  # not half of it loading
    steps = np.diff(times)
    assert steps[0] > 0.0
    np.testing.assert_allclose(steps[: np.argmin(steps)], steps[0], rtol=1e-9)
    assert not steps[np.argmin(steps) :].any()  # and the end stays for a while


def test_where_nothing_detaches_the_whole_run_is_shown():
    times = film.moments(simulate(Surface(PILLARS.contact, 1.0, 0.6), duration=1e-5))
    assert (times[0], times[-1]) == (0.0, pytest.approx(1e-5))


def test_each_frame_shows_its_time(run):
    picture, update = film.scenery(run)
    blocks, force, share = picture.axes
    now, before = np.nanpercentile(run.t_det, [50, 40])
    update(now, before)
    np.testing.assert_array_equal(blocks.images[0].get_array(), painted(run, now, before))
    for ax, values in ((force, run.force / run.normal_force), (share, None)):
        _, so_far, cursor, *_ = ax.get_lines()
        assert (so_far.get_xdata() <= 1e6 * now).all()
        assert so_far.get_xdata()[-1] > 1e6 * (now - 2.1e-7)
        assert cursor.get_xdata() == [1e6 * now] * 2
        if values is not None:
            np.testing.assert_array_equal(so_far.get_ydata(), values[: len(so_far.get_ydata())])
    half = share.get_lines()[1].get_ydata()[-1]
    assert half == pytest.approx(50.0, abs=100.0 * 2.0 / run.contact.sum())


def test_nothing_is_left_of_the_frames_before(run, brief):
    frames = film.frames(run)
    assert all(side % 2 == 0 for side in frames[0].shape[:2])  # as players of MP4 need
    cursors = [(frame == 255.0 * np.array(to_rgb(VERMILION))).all(axis=2) for frame in frames]
    assert 0 < cursors[-1].sum() <= 1.1 * cursors[0].sum()


def test_films_have_every_frame_at_its_pace(run, brief, tmp_path):
    animate(run, str(tmp_path / "run.mp4"))
    count, seconds = count_frames_and_secs(str(tmp_path / "run.mp4"))
    assert (count, seconds) == (film.FRAMES, film.FRAMES / film.PER_SECOND)
    animate(run, tmp_path / "run.gif")
    with Image.open(tmp_path / "run.gif") as image:
        pauses = [frame.info["duration"] for frame in ImageSequence.Iterator(image)]
    assert sum(pauses) == pytest.approx(1000 * film.FRAMES / film.PER_SECOND)  # ms
    assert {file.name for file in tmp_path.iterdir()} == {"run.gif", "run.mp4"}
