"""springblock collect: one table of many."""

from pathlib import Path

import click

from springblock.cli.options import INPUT, OUTPUT, one_sentence
from springblock.io.parquet import load, origin_of, read, write


@click.command("collect")
@click.argument("tables", type=INPUT, nargs=-1, required=True)
@click.option("--configuration", help="Digest of the configuration, where one matters.")
@click.option("--output", type=OUTPUT, required=True, help="Parquet file.")
def collect(tables: tuple[Path, ...], configuration: str | None, output: Path) -> None:
    """Collect TABLES of equal columns, made by the same code, in one."""
    with one_sentence():
        first = load(tables[0])
        metadata = {"code_version": origin_of(first)["code_version"]}
        if configuration is not None:
            metadata["configuration_digest"] = configuration
        write(read(tables, first.schema.remove_metadata()), output, metadata)
