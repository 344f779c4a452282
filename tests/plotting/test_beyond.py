"""The figures beyond the paper draw without a warning and show the data they are given."""

from dataclasses import replace
from functools import cache

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from beyond.made_up import ensemble, grooves, lattices, lean, sizes_and_distances
from springblock.io.records import Record
from springblock.model.scene import Scene
from springblock.plotting import drawing


def by_folder(*groups: dict[Scene, list[Record]]) -> dict[str, list[Record]]:
    """Realisations as the command hands them to a figure."""
    return {scene.folder: runs for group in groups for scene, runs in group.items()}


@cache
def lattice() -> Figure:
    """Static friction is 0.7 at 80 µm, whatever the lattice."""
    return drawing("beyond_lattice")(
        by_folder(lattices(lambda *_: 20.0, lambda *_: 80.0, runs=12)),
    )


def peaks() -> Figure:
    """Narrow pawls, below wider ones with lower peaks."""
    heights = {"x": 0.97, "30": 0.95, "y": 0.92}
    narrow = grooves(heights, runs=2), grooves(heights, 22, runs=2)
    wide: dict[Scene, list[Record]] = {}
    for scene, runs in grooves(dict.fromkeys(heights, 0.9), runs=2).items():
        wider = replace(scene, n_p2=10)
        wide[wider] = [replace(run, scene=wider) for run in runs]
    return drawing("beyond_peaks")(by_folder(*narrow, wide))


def friction() -> Figure:
    made = sizes_and_distances(lambda n_p, ratio: 0.6 + 0.05 * np.log(n_p / 6.0) ** 2 - 0.1 * ratio)
    return drawing("beyond_friction")(by_folder(made))


def precursors() -> Figure:
    angles = {
        (scene := Scene(60, 28, 32, 8, 2, direction=direction)): ensemble(scene, runs=10)
        for direction in ("x", "45", "y")
    }
    plain = {scene: ensemble(scene, runs=3) for scene in (Scene(60), Scene(60, 6, 6))}
    return drawing("beyond_precursors")(by_folder(plain, angles))


def disorder() -> Figure:
    """Variance as of independent blocks, 1e-2 / N², and l_c of two blocks."""
    scatter = {
        (scene := Scene(60, n_p, n_p, varied=varied)): ensemble(scene, 0.7, 2.0, runs=12)
        for n_p in (3, 6, 10)
        for varied in ((), (("mu_static_std", 0.05),), (("mu_static_std", 0.2),))
    }
    flat = {(scene := Scene(n)): lean(scene, 0.7, 40, 0.1 / n) for n in (12, 24, 48)}
    return drawing("beyond_disorder")(by_folder(scatter, flat))


DRAWINGS = {
    f"beyond_{make.__name__}": make for make in (lattice, peaks, friction, precursors, disorder)
}


drawn = cache(lambda name: DRAWINGS[name]())  # for tests that only look at it


def bars(ax: Axes) -> dict[str, np.ndarray]:
    """Values with intervals, (n, 2), by their names in the legend."""
    return {c.get_label(): c.lines[0].get_xydata() for c in ax.containers}


def test_friction_is_lowest_where_it_is_said_to_be():
    ax = drawn("beyond_lattice").axes[2]
    upper = {label: xy for label, xy in bars(ax).items() if "=" in label}
    assert list(upper) == ["$l$ = 5 µm", "$l$ = 10 µm", "$l$ = 20 µm"]
    for xy in upper.values():
        np.testing.assert_allclose(xy[:, 0], (20, 40, 80, 120, 240))
        np.testing.assert_allclose(xy[:, 1], 0.7 + 0.02 * np.log(xy[:, 0] / 80) ** 2, atol=2e-3)
    crosses = [float(c.lines[0].get_xdata()[0]) for c in ax.containers if "=" not in c.get_label()]
    np.testing.assert_allclose(crosses, 80.0)


def test_cells_hold_the_prominence_of_their_surface():
    for ax in drawn("beyond_peaks").axes[:2]:
        assert [text.get_text() for text in ax.texts][-3:] == ["97.0", "95.0", "92.0"]
        assert [label.get_text() for label in ax.get_xticklabels()] == ["0", "30", "90"]


def test_two_factors_that_add_up_describe_friction():
    """Dashes lie on the means of sizes that several contact fractions have."""
    ax = drawn("beyond_friction").axes[1]
    dashes = [line.get_xydata() for line in ax.get_lines() if line.get_markersize() == 7.0]
    assert len(dashes) == 3
    for model, means in zip(dashes, bars(ax).values(), strict=True):
        shown = np.isin(means[:, 0], model[:, 0])
        np.testing.assert_allclose(model, means[shown], atol=1e-3)


def test_clusters_begin_with_all_precursors():
    ax = drawn("beyond_precursors").axes[0]
    curves = [line.get_xydata() for line in ax.get_lines() if len(line.get_xdata())]
    assert len(curves) == 6  # two surfaces and their two kinds of chance
    for curve in curves:
        assert tuple(curve[0]) == (1.0, 1.0)
        assert (np.diff(curve[:, 1]) <= 0.0).all()


def test_the_variance_of_independent_blocks_lies_on_the_guide():
    ax = drawn("beyond_disorder").axes[2]
    ((label, points),) = bars(ax).items()
    assert label.startswith("flat: $x$ = ")
    np.testing.assert_allclose(points[:, 0], (144, 576, 2304))
    np.testing.assert_allclose(points[:, 1], 1e-2 / points[:, 0], rtol=0.8)
    lengths = bars(drawn("beyond_disorder").axes[0])["$n_p$ = 10"]
    np.testing.assert_allclose(lengths[:, 1], 2.0, atol=1.2)
