"""The figures of ensembles draw without a warning and show the data they are given."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from springblock import Pattern
from springblock.analysis.statistics import whole_curve
from springblock.io.records import Record
from springblock.model.scene import Scene
from springblock.plotting.curves import draw_single_forces
from springblock.plotting.figures import SINGLE
from springblock.plotting.looks import pillar_look
from springblock.plotting.paper_results import figure_5, figure_6, figure_9

SIZE = 6
PILLARS = Pattern.pillars(24, SIZE, SIZE)
ASKEW = Scene(24, SIZE, SIZE, direction="30")
NORMAL_FORCE = 1.3e-3


def record(seed: int, peaks: tuple[float, ...] = (110e-6,), samples: int = 700) -> Record:
    """A force with hills at `peaks`; blocks let go from the edge of their pillar to its middle."""
    rng = np.random.default_rng(seed)
    time = 2e-7 * np.arange(samples - 3 * seed)
    force = 1e-4 * np.minimum(time / peaks[0], 1.0)
    force += sum(1e-3 * np.exp(-(((time - peak) / 8e-6) ** 2)) for peak in peaks)
    from_edge = np.minimum(np.arange(SIZE), np.arange(SIZE)[::-1])
    place = 100e-6 + 5e-6 * np.add.outer(2.0 * from_edge, from_edge)
    t_det = np.full((24, 24), np.nan)
    for y, x in PILLARS.origins:
        t_det[y : y + SIZE, x : x + SIZE] = place
    t_det += rng.normal(0.0, 1e-6, t_det.shape)
    detachments = np.histogram(t_det[PILLARS.contact], np.append(-1.0, time))[0].astype(np.int32)
    return Record(
        scene=Scene(24, SIZE, SIZE),
        seed=seed,
        time=time,
        force=force * (1.0 + 0.01 * rng.standard_normal()),
        normal_force=NORMAL_FORCE,
        detachments=detachments,
        switches=detachments,
        t_det=t_det,
        contact=np.isfinite(t_det),
    )


@cache
def ensemble(*peaks: float, runs: int = 4) -> list[Record]:
    return [record(seed, peaks) for seed in range(runs)]


def along_and_across(runs: int = 4):
    """Two configurations of grooves, one of which was slid along them alone."""
    return {
        (8, 2, "x"): ensemble(80e-6, 110e-6, runs=runs),
        (8, 2, "y"): ensemble(100e-6, runs=runs),
        (4, 2, "x"): ensemble(90e-6, runs=runs),
    }


def sizes(runs: int = 4):
    peaks = {0: 60e-6, 2: 80e-6, 6: 100e-6, 20: 120e-6}
    return {n_p: ensemble(peak, runs=runs) for n_p, peak in peaks.items()}


DRAWINGS: dict[str, Callable[[], Figure]] = {
    "figure_5": lambda: figure_5(ensemble(110e-6)),
    "figure_6": lambda: figure_6(sizes()),
    "figure_9": lambda: figure_9(along_and_across()),
    "figure_5 of one run": lambda: figure_5([replace(record(0), scene=ASKEW)]),
    "figure_6 of one run": lambda: figure_6(sizes(runs=1)),
    "figure_9 of one run": lambda: figure_9(along_and_across(runs=1)),
}


@cache
def drawn(name: str) -> Figure:
    """A figure for tests that only look at it."""
    return DRAWINGS[name]()


def lines(ax):
    """Data of the lines of a panel, (n, 2), by label."""
    return {line.get_label(): line.get_xydata() for line in ax.get_lines()}


def test_figure_5_maps_the_mean_and_tells_sides_apart():
    pillar, rings = drawn("figure_5").axes
    shown = np.ma.filled(pillar.images[0].get_array(), np.nan)
    starts = PILLARS.origins
    cut = [r.t_det[y : y + SIZE, x : x + SIZE] for r in ensemble(110e-6) for y, x in starts]
    np.testing.assert_allclose(shown, np.mean(cut, axis=0) / 110e-6)
    bars = {bar.get_label(): bar.lines[0].get_xydata() for bar in rings.containers}
    corners, along_y, along_x = bars.values()
    assert [label.split(" (")[0] for label in bars] == [
        "corners",
        "sides along $y$",
        "sides along $x$",
    ]
    assert [len(part) for part in (corners, along_y, along_x)] == [3, 2, 2]  # rings
    assert corners[0, 1] == pytest.approx(shown[[0, 0, -1, -1], [0, -1, 0, -1]].mean())
    assert along_y[0, 1] == pytest.approx(shown[1:-1, [0, -1]].mean())
    assert along_x[0, 1] == pytest.approx(shown[[0, -1], 1:-1].mean())


def test_figure_6_shows_every_size_and_marks_both_times():
    force, friction, _, lag = drawn("figure_6").axes
    curves = lines(force)
    mean = np.mean([r.force[:691] / NORMAL_FORCE for r in ensemble(100e-6)], axis=0)
    np.testing.assert_allclose(curves["$n_p$ = 6"][:, 1], mean)
    dots = [line.get_xydata()[0, 0] for line in force.get_lines() if len(line.get_xydata()) == 1]
    for n_p, runs in sizes().items():
        assert ("flat" if n_p == 0 else f"$n_p$ = {n_p}") in curves
        assert pytest.approx(1e6 * runs[0].t_max) in dots
        assert pytest.approx(1e6 * np.mean([r.t_avg for r in runs])) in dots
    for ax in (friction, lag):
        shown = [bar.lines[0].get_xydata()[0] for bar in ax.containers]
        assert [x for x, _ in shown] == [2.0, 6.0, 20.0]
    assert shown[1][1] == pytest.approx(100.0 - 1e6 * np.mean([r.t_avg for r in ensemble(100e-6)]))


def marked(ax) -> list[float]:
    """Times of the triangles of a panel, µs."""
    return [text.xy[0] for text in ax.texts if text.get_text() == "▼"]


def test_figure_9_marks_the_load_peaks_of_the_data():
    """A row for each configuration, in order of their pawls."""
    narrow, _, wide, _ = drawn("figure_9").axes
    names = ["along grooves: 2 load peaks", "across grooves: 1 load peak"]
    assert [text.get_text() for text in wide.get_legend().get_texts()] == names
    assert marked(wide) == pytest.approx([80.0, 110.0, 100.0], abs=0.5)
    assert marked(narrow) == pytest.approx([90.0], abs=0.5)
    assert ["8/2" in text.get_text() for text in wide.texts].count(True) == 1


def test_figure_9_shows_every_single_run():
    wide = drawn("figure_9").axes[2]
    thin = [line.get_xydata() for line in wide.get_lines() if line.get_linewidth() == 0.3]
    for runs, shown in ((ensemble(80e-6, 110e-6), thin[:4]), (ensemble(100e-6), thin[4:])):
        for run, line in zip(runs, shown, strict=True):
            ended = np.isnan(line[:, 1])
            assert len(run.time) == np.count_nonzero(~ended)
            np.testing.assert_allclose(line[~ended, 1], run.force / NORMAL_FORCE)


def test_no_more_single_runs_are_shown_than_can_be_told_apart():
    ax = Figure().subplots()
    draw_single_forces(ax, whole_curve(ensemble(100e-6) * 6), "black")  # 24 runs
    assert len(ax.get_lines()) == SINGLE == 20


def test_curves_go_on_past_the_shortest_run():
    """Solid while all runs go on, dotted and over the rest of them as long as half are left."""
    runs = ensemble(100e-6)  # they end after 700, 697, 694 and 691 samples
    force, blocks = (drawn("figure_6").axes[i] for i in (0, 2))
    solid = lines(force)["$n_p$ = 6"]
    (dotted,) = (
        line.get_xydata()
        for line in force.get_lines()
        if line.get_linestyle() == "--"
        and len(line.get_xydata()) > 1
        and np.array_equal(line.get_xydata()[0], solid[-1])
    )
    assert len(solid) == 691
    shown = dotted[np.isfinite(dotted[:, 1])]
    assert len(solid) + len(shown) - 1 == 697
    rest = np.mean([run.force[691:697] / NORMAL_FORCE for run in runs[:2]], axis=0)
    np.testing.assert_allclose(shown[-3:, 1], rest[-3:])
    for steps, n_p in zip(blocks.patches, sizes(), strict=True):
        shares = steps.get_data()
        assert shares.edges[-1] == pytest.approx(138.0)  # whole bins of the longest run
        late = np.mean(
            [np.sum(r.t_det > 138e-6) / np.isfinite(r.t_det).sum() for r in sizes()[n_p]]
        )
        assert shares.values.sum() == pytest.approx(100.0 * (1.0 - late), abs=0.01)


def test_pillars_look_the_same_wherever_they_are_drawn():
    """Neighbouring sizes differ in their marker, and in lightness for those who see no colour."""
    looks = [pillar_look(n_p) for n_p in (0, 2, 3, 4, 5, 6, 10, 20, 30, 60)]
    assert len({look["marker"] for look in looks}) == len(looks)
    grey = [np.dot(to_rgb(look["color"]), (0.299, 0.587, 0.114)) for look in looks]
    assert (np.diff(grey) > 0.0).all()
