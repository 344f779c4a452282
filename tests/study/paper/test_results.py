"""Figures 2, 3, 5, 6, 7 and 9 show the runs and the tables that they are given."""

from dataclasses import replace
from functools import cache

import numpy as np
import pandas as pd
import pytest
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from springblock import Pattern
from springblock.analysis.statistics import prominence_of_mean
from springblock.io.identity import identity
from springblock.io.records import Record
from springblock.io.rows import limits
from springblock.model.scene import Scene
from springblock.plotting.maps import painted, scale
from springblock.study.results import FIGURES

SIZE = 6
PILLARS = Pattern.pillars(24, SIZE, SIZE)
ASKEW = Scene(24, SIZE, SIZE, direction="30")
NORMAL_FORCE = 1.3e-3


def record(seed: int, peaks: tuple[float, ...] = (110e-6,)) -> Record:
    """A force with hills at `peaks`; blocks let go from the edge of their pillar to its middle."""
    rng = np.random.default_rng(seed)
    time = 2e-7 * np.arange(700 - 3 * seed)
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
        switches=detachments + (time > 120e-6),
        t_det=t_det,
        contact=np.isfinite(t_det),
    )


@cache
def ensemble(*peaks: float, runs: int = 4) -> list[Record]:
    return [record(seed, peaks) for seed in range(runs)]


def along_and_across(runs: int = 4):
    """Two configurations of grooves, one of which was slid along them alone."""
    return {
        (8, 2, 0, 0, "", "x"): ensemble(80e-6, 110e-6, runs=runs),
        (8, 2, 0, 0, "", "y"): ensemble(100e-6, runs=runs),
        (4, 2, 0, 0, "", "x"): ensemble(90e-6, runs=runs),
    }


def levels():
    """The second level alone, cut across and cut along."""
    along, across = ensemble(80e-6, 110e-6), ensemble(100e-6)
    patterns = (8, 2, 0, 0, ""), (8, 2, 18, 2, "x"), (8, 2, 18, 2, "y"), (25, 8, 7, 2, "x")
    ways = ("x", along), ("y", across)
    return {(*pattern, way): runs for pattern in patterns for way, runs in ways}


def sizes(runs: int = 4):
    peaks = {0: 60e-6, 2: 80e-6, 6: 100e-6, 20: 120e-6}
    return {n_p: ensemble(peak, runs=runs) for n_p, peak in peaks.items()}


SIZES = [6, 20, 60]
LENGTH = {"x": 3.0, "y": 0.5}


