"""Runs read back from the file that `springblock simulate` has written."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pyarrow as pa

from springblock.io.tables import SNAPSHOTS, Record, load, read_records


def read(path: str | Path) -> list[Record]:
    """Read the runs of one file, in order of their seeds.

    Each has the fields of `Realisation` but for energy, steps and the last displacements and
    velocities, which are not stored, and knows its `scene`, `seed` and `material`.

    Raises
    ------
    FileNotFoundError
        Where there is no such file.
    ValueError
        Where it is no such file, naming what it lacks, or is not as it was written.
    """
    records, table = read_records([Path(path)]), load(Path(path))
    if "snapshots" not in table.column_names:
        return records
    return list(_with_snapshots(records, table))


def _with_snapshots(records: list[Record], table: pa.Table) -> Iterator[Record]:
    seeds = table["seed"].to_pylist()
    for record in records:
        stored = table.slice(seeds.index(record.seed), 1)
        times, fields = (stored[name][0].values.to_numpy() for name in SNAPSHOTS.names)
        shape = (len(times), 2, *record.t_det.shape)
        yield replace(record, snapshot_times=times, snapshots=fields.reshape(shape))
