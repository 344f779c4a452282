"""The figure of the continuum limit shows the table and the theory."""

import numpy as np
import pandas as pd
import pytest

from springblock.study.results import FIGURES
from springblock.theory.layer import stripe
from study.continuum.chapter import rows

TABLE = pd.DataFrame(rows())
DRAWINGS = {"continuum_friction": lambda: FIGURES["continuum_friction"].function()(TABLE)}


def test_points_are_the_simulation_and_lines_the_theory():
    stripes, squares, best = DRAWINGS["continuum_friction"]().axes
    series = TABLE[TABLE["what"].str.match("d_c|l_z")]
    for ax, is_square in ((stripes, False), (squares, True)):
        drawn = [y for line in ax.lines if line.get_linestyle() == "None" for y in line.get_ydata()]
        known = series[(series["shape"] == "square") == is_square]["simulated"]
        assert sorted(drawn) == pytest.approx(sorted(known))
    assert best.lines[2].get_ydata()[0] == pytest.approx(6.05, abs=0.1)  # mu_d = 0.6, kappa = 0.1
    line = next(line for line in stripes.lines if line.get_label() == r"$\kappa$ = 1.88")
    a, friction = np.array(line.get_data())[:, 15]
    assert friction == pytest.approx(0.6 + 0.4 * stripe(a, a, 1.5, 1.875).excess)