def correlation(n_p: int = 60) -> pd.DataFrame:
    """Exponential curves whose intervals are 0.1 wide."""
    r = np.arange(n_p // 2 - n_p // 10 + 1)
    sides = []
    for side, length in LENGTH.items():
        c = np.exp(-r / length)
        columns = {"r": r, "correlation": c, "ci_low": c - 0.05, "ci_high": c + 0.05}
        sides.append(pd.DataFrame(columns).assign(n_p=n_p, side=side))
    return on_pillars(pd.concat(sides))


def on_pillars(table: pd.DataFrame) -> pd.DataFrame:
    """Add the scenes of a table of correlations: pillars and gaps of n_p blocks."""
    scenes = [identity(Scene(120, n_p, n_p)) | {"level": 1} for n_p in table["n_p"]]
    return table.assign(**pd.DataFrame(scenes, table.index).drop(columns=["n_p", "snapshot_times"]))


def lengths() -> pd.DataFrame:
    """Lengths that grow with n_p; the smallest pillars have no fit with a free amplitude."""
    rows = []
    for n_p in SIZES:
        for side, length in LENGTH.items():
            l_c = length * (1.0 + n_p / 600.0)
            tail = np.nan if n_p == 6 else l_c + 1.0
            row = {"n_p": n_p, "side": side, "r_last": min(n_p // 3, 5), "amplitude": 0.8}
            row |= limits("l_c", (l_c, l_c - 0.2, l_c + 0.3), "ci")
            rows.append(row | limits("tail", (tail, tail - 0.5, tail + 0.5)))
    return on_pillars(pd.DataFrame(rows))


def draw(figure: str, *data: object) -> Figure:
    """Draw a figure of the study."""
    return FIGURES[figure].function()(*data)


DRAWINGS = {
    "figure_2": lambda: draw("figure_2", ensemble(110e-6)),
    "figure_3": lambda: draw("figure_3", ensemble(110e-6)),
    "figure_5": lambda: draw("figure_5", ensemble(110e-6)),
    "figure_6": lambda: draw("figure_6", sizes()),
    "figure_7": lambda: draw("figure_7", 60, correlation(), lengths()),
    "figure_9": lambda: draw("figure_9", along_and_across()),
    "supplement_levels": lambda: draw("supplement_levels", levels()),
    "supplement_grooves": lambda: draw("supplement_grooves", levels()),
    "figure_5 of one run": lambda: draw("figure_5", [replace(record(0), scene=ASKEW)]),
    "figure_6 of one run": lambda: draw("figure_6", sizes(runs=1)),
    "figure_7 of the smallest pillars": lambda: draw("figure_7", 6, correlation(6), lengths()[:2]),
    "figure_9 of one run": lambda: draw("figure_9", along_and_across(runs=1)),
}
drawn = cache(lambda name: DRAWINGS[name]())  # for tests that only look at it


def test_figure_2_shows_the_run_in_front_of_the_others():
    runs = ensemble(110e-6, runs=3)
    force, blocks = (draw("figure_2", runs).axes[i] for i in (0, 2))
    lines = {line.get_label(): line for line in force.get_lines()}
    np.testing.assert_allclose(lines["one run"].get_ydata(), runs[0].force / NORMAL_FORCE)
    others = (runs[1].force[:694] + runs[2].force) / (2.0 * NORMAL_FORCE)
    np.testing.assert_allclose(lines["their mean"].get_ydata(), others)
    all_switches, first = blocks.patches[:2]
    per_block = 100.0 / PILLARS.contact.sum()
    for steps, counts in ((all_switches, runs[0].switches), (first, runs[0].detachments)):
        np.testing.assert_allclose(steps.get_data().values, per_block * counts[1:])
    assert blocks.get_ylim()[0] < per_block  # one block is visible


def test_figure_3_maps_t_det_over_t_max():
    run = record(0)
    ax = draw("figure_3", [run]).axes[0]
    np.testing.assert_array_equal(ax.images[0].get_array(), painted(run))
    times = (run.t_det / run.t_max)[run.contact]
    norm = scale(times)
    assert (norm.vmin, norm.vmax) == pytest.approx((times.min(), times.max()))
    assert norm(1.0) == pytest.approx(0.5)


def lines(ax):
    """Data of the lines of a panel, (n, 2), by label."""
    return {line.get_label(): line.get_xydata() for line in ax.get_lines()}


def test_figure_5_maps_the_mean_and_tells_sides_apart():
    pillar, rings = drawn("figure_5").axes
    shown = np.ma.filled(pillar.images[0].get_array(), np.nan)
    starts = PILLARS.origins
    cut = [r.t_det[y : y + SIZE, x : x + SIZE] for r in ensemble(110e-6) for y, x in starts]
    np.testing.assert_allclose(shown, np.mean(cut, axis=0) / 110e-6)
    parts = (xy for label, xy in lines(rings).items() if not label.startswith("_"))
    corners, along_y, along_x = parts
    assert [len(part) for part in (corners, along_y, along_x)] == [3, 2, 2]  # rings
    assert corners[0, 1] == pytest.approx(shown[[0, 0, -1, -1], [0, -1, 0, -1]].mean())
    assert along_y[0, 1] == pytest.approx(shown[1:-1, [0, -1]].mean())
    assert along_x[0, 1] == pytest.approx(shown[[0, -1], 1:-1].mean())


def test_figure_6_shows_every_size_and_marks_the_largest_force():
    force, highest, _, lag = drawn("figure_6").axes
    curves = lines(force)
    mean = np.mean([r.force[:691] / NORMAL_FORCE for r in ensemble(100e-6)], axis=0)
    np.testing.assert_allclose(curves["$n_p$ = 6"][:, 1], mean)
    dots = [line.get_xydata()[0, 0] for line in force.get_lines() if len(line.get_xydata()) == 1]
    for n_p, runs in sizes().items():
        assert ("flat" if n_p == 0 else f"$n_p$ = {n_p}") in curves
        assert pytest.approx(1e6 * runs[0].t_max) in dots
    assert [bar.lines[0].get_xdata()[0] for bar in highest.containers] == [2.0, 6.0, 20.0]
    dots = [line for line in lag.get_lines() if line.get_marker() == "."]
    assert [line.get_xdata()[0] for line in dots] == [2.0, 6.0, 20.0]
    each = [100.0 - 1e6 * run.t_avg for run in ensemble(100e-6)]
    assert dots[1].get_ydata() == pytest.approx(each)
    assert lag.containers[1].lines[0].get_ydata() == pytest.approx(np.mean(each))
    band = force.collections[2].get_paths()[0].vertices  # of n_p = 6
    at = band[np.isclose(band[:, 0], 100.0)][:, 1]
    forces = [run.force[500] / NORMAL_FORCE for run in ensemble(100e-6)]
    assert (at.min(), at.max()) == pytest.approx(tuple(np.percentile(forces, (5.0, 95.0))))


def marked(ax) -> list[float]:
    """Times of the triangles of a panel, µs."""
    return [text.xy[0] for text in ax.texts if text.get_text() == "▼"]


def test_figure_9_marks_the_load_peaks_of_the_data():
    """A row for each configuration, that with two peaks first."""
    wide, _, narrow, _ = drawn("figure_9").axes
    assert marked(wide) == pytest.approx([80.0, 110.0, 100.0], abs=0.5)
    assert marked(narrow) == pytest.approx([90.0], abs=0.5)
    words = wide.get_title("right")
    along = 100.0 * prominence_of_mean(ensemble(80e-6, 110e-6)).mean
    assert f"along {along:.1f} % [" in words
    assert "across 0.0 % [" in words


def test_curves_and_bands_are_those_of_the_table():
    """Behind r = 0, where c is 1; the logarithmic panel ends before an interval holds zero."""
    for ax, limit in zip(drawn("figure_7").axes, (-1.0, 0.0), strict=False):
        bands = [part for part in ax.collections if isinstance(part, PolyCollection)]
        points = [line.get_xydata() for line in ax.get_lines() if line.get_marker() in ("D", "s")]
        for (_, side), shown, band in zip(
            correlation().groupby("side"), filter(len, points), bands, strict=True
        ):
            part = side[(side["r"] > 0) & (side["ci_low"] > limit)]
            np.testing.assert_allclose(shown, part[["r", "correlation"]])
            limits = band.get_datalim(ax.transData)
            assert (limits.x0, limits.x1) == (1.0, part["r"].max())
            ends = part["ci_low"].min(), part["ci_high"].max()
            assert (limits.y0, limits.y1) == pytest.approx(ends)


def test_the_fit_is_solid_where_it_was_fitted_and_dotted_beyond():
    curves = drawn("figure_7").axes[1]
    assert curves.get_yscale() == "log"
    for pattern, span in (("-", (0.0, 5.0)), (":", (5.0, 24.0))):
        drawn_so = [line for line in curves.get_lines() if line.get_linestyle() == pattern]
        lines = [line.get_xydata() for line in drawn_so if len(line.get_xydata()) > 25]
        assert len(lines) == 2
        for line, length in zip(lines, LENGTH.values(), strict=True):
            assert (line[0, 0], line[-1, 0]) == span
            np.testing.assert_allclose(line[:, 1], np.exp(-line[:, 0] / (1.1 * length)))


def test_the_last_panel_shows_the_lengths_along_x_with_their_intervals():
    sizes = drawn("figure_7").axes[2]
    fitted, tail = sizes.containers
    expected = lengths().query("side == 'x'")
    np.testing.assert_allclose(fitted.lines[0].get_ydata(orig=False), expected["l_c"])
    np.testing.assert_allclose(tail.lines[0].get_ydata(orig=False), expected["tail"])
    (bars,) = fitted.lines[2]
    np.testing.assert_allclose(
        [segment[:, 1] for segment in bars.get_segments()], expected[["ci_low", "ci_high"]]
    )


def test_figure_7_shows_pillars_with_equal_gaps_and_the_study_s_constants():
    """Neither other gaps, nor another material, nor a first surface with fewer sizes.

    Without the size asked for it is refused.
    """
    first = lengths()[:4].assign(n_blocks=24, n_rows=24)
    others = [lengths().assign(n_s=5), lengths().assign(gamma=1.0)]
    picture = draw("figure_7", 60, correlation(), pd.concat([first, lengths(), *others]))
    shown, usual = (each.axes[2].lines[0].get_xydata() for each in (picture, drawn("figure_7")))
    np.testing.assert_array_equal(shown, usual)
    with pytest.raises(ValueError, match="no correlation length for n_p = 60"):
        draw("figure_7", 60, correlation(), lengths()[:4])
