"""Stripes: the register is what the code predicts, and the simulation has what is compared."""

import math
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from springblock import Setup
from springblock.study.precursors import cases
from springblock.study.precursors.cases import AVALANCHES, CELLS, PASSAGES, PRECURSORS
from springblock.study.results import TABLES
from springblock.theory.chain import avalanche_length, one_sided_correlation
from springblock.theory.front import Front
from study.precursors.test_page import REGISTER

CHAIN = pd.read_csv(REGISTER / "chain.csv").set_index(["edge", "what"])


def test_the_register_has_what_the_exact_solution_gives():
    assert len(CHAIN) == len(AVALANCHES)
    for cell in AVALANCHES[::7]:
        c = one_sided_correlation(cell.material, cell.handed, np.array([1, 6]))
        values = [cell.handed, avalanche_length(cell.material, cell.handed), *c]
        found = CHAIN.loc[cell.shape, cell.what][["t_1", "length", "one_sided_1", "one_sided_6"]]
        assert found.to_numpy(float) == pytest.approx(values, rel=1e-3, abs=1e-5)


@pytest.mark.parametrize("paper", AVALANCHES[:2], ids=cases.SHAPES)
def test_the_register_has_what_the_chain_gives(paper):
    row, found = CHAIN.loc[paper.shape, "paper"], paper.predicted(seeds=2)
    assert found["l_c"].mean == pytest.approx(row["l_c"], rel=0.1)
    assert found["load"].mean == pytest.approx(row["load"], abs=1e-3)


def test_the_register_has_what_the_theory_of_the_front_gives():
    register = pd.read_csv(REGISTER / "front.csv")
    assert len(register) == len(PASSAGES)
    for place in (0, 20, 53):
        for name, found in PASSAGES[place].predicted().items():
            assert register[name][place] == pytest.approx(float(found.mean), rel=1e-3, abs=1e-5)


def test_each_part_has_its_cells():
    """Seven kinds of fronts: the usual one, and two other values of l, ξ and d_c."""
    assert {*TABLES["precursors"].parts} == {*CELLS}
    assert len(CELLS["precursors-fronts"]) == 7 * len(cases.SHAPES)
    assert CELLS["precursors-avalanches"][0].setup.step == Setup().step


def test_rows_have_simulation_beside_theory(monkeypatch):
    """With few realisations: the order of edges along and across, and the load of an edge."""
    monkeypatch.setitem(
        CELLS, "precursors-paper", [replace(each, seeds=4) for each in AVALANCHES[:2]]
    )
    rows = list(cases.measure("precursors-paper"))
    assert all({*row} == {*PRECURSORS.names} for row in rows)
    found = {(row["edge"], row["quantity"]): row for row in rows}
    assert found["along", "c_1"]["simulated"] > 0.4 > found["across", "c_1"]["simulated"]
    for shape in cases.SHAPES:
        load = found[shape, "load"]
        assert load["simulated"] == pytest.approx(load["predicted"], abs=0.02)


def test_a_front_passes_a_row_at_the_load_of_the_theory():
    """A block at x detaches where that before it, at x - l, bears the rest of its strength.

    Between them u = (1 - p) (s - x)²/2, and M u/l² = 1 - p for a front at s = x + (√2 - 1) l.
    """
    cell = replace(CELLS["precursors-fronts"][0], seeds=2)
    material, row = cell.material, round(cell.material.thickness / cell.material.spacing)
    load = cell.first_times(row, 1.2).mean() / cell.loading_time
    depth = cell.depth + (math.sqrt(2.0) - 1.0) * material.spacing
    front = Front.of(material, cell.shape, depth, cases.WIDTH, cases.WIDTH)
    drop = material.mu_static - material.mu_dynamic
    assert load == pytest.approx((front.load + front.groups.residual) * drop, rel=0.02)
