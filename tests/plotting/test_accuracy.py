"""The figures of errors against cost show their tables, all of them, without a warning."""

from functools import cache
from itertools import product

import numpy as np
import pandas as pd
import pytest

from precision import production_rows
from springblock import Setup
from springblock.accuracy.conventions import (
    ENSEMBLE,
    PAPER_STEP,
    PLAIN,
    SCENES,
    half_width,
)
from springblock.plotting import drawing

STEPS = np.array([8e-8, 4e-8, 2e-8, 1e-8, 5e-9, 2.5e-9, 1e-9])
SEEDS = 4 * ENSEMBLE  #: of the ensembles


def row(comparison, scene, integrator, step, nudge, quantity, error, half=0.0):
    evaluations = 2e-4 / step * (1 if integrator == "leapfrog" else 4)
    return {
        "comparison": comparison,
        "scene": scene,
        "n_blocks": 16 if comparison in ("paired", "scatter") else 8,
        "integrator": integrator,
        "step": step,
        "nudge": nudge,
        "quantity": quantity,
        "error": error,
        "ci_low": error - half,
        "ci_high": error + half,
        "worst": 2.0 * error,
        "realisations": SEEDS,
        "cpu_seconds": 3e-6 * evaluations,
        "force_evaluations": evaluations,
    }


@cache
def table():
    """First order for both integrators, none for the plain Runge-Kutta; in no order of rows."""
    rows = []
    for i, scene in enumerate(SCENES, 1):
        for quantity in ("t_det before horizon", "static_friction", "t_max"):
            for h, integrator in product(STEPS, ("leapfrog", "rk4")):
                rows.append(row("reference", scene, integrator, h, 0.0, quantity, 3e3 * i * h))
            for h in STEPS[:-1]:
                rows.append(row("reference", scene, PLAIN, h, 0.0, quantity, 0.02 * i))
        for quantity in ("static_friction", "t_max", "t_avg"):
            rows.append(row("scatter", scene, "leapfrog", 2.5e-9, 0.0, quantity, 0.0, 4e-3 * i))
            for h, integrator in product(STEPS[:3], ("leapfrog", "rk4")):
                bias = row("paired", scene, integrator, h, 0.0, quantity, -3e4 * i * h, 5e-4)
                rows.append(bias)
    return pd.DataFrame(rows).sample(frac=1.0, random_state=1)


@cache
def production_table():
    """A bias of order two; in no order of rows."""
    return pd.DataFrame(production_rows()).sample(frac=1.0, random_state=1)


DRAWINGS = {
    "work_precision": lambda: drawing("work_precision")(table()),
    "work_precision at full size": lambda: drawing("work_precision")(table(), production_table()),
}
drawn = cache(lambda name: DRAWINGS[name]())  # for tests that only look at it


def panel(letter, name="work_precision"):
    """The axes that carry this letter."""
    return next(ax for ax in drawn(name).axes if ax.get_title("left") == f"{letter})")


def chosen(rows, **conditions):
    for name, value in conditions.items():
        rows = rows[rows[name] == value]
    return rows


def points(ax):
    """What markers of lines show, (n, 2), but for rings."""
    lines = [line for line in ax.lines if line.get_marker() != "None"]
    return np.vstack([line.get_xydata() for line in lines if line.get_linestyle() != "None"])


def visible(ax, places):
    """Within the limits of the axes, and where a logarithm exists."""
    shown = ax.transData.transform(places)
    low, high = ax.transAxes.transform([(0.0, 0.0), (1.0, 1.0)])
    return bool(((shown >= low - 0.01) & (shown <= high + 0.01)).all())


def check_points(ax, wanted):
    """Every wanted point is drawn, no other, and all are visible."""
    shown, wanted = points(ax), wanted.to_numpy()
    assert len(shown) == len(wanted)
    assert visible(ax, wanted)
    for point in wanted:
        assert np.isclose(shown, point, rtol=1e-9, atol=0.0).all(axis=1).any()


@pytest.mark.parametrize(("letter", "scene"), list(zip("abc", SCENES, strict=True)))
def test_every_single_run_is_shown(letter, scene):
    wanted = chosen(table(), comparison="reference", scene=scene, quantity="t_det before horizon")
    assert len(wanted) == 20
    check_points(panel(letter), wanted[["force_evaluations", "error"]])


def test_rings_mark_the_default_and_the_paper():
    default = Setup()
    rings = [line for line in panel("a").lines if line.get_linestyle() == "None"]
    runs = chosen(table(), comparison="reference", scene="flat", quantity="t_det before horizon")
    marked = ((default.integrator, default.step), (PLAIN, PAPER_STEP))
    for ring, (integrator, step) in zip(rings, marked, strict=True):
        row = chosen(runs, integrator=integrator, step=step)
        assert ring.get_xydata().tolist() == row[["force_evaluations", "error"]].values.tolist()


@pytest.mark.parametrize(("letter", "scene"), list(zip("def", SCENES, strict=True)))
def test_every_bias_is_shown_with_its_interval_and_the_scatter(letter, scene):
    ax = panel(letter)
    of_scene = chosen(table(), scene=scene, quantity="static_friction")
    wanted = chosen(of_scene, comparison="paired")
    assert sorted(points(ax)[:, 1]) == pytest.approx(sorted(100.0 * wanted.error))
    bars = np.vstack([b for c in ax.collections for b in c.get_segments()])
    ends = sorted(100.0 * pd.concat([wanted.ci_low, wanted.ci_high]))
    assert sorted(bars[:, 1]) == pytest.approx(ends)
    assert visible(ax, bars)
    scatter = chosen(of_scene, comparison="scatter").ci_high.item()
    (band,) = ax.patches
    assert band.get_y() == pytest.approx(-100.0 * scatter * 2.0)  # 20 seeds instead of 80
    assert band.get_height() == pytest.approx(100.0 * scatter * 4.0)


@pytest.mark.parametrize(("letter", "scene"), list(zip("def", SCENES, strict=True)))
def test_biases_at_full_size_are_shown_where_a_study_has_them(letter, scene):
    ax = panel(letter, "work_precision at full size")
    shown = chosen(production_table(), scene=scene, quantity="static_friction").sort_values("step")
    (full,) = (bars for bars in ax.containers if bars.lines[0].get_marker() == "D")
    assert [*full.lines[0].get_xdata()] == pytest.approx([*(1e9 * shown.step[1:])])
    assert [*full.lines[0].get_ydata()] == pytest.approx([*(100.0 * shown.bias[1:] / 50.0)])
    half = 100.0 * half_width(10.0 / 50.0, ENSEMBLE)
    assert ax.patches[1].get_height() == pytest.approx(2.0 * half)
