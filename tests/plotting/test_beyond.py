"""The figures beyond the paper draw without a warning and show the data they are given."""

from dataclasses import replace
from functools import cache
from itertools import product

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from beyond.made_up import ensemble, grooves, lattices, sizes_and_distances
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


def two_factors(n_p, ratio):
    return 0.6 + 0.05 * np.log(n_p / 6.0) ** 2 - 0.1 * ratio


def friction() -> Figure:
    return drawing("beyond_friction")(by_folder(sizes_and_distances(two_factors)))


def disorder() -> Figure:
    """Decay lengths of 4, 2 and 1 blocks."""
    scatter = {}
    for n_p, (std, length) in product((3, 6, 10), {0.05: 4.0, 0.1: 2.0, 0.2: 1.0}.items()):
        scene = Scene(60, n_p, n_p, varied={} if std == 0.1 else {"mu_static_std": std})
        scatter[scene] = ensemble(scene, 0.7, length, runs=12)
    return drawing("beyond_disorder")(by_folder(scatter))


DRAWINGS = {f"beyond_{make.__name__}": make for make in (lattice, peaks, friction, disorder)}


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


def test_correlations_are_drawn_over_distances_in_micrometres():
    curves = drawn("beyond_lattice").axes[0].lines[:3]
    for spacing, curve in zip((5.0, 10.0, 20.0), curves, strict=True):
        np.testing.assert_allclose(np.diff(curve.get_xdata()), spacing)


def test_cells_hold_the_prominence_of_their_surface():
    for ax in drawn("beyond_peaks").axes[:2]:
        assert [text.get_text() for text in ax.texts][-3:] == ["97.0", "95.0", "92.0"]
        assert [label.get_text() for label in ax.get_xticklabels()] == ["0", "30", "90"]


def test_each_contact_fraction_has_its_curve():
    curves = bars(drawn("beyond_friction").axes[1])
    assert list(curves) == ["44% in contact", "25% in contact", "11% in contact"]
    for ratio, (n_p, values) in zip((0.5, 1.0, 2.0), (xy.T for xy in curves.values()), strict=True):
        np.testing.assert_allclose(values, two_factors(n_p, ratio), atol=1e-3)


def test_decay_lengths_are_those_of_the_times():
    lengths = bars(drawn("beyond_disorder").axes[0])["$n_p$ = 10"]
    np.testing.assert_allclose(lengths[:, 1], [4.0, 2.0, 1.0], rtol=0.4)
