"""What may become of a file."""

import os
import shutil
from dataclasses import replace
from zipfile import ZipFile

import pyarrow as pa
import pyarrow.parquet as pq

from springblock.io.parquet import load, origin_of, write
from springblock.simulation.prelude import Prelude

FLAT, PILLARS = "n_blocks-12/level-0/direction-x", "n_blocks-12/level-1/n_p-6/n_s-6/direction-x"
BATCH = f"realisations/{FLAT}/batch-0.parquet"
OTHER = f"realisations/{PILLARS}/batch-0.parquet"
PRELUDE = f"preludes/{FLAT}.npz"
TABLE = "tables/realisations.parquet"


def truncated(file, study):
    content = file.read_bytes()
    file.write_bytes(content[: len(content) // 8])


def flipped(file, study):
    content = bytearray(file.read_bytes())
    place = len(content) // 3
    if file.suffix == ".npz":  # within an array: of what surrounds it, some bits mean nothing
        with ZipFile(file) as packed:
            array = max(packed.infolist(), key=lambda part: part.compress_size)
        place = array.header_offset + 60 + array.compress_size // 2
    content[place] ^= 4
    file.write_bytes(content)


def unsealed(file, study):
    """As the study wrote it before there were checksums."""
    table = load(file)
    pq.write_table(table.replace_schema_metadata(None), file)


def old(damage):
    """The same, with the time stamp of before."""

    def damaged(file, study):
        before = file.stat()
        damage(file, study)
        os.utime(file, ns=(before.st_atime_ns, before.st_mtime_ns))

    return damaged


def replaced(by):
    """Another whole file in its place."""

    def damaged(file, study):
        shutil.copy(study.results / by, file)

    return damaged


def with_constant(name, value):
    """The same realisations, as if computed with another constant."""

    def damaged(file, study):
        table = load(file)
        place = table.column_names.index(name)
        other = pa.array([value] * len(table))
        write(table.set_column(place, table.schema.field(name), other), file, origin_of(table))

    return damaged


def older_code(file, study):
    older = "0.0.9+0123456789abcdef"
    if file.suffix == ".npz":
        replace(Prelude.read(file), code_version=older).save(file)
    else:
        table = load(file)
        write(table, file, origin_of(table) | {"code_version": older})
