"""The figure of the mechanism shows the table, and stress as the elastic layer has it."""

import numpy as np
import pandas as pd
import pytest

from springblock.study.mechanism.figures import _pillar_stress
from springblock.study.mechanism.page import NAMES
from springblock.study.results import FIGURES
from study.mechanism import chapter

TABLE = pd.DataFrame(
    [
        {"n_p": n_p, "seed": seed, "stress_variation": 0.1 * n_p}
        | {name: 0.6 + 0.1 * i + 0.01 * seed * n_p for i, name in enumerate(NAMES)}
        for n_p in (2, 6, 20)
        for seed in (-1, 0, 1)
    ]
)
DRAWINGS = {
    "mechanism_friction": lambda: FIGURES["mechanism_friction"].function()(TABLE),
    "mechanism_sensitivities": lambda: FIGURES["mechanism_sensitivities"].function()(
        pd.DataFrame(chapter.settings())
    ),
}


def test_each_model_is_drawn_with_its_mean_by_size():
    panels = DRAWINGS["mechanism_friction"]().axes
    (friction,) = (ax for ax in panels if ax.get_ylabel() == "static friction")
    assert [text.get_text() for text in friction.get_legend().texts] == list(NAMES.values())
    lines = [line for line in friction.lines if line.get_linestyle() != "None"]
    for i in range(len(NAMES)):
        places, means = lines[i].get_data()
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


def test_each_setting_has_its_row_of_four_quantities():
    """Those with periodic edges and other damping are for load peaks alone, on the page."""
    size, depth, lag, prominence = DRAWINGS["mechanism_sensitivities"]().axes
    names = [label.get_text() for label in size.get_yticklabels()]
    assert names == ["paper ", r"$\gamma$ = 1e+06 1/s", "edges periodic"]
    for ax, means in (
        (size, [6.0, 6.01, 6.02]),
        (depth, [0.05, 0.06, 0.07]),
        (lag, [-10.0, 9990.0, 19990.0]),
        (prominence, [3.0, 4.0, 5.0]),
    ):
        assert ax.containers[0].lines[0].get_xdata() == pytest.approx(means)
