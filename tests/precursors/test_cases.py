"""Stripes: the register is what the code predicts, and the simulation has what is compared."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from springblock.precursors import PARTS, cases
from springblock.precursors.cases import AVALANCHES, CELLS, PASSAGES, PRECURSORS, Avalanches

REGISTER = Path(__file__).parents[2] / "docs/registration"


def test_the_register_has_what_the_exact_solution_gives():
    register = pd.read_csv(REGISTER / "chain.csv").set_index(["edge", "what"])
    assert len(register) == len(AVALANCHES)
    for cell in AVALANCHES[::7]:
        row = cell.exact
        values = pd.Series(row).drop(["edge", "what"]).astype(float)
        found = register.loc[cell.shape, cell.what][values.index]
        assert found.to_numpy(float) == pytest.approx(values.to_numpy(), rel=1e-3, abs=1e-5)


@pytest.mark.parametrize("shape", cases.SHAPES)
def test_the_register_has_what_the_chain_gives(shape):
    register = pd.read_csv(REGISTER / "chain.csv").set_index(["edge", "what"])
    row, found = register.loc[shape, "paper"], Avalanches(shape).predicted(seeds=2)
    assert found["l_c"].mean == pytest.approx(row["l_c"], rel=0.1)
    assert found["load"].mean == pytest.approx(row["load"], abs=1e-3)


def test_the_register_has_what_the_theory_of_the_front_gives():
    register = pd.read_csv(REGISTER / "front.csv")
    assert len(register) == len(PASSAGES)
    for place in (0, 20, 53):
        for name, found in PASSAGES[place].predicted().items():
            assert register[name][place] == pytest.approx(float(found.mean), rel=1e-3, abs=1e-5)


def test_each_part_has_its_cells():
    assert {*PARTS} == {*CELLS}
    assert sum(each.differs == 0 for each in CELLS["fronts"]) == len(cases.SHAPES)


def test_rows_have_simulation_beside_theory(monkeypatch):
    """With few realisations: the order of edges along and across, and the load of an edge."""
    few = [Avalanches(shape, seeds=4) for shape in cases.SHAPES]
    monkeypatch.setitem(CELLS, "avalanches", few)
    rows = list(cases.measure("avalanches"))
    assert all({*row} == {*PRECURSORS.names} for row in rows)
    found = {(row["edge"], row["quantity"]): row for row in rows}
    assert found["along", "c_1"]["simulated"] > 0.4 > found["across", "c_1"]["simulated"]
    for shape in cases.SHAPES:
        load = found[shape, "load"]
        assert load["simulated"] == pytest.approx(load["predicted"], abs=0.02)


def test_a_front_passes_a_row_as_the_theory_has_it(monkeypatch):
    """Load of passage of four realisations on a coarse lattice: its mean and its scatter."""
    cell = replace(next(each for each in PASSAGES if each.spacing == 5e-6), seeds=4)
    times = cases.first_times(cell, [2, 13])
    load = cell.material.k_s * cell.material.slider_velocity * times / cell.material.block_load / 2
    groups = cell.front.groups
    expected = (cell.front.load + groups.residual) * (
        cell.material.mu_static - cell.material.mu_dynamic
    )
    assert np.mean(load) == pytest.approx(expected, rel=0.05)
