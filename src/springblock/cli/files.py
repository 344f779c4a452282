"""springblock info and dictionary: contents of a table, and columns of all tables."""

from pathlib import Path

import click

from springblock.cli.options import INPUT, OUTPUT, print_columns
from springblock.files import write_text
from springblock.io.parquet import load, origin_of
from springblock.report.dictionary import columns, page


@click.command("info")
@click.argument("file", type=INPUT)
def info(file: Path) -> None:
    """Describe a table: rows, origin, and columns with units.

    `springblock table` lists its ensembles.
    """
    if file.suffix in (".npz", ".nc"):
        raise ValueError(f"{file} is not a table; info describes Parquet files")
    table = load(file)
    click.echo(f"{file}: {table.num_rows} rows, {table.num_columns} columns")
    for key, value in origin_of(table).items():
        click.echo(f"{key}: {value}")
    print_columns([[cell.strip("`") for cell in line] for line in columns(table.schema)])


@click.command("dictionary")
@click.option("--output", type=OUTPUT, required=True, help="Markdown file.")
def dictionary(output: Path) -> None:
    """Write the columns of all tables with units and meanings."""
    write_text(output, page())
