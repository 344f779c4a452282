"""The figure of the stiff and extreme cases shows what the table holds."""

from functools import cache

import numpy as np
import pandas as pd

from springblock.study.results import FIGURES

NAN = np.nan
#: family, parameter, outcome, quantity, energy residual, relative error, tolerance
ROWS = [
    ("step", 0.5, "stable", "static friction", -3e-3, NAN, NAN),
    ("step", 0.99, "stable", "static friction", 4e-2, NAN, NAN),
    ("step", 1.01, "refused", "none", NAN, NAN, NAN),
    ("stiffness", 1e-4, "agrees", "displacement, l", -1e-6, 1e-15, 1e-12),
    ("stiffness", 1e4, "agrees", "displacement, l", -1e-6, -2e-4, 1e-3),
    ("strain", 1e-9, "agrees", "displacement, l", 1e-7, 2e-11, 1e-10),
    ("strain", 1e-1, "agrees", "displacement, l", 1e-7, 0.0, 1e-2),
    ("damping", 0.0, "agrees", "spring force, F_n", 1e-4, 2e-4, 1e-3),
    ("damping", 100.0, "agrees", "spring force, F_n", 1e-4, -1e-5, 1e-3),
    ("damping", 1e4, "refused", "none", NAN, NAN, NAN),
    ("speed", 1e-4, "agrees", "spring force, F_n", 1e-16, 3e-5, 1e-3),
    ("speed", 1e2, "agrees", "spring force, F_n", 1e-16, 2e-7, 4e-2),
    ("scatter", 0.0, "agrees", "first detachment, F_n/(K_s v)", 1e-7, 0.0, 1e-12),
    ("overflow", 1e160, "raises", "none", NAN, NAN, NAN),
]
NAMES = ["family", "parameter", "outcome", "quantity"]
NAMES += ["energy_error", "relative_error", "tolerance"]


def cases() -> pd.DataFrame:
    """Every case by both integrators."""
    table = pd.DataFrame(ROWS, columns=NAMES)
    table["case"] = [f"pillars {i}" for i in table.index]
    return pd.concat([table.assign(integrator=name) for name in ("leapfrog", "rk4")])


DRAWINGS = {"stability": lambda: FIGURES["stability"].function()(cases())}
drawn = cache(DRAWINGS["stability"])  # for tests that only look at it


def points(ax, marker, axis=0):
    """Places of all markers of a kind in a panel, sorted."""
    lines = [line for line in ax.get_lines() if line.get_marker() == marker]
    return np.sort(np.concatenate([line.get_data()[axis] for line in lines]).astype(float))


def heights(ax, marker):
    return points(ax, marker, axis=1)


def test_stable_steps_show_their_residual_and_unstable_ones_that_they_are_refused():
    steps = drawn().axes[0]
    assert points(steps, "o").tolist() == points(steps, "s").tolist() == [0.5, 0.99]
    assert heights(steps, "o").tolist() == [3e-3, 4e-2]
    assert points(steps, "x").tolist() == [1.01, 1.01]


def test_families_show_each_error_below_what_is_accepted():
    stiffness, strain, damping = drawn().axes[2:5]
    assert points(stiffness, "o").tolist() == [1e-4, 1e4]
    assert heights(stiffness, "o").tolist() == [1e-15, 2e-4]
    assert heights(strain, "o").tolist() == [1e-16, 2e-11]  # no error at all is on the floor
    assert heights(damping, "_").tolist() == 4 * [1e-3]
    assert points(damping, "x").tolist() == [1e4, 1e4]
    assert points(damping, "o").tolist() == [0.0, 100.0]
