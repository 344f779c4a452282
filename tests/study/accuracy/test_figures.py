"""The figures of errors against cost show their tables, all of them, without a warning."""

from functools import cache
from itertools import product

import numpy as np
import pandas as pd
import pytest

from precision import production_rows
from springblock.model.defaults import STEP
from springblock.study.accuracy.conventions import ENSEMBLE, PLAIN, SCENES
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
    "work_precision": lambda: FIGURES["work_precision"].function()(table(), production_table())
}
drawn = cache(lambda name: DRAWINGS[name]())  # for tests that only look at it


def panels(letters):
    """Axes that carry these letters, with the scenes that they show."""
    axes = {ax.get_title("left"): ax for ax in drawn("work_precision").axes}
    return [(axes[f"{letter})"], scene) for letter, scene in zip(letters, SCENES, strict=True)]


def test_every_single_run_is_shown():
    runs = table().query("quantity == 't_det before horizon'")
    for ax, scene in panels("abc"):
        wanted = runs[runs.scene == scene][["cpu_seconds", "error"]]
        lines = [line for line in ax.lines if line.get_marker() != "None"]
        shown = np.vstack([line.get_xydata() for line in lines if line.get_linestyle() != "None"])
        np.testing.assert_allclose(sorted(shown.tolist()), sorted(wanted.to_numpy().tolist()))
        assert ax.viewLim.count_contains(shown) == len(shown) == 20


def test_the_band_is_the_standard_error_of_the_usual_mean():
    rows = production_table().query("quantity == 't_avg'")
    for ax, scene in panels("abc"):
        (row,) = rows[(rows.scene == scene) & (rows.step == STEP)].itertuples()
        (band,) = ax.patches
        top = band.get_y() + band.get_height()
        assert top == pytest.approx(row.deviation / row.value / ENSEMBLE**0.5)
