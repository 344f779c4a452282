"""Pictures of runs and of surfaces show what these hold, and stay on their pages."""

from dataclasses import replace
from functools import cache, partial

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from springblock import Pattern, Realisation, Surface, plot, simulate
from springblock.io.records import Record
from springblock.model.blockmap import BlockMap
from springblock.model.scene import Scene
from springblock.plotting.maps import painted, scale
from springblock.plotting.still import plot_fields, show
from springblock.plotting.style import BEFORE_AFTER, BLACK, CONTACT, NO_CONTACT
from springblock.simulation.fields import Fields
from study.paper.test_results import draw, record

PILLARS = Pattern.pillars(12, 4, 2)
ISLANDS = np.indices((6, 9)).sum(axis=0) % 4 > 1
GROOVED = Pattern.pillars(60, 28, 32).grooved(8, 2)
SURFACES = {
    "flat": Pattern.flat(8).contact,
    "grooved": GROOVED.contact,
    "oblong": GROOVED.contact[:20],
    "one row": np.array([[True, False, True]]),
    "one pillar in a corner": np.pad(np.ones((6, 5), bool), ((50, 4), (4, 51))),
}


@cache
def made() -> Realisation:
    """A run that ends when some blocks have detached and some have not, with two snapshots."""
    surface = Surface.draw(PILLARS.contact, 1)
    return simulate(surface, duration=1.6e-4, snapshot_times=(1e-4, 1.5e-4))


@cache
def oblong() -> Realisation:
    """The same run with its last three columns cut off."""
    cut = {name: getattr(made(), name)[..., :9] for name in ("t_det", "contact", "snapshots")}
    return replace(made(), **cut)


run = pytest.fixture(made, scope="module")


@cache
def kept(count: int) -> Fields:
    """Fields of the first so many of five times."""
    surface, times = Surface.draw(PILLARS.contact, 1), 1e-5 * np.arange(11, 16)
    return simulate(surface, duration=1.6e-4, snapshot_times=times[:count]).fields


@cache
def on_islands(number: int) -> list[Record]:
    """Runs on islands that let go from left to right, about t_max."""
    scene = Scene(mask=BlockMap("islands-1a2b3c4d", ISLANDS))
    made = [record(seed, (110e-6,)) for seed in range(number)]
    columns = np.linspace(0.8, 1.2, 9)
    times = [np.where(ISLANDS, run.t_max * (columns + 0.01 * run.seed), np.nan) for run in made]
    own = {"scene": scene, "contact": ISLANDS}
    return [replace(run, **own, t_det=t) for run, t in zip(made, times, strict=True)]


def draw_surfaces(number: int = 3) -> Figure:
    return draw("surfaces", {name: on_islands(number) for name in ("first", "second")})


#: Drawn for `test_every_figure.py`.
DRAWINGS = {"surfaces": draw_surfaces, "surfaces of one run": partial(draw_surfaces, 1)}
PICTURES = {
    "run": lambda: plot(made()),
    "oblong run": lambda: plot(oblong()),
    **{f"fields {count}": lambda k=count: plot_fields(kept(k), "its name") for count in (1, 5)},
    **{name: lambda c=c: show(c, 30, "its name") for name, c in SURFACES.items()},
}


def test_colours_tell_when_a_block_has_detached(run):
    image, detached = painted(run), np.isfinite(run.t_det)
    assert image.shape == (12, 12, 3)
    assert 0 < detached.sum() < run.contact.sum()
    expected = BEFORE_AFTER(scale(run.t_det / run.t_max)(run.t_det[detached] / run.t_max))[:, :3]
    np.testing.assert_array_equal(image[detached], expected)
    assert (image[run.contact & ~detached] == to_rgb(CONTACT)).all()
    assert (image[~run.contact] == to_rgb(NO_CONTACT)).all()


