"""What may become of a file."""

import os
import shutil

import pyarrow.parquet as pq

from springblock.io.parquet import load, origin_of, write
from springblock.simulation.prelude import Prelude

FLAT, PILLARS = "n_blocks-12/level-0/direction-x", "n_blocks-12/level-1/n_p-6/n_s-6/direction-x"
BATCH = f"realisations/{FLAT}/seeds-0-1.parquet"
OTHER = f"realisations/{PILLARS}/seeds-0-1.parquet"
PRELUDE, OTHER_PRELUDE = f"preludes/{FLAT}.npz", f"preludes/{PILLARS}.npz"
TABLE = "tables/realisations.parquet"
CORRELATION = f"correlations/{PILLARS}/correlation.parquet"


def truncated(file, study):
    content = file.read_bytes()
    file.write_bytes(content[: len(content) // 8])


def emptied(file, study):
    file.write_bytes(b"")


def flipped(file, study):
    content = bytearray(file.read_bytes())
    content[len(content) // 3] ^= 4
    file.write_bytes(content)


def text(file, study):
    file.write_text("static_friction,t_max\n0.7,1e-4\n")


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


def seed_missing(file, study):
    table = load(file)
    write(table.slice(0, 1), file, origin_of(table))


def with_constant(name, value):
    """The same realisations, as if computed with another constant."""

    def damaged(file, study):
        table = load(file)
        made_by = origin_of(table)
        made_by["configuration"] = made_by["configuration"].replace(*value)
        write(table, file, made_by)

    damaged.__name__ = name
    return damaged


def older_code(file, study):
    if file.suffix == ".npz":
        loaded = Prelude.read(file)
        object.__setattr__(loaded, "code_version", "0.0.9+0123456789abcdef")
        loaded.save(file)
        return
    table = load(file)
    write(table, file, origin_of(table) | {"code_version": "0.0.9+0123456789abcdef"})


def outdated(file, study):
    """Whole, but of realisations that have been computed again since."""
    batch = study.results / BATCH
    table = load(batch)
    write(table.slice(0), batch, origin_of(table) | {"again": "and differently"})
