"""Tables and pictures of another configuration, which Snakemake shall make again."""

import os
from collections.abc import Iterable
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq
from PIL import Image, UnidentifiedImageError


def set_back(files: Iterable[str], study: str) -> None:
    """Set the time stamps of those files to 1970 that say they are of another study, or nothing.

    Snakemake makes them again, since they are older than their inputs, whatever it remembers or is
    told to ignore: lost metadata, `--touch` and `--rerun-triggers mtime` cannot hide them.
    """
    for file in map(Path, files):
        if file.exists() and _study_of(file) != study:
            os.utime(file, (0, 0))


def _study_of(file: Path) -> str | None:
    """Return the digest of the study that a table or picture keeps; None without one."""
    try:
        if file.suffix == ".parquet":
            metadata = pq.read_schema(file).metadata or {}
            return metadata.get(b"study", b"").decode() or None
        with Image.open(file) as picture:
            kept = picture.info.get("Source") or picture.info.get("comment") or b""
        return kept.decode() if isinstance(kept, bytes) else str(kept)
    except (pa.ArrowException, OSError, UnidentifiedImageError):
        return None
