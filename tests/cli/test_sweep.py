"""springblock sweep: ensembles without Snakemake."""

import os
import re
import signal
import subprocess
import sys
import time

import pyarrow.parquet as pq

from springblock.io.schemas import SUMMARY

SURFACE = ("--n-blocks", 8, "--n-p", 2, "--n-s", 2)


def test_all_its_runs_have_the_samples_of_the_fastest_slider_and_each_run_once(
    springblock, tmp_path
):
    """Directions and values that are given twice count once."""
    how = ("--slider-velocity", "5e-3,5e-2,5e-2", "--direction", "x,0", "--seeds", 1)
    springblock("sweep", "--n-blocks", 4, *how, "--output", tmp_path)
    rows = pq.read_table(tmp_path / "realisations.parquet").to_pylist()
    assert [(row["slider_velocity"], row["sample_interval"]) for row in rows] == [
        (5e-3, 2e-8),
        (5e-2, 2e-8),
    ]


def test_its_runs_are_those_of_single_commands(springblock, tmp_path):
    folder = tmp_path / "speeds"
    varied = ("--slider-velocity", "5e-3,1e-2", "--direction", "x,y", "--seeds", 2, "--jobs", 2)
    springblock("sweep", *SURFACE, *varied, "--output", folder)
    table = pq.read_table(folder / "realisations.parquet")
    assert table.num_rows == 8
    own = ("--slider-velocity", "1e-2", "--direction", "y", "--last-seed", 1)
    springblock("simulate", *SURFACE, *own, "--output", tmp_path / "alone.parquet")
    alone = pq.read_table(tmp_path / "alone.parquet", columns=SUMMARY.names).to_pylist()
    found = [row for row in table.to_pylist() if repr(row) in map(repr, alone)]  # NaN included
    assert sorted(row["seed"] for row in found) == [0, 1]
    names = {"realisations.parquet", "slider_velocity.png", "direction.png"}
    assert {file.name for file in folder.iterdir()} == names


def test_lengths_ranges_and_laws_are_varied(springblock, tmp_path):
    """Coulomb's law, which has no slip distance, is simulated once on each surface."""
    lengths = ("--n-blocks", 8, "--n-p", "2:4:2", "--n-s", "n_p")
    laws = ("--law", "coulomb,slip_weakening", "--slip-distance", "1e-8,2e-8")
    how = ("--duration", 1e-6, "--seeds", 1, "--output", tmp_path)
    springblock("sweep", *lengths, *laws, "--gamma", "0:1e3:3", *how)
    rows = pq.read_table(tmp_path / "realisations.parquet").to_pylist()
    found = {(row["n_p"], row["n_s"], row["gamma"], row["slip_distance"]) for row in rows}
    assert len(rows) == len(found)
    assert found == {
        (n, n, gamma, distance)
        for n in (2, 4)
        for gamma in (0.0, 500.0, 1000.0)
        for distance in (0.0, 1e-8, 2e-8)
    }


def test_values_that_are_no_numbers_are_refused(springblock, tmp_path):
    said = springblock("sweep", "--n-p", "2,a", "--output", tmp_path, refused=True)
    assert "'a' is not a valid integer" in said


def test_an_interrupt_ends_in_one_line_and_leaves_no_file(tmp_path):
    """Sent to all processes of the command, as a terminal does."""
    words = ["sweep", "--seeds", "2", "--jobs", "2", "--gamma", "0:1e3:99", "--n-blocks", "24"]
    words += ["--output", str(tmp_path / "runs")]
    said = tmp_path / "said"
    with said.open("w") as log:
        run = subprocess.Popen(
            [sys.executable, "-m", "springblock", *words],
            stderr=log,
            env=os.environ | {"TQDM_DISABLE": ""},  # a bar in a file, too
            start_new_session=True,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
        )
        while not re.search(r" [1-9]\d*/", said.read_text()):  # runs are finished
            assert run.poll() is None
            time.sleep(0.05)
        os.killpg(run.pid, signal.SIGINT)
        assert run.wait(60.0) == 130
    assert said.read_text().splitlines()[-1] == "Interrupted."
    assert "Traceback" not in said.read_text()
    assert [file for file in tmp_path.rglob("*") if file.is_file()] == [said]
