"""The figures of the supplement draw without a warning and show the data they are given."""

from dataclasses import replace
from functools import cache, partial

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from plotting.test_paper_results import marked, record
from springblock import Material
from springblock.io.records import Record
from springblock.model.blockmap import BlockMap
from springblock.model.scene import Scene
from springblock.plotting import drawing
from springblock.plotting.figures import FIGURES
from springblock.plotting.supplement import let_go_again
from springblock.study.configuration import Ensemble

ISLANDS = np.indices((6, 9)).sum(axis=0) % 4 > 1


@cache
def ensemble(friction: float, *peaks: float, runs: int = 4) -> list[Record]:
    """Runs with about this static friction."""
    made = [record(seed, peaks) for seed in range(runs)]
    return [
        replace(run, normal_force=run.force.max() / (friction + 0.01 * run.seed)) for run in made
    ]


@cache
def given(number: int) -> dict[str, dict]:
    """What each figure is drawn from, of so many runs of each surface."""

    def some(friction: float, *peaks: float) -> list[Record]:
        return ensemble(friction, *(peaks or (110e-6,)), runs=number)

    sizes = {(0, 0, "x", 60): some(0.8), (0, 0, "x", 120): some(0.79)}
    sizes |= {(20, 0, "x", 80): some(0.7), (58, 8, "y", 120): some(0.72)}
    levels = {("x", 2): some(0.7, 80e-6, 110e-6), ("x", 3): some(0.7, 90e-6, 110e-6)}
    levels |= {("y", 2): some(0.7, 100e-6), ("y", 3): some(0.7, 105e-6)}
    scenes = {(0, 0, "x"): some(0.8), (6, 0, "x"): some(0.6), (58, 8, "y"): some(0.7)}
    return {
        "spacing": {(2, 2): some(0.8), (2, 1): some(0.7), (6, 6): some(0.6), (6, 3): some(0.5)},
        "size": sizes,
        "angle": {"x": some(0.7), "45": some(0.6), "y": some(0.8)},
        "levels": levels,
        "restick": scenes,
    }


def draw(name: str, number: int = 6) -> Figure:
    return drawing(f"supplement_{name}")(given(number)[name])


@cache
def on_islands(number: int) -> list[Record]:
    """Runs on islands that let go from left to right, about t_max."""
    scene = Scene(mask=BlockMap("islands-1a2b3c4d", ISLANDS))
    made = [record(seed, (110e-6,)) for seed in range(number)]
    columns = np.linspace(0.8, 1.2, 9)
    times = [np.where(ISLANDS, run.t_max * (columns + 0.01 * run.seed), np.nan) for run in made]
    return [replace(run, scene=scene, t_det=t) for run, t in zip(made, times, strict=True)]


def draw_surfaces(number: int = 3) -> Figure:
    return drawing("surfaces")({name: on_islands(number) for name in ("first", "second")})


DRAWINGS = {"surfaces": draw_surfaces, "surfaces of one run": partial(draw_surfaces, 1)}
for name in given(1):
    DRAWINGS[f"supplement_{name}"] = partial(draw, name)
    DRAWINGS[f"supplement_{name} of one run"] = partial(draw, name, 1)


def means(ax: Axes) -> list[np.ndarray]:
    """Data of means with bars, (n, 2), in order of their drawing."""
    return [bars.lines[0].get_xydata() for bars in ax.containers]


@pytest.mark.parametrize(
    ("name", "line", "expected"),
    [
        ("spacing", 1, [(3, 0.525), (6, 0.625)]),
        ("size", 0, [(60 * 2**-0.03, 0.825 / 0.815), (120 * 2**-0.03, 1.0)]),  # left of three
        ("angle", 0, [(0, 0.725)]),
        ("angle", 1, [(45, 0.625)]),
    ],
)
def test_friction_is_a_mean_and_the_lag_of_every_realisation_a_dot(name, line, expected):
    friction, lag = draw(name).axes[:2]
    np.testing.assert_allclose(means(friction)[line], expected)
    each = [1e6 * (run.t_max - run.t_avg) for run in ensemble(0.8, 110e-6, runs=6)]
    dots = [one.get_ydata() for one in lag.get_lines() if one.get_marker() == "."]
    assert all(sorted(shown) == pytest.approx(sorted(each)) for shown in dots)
    assert len(dots) == {"spacing": 4, "size": 4, "angle": 3}[name]
    assert not lag.containers  # no mean, which may lie between two clusters


