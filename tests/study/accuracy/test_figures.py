"""The figures of errors against cost show their tables, all of them, without a warning."""

from functools import cache
from itertools import product

import numpy as np
import pandas as pd
import pytest

from precision import production_rows
from springblock.model.defaults import STEP
from springblock.study.accuracy.conventions import (
    ENSEMBLE,
    MEANS,
    PLAIN,
    SCENES,
)
from springblock.study.results import FIGURES

STEPS = np.array([8e-8, 4e-8, 2e-8, 1e-8, 5e-9, 2.5e-9, 1e-9])


def row(comparison, scene, integrator, step, nudge, quantity, error, half=0.0):
    evaluations = 2e-4 / step * (1 if integrator == "leapfrog" else 4)
    return {
        "comparison": comparison,
        "scene": scene,
        "n_blocks": 8,
        "integrator": integrator,
        "step": step,
        "nudge": nudge,
        "quantity": quantity,
        "error": error,
        "ci_low": error - half,
        "ci_high": error + half,
        "worst": 2.0 * error,
        "realisations": 4,
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
    return pd.DataFrame(rows).sample(frac=1.0, random_state=1)


@cache
def production_table():
    """A bias of order two; in no order of rows."""
    return pd.DataFrame(production_rows()).sample(frac=1.0, random_state=1)


DRAWINGS = {
    "work_precision": lambda: FIGURES["work_precision"].function()(table(), production_table()),
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


@pytest.mark.parametrize(("letter", "scene"), list(zip("def", SCENES, strict=True)))
def test_biases_are_shown_over_seconds_in_standard_errors_of_the_usual_mean(letter, scene):
    """Of all quantities and of steps up to twice the default, which has a ring."""
    ax = panel(letter)
    rows = production_table()
    rows = rows[(rows.step <= 4e-8) & rows.quantity.isin(MEANS)]
    shown = chosen(rows, scene=scene)
    errors = ENSEMBLE**0.5 / 10.0  # of a deviation of 10
    drawn_points = np.vstack([bars.lines[0].get_xydata() for bars in ax.containers])
    assert len(drawn_points) == len(shown) == 3 * 4
    assert sorted(drawn_points[:, 1]) == pytest.approx(sorted(errors * shown.bias))
    assert drawn_points[:, 0].min() == pytest.approx(shown.cpu_seconds.min(), rel=0.1)
    assert drawn_points[:, 0].max() == pytest.approx(shown.cpu_seconds.max(), rel=0.1)
    bars = np.vstack([b for c in ax.collections for b in c.get_segments()])
    ends = sorted(errors * pd.concat([shown.ci_low, shown.ci_high]))
    assert sorted(bars[:, 1]) == pytest.approx(ends)
    assert visible(ax, bars)
    (band,) = ax.patches
    assert (band.get_y(), band.get_height()) == (-1.0, 2.0)
    rings = [line for line in ax.lines if line.get_fillstyle() == "none"]
    default = chosen(shown, step=STEP)
    assert [ring.get_ydata().item() for ring in rings] == pytest.approx([*(errors * default.bias)])
    names = [text.get_text() for text in ax.texts]
    assert sorted(names) == ["10 ns", "20 ns", "40 ns", "5 ns"]
