"""Stored reference solutions are those that the reference computes."""

import pytest

from benchmarks.reference import solve
from springblock.io.parquet import load
from springblock.study.accuracy.solutions import FILE, SMALL
from springblock.study.accuracy.stability.surfaces import COLUMNS, pulled_column


def test_the_solutions_are_stored_in_a_small_file():
    runs = [(row["scene"], row["seed"]) for row in load(FILE).to_pylist()]
    assert runs == [(scene, seed) for scene, small in SMALL.items() for seed in range(small.seeds)]
    assert FILE.stat().st_size < 300_000


@pytest.mark.parametrize(("ratio", "strain"), COLUMNS)
def test_columns_move_as_stored(ratio, strain):
    surface, material, duration = pulled_column(ratio, strain)
    run = solve(surface, material, duration, sample_interval=duration)
    moved = run.displacement[0, ~surface.contact][0] / material.spacing
    assert moved == pytest.approx(COLUMNS[ratio, strain], rel=1e-9)
