"""Errors that no check foresees, and the surroundings in which commands are called."""

import os
import subprocess
import sys

import pytest

from springblock.cli import tables


@pytest.mark.parametrize(
    ("error", "said"),
    [
        (KeyError("x"), "info table: KeyError('x'); SPRINGBLOCK_TRACEBACK=1 shows where this"),
        (RecursionError("too deep"), "info table: RecursionError('too deep'); SPRINGBLOCK"),
        (ValueError(), "info table: ValueError(); SPRINGBLOCK"),
        (MemoryError("72 GB"), "info table: there is not enough memory. 72 GB"),
        (FileNotFoundError(2, "gone", "table"), "[Errno 2] gone: 'table'"),
    ],
)
def test_an_unforeseen_error_names_the_command(springblock, monkeypatch, tmp_path, error, said):
    def fail(*_):
        raise error

    (tmp_path / "table").touch()
    monkeypatch.setattr(tables, "load", fail)
    monkeypatch.setattr(sys, "argv", ["springblock", "info", "table"])
    assert springblock("info", tmp_path / "table", refused=True).startswith(f"Error: {said}")


def called(*words, **environment):
    """Call `springblock` in a process of its own."""
    command = [sys.executable, "-m", "springblock", *map(str, words)]
    ours = {**os.environ, **environment}
    return subprocess.run(command, env=ours, capture_output=True, text=True)


@pytest.mark.parametrize("asked", ["", "1"])
def test_the_traceback_of_an_error_is_shown_on_request(asked):
    said = called("info", __file__, SPRINGBLOCK_TRACEBACK=asked).stderr
    assert ("Traceback" in said) == bool(asked)
    assert said.splitlines()[-1].startswith(f"Error: {__file__} is damaged, or not")


def test_output_that_nobody_reads_ends_a_command_quietly(batch):
    """With the status of a program that the broken pipe ends."""
    reading, writing = os.pipe()
    os.close(reading)
    words = [sys.executable, "-m", "springblock", "info", str(batch(0, 2))]
    with os.fdopen(writing, "w") as pipe:
        run = subprocess.run(words, stdout=pipe, stderr=subprocess.PIPE, text=True)
    assert (run.returncode, run.stderr) == (141, "")


def test_settings_for_notebooks_and_debuggers_do_not_matter(tmp_path):
    """Matplotlib's backend may be missing here; kernels have parts that are only compiled."""
    settings = {"MPLBACKEND": "module://missing", "NUMBA_DISABLE_JIT": "1"}
    run, picture = tmp_path / "run.parquet", tmp_path / "run.png"
    size = ("--n-blocks", 4, "--duration", 1e-6)
    for words in (("simulate", *size, "--output", run), ("plot", run, "--output", picture)):
        done = called(*words, **settings)
        assert done.returncode == 0, done.stderr
    assert picture.exists()
