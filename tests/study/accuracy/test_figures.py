"""The figures of errors against cost, and of stiff and extreme cases, show all of their tables."""

from functools import cache

import numpy as np
import pandas as pd
import pytest

from springblock.model.defaults import STEP
from springblock.study.accuracy.conventions import ENSEMBLE, SCENES
from springblock.study.results import FIGURES
from study.accuracy.test_page import precision_rows, production_rows

#: Tables in no order of rows.
PRECISION, PRODUCTION = (
    pd.DataFrame(rows).sample(frac=1.0, random_state=1)
    for rows in (precision_rows(), production_rows())
)
#: family, parameter, outcome, quantity, energy residual, relative error, tolerance
ROWS = [
    ("step", 0.5, "stable", "static friction", -3e-3, np.nan, np.nan),
    ("step", 0.99, "stable", "static friction", 4e-2, np.nan, np.nan),
    ("step", 1.01, "refused", "none", np.nan, np.nan, np.nan),
    ("stiffness", 1e-4, "agrees", "displacement, l", -1e-6, 1e-15, 1e-12),
    ("stiffness", 1e4, "agrees", "displacement, l", -1e-6, -2e-4, 1e-3),
    ("strain", 1e-9, "agrees", "displacement, l", 1e-7, 2e-11, 1e-10),
    ("strain", 1e-1, "agrees", "displacement, l", 1e-7, 0.0, 1e-2),
    ("damping", 0.0, "agrees", "spring force, F_n", 1e-4, 2e-4, 1e-3),
    ("damping", 100.0, "agrees", "spring force, F_n", 1e-4, -1e-5, 1e-3),
    ("damping", 1e4, "refused", "none", np.nan, np.nan, np.nan),
    ("speed", 1e-4, "agrees", "spring force, F_n", 1e-16, 3e-5, 1e-3),
    ("speed", 1e2, "agrees", "spring force, F_n", 1e-16, 2e-7, 4e-2),
    ("scatter", 0.0, "agrees", "first detachment, F_n/(K_s v)", 1e-7, 0.0, 1e-12),
    ("overflow", 1e160, "raises", "none", np.nan, np.nan, np.nan),
]
NAMES = ["family", "parameter", "outcome", "quantity"]
NAMES += ["energy_error", "relative_error", "tolerance"]
#: Every case by both integrators.
CASES = pd.DataFrame(ROWS, columns=NAMES).assign(case="pillars")
CASES = pd.concat([CASES.assign(integrator=name) for name in ("leapfrog", "rk4")])
DRAWINGS = {
    "work_precision": lambda: FIGURES["work_precision"].function()(PRECISION, PRODUCTION),
    "stability": lambda: FIGURES["stability"].function()(CASES),
}
drawn = cache(lambda name: DRAWINGS[name]())  # for tests that only look at it


def panels():
    """Panels a to c with the scenes that they show."""
    axes = {ax.get_title("left"): ax for ax in drawn("work_precision").axes}
    return zip([axes["a)"], axes["b)"], axes["c)"]], SCENES, strict=True)


def test_every_single_run_is_shown():
    runs = PRECISION.query("comparison == 'reference' and quantity == 't_det before horizon'")
    for ax, scene in panels():
        wanted = runs[runs.scene == scene][["cpu_seconds", "error"]]
        lines = [line for line in ax.lines if line.get_marker() != "None"]
        shown = np.vstack([line.get_xydata() for line in lines if line.get_linestyle() != "None"])
        np.testing.assert_allclose(sorted(shown.tolist()), sorted(wanted.to_numpy().tolist()))
        assert ax.viewLim.count_contains(shown) == len(shown) == 12


def test_the_band_is_the_standard_error_of_the_usual_mean():
    rows = PRODUCTION.query("quantity == 't_avg'")
    for ax, scene in panels():
        (row,) = rows[(rows.scene == scene) & (rows.step == STEP)].itertuples()
        (band,) = ax.patches
        top = band.get_y() + band.get_height()
        assert top == pytest.approx(row.deviation / row.value / ENSEMBLE**0.5)


def points(ax, marker):
    """Sorted places of all markers of a kind in a panel."""
    lines = [line for line in ax.get_lines() if line.get_marker() == marker]
    return sorted(np.concatenate([line.get_xydata() for line in lines]).tolist())


def test_stable_steps_show_their_residual_and_unstable_ones_that_they_are_refused():
    steps = drawn("stability").axes[0]
    assert points(steps, "o") == points(steps, "s") == [[0.5, 3e-3], [0.99, 4e-2]]
    assert [x for x, _ in points(steps, "x")] == [1.01, 1.01]


def test_families_show_each_error_below_what_is_accepted():
    stiffness, strain, damping = drawn("stability").axes[2:5]
    assert points(stiffness, "o") == [[1e-4, 1e-15], [1e4, 2e-4]]
    assert points(strain, "o") == [[1e-9, 2e-11], [1e-1, 1e-16]]  # no error at all: on the floor
    assert points(damping, "_") == 2 * [[0.0, 1e-3]] + 2 * [[100.0, 1e-3]]
    assert points(damping, "o") == [[0.0, 2e-4], [100.0, 1e-5]]
    assert [x for x, _ in points(damping, "x")] == [1e4, 1e4]
