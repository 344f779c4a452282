"""Tables of another configuration, which Snakemake shall make again."""

import sys
from collections.abc import Iterable
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq


def remove_others(tables: Iterable[str], study: str, dryrun: bool) -> None:
    """Remove tables that keep the digest of another study than this, and say so.

    They are made again from realisations, whatever Snakemake remembers of them or is told to
    ignore: lost metadata, `--touch` and `--rerun-triggers` cannot hide them. A dry run removes
    nothing.
    """
    there = [file for file in map(Path, tables) if file.exists()]
    others = [file for file in there if _study_of(file) != study]
    for file in [] if dryrun else others:
        file.unlink()
    if others:
        print(f"{len(others)} tables are of another configuration: made again", file=sys.stderr)


def _study_of(table: Path) -> str:
    """Return the digest of the study that a table keeps; "" without one."""
    try:
        metadata = pq.read_schema(table).metadata or {}
    except (pa.ArrowException, OSError):
        return "damaged"
    return metadata.get(b"study", b"").decode()