def test_each_level_has_its_load_peaks_marked():
    panels = draw("levels").axes
    assert panels[0].get_ylim() == panels[1].get_ylim()
    title, *names = (panels[0].get_legend().get_title(), *panels[0].get_legend().get_texts())
    assert title.get_text() == "$n_p/n_s$ of each level: lesser peak"
    assert all(name.get_text().startswith("6/6: ") for name in names)
    for ax, expected in zip(panels, ([80, 110, 90, 110], [100, 105]), strict=True):
        assert marked(ax) == pytest.approx(expected, abs=0.6)


def test_the_lesser_peak_is_shown_run_by_run():
    """Two hills alike, then one alone: what stands out is the valley, or nothing."""
    *_, lesser = draw("angle").axes
    assert lesser.get_ylabel() == "lesser peak (% of force)"
    dots = [line.get_xydata() for line in lesser.get_lines() if line.get_marker() == "."]
    assert [len(runs) for runs in dots] == [6, 6, 6]
    assert not np.concatenate(dots)[:, 1].any()
    hills = {"x": ensemble(0.7, 80e-6, 110e-6), "y": ensemble(0.7, 100e-6)}
    twin = drawing("supplement_angle")(hills)
    ((along,), (across,)) = means(twin.axes[2])
    assert along[1] > 80.0  # both hills rise from almost nothing
    assert across[1] == 0.0


def test_only_blocks_that_let_go_again_are_counted():
    run = ensemble(0.8, 110e-6)[0]
    assert not let_go_again(replace(run, switches=run.detachments)).any()
    once_more = run.detachments.copy()
    once_more[10] += 3
    again = let_go_again(replace(run, switches=once_more))
    blocks = np.count_nonzero(np.isfinite(run.t_det))
    assert again.tolist() == pytest.approx(3 * [300.0 / blocks])
    once_more[10], once_more[500] = run.detachments[10], 2  # at 91 % of t_max
    again = let_go_again(replace(run, switches=once_more))
    assert again.tolist() == pytest.approx([0.0, 0.0, 200.0 / blocks])
    assert len(draw("restick").axes[0].get_lines()) == 3 * (3 + 1)  # dots of surfaces, medians


def test_a_row_shows_the_mask_the_mean_times_and_the_force():
    (mask, times, force), others = np.split(draw_surfaces().axes, [3])
    np.testing.assert_array_equal(mask.images[0].get_array(), ISLANDS)
    expected = np.where(ISLANDS, np.linspace(0.8, 1.2, 9) + 0.01, np.nan)
    shown = np.ma.filled(times.images[0].get_array(), np.nan)
    np.testing.assert_allclose(shown, expected)
    assert force.get_ylim()[0] == 0.0
    names = [ax.get_title("left") for ax in (mask, *others)]
    assert names.count("n_blocks = 9, n_rows = 6, mask = islands-1a2b3c4d, direction = x") == 2


def test_a_block_that_has_not_let_go_in_a_run_has_no_mean_time():
    one, other = on_islands(2)
    short = replace(other, t_det=np.where(np.arange(9) < 8, np.nan, other.t_det))
    (image,) = drawing("surfaces")({"short": [one, short]}).axes[1].images
    known = np.isfinite(np.ma.filled(image.get_array(), np.nan))
    np.testing.assert_array_equal(known, ISLANDS & (np.arange(9) == 8))


def test_its_caption_names_what_is_ones_own():
    mu = BlockMap("strong-00000000", np.ones((4, 4)))
    weibull = Scene(4, n_rows=2, varied={"distribution": "weibull"})
    scenes = [Scene(mask=BlockMap("islands-1a2b3c4d", ISLANDS), edges="periodic"), weibull]
    scenes += [Scene(4, mu_static_field=mu)]
    ensembles = {"surfaces": [Ensemble(scene, range(3), None) for scene in scenes]}
    said = FIGURES["surfaces"].source.in_words(ensembles, {}, Material(distribution="uniform"))
    assert said == (
        "Sliding direction x. "
        "Surface islands-1a2b3c4d, n_rows = 6, periodic edges, N = 9 "
        "(3 realisations, seeds 0 to 2). "
        "Flat surface, distribution=weibull, n_rows = 2, N = 4 (3 realisations, seeds 0 to 2); "
        "mu_static from strong-00000000, N = 4 (3 realisations, seeds 0 to 2). "
        "Material of the paper, but distribution = uniform."
    )
