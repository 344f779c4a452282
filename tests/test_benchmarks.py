"""The benchmark measures the right thing: peers solve the same model, and numbers are right."""

import csv
import re

import numpy as np
import pytest
from click.testing import CliRunner

from benchmarks import history, load, speed
from benchmarks.peers import c_loop, lammps_lattice
from benchmarks.timing import BLOCK_STEP, Missing, Row, interleaved, printed
from springblock.model.scene import Scene
from studies import ROOT

CPU = "AMD EPYC 7B13 64-Core Processor"
MACHINE = {"code_version": "0.2.0+0123", "cpu": CPU, "vectors": "avx2"}


@pytest.fixture
def in_small(monkeypatch, tmp_path):
    """Let every part take moments: small surfaces, few repetitions; and a history of its own."""
    small = {"N": 8, "REPETITIONS": 2, "FEW": 1, "ROUNDS": 100_000, "PLAIN_N": 6}
    small |= {"SCENES": {"flat": Scene(8)}, "SIZES": (4, 8), "LARGE": (8,), "BLOCK_STEPS": 2000}
    for name, value in small.items():
        monkeypatch.setattr(speed, name, value)
    monkeypatch.setattr(history, "FILE", tmp_path / "history.csv")


def operators(function):
    """Floating-point operators in the innermost block of a function of loop.c, roots among them."""
    source = (ROOT / "benchmarks/peers/loop.c").read_text()
    source = re.sub(r"/\*.*?\*/|\[.*?\]", "", source, flags=re.DOTALL)  # comments and indices
    body = re.search(rf" {function}\((.*?)\n}}", source, re.DOTALL).group(1).rpartition("{")[2]
    return len(re.findall(r"[-+*/]|sqrt", body))


def test_c_loop_moves_as_the_solver():
    try:
        differences = c_loop.differences()
    except Missing as why:
        pytest.skip(str(why))
    assert set(differences) == {"displacement", "velocity", "force", "first detachment"}
    assert max(differences.values()) < c_loop.TOLERANCE
    assert np.float64(1e-320) * 0.5 > 0.0  # this process still knows subnormal numbers


def test_operations_are_those_of_the_c_loop():
    springs = operators("springs") + 4 * operators("pull")
    assert springs == speed.SPRINGS
    moving = operators("move") + 2  # and a sum over the blocks of each component
    assert springs + moving == speed.LEAPFROG


def test_what_is_compared_runs_in_turn():
    order = []
    runs = {name: lambda name=name: order.append(name) for name in "AB"}
    seconds = interleaved(runs, 3)
    assert "".join(order) == "ABABAB"
    assert {name: len(each) for name, each in seconds.items()} == {"A": 3, "B": 3}


def test_ratios_are_taken_within_repetitions():
    values, others = np.array([2.0, 40.0, 6.0]), np.array([1.0, 20.0, 3.0])
    row = Row("kernel", "slow", "s", values, reference=others, at_peak=others)
    assert (row.value, row.ratio, row.of_peak) == (6.0, 2.0, 0.5)
    assert re.search(r"6\.00 +4\.00 - 23\.0 +s +50 % +2\.00$", printed([row]))


def test_the_benchmark_prints_its_table_and_adds_its_line(in_small, monkeypatch):
    """Of moments, so that numbers mean nothing; LAMMPS is not there."""

    def absent():
        raise Missing("not installed")

    monkeypatch.setattr(lammps_lattice, "require", absent)
    outcome = CliRunner().invoke(speed.main, ["--release"], catch_exceptions=False)
    assert outcome.exit_code == 0, outcome.output
    for part in speed.PARTS:
        assert re.search(rf"^{part} ", outcome.output, re.MULTILINE)
    for name in speed.CONTENDERS:
        assert re.search(rf"^kernel +{name} +flat +8 ", outcome.output, re.MULTILINE)
    assert re.search(r"^kernel +LAMMPS .* missing .* not installed$", outcome.output, re.MULTILINE)
    assert re.search(r"^kernel +leapfrog .* 1\.00 ", outcome.output, re.MULTILINE)
    assert outcome.output.rstrip().endswith(history.FILE.read_text().rstrip())
    incomplete = CliRunner().invoke(speed.main, ["--part", "kernel", "--release"])
    assert "--release needs the parts kernel and realisation" in incomplete.output


@pytest.mark.parametrize("integrator", ["leapfrog", "rk4"])
def test_all_blocks_move_while_kernels_are_timed(integrator):
    solver = speed.Solver(integrator, 16)
    solver.advance(speed.STEPS)
    assert solver.moving == "100 % of the blocks move"


def test_a_line_of_the_history_is_what_was_measured():
    def rows(n):
        costs = {"leapfrog": 5.0, "C loop": 8.0, "rk4": 31.25, "plain rk4": 1234.0}
        for name, cost in (costs | {"LAMMPS": np.nan}).items():
            peak = 2.0 if name == "leapfrog" else np.nan
            yield Row("kernel", name, BLOCK_STEP, cost, "flat", n, 5.0, peak)
        for scene, seconds in {"flat": 0.1, "pillars": 1.6}.items():
            for name, times in {"from zero": 2, "with the prelude": 1}.items():
                yield Row("realisation", name, "s", times * seconds, scene, n, 4.0)

    line = history.line(MACHINE, [*rows(120), *rows(40)], 120)
    version, _, *rest = line.split(",")
    assert version == "0.2.0"
    assert rest[:3] == ["0123", "AMD EPYC 7B13", "avx2"]
    assert rest[3:] == ["5", "8", "0.625", "", "31.2", "1230", "40", "0.025", "0.4", ""]
    header, *lines = csv.reader(history.FILE.read_text().splitlines())
    assert {len(each) for each in lines} == {len(header)} == {len(line.split(","))}


def test_many_jobs_can_be_planned():
    assert load.measured(5, "--dry-run").startswith("5 jobs: ")
