"""Parts of the chapter's tables."""

import pytest

from springblock.mechanism import tables
from springblock.mechanism.surfaces import TABLES
from springblock.mechanism.tables import measure
from springblock.model.scene import Scene


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
        assert {id(measure(part)[0]) for part in parts} == {id(schema)}


def test_load_peaks_are_measured_on_each_surface_and_seed(monkeypatch):
    small = [Scene(12, n_p2=4, n_s2=2, direction=direction) for direction in "xy"]
    monkeypatch.setitem(TABLES["mechanism_peaks"], "peaks-0", small)
    monkeypatch.setattr(tables, "SEEDS_OF_GROOVES", 2)
    rows = list(measure("peaks-0")[1])
    assert [(row["direction"], row["seed"]) for row in rows] == [
        ("x", 0),
        ("x", 1),
        ("y", 0),
        ("y", 1),
    ]
    assert {row["predicted"] for row in rows} == set(map(tables.predicted, small))
