"""springblock info and dictionary: contents of a table, and columns of all tables."""

from pathlib import Path

import click
import pyarrow as pa

from springblock.cli.options import INPUT, OUTPUT
from springblock.files import write_text
from springblock.io.parquet import load, origin_of
from springblock.model.scene import Scene
from springblock.report.dictionary import columns, page

_SHOWN = 12  #: largest number of scenes listed


@click.command("info")
@click.argument("file", type=INPUT)
def info(file: Path) -> None:
    """Describe the table FILE: its rows, scenes, origin, and columns with their units."""
    table = load(file)
    click.echo(f"{file}: {table.num_rows} rows, {table.num_columns} columns")
    for key, value in origin_of(table).items():
        click.echo(f"{key}: {value}")
    _list_scenes(table)
    cells = [[cell.strip("`") for cell in line] for line in columns(table.schema)]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    for *short, meaning in cells:
        padded = (cell.ljust(width) for cell, width in zip(short, widths, strict=False))
        click.echo("  ".join([*padded, meaning]).rstrip())


def _list_scenes(table: pa.Table) -> None:
    """Print the scenes of a table and the number of rows of each."""
    if not {"n_blocks", "varied"} <= set(table.column_names):
        return
    names = [name for name in Scene(1).row if name in table.column_names]
    found = table.group_by(names, use_threads=False).aggregate([([], "count_all")]).to_pylist()
    click.echo(f"{len(found)} scenes, with numbers of rows:")
    for row in found[:_SHOWN]:
        click.echo(f"  {Scene.from_row(row).folder}: {row['count_all']}")
    if len(found) > _SHOWN:
        click.echo(f"  and {len(found) - _SHOWN} more")


@click.command("dictionary")
@click.option("--output", type=OUTPUT, required=True, help="Markdown file.")
def dictionary(output: Path) -> None:
    """Write the meaning and unit of every column of every table."""
    write_text(output, page())
