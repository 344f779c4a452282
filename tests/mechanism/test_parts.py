"""Parts of the chapter's tables."""

from dataclasses import replace

import pytest

from springblock.mechanism import PEAK_JOBS, TABLES, VARIANTS, budget, peaks, table
from springblock.mechanism.parts import measure


@pytest.mark.parametrize("name", VARIANTS)
def test_a_variant_has_the_constants_and_gaps_of_its_name(name):
    scenes, (kind, _, value) = table.variant(name), name.partition("-")
    gaps = {"half": 0.5, "double": 2.0}.get(kind, 1.0)
    varied = {"thickness": 1e-6, "scatter": 1.0}
    for scene in scenes:
        assert scene.contact.any()
        assert scene.n_s == gaps * scene.n_p
        assert [each for _, each in scene.varied] == pytest.approx(
            [varied[kind] * float(value)] if kind in varied else []
        )


def test_each_part_has_the_columns_of_its_table(monkeypatch):
    schemas = (table.SCHEMA, table.SCHEMA, peaks.SCHEMA, budget.SCHEMA)
    for parts, schema in zip(TABLES.values(), schemas, strict=True):
        assert {id(measure(part)[0]) for part in parts} == {id(schema)}


def test_jobs_share_the_surfaces_with_grooves(monkeypatch):
    """Each surface is measured once, however many jobs there are."""
    few = [(grooves, way) for grooves, way in peaks.surfaces() if grooves.n_p == 0][:5]
    small = replace(few[0][0].scene("x"), n_blocks=12, n_p2=4, n_s2=2)
    monkeypatch.setattr(peaks, "surfaces", lambda: iter(few))
    monkeypatch.setattr(peaks, "SEEDS", 1)
    monkeypatch.setattr(peaks.Grooves, "scene", lambda self, way: replace(small, direction=way))
    rows = [row for job in range(PEAK_JOBS) for row in measure(f"peaks-{job}")[1]]
    assert sorted(row["predicted"] for row in rows) == sorted(
        peaks.predicted(*each) for each in few
    )
    assert {row["n_p2"] for row in rows} == {4}
