"""Tables and pictures of another configuration, which Snakemake shall make again."""

import sys
from collections.abc import Iterable
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq
from PIL import Image


def remove_others(files: Iterable[str], study: str, dryrun: bool) -> None:
    """Remove tables and pictures that are of another study than this, and say so.

    They are made again from realisations, whatever Snakemake remembers of them or is told to
    ignore: lost metadata, `--touch` and `--rerun-triggers` cannot hide them. A dry run removes
    nothing.
    """
    others = [file for file in map(Path, files) if file.exists() and _study_of(file) != study]
    for file in [] if dryrun else others:
        file.unlink()
    if others:
        told = f"{len(others)} tables and pictures are of another configuration: made again"
        print(told, file=sys.stderr)


def _study_of(file: Path) -> str | None:
    """Return the digest of the study that a table or picture keeps; None without one."""
    try:
        if file.suffix == ".parquet":
            metadata = pq.read_schema(file).metadata or {}
            return metadata.get(b"study", b"").decode() or None
        with Image.open(file) as picture:
            kept = picture.info.get("Source") or picture.info.get("comment") or b""
        return kept.decode() if isinstance(kept, bytes) else str(kept)
    except (pa.ArrowException, OSError):
        return None
