"""The figures of the supplement draw without a warning and show the data they are given."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from plotting.test_ensembles import record
from springblock.io.records import Record
from springblock.plotting.supplement import (
    let_go_again,
    supplement_angle,
    supplement_levels,
    supplement_repetitions,
    supplement_restick,
    supplement_size,
    supplement_spacing,
)


@cache
def ensemble(friction: float, *peaks: float, runs: int = 4) -> list[Record]:
    """Runs with about this static friction."""
    made = [record(seed, peaks) for seed in range(runs)]
    return [
        replace(run, normal_force=run.force.max() / (friction + 0.01 * run.seed)) for run in made
    ]


def drawings(runs: int) -> dict[str, Callable[[], Figure]]:
    def some(friction: float, *peaks: float) -> list[Record]:
        return ensemble(friction, *(peaks or (110e-6,)), runs=runs)

    lengths = {(2, 2): some(0.8), (2, 1): some(0.7), (6, 6): some(0.6), (6, 3): some(0.5)}
    sizes = {(0, 0, "x", 60): some(0.8), (0, 0, "x", 120): some(0.79)}
    sizes |= {(20, 0, "x", 80): some(0.7), (58, 8, "y", 120): some(0.72)}
    levels = {
        ("x", 2): some(0.7, 80e-6, 110e-6),
        ("x", 3): some(0.7, 90e-6, 110e-6),
        ("y", 2): some(0.7, 100e-6),
        ("y", 3): some(0.7, 105e-6),
    }
    scenes = {(0, 0, "x"): some(0.8), (6, 0, "x"): some(0.6), (58, 8, "y"): some(0.7)}
    return {
        "spacing": lambda: supplement_spacing(lengths),
        "size": lambda: supplement_size(sizes),
        "angle": lambda: supplement_angle({"x": some(0.7), "45": some(0.6), "y": some(0.8)}),
        "levels": lambda: supplement_levels(levels),
        "repetitions": lambda: supplement_repetitions(scenes),
        "restick": lambda: supplement_restick(scenes),
    }


DRAWINGS = {f"supplement_{name}": draw for name, draw in drawings(6).items()}
DRAWINGS |= {f"supplement_{name} of one run": draw for name, draw in drawings(1).items()}


@cache
def drawn(name: str, runs: int = 6) -> Figure:
    """A figure for tests that only look at it."""
    return drawings(runs)[name]()


def lines(ax: Axes) -> list[np.ndarray]:
    """Data of the lines through means, (n, 2), in order of their drawing."""
    return [
        line.get_xydata()
        for line in ax.get_lines()
        if line.get_linewidth() in (0.6, 0.7) and line.get_linestyle() == "-"
    ]


@pytest.mark.parametrize(
    ("name", "line", "expected"),
    [
        ("spacing", 1, [(3, 0.525), (6, 0.625)]),
        ("size", 0, [(60, 0.825), (120, 0.815)]),
        ("angle", 0, [(0, 0.725), (45, 0.625), (90, 0.825)]),
    ],
)
def test_lines_go_through_the_means(name, line, expected):
    friction, lag = drawn(name).axes[:2]
    np.testing.assert_allclose(lines(friction)[line], expected)
    expected_lag = 1e6 * np.mean([run.t_max - run.t_avg for run in ensemble(0.8, 110e-6, runs=6)])
    np.testing.assert_allclose(lines(lag)[line][:, 1], expected_lag)


def test_each_level_has_its_load_peaks_marked():
    for ax, expected in zip(drawn("levels").axes, ([80, 110, 90, 110], [100, 105]), strict=True):
        peaks = [text.xy[0] for text in ax.texts if text.get_text() == "▼"]
        assert peaks == pytest.approx(expected, abs=0.6)


def test_the_lesser_peak_is_shown_run_by_run():
    """Two hills alike, then one alone: what stands out is the valley, or nothing."""
    *_, lesser = drawn("angle").axes
    assert lesser.get_ylabel() == "lesser peak (% of force)"
    dots = [line.get_xydata() for line in lesser.get_lines() if line.get_marker() == "."]
    assert [len(runs) for runs in dots] == [6, 6, 6]
    assert not np.concatenate(dots)[:, 1].any()
    twin = supplement_angle({"x": ensemble(0.7, 80e-6, 110e-6), "y": ensemble(0.7, 100e-6)})
    along, across = lines(twin.axes[2])[0]
    assert along[1] > 80.0  # both hills rise from almost nothing
    assert across[1] == 0.0


def test_intervals_narrow_with_the_root_of_the_number():
    friction, _ = drawn("repetitions", runs=20).axes
    measured, predicted = (line.get_xydata() for line in friction.get_lines()[:2])
    assert measured[:, 0].tolist() == [3, 5, 10, 20]
    np.testing.assert_allclose(predicted[:, 1] * np.sqrt(predicted[:, 0]), predicted[0, 1] * 3**0.5)
    assert measured[-1, 1] == pytest.approx(predicted[-1, 1], rel=0.1)


def test_only_blocks_that_let_go_again_are_counted():
    run = ensemble(0.8, 110e-6)[0]
    assert not let_go_again(replace(run, switches=run.detachments)).any()
    once_more = run.detachments.copy()
    once_more[10] += 3
    again = let_go_again(replace(run, switches=once_more))
    blocks = np.count_nonzero(np.isfinite(run.t_det))
    assert again[0] == 0.0
    assert again[-1] == pytest.approx(300.0 / blocks)
