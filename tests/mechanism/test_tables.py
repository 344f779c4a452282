"""Surfaces and rows of the chapter's tables; forces on edges, core and blocks without contact."""

from types import SimpleNamespace

import numpy as np
import pytest

from springblock import Material, Pattern, Setup, Surface, simulate
from springblock.io.rows import select
from springblock.mechanism import tables
from springblock.mechanism.surfaces import TABLES
from springblock.model.scene import Scene

MATERIAL = Material()


def test_load_peaks_are_measured_on_each_surface_and_seed(monkeypatch):
    small = [Scene(12, n_p2=4, n_s2=2, direction=direction) for direction in "xy"]
    monkeypatch.setitem(TABLES["mechanism_peaks"], "peaks-0", small)
    monkeypatch.setattr(tables, "SEEDS_OF_GROOVES", 2)
    schema, found = tables.measure("peaks-0")
    rows = list(found)
    assert schema is tables.PEAKS
    assert [row["direction"] + str(row["seed"]) for row in rows] == ["x0", "x1", "y0", "y1"]
    assert {row["predicted"] for row in rows} == set(map(tables.predicted, small))


def test_each_part_has_the_columns_of_its_table():
    columns = {
        table: {tables.measure(part)[0] for part in parts} for table, parts in TABLES.items()
    }
    assert columns == {
        "mechanism": {tables.FRICTION},
        "mechanism_variants": {tables.FRICTION},
        "mechanism_peaks": {tables.PEAKS},
        "mechanism_budget": {tables.BUDGET},
    }


def test_edges_are_beside_a_block_without_contact():
    edges = tables.edge_blocks(Pattern.pillars(8, 4, 4).contact)
    expected = np.zeros((8, 8), bool)
    expected[2:6, 2:6] = True
    expected[3:5, 3:5] = False
    assert np.array_equal(edges, expected)
    assert not tables.edge_blocks(np.ones((3, 3), bool)).any()  # an edge of the surface is none


def test_events_on_edges_count_neighbours_along_x_that_detach_together():
    """Two edges of four blocks: one detaches in two events, the other block by block."""
    contact = Pattern.pillars(6, 4, 2).contact
    times = np.zeros((6, 6))
    times[1, 1:5], times[4, 1:5] = (0.2, 0.204, 0.3, 0.3), (0.1, 0.2, 0.3, 0.4)
    run = SimpleNamespace(t_det=times, t_max=1.0)
    assert tables.event_size(run, contact) == pytest.approx(8 / (2 + 4))


def test_forces_on_all_blocks_add_up_to_friction(monkeypatch):
    """Springs between blocks add up to nothing: the curve of the run is the sum of the parts."""
    pulled = Scene(24, n_p=10, n_s=14, n_p2=4, n_s2=2, direction="y")
    monkeypatch.setattr(tables, "SEEDS_OF_GROOVES", 1)
    rows = list(tables.budget_rows(pulled))
    found = {model: select(rows, model=model) for model in ("simulation", "overshooting")}
    surface = Surface.draw(pulled.contact, 0, MATERIAL)
    run = simulate(surface, Setup(MATERIAL), "y", duration=600e-6)
    for row in found["simulation"]:
        whole = row["edge"] + row["core"] + row["free"]
        at_time = np.interp(row["time"], run.time, run.force) / run.normal_force
        assert whole == pytest.approx(at_time, rel=2e-3)  # |ΣF_s| has a part across, too
    before = [(row["edge"], row["core"]) for row in found["overshooting"][:2]]
    simulated = [(row["edge"], row["core"]) for row in found["simulation"][:2]]
    assert np.array(before) == pytest.approx(np.array(simulated), rel=0.05)


def test_a_model_has_no_force_after_its_last_block_has_detached(monkeypatch):
    last = np.array([301e-6 * MATERIAL.slider_velocity])  # position of the slider, m
    monkeypatch.setattr(tables, "SEEDS_OF_GROOVES", 1)
    monkeypatch.setattr(tables.models, "overshooting", lambda *_: tables.models.Curve(last, last))
    rows = list(tables.budget_rows(Scene(24, n_p=10, n_s=14, n_p2=4, n_s2=2)))
    ended = {np.isnan(row["edge"]) for row in rows if row["time"] > 301e-6}
    assert ended == {False, True}  # in the simulation, and in the model
    assert not any(np.isnan(row["edge"]) for row in rows if row["time"] < 301e-6)
