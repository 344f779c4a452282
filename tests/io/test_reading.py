"""Stored runs are read as they were written."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from springblock import Surface, read, simulate
from springblock.io.records import by_scene, read_records
from springblock.model.scene import Scene

BATCH = ("simulate", "--n-blocks", 6, "--n-p", 2, "--n-s", 1, "--first-seed", 9, "--last-seed", 10)
TIMES = (1e-6, 1.5e-4)  #: s; before all detachments and amid them


def test_runs_and_their_snapshots_are_read_back_as_they_were(springblock, tmp_path):
    path, duration, rows = tmp_path / "a.parquet", 1.6e-4, 9
    scene = Scene(6, 2, 1, n_rows=rows, duration=duration, snapshot_times=TIMES)
    asked = ("--duration", duration, "--snapshot-times", f"{TIMES[0]},{TIMES[1]}")
    springblock(*BATCH, "--n-rows", rows, *asked, "--output", path)
    read_back = read(str(path))
    assert [run.seed for run in read_back] == [9, 10]
    for run in read_back:
        surface = Surface.draw(scene.contact, run.seed)
        told = simulate(surface, duration=duration, snapshot_times=TIMES)
        assert run.scene == scene
        for name in ("force", "detachments", "switches", "t_det", "contact"):
            np.testing.assert_array_equal(getattr(run, name), getattr(told, name))
        assert run.time == pytest.approx(told.time, rel=1e-15)
        assert (run.t_max, run.static_friction) == (told.t_max, told.static_friction)
        assert run.snapshot_times.tobytes() == told.snapshot_times.tobytes()
        assert run.snapshots.tobytes() == told.snapshots.tobytes()
        assert run.snapshots.shape == (2, 2, rows, 6)
    assert (read_back[0].snapshots[1] != read_back[1].snapshots[1]).any()


def test_runs_of_several_files_are_in_the_order_of_their_seeds(springblock, tmp_path):
    late, early = tmp_path / "batch-10.parquet", tmp_path / "batch-2.parquet"
    kept = ("--snapshot-times", TIMES[0])
    springblock(*BATCH, *kept, "--output", late)
    springblock(*BATCH[:-4], "--first-seed", 2, *kept, "--output", early)
    found = [(run.seed, len(run.snapshots)) for run in read_records([late, early], snapshots=True)]
    assert found == [(2, 1), (9, 1), (10, 1)]
    assert not any(len(run.snapshots) for run in read_records([late, early]))
    with pytest.raises(ValueError, match="both hold seed 9"):
        read_records([late, early, Path(str(late))])


def test_realisations_are_sorted_by_scene():
    """Those on surfaces that the paper could not have are left out."""
    scenes = [Scene(10), Scene(20), Scene(10), Scene(10, edges="periodic")]
    found = by_scene(SimpleNamespace(scene=scene) for scene in scenes)
    assert {scene: len(runs) for scene, runs in found.items()} == {Scene(10): 2, Scene(20): 1}
