"""The picture of one run shows what the run holds, and nothing else."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.colors import to_rgb

from springblock import Pattern, Realisation, draw_friction, plot, simulate
from springblock.plotting.maps import painted, scale
from springblock.plotting.style import BEFORE_AFTER, BLACK, CONTACT, NO_CONTACT

PILLARS = Pattern.pillars(12, 4, 2)
TIMES = (1e-4, 1.5e-4)


@pytest.fixture(scope="module")
def run() -> Realisation:
    """It ends when some blocks have detached and some have not."""
    scene = PILLARS.contact, *draw_friction(12, 1)
    return simulate(*scene, duration=1.6e-4, snapshot_times=TIMES)


def oblong(run: Realisation) -> Realisation:
    """The same run with its last three columns cut off."""
    cut = {name: getattr(run, name)[..., :9] for name in ("t_det", "contact", "snapshots")}
    return replace(run, **cut)


def test_colours_tell_when_a_block_has_detached(run):
    image, detached = painted(run), np.isfinite(run.t_det)
    assert image.shape == (12, 12, 3)
    assert 0 < detached.sum() < run.contact.sum()
    expected = BEFORE_AFTER(scale(run)(run.t_det[detached] / run.t_max))[:, :3]
    np.testing.assert_array_equal(image[detached], expected)
    assert (image[run.contact & ~detached] == to_rgb(CONTACT)).all()
    assert (image[~run.contact] == to_rgb(NO_CONTACT)).all()


def test_what_is_still_to_come_is_not_seen_and_what_has_just_come_is_black(run):
    before, now = np.nanpercentile(run.t_det, [30, 60])
    image = painted(run, until=now, since=before)
    recent = (run.t_det > before) & (run.t_det <= now)
    assert recent.any()
    assert ((image == to_rgb(BLACK)).all(axis=2) == recent).all()
    assert (image[run.t_det > now] == to_rgb(CONTACT)).all()
    np.testing.assert_array_equal(image[run.t_det <= before], painted(run)[run.t_det <= before])


@pytest.mark.parametrize("shape", [lambda run: run, oblong])
def test_a_run_is_drawn_with_all_that_it_holds(run, shape):
    run = shape(run)
    force, times, blocks, *snapshots = plot(run).axes
    np.testing.assert_array_equal(force.get_lines()[0].get_ydata(), run.force / run.normal_force)
    assert blocks.patches
    np.testing.assert_array_equal(times.images[0].get_array(), painted(run))
    (bar,) = times.child_axes
    assert "t_\\mathrm{det}" in bar.get_xlabel()
    for ax, field in zip(snapshots, run.snapshots, strict=True):
        np.testing.assert_allclose(ax.images[0].get_array(), 1e9 * np.hypot(*field))
    assert [ax.get_title() for ax in snapshots] == ["100 µs", "150 µs"]
    (displacement,) = snapshots[-1].child_axes
    assert displacement.get_ylabel().endswith("(nm)")


def test_a_run_in_which_nothing_detaches_has_no_times_to_be_drawn():
    run = simulate(PILLARS.contact, 1.0, 0.6, duration=1e-5)
    force, times = plot(run).axes
    assert len(force.get_lines()) == 1  # no t_max, which is merely the end
    words = [text.get_text() for text in times.get_legend().get_texts()]
    assert words == ["not detached", "not in contact"]


def test_of_many_snapshots_the_first_the_last_and_two_between_are_drawn(run):
    times = 1e-6 * np.arange(1.0, 11.0)
    many = replace(run, snapshot_times=times, snapshots=np.zeros((10, 2, 12, 12)))
    titles = [ax.get_title() for ax in plot(many).axes]
    assert [title for title in titles if title] == ["1 µs", "4 µs", "7 µs", "10 µs"]
