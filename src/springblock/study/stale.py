"""Tables and pictures of another configuration, which Snakemake shall make again."""

import sys
from collections.abc import Mapping
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq
from PIL import Image


def remove_others(wanted: Mapping[str, str], dryrun: bool) -> None:
    """Remove tables and pictures that keep another digest than that wanted of them, and say so.

    They are made again from realisations, whatever Snakemake remembers of them or is told to
    ignore: lost metadata, `--touch` and `--rerun-triggers` cannot hide them. A dry run removes
    nothing.
    """
    others = [
        file for file in map(Path, wanted) if file.exists() and _kept(file) != wanted[str(file)]
    ]
    for file in [] if dryrun else others:
        file.unlink()
    if others:
        told = f"{len(others)} tables and pictures are of another configuration: made again"
        print(told, file=sys.stderr)


def _kept(file: Path) -> str:
    """Return the digest that a table keeps of its study, or a picture of its files; "" without."""
    try:
        if file.suffix == ".parquet":
            metadata = pq.read_schema(file).metadata or {}
            return metadata.get(b"study", b"").decode()
        with Image.open(file) as picture:
            return str(picture.info.get("Source", ""))
    except (pa.ArrowException, OSError):
        return "damaged"
