"""The figure of one's own surfaces: a row each, of what it is given."""

from dataclasses import replace
from functools import cache

import numpy as np
from matplotlib.figure import Figure

from plotting.test_ensembles import record
from springblock import Material
from springblock.io.records import Record
from springblock.model.blockmap import BlockMap
from springblock.model.scene import Scene
from springblock.plotting.figures import FIGURES
from springblock.plotting.supplement import surfaces
from springblock.study.configuration import Ensemble

ISLANDS = np.indices((6, 9)).sum(axis=0) % 4 > 1


@cache
def runs(number: int) -> list[Record]:
    """Runs on islands that let go from left to right, about t_max."""
    scene = Scene(mask=BlockMap("islands-1a2b3c4d", ISLANDS))
    made = [record(seed, (110e-6,)) for seed in range(number)]
    columns = np.linspace(0.8, 1.2, 9)
    times = [np.where(ISLANDS, run.t_max * (columns + 0.01 * run.seed), np.nan) for run in made]
    return [replace(run, scene=scene, t_det=t) for run, t in zip(made, times, strict=True)]


def drawing(number: int) -> Figure:
    return surfaces({"first": runs(number), "second": runs(number)})


DRAWINGS = {"surfaces": lambda: drawing(3), "surfaces of one run": lambda: drawing(1)}


def test_a_row_shows_the_mask_the_mean_times_and_the_force():
    mask, times, force = drawing(3).axes[:3]
    np.testing.assert_array_equal(mask.images[0].get_array(), ISLANDS)
    expected = np.where(ISLANDS, np.linspace(0.8, 1.2, 9) + 0.01, np.nan)
    shown = np.ma.filled(times.images[0].get_array(), np.nan)
    np.testing.assert_allclose(shown, expected)
    assert force.get_ylim()[0] == 0.0
    assert len(drawing(3).axes) == 6


def test_a_block_that_has_not_let_go_in_a_run_has_no_mean_time():
    one, other = runs(2)
    short = replace(other, t_det=np.where(np.arange(9) < 8, np.nan, other.t_det))
    (image,) = surfaces({"short": [one, short]}).axes[1].images
    known = np.isfinite(np.ma.filled(image.get_array(), np.nan))
    np.testing.assert_array_equal(known, ISLANDS & (np.arange(9) == 8))


def test_each_row_is_named_after_its_scene():
    names = [ax.get_title("left") for ax in drawing(1).axes]
    assert names.count("n_blocks = 9, n_rows = 6, mask = islands-1a2b3c4d, direction = x") == 2


def test_its_caption_names_what_is_ones_own():
    mu = BlockMap("strong-00000000", np.ones((4, 4)))
    weibull = Scene(4, n_rows=2, varied={"distribution": "weibull"})
    scenes = [Scene(mask=BlockMap("islands-1a2b3c4d", ISLANDS), edges="periodic"), weibull]
    scenes += [Scene(4, mu_static_field=mu)]
    ensembles = {"surfaces": [Ensemble(scene, range(3), None) for scene in scenes]}
    said = FIGURES["surfaces"].source.in_words(ensembles, {}, Material(distribution="uniform"))
    assert said == (
        "Sliding direction x. "
        "Surface islands-1a2b3c4d n_rows = 6, periodic edges, N = 9 (seeds 0 to 2). "
        "Flat distribution=weibull, n_rows = 2, N = 4 (seeds 0 to 2); "
        "mu_static from strong-00000000, N = 4 (seeds 0 to 2). "
        "Material of the paper, but distribution = uniform."
    )
