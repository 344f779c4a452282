"""Runs read back from the file that `springblock simulate` has written."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pyarrow.parquet as pq

from springblock.tables import SNAPSHOTS, Record, read_records
from springblock.tables import read as read_columns


def read(path: str | Path) -> list[Record]:
    """Read the runs of one file, in order of their seeds.

    Each has the fields of `Realisation` but for energy, steps and the last displacements and
    velocities, which are not stored, and knows its `scene`, `seed` and `material`.

    Raises
    ------
    FileNotFoundError
        Where there is no such file.
    ValueError
        Where it is no such file, naming what it lacks.
    """
    records = read_records([Path(path)])
    if "snapshots" not in pq.read_schema(path).names:
        return records
    return list(_with_snapshots(records, Path(path)))


def _with_snapshots(records: list[Record], path: Path) -> Iterator[Record]:
    table = read_columns([path], SNAPSHOTS)
    seeds = pq.read_table(path, columns=["seed"], partitioning=None)["seed"].to_pylist()
    for record in records:
        stored = table.slice(seeds.index(record.seed), 1)
        times, fields = (stored[name][0].values.to_numpy() for name in SNAPSHOTS.names)
        shape = (len(times), 2, *record.t_det.shape)
        yield replace(record, snapshot_times=times, snapshots=fields.reshape(shape))
