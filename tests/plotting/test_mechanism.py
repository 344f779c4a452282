"""The figure of the mechanism shows the table, and stress as the elastic layer has it."""

import numpy as np
import pandas as pd
import pytest

from springblock.plotting import drawing
from springblock.plotting.mechanism import _pillar_stress

MODELS = ("independent", "quasi_static", "overshooting", "simulation")
TABLE = pd.DataFrame(
    [
        {"n_p": n_p, "seed": seed, "stress_variation": 0.1 * n_p}
        | {name: 0.6 + 0.1 * i + 0.01 * seed * n_p for i, name in enumerate(MODELS)}
        for n_p in (2, 6, 20)
        for seed in (-1, 0, 1)
    ]
)
BUDGET = pd.DataFrame(
    [
        {"direction": direction, "model": model, "seed": seed, "time": 1e-6 * time}
        | {"edge": 0.1 * time, "core": 0.2 * time, "free": 0.01 * seed}
        for direction in "xy"
        for model in ("simulation", "overshooting")
        for seed in (-1, 0, 1)
        for time in (1.0, 2.0)
    ]
)
DRAWINGS = {
    "mechanism_friction": lambda: drawing("mechanism_friction")(TABLE),
    "mechanism_budget": lambda: drawing("mechanism_budget")(BUDGET),
}


def test_each_model_is_drawn_with_its_mean_by_size():
    panels = DRAWINGS["mechanism_friction"]().axes
    (friction,) = (ax for ax in panels if ax.get_ylabel() == "static friction")
    lines = {line.get_label(): line for line in friction.containers}
    assert list(lines) == ["stress alone", "load transfer", "overshoot", "full model"]
    for i, bars in enumerate(lines.values()):
        places, means = bars.lines[0].get_data()
        assert list(places) == [2, 6, 20]
        assert means == pytest.approx(0.6 + 0.1 * i)


def test_edges_bear_more_than_the_inside_which_the_slider_pulls_alone():
    """Inside, F_mot is K_s s on each block, since no neighbour has moved."""
    stress = _pillar_stress(6)
    inside = stress[1:-1, 1:-1]
    assert inside == pytest.approx(np.full_like(inside, inside[0, 0]))
    assert stress[0].min() > inside.max()
    assert stress[:, 0].min() > inside.max()
    assert stress.mean() == pytest.approx(1.0, rel=1e-3)  # other pillars lie nearer to the middle


def test_edges_core_and_blocks_without_contact_add_up_to_friction():
    for ax in DRAWINGS["mechanism_budget"]().axes:
        for lines in (ax.lines[::2], ax.lines[1::2]):  # of each model
            both, edges, core = (line.get_ydata() for line in lines)
            assert lines[0].get_xdata() == pytest.approx([1.0, 2.0])
            assert both == pytest.approx(np.add(edges, core))
            assert edges == pytest.approx([0.1, 0.2])