def test_what_is_still_to_come_is_not_seen_and_what_has_just_come_is_black(run):
    before, now = np.nanpercentile(run.t_det, (70, 90))
    image = painted(run, until=now, since=before)
    recent = (run.t_det > before) & (run.t_det <= now)
    assert recent.any()
    assert ((image == to_rgb(BLACK)).all(axis=2) == recent).all()
    assert (image[run.t_det > now] == to_rgb(CONTACT)).all()
    np.testing.assert_array_equal(image[run.t_det <= before], painted(run)[run.t_det <= before])


@pytest.mark.parametrize("made", [made, oblong])
def test_a_run_is_drawn_with_all_that_it_holds(made):
    run = made()
    force, times, blocks, *snapshots = plot(run).axes
    np.testing.assert_array_equal(force.get_lines()[0].get_ydata(), run.force / run.normal_force)
    assert blocks.patches
    np.testing.assert_array_equal(times.images[0].get_array(), painted(run))
    for ax, field in zip(snapshots, run.snapshots, strict=True):
        np.testing.assert_allclose(ax.images[0].get_array(), 1e9 * np.hypot(*field))
    assert [ax.get_title() for ax in snapshots] == ["100 µs", "150 µs"]


def test_a_run_in_which_nothing_detaches_has_no_times_to_be_drawn():
    run = simulate(Surface(PILLARS.contact, 1.0, 0.6), duration=1e-5)
    force, _ = plot(run).axes
    assert len(force.get_lines()) == 1  # no t_max, which is merely the end


def test_stress_is_mapped_above_slip():
    """In the same colours at all times; blocks without contact have none."""
    fields, chosen = kept(5), [0, 1, 3, 4]
    panels = plot_fields(fields).axes
    images = np.array([ax.images[0] for ax in panels]).reshape(2, 4)
    for row, values in zip(images, (1e-3 * fields.shear_stress, 1e9 * fields.slip), strict=True):
        assert len({image.get_clim() for image in row}) == 1
        for image, i in zip(row, chosen, strict=True):
            assert (image.get_array().mask == ~PILLARS.contact).all()
            np.testing.assert_allclose(image.get_array().filled(np.nan), values[i])
    assert [ax.get_title() for ax in panels[:4]] == ["110 µs", "120 µs", "140 µs", "150 µs"]


@pytest.mark.parametrize("name", SURFACES)
def test_blocks_are_those_of_the_mask(name):
    contact = SURFACES[name]
    whole, detail = show(contact, "x").axes
    np.testing.assert_array_equal(whole.images[0].get_array(), contact)
    left, right, bottom, top = detail.images[0].get_extent()
    left, right, bottom, top = (round(edge + 0.5) for edge in (left, right, bottom, top))
    np.testing.assert_array_equal(detail.images[0].get_array(), contact[bottom:top, left:right])
    assert contact[bottom:top, left:right].any()
    assert (top - bottom, right - left) == tuple(np.minimum(contact.shape, 24))


def test_a_row_shows_the_mask_the_mean_times_and_the_force():
    (mask, times, force), others = np.split(draw_surfaces().axes, [3])
    np.testing.assert_array_equal(mask.images[0].get_array(), ISLANDS)
    expected = np.where(ISLANDS, np.linspace(0.8, 1.2, 9) + 0.01, np.nan)
    shown = np.ma.filled(times.images[0].get_array(), np.nan)
    np.testing.assert_allclose(shown, expected)
    assert force.get_ylim()[0] == 0.0
    names = [ax.get_title("left") for ax in (mask, *others)]
    assert names.count("mask = islands-1a2b3c4d") == 2


def test_a_block_that_has_not_let_go_in_a_run_has_no_mean_time():
    one, other = on_islands(2)
    short = replace(other, t_det=np.where(np.arange(9) < 8, np.nan, other.t_det))
    (image,) = draw("surfaces", {"short": [one, short]}).axes[1].images
    known = np.isfinite(np.ma.filled(image.get_array(), np.nan))
    np.testing.assert_array_equal(known, ISLANDS & (np.arange(9) == 8))
