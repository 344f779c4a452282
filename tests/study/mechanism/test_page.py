"""Page and figures of the mechanism show their tables, and stress as the elastic layer has it."""

import numpy as np
import pandas as pd
import pytest
from matplotlib.figure import Figure

from springblock.io.rows import Row, limits
from springblock.study.mechanism.figures import _pillar_stress
from springblock.study.mechanism.page import NAMES, values
from springblock.study.results import FIGURES

#: Static friction of the models by n_p.
FRICTION = {
    2: (0.9, 0.8, 0.85, 0.75, 0.752),
    6: (0.7, 0.65, 0.8, 0.6, 0.601),
    20: (0.6, 0.7, 0.82, 0.65, 0.6),
}
UNEVEN = {2: 0.0, 6: 0.3, 20: 0.2}


def rows(**constants: float) -> list[Row]:
    """Return the table `mechanism`, or rows with other constants."""
    return [
        {"n_p": n_p, "n_s": n_p, "n_blocks": 40, "seed": seed, "stress_variation": UNEVEN[n_p]}
        | {name: value + 0.001 * seed for name, value in zip(NAMES, values, strict=True)}
        | constants
        for n_p, values in FRICTION.items()
        for seed in (-1, 0, 1)
    ]


#: Varied constant and its value, edges and gamma of some settings, and what depends on them.
SETTINGS = [("", "", "free", 5e3), ("gamma", "1e+06 1/s", "free", 1e6)]
SETTINGS += [("edges", "periodic", "periodic", 5e3), ("gamma", "1e+06 1/s", "periodic", 1e6)]
QUANTITIES = {"size": 6.0, "friction": 0.6, "depth": 0.05, "lag": -1e-5, "prominence": 0.03}
#: Rows of the tables of the page, in its order.
TABLES = {
    "mechanism": rows(),
    # friction in the simulation is that of load transfer and 0.01
    "mechanism_damped": [
        row | {"simulation": row["quasi_static"] + 0.01}
        for gamma in (1e7, 4e7)
        for row in rows(gamma=gamma)
    ],
    # half and twice K_s: thickness goes with K_s^(-1/2)
    "mechanism_springs": [
        row for factor in (0.5, 2.0) for row in rows(thickness=1e-5 / factor**0.5)
    ],
    # overshoot together has the friction of the full model
    "mechanism_grooves": [
        {"model": name}
        | limits("static_friction", 3 * [friction])
        | limits("prominence", 3 * [dip])
        for name, friction, dip in (
            ("sticking", 0.84, 0.001),
            ("overshooting", 0.73, 0.01),
            ("collective", 0.69, 0.01),
            ("simulation", 0.69, 0.02),
        )
    ],
    "sensitivities": [
        dict(zip(("varied", "value", "edges", "gamma"), setting, strict=True))
        | {"quantity": name, "seeds": 8}
        | limits("mean", (value + 0.01 * i, value, value + 0.02 * i))
        for i, setting in enumerate(SETTINGS)
        for name, value in QUANTITIES.items()
    ],
}


def draw(figure: str, table: str) -> Figure:
    return FIGURES[figure].function()(pd.DataFrame(TABLES[table]))


DRAWINGS = {
    "mechanism_friction": lambda: draw("mechanism_friction", "mechanism"),
    "mechanism_sensitivities": lambda: draw("mechanism_sensitivities", "sensitivities"),
}


def test_each_model_is_drawn_with_its_mean_by_size():
    panels = DRAWINGS["mechanism_friction"]().axes
    (friction,) = (ax for ax in panels if ax.get_ylabel() == "static friction")
    assert [text.get_text() for text in friction.get_legend().texts] == list(NAMES.values())
    lines = [line for line in friction.lines if line.get_linestyle() != "None"]
    for i in range(len(NAMES)):
        places, means = lines[i].get_data()
        assert list(places) == list(FRICTION)
        assert means == pytest.approx([values[i] for values in FRICTION.values()])


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


@pytest.fixture(scope="module")
def found():
    return values(*TABLES.values())


def test_changes_are_those_from_one_model_to_the_next_in_percent(found):
    assert found["change"]["sticking"][6].mean == pytest.approx(100.0 * (0.8 / 0.65 - 1.0), 1e-4)
    assert found["change"]["simulation"][20].mean == pytest.approx(-7.7, abs=0.1)
    assert str(found["minimum"]["simulation"]) == "20 (or 6)"


def test_damped_runs_are_compared_with_load_transfer_seed_by_seed(found):
    """The drag is gamma m v/(P l²) = 1e7/s 1.2e-12 kg 5e-4 m/s / 5e-6 N."""
    damped = found["damped"][1e7]
    assert damped["drag"] == pytest.approx(1.2e-3)
    assert damped["excess"] == pytest.approx([0.01] * 2)
    assert damped["minimum"].place == 6


def test_springs_are_told_by_their_ratio_to_the_papers(found):
    assert {*found["springs"]} == {"0.5", "2"}
    assert found["springs"]["2"]["minimum"]["simulation"].place == 20
    assert found["springs"]["2"]["uneven"] == UNEVEN[6]


def test_settings_are_named_by_what_differs_from_the_papers_surfaces(found):
    assert [*found["settings"]] == [
        "",
        "gamma 1e+06 1/s",
        "edges periodic",
        "periodic gamma 1e+06 1/s",
    ]
    assert found["settings"]["periodic gamma 1e+06 1/s"]["prominence"].high == pytest.approx(0.09)
    names = ["", "gamma 1e+06 1/s"]
    assert found["least"]("size", names) == pytest.approx(6.0)
    assert found["most"]("size", names) == pytest.approx(6.02)
