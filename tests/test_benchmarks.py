"""The benchmark measures the right thing: peers solve the same model, and runs alternate."""

import re

import numpy as np
import pytest
from click.testing import CliRunner

from benchmarks import speed
from benchmarks.peers import c_loop, lammps_lattice
from benchmarks.timing import Missing
from springblock.model.scene import Scene


def test_c_loop_moves_as_the_solver():
    try:
        differences = c_loop.differences()
    except Missing as why:
        pytest.skip(str(why))
    assert set(differences) == {"displacement", "velocity", "force", "first detachment"}
    assert max(differences.values()) < c_loop.TOLERANCE
    assert np.float64(1e-320) * 0.5 > 0.0  # this process still knows subnormal numbers


def test_the_benchmark_prints_one_table(monkeypatch):
    """Of moments, so that numbers mean nothing; LAMMPS is not there."""

    def absent():
        raise Missing("not installed")

    small = {"N": 8, "REPETITIONS": 2, "FEW": 1, "PLAIN_N": 6, "SCENES": {"flat": Scene(8)}}
    small |= {"SIZES": (4, 8), "BLOCK_STEPS": 2000}
    for name, value in small.items():
        monkeypatch.setattr(speed, name, value)
    monkeypatch.setattr(lammps_lattice, "require", absent)
    outcome = CliRunner().invoke(speed.main, catch_exceptions=False)
    assert outcome.exit_code == 0, outcome.output
    for part in speed.PARTS:
        assert re.search(rf"^ *{part} ", outcome.output, re.MULTILINE)
    for name in speed.CODES:
        assert re.search(rf"^ *kernel +{name} ", outcome.output, re.MULTILINE)
    assert re.search(r"^ *kernel +LAMMPS +missing .* not installed$", outcome.output, re.MULTILINE)
    assert re.search(r"^ *kernel +leapfrog .* 1\.00 ", outcome.output, re.MULTILINE)
