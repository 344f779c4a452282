"""The benchmark measures the right thing: peers solve the same model, and rows are whole."""

import csv
import os
import re
import runpy
import sys
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from benchmarks import history, speed, study_cost
from benchmarks.peers import c_loop, lammps_lattice
from benchmarks.peers.missing import Missing
from benchmarks.peers.scipy_lattice import UNIT, ScipyLattice
from benchmarks.timing import BLOCK_STEP, SCHEMA, interleaved, missing, printed, row
from springblock import Material
from springblock.accuracy.kernels import spring_forces
from springblock.io.parquet import rows_to_table
from springblock.model.scene import Scene
from springblock.plotting import declarations

ROOT = Path(__file__).parents[1]
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
        "LARGE": (8,),
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


def test_operations_are_those_of_the_c_loop():
    springs = operators("springs") + 4 * operators("pull")
    moving = operators("move") + 2  # and a sum over the blocks of each component
    assert sum(speed.OPERATIONS["leapfrog"].values()) == springs + moving
    assert 4 * speed.SPRINGS == speed.OPERATIONS["rk4"]["springs"] == 4 * springs


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
    assert np.isnan(measured["of_peak"])


def test_a_kernel_that_takes_twice_as_long_reaches_half_the_peak():
    measured = row("kernel", "slow", "s", [2.0, 40.0, 6.0], at_peak=[1.0, 20.0, 3.0])
    assert measured["of_peak"] == 0.5
    assert "  50 %  " in printed([measured | {"note": "its share"}])


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
    leapfrog = rows["leapfrog", BLOCK_STEP]
    assert leapfrog["ratio"] == 1.0
    assert leapfrog["note"] == "100 % of the blocks move"
    if rows["C loop", BLOCK_STEP]["repetitions"]:  # there is a compiler, for the peak as well
        counted = {name for (name, _), each in rows.items() if each["of_peak"] > 0.0}
        assert counted == {"leapfrog", "C loop", "rk4"}
    assert rows["rk4", BLOCK_STEP]["value"] == pytest.approx(
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
        ("level-0/seeds-0-4", 6.0, 300),
        ("level-1/seeds-0-4", 2.0, 100),
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


def jobs_of_the_workflow():
    """Rules that leave a benchmark file, and the path of one such file."""
    wildcards = {"scene": "n_blocks-12/level-0/direction-x", "more": "", "first": "0", "last": "4"}
    wildcards |= {"integrator": "rk4", "table": "correlation", "mask": "islands-1a2b3c4d"}
    wildcards |= {"name": "pressure", "surface": "flat"}  # of a sweep, of a film
    for file in sorted((ROOT / "workflow/rules").glob("*.smk")):
        for text in re.split(r"^ *rule\b", file.read_text(), flags=re.MULTILINE)[1:]:
            for path in re.findall(r'benchmarks/(.*?)"', text):
                path = path.replace("{{comparison}}-{{scene}}", "paired-flat")
                path = path.replace("production/{{scene}}", "production/flat")
                path = path.replace("{{", "{").replace("}}", "}")
                for figure in declarations() if "{figure}" in path else [""]:
                    for part in ("", "beyond/", "more/"):
                        named = path.format(figure=figure, part=part, **wildcards)
                        yield text.split(":")[0].strip(), named


def test_every_job_of_the_workflow_counts_for_its_step():
    step = {
        "compile_integrator": "compile",
        "mask_topography": "mask",
        "prelude_scene": "prelude",
        "simulate_batch": "simulate",
        "aggregate_part": "aggregate",
        "correlation_scene": "correlation",
        "correlations_table": "correlation",
        "compare_scene": "accuracy",
        "precision_table": "accuracy",
        "production_scene": "production",
        "production_table": "production",
        "stability_table": "accuracy",
        "": "figures",  # their rules are named in a loop
    }
    found = list(jobs_of_the_workflow())
    assert set(step) <= {rule for rule, _ in found}
    for rule, path in found:
        assert study_cost._rule(Path(path)) == step.get(rule, rule)


def test_threads_are_set_before_any_library_is_loaded(monkeypatch):
    started = []
    monkeypatch.delenv("OMP_NUM_THREADS", raising=False)
    monkeypatch.setattr(os, "execve", lambda *arguments: started.append(arguments))
    monkeypatch.delitem(sys.modules, "benchmarks.speed")
    runpy.run_module("benchmarks")
    ((_, _, environment),) = started
    assert environment["OMP_NUM_THREADS"] == environment["OPENBLAS_NUM_THREADS"] == "1"
    assert "benchmarks.speed" not in sys.modules


def test_the_readme_names_the_options_of_the_c_loop():
    options = [name for name in c_loop.OPTIONS if name not in ("-shared", "-fPIC")]
    assert f"C, `{' '.join(options)}`" in (ROOT / "README.md").read_text()


MACHINE = {
    "code_version": "0.2.0+0123456789abcdef",
    "cpu": "AMD EPYC 7B13 64-Core Processor",
    "vectors": "avx2",
}


def made_up(n):
    """Rows of kernels and whole runs on surfaces of N = n."""
    kernels = {"leapfrog": 5.0, "C loop": 8.0, "rk4": 31.25, "plain rk4": 1234.0}
    for name, cost in kernels.items():
        counted = {"at_peak": 2.0} if name == "leapfrog" else {}
        yield row("kernel", name, BLOCK_STEP, cost, "flat", n, reference=5.0, **counted)
        yield row("kernel", name, "ns per block and evaluation", cost / 4, "flat", n)
    yield missing("kernel", "LAMMPS", BLOCK_STEP, Missing("none"), "flat", n)
    for scene, seconds in {"flat": 0.1, "pillars": 1.6}.items():
        for name, times in {"from zero": 2, "with the prelude": 1}.items():
            yield row("realisation", name, "s", times * seconds, scene, n, reference=4.0)


@pytest.fixture
def past(tmp_path, monkeypatch):
    """A history without a line."""
    file = tmp_path / "history.csv"
    file.write_text(history.FILE.read_text().splitlines(keepends=True)[0])
    monkeypatch.setattr(history, "FILE", file)
    return file


@pytest.fixture
def bench(tmp_path, monkeypatch):
    """The command, with made-up numbers in place of measured ones."""
    monkeypatch.setattr(speed, "machine", lambda: MACHINE)
    monkeypatch.setitem(speed.PARTS, "kernel", lambda: made_up(speed.N))
    monkeypatch.setitem(speed.PARTS, "realisation", lambda: [])
    output = f"--output={tmp_path / 'benchmark.parquet'}"
    return lambda *options: CliRunner().invoke(speed.main, [*options, output])


def test_a_line_of_the_history_is_what_was_measured():
    rows = [*made_up(120), *made_up(40)]
    assert history.measured(rows, 120) == {
        "leapfrog_ns": "5",
        "c_loop_ns": "8",
        "leapfrog_to_c": "0.625",
        "lammps_ns": "",
        "rk4_ns": "31.2",
        "plain_rk4_ns": "1230",
        "percent_of_peak": "40",
        "flat_to_c": "0.025",
        "pillars_to_c": "0.4",
        "grooves_to_c": "",
    }


def test_the_history_has_the_columns_of_its_lines():
    header, *lines = csv.reader(history.FILE.read_text().splitlines())
    assert header == list(history.release(MACHINE) | history.measured([], 120))
    keys = [(line[0], *line[3:5]) for line in lines]
    assert all(len(line) == len(header) for line in lines)
    assert len(keys) == len(set(keys))


@pytest.mark.parametrize(
    ("model", "name"),
    [
        ("AMD EPYC 7B13 64-Core Processor", "AMD EPYC 7B13"),
        ("Intel(R) Xeon(R) Processor", "Intel Xeon"),
        ("Intel(R) Core(TM) i7-8550U CPU @ 1.80GHz", "Intel Core i7-8550U"),
        ("arm", "arm"),
    ],
)
def test_a_processor_goes_by_its_name(model, name):
    assert history.release(MACHINE | {"cpu": model})["cpu"] == name


def test_the_history_has_one_line_for_each_version_and_processor(past):
    line = history.release(MACHINE) | history.measured([], 120)
    for others in ({}, {"version": "0.3.0"}, {"cpu": "a, b"}, {"vectors": "avx512"}):
        history.append(line | others)
    written = list(csv.DictReader(past.read_text().splitlines()))
    assert [each["cpu"] for each in written] == ["AMD EPYC 7B13"] * 2 + ["a, b", "AMD EPYC 7B13"]
    with pytest.raises(ValueError, match=r"version is 0\.2\.0 .* AMD EPYC 7B13 with avx2 already"):
        history.append(line | {"date": "2000-01-01"})
    assert len(past.read_text().splitlines()) == 5


def test_the_benchmark_ends_with_the_line_that_a_release_adds(bench, past):
    whole = "--part=kernel", "--part=realisation"
    printed_only = bench(*whole)
    assert printed_only.exit_code == 0, printed_only.output
    assert len(past.read_text().splitlines()) == 1
    added = bench(*whole, "--release")
    assert added.exit_code == 0, added.output
    _, line = past.read_text().splitlines()
    assert line == added.stdout.splitlines()[-1] == printed_only.stdout.splitlines()[-1]
    again = bench(*whole, "--release")
    assert again.exit_code == 1
    assert again.output.startswith("Error: version is 0.2.0 and history.csv has its line")


def test_a_release_needs_all_that_its_line_holds(bench, past):
    outcome = bench("--part=kernel", "--release")
    assert outcome.exit_code == 2
    assert "--part is kernel, and --release needs kernel and realisation" in outcome.output
    assert "history.csv" not in bench("--part=kernel").output
    assert len(past.read_text().splitlines()) == 1
