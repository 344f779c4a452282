"""Runs are read back as they were."""

import subprocess
import sys

import numpy as np
import pyarrow as pa
import pytest

from springblock import Pattern, draw_friction, read, simulate
from springblock.cli.simulate import batch_row
from springblock.io.parquet import rows_to_table, write
from springblock.io.schemas import BATCH, SNAPSHOTS
from springblock.model.scene import Scene
from springblock.simulation.setup import Setup

SCENE = Scene(n_blocks=6, n_p=2, n_s=1)
TIMES = (1e-6, 1.5e-4)  #: s; before all detachments and amid them


@pytest.fixture(scope="module")
def runs():
    """By their seeds, the higher one first."""
    contact = Pattern.pillars(6, 2, 1).contact
    return {
        seed: simulate(contact, *draw_friction(6, seed), duration=1.6e-4, snapshot_times=TIMES)
        for seed in (4, 3)
    }


def stored(runs, path, schema):
    rows = [batch_row(SCENE, Setup(), seed, run) for seed, run in runs.items()]
    write(rows_to_table(rows, schema), path, {})
    return path


def test_runs_are_in_order_of_their_seeds_and_have_their_snapshots(runs, tmp_path):
    path = stored(runs, tmp_path / "a.parquet", pa.schema([*BATCH, *SNAPSHOTS]))
    assert (runs[3].snapshots[1] != runs[4].snapshots[1]).any()
    read_back = read(str(path))
    assert [run.seed for run in read_back] == [3, 4]
    for run in read_back:
        told = runs[run.seed]
        assert run.scene == SCENE
        for name in ("force", "detachments", "switches", "t_det", "contact"):
            np.testing.assert_array_equal(getattr(run, name), getattr(told, name))
        assert run.time == pytest.approx(told.time, rel=1e-15)
        assert (run.t_max, run.static_friction) == (told.t_max, told.static_friction)
        assert run.snapshot_times.tobytes() == told.snapshot_times.tobytes()
        assert run.snapshots.tobytes() == told.snapshots.tobytes()
        assert run.snapshots.shape == (2, 2, 6, 6)


def test_a_run_says_in_one_line_which_it_is_and_may_have_no_snapshots(runs, tmp_path):
    (run, _) = read(stored(runs, tmp_path / "a.parquet", BATCH))
    assert len(run.snapshots) == len(run.snapshot_times) == 0
    scene = "n_blocks = 6, level = 1, n_p = 2, n_s = 1, direction = x, seed = 3"
    assert repr(run).startswith(f"<{scene}: static friction ")
    assert "\n" not in repr(run)


def test_what_is_no_file_of_runs_is_refused(tmp_path):
    write(pa.table({"level": [1]}), tmp_path / "a.parquet", {})
    with pytest.raises(ValueError, match=r"a.parquet lacks the column 'n_p'"):
        read(tmp_path / "a.parquet")
    with pytest.raises(FileNotFoundError):
        read(tmp_path / "b.parquet")


def test_nothing_slow_is_imported_before_it_is_needed():
    script = "import sys, springblock; print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert loaded.returncode == 0, loaded.stderr
    slow = {"matplotlib", "numba", "pandas", "PIL", "pyarrow", "scipy", "tqdm"}
    assert not slow & set(loaded.stdout.split())
