"""springblock info and dictionary: contents of a file, and columns of all tables."""

import zipfile
from pathlib import Path

import click
import pyarrow as pa

from springblock.cli.options import INPUT, OUTPUT
from springblock.files import write_text
from springblock.io.fields import VARIABLES, read_fields
from springblock.io.parquet import load, origin_of
from springblock.model.scene import Scene
from springblock.report.dictionary import columns, page, tables
from springblock.simulation.prelude import Prelude

_SHOWN = 12  #: largest number of scenes listed


@click.command("info")
@click.argument("file", type=INPUT)
def info(file: Path) -> None:
    """Describe FILE (table, prelude or fields): rows, scenes, origin, columns with their units."""
    describe = _fields if file.suffix == ".nc" else _table
    for line in _prelude(file) if zipfile.is_zipfile(file) else describe(file):
        click.echo(line)


def _fields(file: Path) -> list[str]:
    fields, attributes = read_fields(file)
    rows, columns = fields.contact.shape
    return [
        f"{file}: fields of {columns} x {rows} blocks at {len(fields.time)} times",
        *(f"{key}: {value}" for key, value in attributes.items()),
        *(f"{name} ({unit}): {meaning}" for name, (unit, meaning, _) in VARIABLES.items()),
    ]


def _prelude(file: Path) -> list[str]:
    loaded = Prelude.read(file)
    states = ", ".join(str(samples) for samples in loaded.samples)
    constants = ", ".join(f"{name}={value}" for name, value in loaded.constants.items())
    return [
        f"{file}: the loading of a scene before its first detachment",
        f"states after {states} samples",
        f"material: {constants}",
    ]


def _table(file: Path) -> list[str]:
    table = load(file)
    schema, origin = table.schema, origin_of(table)
    lines = [f"{file}: {table.num_rows} rows, {len(schema)} columns"]
    lines += [f"{key}: {value}" for key, value in origin.items()]
    lines += _scenes(table)
    cells = [[cell.strip("`") for cell in line] for line in columns(schema)]
    widths = [max(len(line[i]) for line in cells) for i in range(3)]
    for *short, meaning in cells:
        padded = (cell.ljust(width) for cell, width in zip(short, widths, strict=True))
        lines.append("  ".join([*padded, meaning]).rstrip())
    return lines


def _scenes(table: pa.Table) -> list[str]:
    """List the scenes of a table and the number of rows of each."""
    if not {"n_blocks", "varied"} <= set(table.column_names):
        return []
    names = [name for name in Scene(1).row if name in table.column_names]
    found = table.group_by(names, use_threads=False).aggregate([([], "count_all")]).to_pylist()
    lines = [f"  {Scene.from_row(row).folder}: {row['count_all']}" for row in found]
    more = [f"  and {len(lines) - _SHOWN} more"] if len(lines) > _SHOWN else []
    return [f"{len(lines)} scenes, with numbers of rows:", *lines[:_SHOWN], *more]


@click.command("dictionary")
@click.option("--output", type=OUTPUT, required=True, help="Markdown file.")
def dictionary(output: Path) -> None:
    """Write the meaning and unit of every column of every table."""
    write_text(output, page(tables()))
