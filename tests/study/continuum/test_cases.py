"""Unit cells: the simulation agrees with the theory, and the register with the code."""

import math
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from springblock.study.continuum import cases
from springblock.study.continuum.cases import SERIES, Series, lowest_point
from springblock.theory.layer import PLAIN, with_springs
from studies import ROOT

REGISTER = ROOT / "docs/registration/continuum.csv"


@pytest.mark.parametrize("shape", ["across", "along"])
def test_stripes_have_the_friction_of_the_theory(shape, monkeypatch):
    """Within 0.002 for a >= 3 lambda; each block slips once up to the peak."""
    series = Series(shape, material=replace(PLAIN, spacing=1.25e-6), widths=(3.5,))
    monkeypatch.setitem(SERIES, shape, [series])
    (row,) = cases.measure(shape)
    assert row["simulated"] == pytest.approx(row["predicted"], abs=0.002)
    assert row["switches"] == 1.0
    assert row["width"] / row["decay"] == pytest.approx(3.5, abs=0.25)


@pytest.mark.parametrize("own", [{}, {"sides": (2, 1)}, {"is_staggered": True}, {"wave": 0.1}])
def test_pillars_have_the_friction_of_the_theory(own, monkeypatch):
    series = Series("square", material=replace(PLAIN, spacing=5e-6), widths=(4,), **own)
    monkeypatch.setitem(SERIES, "square", [series])
    (row,) = cases.measure("square")
    assert row["simulated"] == pytest.approx(row["predicted"], abs=0.004)


def test_the_register_has_what_the_theory_predicts():
    """Of stripes, which take no time."""
    register = pd.read_csv(REGISTER)
    for series in SERIES["across"][::4]:
        rows = register[(register["shape"] == "across") & (register["what"] == series.what)]
        found = [series.prediction(n) for n in series.blocks]
        assert rows["friction"].to_numpy() == pytest.approx(found, abs=1e-4)


def test_springs_to_the_slider_change_alone():
    other = with_springs(PLAIN, math.sqrt(2.0))
    assert other.k_s == pytest.approx(2.0 * PLAIN.k_s)
    assert (other.k_int, other.mass) == pytest.approx((PLAIN.k_int, PLAIN.mass))


def test_the_lowest_point_of_a_parabola_in_log_a_is_exact():
    widths = np.array([1.0, 2.0, 4.0, 8.0])
    at, least = lowest_point(widths, 0.5 + np.log(widths / 3.0) ** 2)
    assert (at, least) == pytest.approx((3.0, 0.5))
    assert lowest_point(widths, widths) == (1.0, 1.0)
