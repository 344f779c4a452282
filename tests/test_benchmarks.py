"""The benchmark measures the right thing: peers solve the same model, and rows are whole."""

import numpy as np
import pytest

from benchmarks import speed, study_cost
from benchmarks.peers import c_loop, lammps_lattice
from benchmarks.peers.missing import Missing
from benchmarks.peers.scipy_lattice import UNIT, ScipyLattice
from benchmarks.timing import SCHEMA, interleaved, printed, row
from springblock import Material
from springblock.accuracy.kernels import spring_forces
from springblock.scene import Scene
from springblock.tables import rows_to_table

BENCHMARK_FILE = """\
s\th:m:s\tmax_rss\tmax_vms\tmax_uss\tmax_pss\tio_in\tio_out\tmean_load\tcpu_time
{seconds}\t0:00:01\t{memory}\t1\t1\t1\t0\t0\t50\t{cpu}
"""


@pytest.fixture
def in_small(monkeypatch):
    """Let every part take moments: small surfaces, few repetitions, no processes."""
    small = {
        "N": 8,
        "REPETITIONS": 2,
        "FEW": 1,
        "ROUNDS": 100_000,
        "SCENES": {"flat": Scene(8)},
        "PLAIN_N": 6,
        "SIZES": (4, 8),
        "BLOCK_STEPS": 2000,
    }
    for name, value in small.items():
        monkeypatch.setattr(speed, name, value)
    monkeypatch.setattr(study_cost, "N", 8)
    monkeypatch.setattr(study_cost, "_python", lambda *arguments: None)


def without_peers(monkeypatch):
    """Hide the compiler and LAMMPS."""
    monkeypatch.setattr(c_loop.shutil, "which", lambda name: None)
    monkeypatch.setattr(lammps_lattice, "version", lambda: "missing")


def test_c_loop_moves_as_the_solver():
    try:
        differences = c_loop.differences()
    except Missing as why:
        pytest.skip(str(why))
    assert set(differences) == {"displacement", "velocity", "force", "first detachment"}
    assert max(differences.values()) < c_loop.TOLERANCE
    assert np.float64(1e-320) * 0.5 > 0.0  # this process still knows subnormal numbers


def test_lammps_moves_as_the_solver():
    try:
        lammps_lattice.require()
    except Missing as why:
        pytest.skip(str(why))


def test_scipy_lattice_has_the_springs_of_the_solver(rng):
    material, displacement = Material(), 1e-2 * rng.standard_normal((2, 7, 7))
    lattice = ScipyLattice(displacement, material)  # any velocity
    state = np.concatenate([displacement.ravel(), np.zeros(displacement.size)])
    acceleration = lattice.rate(0.0, state)[displacement.size :].reshape(displacement.shape)
    expected = material.k_int * spring_forces(displacement) - material.k_s * displacement
    np.testing.assert_allclose(acceleration, expected * UNIT**2 / material.mass, atol=1e-13)


def test_runs_are_timed_in_turn():
    order = []
    runs = {name: lambda name=name: order.append(name) for name in "AB"}
    seconds = interleaved(runs, 3)
    assert "".join(order) == "ABABAB"
    assert {name: len(each) for name, each in seconds.items()} == {"A": 3, "B": 3}


def test_a_ratio_is_taken_within_repetitions():
    measured = row("kernel", "slow", "s", [2.0, 40.0, 6.0], reference=[1.0, 20.0, 3.0])
    assert (measured["value"], measured["ratio"], measured["repetitions"]) == (6.0, 2.0, 3)
    assert (measured["low"], measured["high"]) == (4.0, 23.0)


@pytest.mark.parametrize("part", speed.PARTS)
def test_rows_have_the_schema(part, in_small, monkeypatch):
    monkeypatch.setattr(lammps_lattice, "version", lambda: "missing")  # it starts a process
    rows = list(speed.PARTS[part]())
    table = rows_to_table(rows, SCHEMA)
    assert table.num_rows >= 2
    assert set(table["part"].to_pylist()) == {part}
    assert all(name for name in table["name"].to_pylist())
    assert len(printed(rows).splitlines()) == table.num_rows + 1


def test_every_kernel_is_compared_with_the_leapfrog(in_small):
    rows = {(each["name"], each["unit"]): each for each in speed.kernel()}
    assert {name for name, _ in rows} == set(speed.CONTENDERS)
    leapfrog = rows["leapfrog", speed.BLOCK_STEP]
    assert leapfrog["ratio"] == 1.0
    assert leapfrog["note"] == "100 % of the blocks move"
    assert rows["rk4", speed.BLOCK_STEP]["value"] == pytest.approx(
        4.0 * rows["rk4", speed.BLOCK_EVALUATION]["value"]
    )


@pytest.mark.parametrize("part", ["kernel", "realisation", "peak"])
def test_what_is_missing_says_so(part, in_small, monkeypatch):
    without_peers(monkeypatch)
    rows = list(speed.PARTS[part]())
    absent = {each["name"]: each["note"] for each in rows if not each["repetitions"]}
    expected = {"kernel": {"C loop", "LAMMPS"}, "realisation": set(), "peak": {"multiply-adds"}}
    assert set(absent) == expected[part]
    assert all(note.startswith("missing: ") for note in absent.values())
    assert "missing" in printed(rows) or not absent
    assert rows_to_table(rows, SCHEMA).num_rows == len(rows)


def test_jobs_are_summed_by_rule(tmp_path, monkeypatch):
    for name, cpu, memory in (
        ("level=0/seeds=0-4", 6.0, 300),
        ("level=1/seeds=0-4", 2.0, 100),
        ("level=0/prelude", 1.0, 100),
        ("figure_2", "NA", 400),
        ("accuracy/paired-flat", 0.5, "NA"),
    ):
        file = tmp_path / f"{name}.tsv"
        file.parent.mkdir(exist_ok=True, parents=True)
        file.write_text(BENCHMARK_FILE.format(seconds=0.5, cpu=cpu, memory=memory))
    rows = {each["name"]: each for each in study_cost.job_rows(study_cost.jobs(tmp_path))}
    assert rows["all jobs"]["value"] == 10.0
    assert {name: each["ratio"] for name, each in rows.items() if name != "all jobs"} == {
        "simulate": 0.8,
        "prelude": 0.1,
        "figures": 0.05,  # too short for a sample of its CPU time
        "accuracy": 0.05,
        "largest memory of a job": pytest.approx(np.nan, nan_ok=True),
    }
    assert rows["largest memory of a job"]["value"] == 400.0


def test_a_study_that_has_not_been_run_is_missing():
    rows = list(study_cost.job_rows([]))
    assert [each["repetitions"] for each in rows] == [0, 0]
    assert all(each["note"] == "missing: the study has not been run" for each in rows)
