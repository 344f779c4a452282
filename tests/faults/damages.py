"""What may become of a file."""

import json
import shutil
from dataclasses import replace
from zipfile import ZipFile

import pyarrow as pa

from springblock.io.identity import metadata
from springblock.io.parquet import load, origin_of, write
from springblock.simulation.prelude import Prelude

FLAT, PILLARS = "n_blocks-12/level-0/direction-x", "n_blocks-12/level-1/n_p-6/n_s-6/direction-x"
BATCH = f"realisations/{FLAT}/batch-0.parquet"
OTHER = f"realisations/{PILLARS}/batch-0.parquet"
PRELUDE = f"preludes/{FLAT}.npz"
TABLE = "tables/realisations.parquet"
CORRELATION = f"correlations/{PILLARS}/correlation.parquet"


def truncated(file, results):
    content = file.read_bytes()
    file.write_bytes(content[: len(content) // 8])


def flipped(file, results):
    content = bytearray(file.read_bytes())
    place = len(content) // 3
    if file.suffix == ".npz":  # within an array: of what surrounds it, some bits mean nothing
        with ZipFile(file) as packed:
            array = max(packed.infolist(), key=lambda part: part.compress_size)
        place = array.header_offset + 60 + array.compress_size // 2
    content[place] ^= 4
    file.write_bytes(content)


def replaced(file, results, by):
    """Another whole file of the study in its place."""
    shutil.copy(results / by, file)


def of_another(file, results, **names):
    """Whole, but of runs of another identity."""
    table = load(file)
    origin = origin_of(table)
    other = json.loads(origin["configuration"]) | names
    for name in names.keys() & set(table.column_names):
        place = table.column_names.index(name)
        column = pa.array([names[name]] * len(table), table.schema.types[place])
        table = table.set_column(place, table.schema.field(place), column)
    write(table, file, origin | metadata(other, origin["code_version"]))


def of_another_configuration(file, results):
    """A table, or a prelude of other conditions."""
    if file.suffix == ".npz":
        begun = Prelude.read(file)
        replace(begun, conditions=begun.conditions.replace("5000.0", "4000.0")).save(file)
    else:
        table = load(file)
        write(table, file, origin_of(table) | {"configuration_digest": 16 * "0"})


def added(file, results):
    """A file that the study does not have."""
    file.parent.mkdir(parents=True, exist_ok=True)
    shutil.copy(results / BATCH, file)


def of_older_code(file, results):
    older = "0.0.9+0123456789abcdef"
    if file.suffix == ".npz":
        replace(Prelude.read(file), code_version=older).save(file)
    else:
        table = load(file)
        write(table, file, origin_of(table) | {"code_version": older})
