"""Surfaces and rows of the chapter's tables; forces on edges, core and blocks without contact."""

import numpy as np
import pytest

from springblock import Material, Pattern, draw_friction, simulate
from springblock.io.rows import select
from springblock.mechanism import tables
from springblock.mechanism.elasticity import Layer, lattice_stiffness
from springblock.mechanism.models import overshooting
from springblock.mechanism.surfaces import TABLES
from springblock.model.scene import Scene

MATERIAL = Material()


@pytest.mark.parametrize("name", TABLES["mechanism_variants"])
def test_a_variant_has_the_constants_and_gaps_of_its_name(name):
    kind, _, value = name.partition("-")
    gaps = {"half": 0.5, "double": 2.0}.get(kind, 1.0)
    varied = {"thickness": 1e-6, "scatter": 1.0}
    for scene in TABLES["mechanism_variants"][name]:
        assert scene.contact.any()
        assert scene.n_s == gaps * scene.n_p
        assert [each for _, each in scene.varied] == pytest.approx(
            [varied[kind] * float(value)] if kind in varied else []
        )


def test_each_part_has_the_columns_of_its_table():
    schemas = (tables.FRICTION, tables.FRICTION, tables.PEAKS, tables.BUDGET)
    for parts, schema in zip(TABLES.values(), schemas, strict=True):
        assert {id(tables.measure(part)[0]) for part in parts} == {id(schema)}


def test_load_peaks_are_measured_on_each_surface_and_seed(monkeypatch):
    small = [Scene(12, n_p2=4, n_s2=2, direction=direction) for direction in "xy"]
    monkeypatch.setitem(TABLES["mechanism_peaks"], "peaks-0", small)
    monkeypatch.setattr(tables, "SEEDS_OF_GROOVES", 2)
    rows = list(tables.measure("peaks-0")[1])
    assert [(row["direction"], row["seed"]) for row in rows] == [
        ("x", 0),
        ("x", 1),
        ("y", 0),
        ("y", 1),
    ]
    assert {row["predicted"] for row in rows} == set(map(tables.predicted, small))


def test_edges_are_beside_a_block_without_contact():
    edges = tables.edge_blocks(Pattern.pillars(8, 4, 4).contact)
    expected = np.zeros((8, 8), bool)
    expected[2:6, 2:6] = True
    expected[3:5, 3:5] = False
    assert np.array_equal(edges, expected)
    assert not tables.edge_blocks(np.ones((3, 3), bool)).any()  # an edge of the surface is none


def test_forces_on_all_blocks_add_up_to_friction(monkeypatch):
    """Springs between blocks add up to nothing: the curve of the run is the sum of the parts."""
    pulled = Scene(24, n_p=10, n_s=14, n_p2=4, n_s2=2, direction="y")
    monkeypatch.setattr(tables, "SEEDS_OF_GROOVES", 1)
    rows = list(tables.budget_rows(pulled))
    found = {model: select(rows, model=model) for model in ("simulation", "overshooting")}
    run = simulate(pulled.contact, *draw_friction(24, 0, MATERIAL), MATERIAL, "y", duration=600e-6)
    for row in found["simulation"]:
        whole = row["edge"] + row["core"] + row["free"]
        at_time = np.interp(row["time"], run.time, run.force) / run.normal_force
        assert whole == pytest.approx(at_time, rel=2e-3)  # |ΣF_s| has a part across, too
    before = [(row["edge"], row["core"]) for row in found["overshooting"][:2]]
    simulated = [(row["edge"], row["core"]) for row in found["simulation"][:2]]
    assert np.array(before) == pytest.approx(np.array(simulated), rel=0.05)


def test_no_spring_pulls_on_blocks_that_moved_as_one():
    stiffness = lattice_stiffness((3, 3), MATERIAL)
    moved = np.stack([np.full((3, 3), 2e-7), np.zeros((3, 3))])
    force = tables.elastic_force(stiffness, moved, MATERIAL.k_s * 3e-7, 0)
    assert force == pytest.approx(np.full((3, 3), MATERIAL.k_s * 1e-7))


def test_forces_on_parts_of_the_blocks_add_up_in_the_model(rng):
    contact = Pattern.pillars(12, 3, 3).contact
    reduced, k = Layer(contact, MATERIAL), contact.sum()
    static, dynamic = rng.uniform(0.9, 1.1, k), np.full(k, 0.6)
    some = rng.random(k) < 0.4
    curves = [overshooting(reduced, static, dynamic, of) for of in (None, some, ~some)]
    assert curves[0].force == pytest.approx(curves[1].force + curves[2].force)
