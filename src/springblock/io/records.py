"""Stored runs, read from the files of `springblock simulate`."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from operator import attrgetter
from pathlib import Path
from typing import TypeVar

import numpy as np
import pyarrow as pa

from springblock.io.parquet import read as read_tables
from springblock.io.rows import scene_of
from springblock.io.schemas import BATCH, SCENE, SNAPSHOTS
from springblock.model.material import Material
from springblock.model.scene import Scene
from springblock.simulation.run import Run

T = TypeVar("T")
_NUMBERS = ("seed", "normal_force", "onset_end", "dynamic_friction")


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Record(Run):
    """A stored run, with its scene and seed."""

    scene: Scene
    seed: int
    snapshot_times: np.ndarray = field(default_factory=lambda: np.empty(0))
    snapshots: np.ndarray = field(default_factory=lambda: np.empty((0, 2, 0, 0)))

    @property
    def material(self) -> Material:
        """Material of the run."""
        return self.scene.material

    @property
    def name(self) -> str:
        """Its scene and its seed."""
        return f"{self.scene}, seed = {self.seed}"


def read(path: str | Path) -> list[Record]:
    """Read the runs of one file, in ascending order of seeds.

    Each has the fields of `Run`, and also `scene`, `seed` and `material`.

    Raises
    ------
    FileNotFoundError
        If the file does not exist.
    ValueError
        If the file is damaged, or lacks a column of such tables.
    """
    return read_records([Path(path)], snapshots=True)


def read_records(paths: Iterable[Path], snapshots: bool = False) -> list[Record]:
    """Read stored realisations in ascending order of seeds.

    Their snapshots, each as large as a realisation, are read on request only.
    """
    table = read_tables(paths, BATCH, *([SNAPSHOTS] if snapshots else []))
    records = [_record(table.slice(i, 1)) for i in range(table.num_rows)]
    return sorted(records, key=lambda record: record.seed)


def _record(row: pa.Table) -> Record:
    scene = scene_of(row.select(SCENE.names).to_pylist()[0])
    interval = scene.sample_interval
    fields = {
        name: row[name][0].values.to_numpy(zero_copy_only=False)
        for name in ("force", "detachments", "switches", "t_det", "contact")
    }
    fields |= {name: fields[name].reshape(scene.shape) for name in ("t_det", "contact")}
    if scene.mask is not None:
        scene = replace(scene, mask=replace(scene.mask, values=fields["contact"]))
    if "snapshots" in row.column_names and row["snapshots"][0].is_valid:
        samples = np.rint(np.array(scene.snapshot_times) / interval)
        stored = row["snapshots"][0].values.to_numpy().reshape(-1, 2, *scene.shape)
        fields |= {"snapshot_times": interval * samples, "snapshots": stored}
    return Record(
        scene=scene,
        time=interval * np.arange(len(fields["force"]), dtype=float),
        **{name: row[name][0].as_py() for name in _NUMBERS},
        **fields,
    )


def by_scene(
    items: Iterable[T], of: Callable[[T], Scene] = attrgetter("scene")
) -> dict[Scene, list[T]]:
    """Realisations, or rows of tables, by scene, in order of first appearance.

    Scenes on surfaces that are not of the paper's kind are left out.
    """
    found: dict[Scene, list[T]] = {}
    for item in items:
        if (scene := of(item)).is_papers:
            found.setdefault(scene, []).append(item)
    return found
