"""springblock sweep: ensembles without Snakemake."""

import os
import re
import signal
import subprocess
import sys
import time

import pyarrow.parquet as pq
import pytest

from springblock.io.parquet import load
from springblock.io.schemas import SUMMARY

SURFACE = ("--n-blocks", 8, "--n-p", 2, "--n-s", 2)


@pytest.fixture(scope="module")
def folder(springblock, tmp_path_factory):
    """A finished sweep."""
    place = tmp_path_factory.mktemp("sweep") / "speeds"
    swept(springblock, place, "--seeds", 2)
    return place


def swept(springblock, folder, *others, refused=False):
    how = ["--vary", "slider_velocity=5e-3,1e-2", "--jobs", 2]
    how += [] if "--direction" in others else ["--direction", "x,y"]
    return springblock("sweep", *SURFACE, *how, *others, "--output", folder, refused=refused)


def test_all_its_runs_have_the_samples_of_the_fastest_slider_and_each_run_once(
    springblock, tmp_path
):
    """Directions and values that are given twice count once."""
    how = ("--vary", "slider_velocity=5e-3,5e-2,5e-2", "--direction", "x,0", "--seeds", 1)
    springblock("sweep", "--n-blocks", 4, *how, "--output", tmp_path)
    rows = pq.read_table(tmp_path / "realisations.parquet").to_pylist()
    assert [(row["slider_velocity"], row["sample_interval"]) for row in rows] == [
        (5e-3, 2e-8),
        (5e-2, 2e-8),
    ]


def test_its_runs_are_those_of_single_commands_and_are_not_run_again(springblock, folder, tmp_path):
    """Seeds may be added: what is there stays."""
    table = pq.read_table(folder / "realisations.parquet")
    assert table.num_rows == 8
    own = ("--vary", "slider_velocity=1e-2", "--direction", "y", "--last-seed", 1)
    springblock("simulate", *SURFACE, *own, "--output", tmp_path / "alone.parquet")
    alone = pq.read_table(tmp_path / "alone.parquet", columns=SUMMARY.names).to_pylist()
    found = [row for row in table.to_pylist() if row in alone]
    assert sorted(row["seed"] for row in found) == [0, 1]
    for name in ("slider_velocity.png", "direction.png"):
        assert (folder / name).stat().st_size > 10_000
    written = {file: file.stat().st_mtime_ns for file in folder.glob("realisations/**/*.parquet")}
    assert "springblock table" in swept(springblock, folder, "--seeds", 2)
    assert {file: file.stat().st_mtime_ns for file in written} == written
    swept(springblock, folder, "--seeds", 6)
    assert pq.read_table(folder / "realisations.parquet").num_rows == 24


@pytest.mark.parametrize(
    ("others", "sentence"),
    [
        (("--seeds", 2, "--material", "gamma=0"), "has runs with other constants or code"),
        (("--seeds", 2, "--duration", 1e-5), "has runs with other constants or code"),
        (("--vary", "slider_velocity=1e-3"), "slider_velocity is given twice, as 5e-3,1e-2 and"),
    ],
)
def test_what_cannot_be_run_is_refused_in_a_sentence(springblock, folder, others, sentence):
    assert sentence in swept(springblock, folder, *others, refused=True)


@pytest.mark.parametrize(
    "command", [("simulate", "--last-seed", "999"), ("sweep", "--seeds", "999", "--jobs", "2")]
)
def test_an_interrupt_ends_in_one_line_and_leaves_no_half_written_file(command, tmp_path):
    """Sent to all processes of the command, as a terminal does."""
    words = [*command, "--n-blocks", "60", "--output", str(tmp_path / "runs")]
    said = tmp_path / "said"
    with said.open("w") as log:
        run = subprocess.Popen(
            [sys.executable, "-m", "springblock", *words],
            stderr=log,
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
    left = [file for file in tmp_path.rglob("*") if file.is_file() and file != said]
    assert bool(left) == (command[0] == "sweep")
    assert all(load(file).num_rows == 5 for file in left)
