"""The figures of the supplement draw without a warning and show the data they are given."""

from dataclasses import replace
from functools import cache, partial

import numpy as np
from matplotlib.figure import Figure

from springblock.io.records import Record
from springblock.model.blockmap import BlockMap
from springblock.model.scene import Scene
from study.paper.test_results import draw, ensemble, record

ISLANDS = np.indices((6, 9)).sum(axis=0) % 4 > 1


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


def draw_levels() -> Figure:
    """The second level alone, cut across and cut along."""
    along, across = ensemble(80e-6, 110e-6), ensemble(100e-6)
    patterns = (8, 2, 0, 0, ""), (8, 2, 18, 2, "x"), (8, 2, 18, 2, "y"), (25, 8, 7, 2, "x")
    made = {
        (*pattern, way): runs for pattern in patterns for way, runs in (("x", along), ("y", across))
    }
    return draw("supplement_levels", made)


DRAWINGS = {
    "supplement_levels": draw_levels,
    "supplement_grooves": draw_levels,
    "surfaces": draw_surfaces,
    "surfaces of one run": partial(draw_surfaces, 1),
}


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
