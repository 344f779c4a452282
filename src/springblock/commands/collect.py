"""springblock collect: one table of many."""

from pathlib import Path

import click
import pyarrow.parquet as pq

from springblock.commands.options import INPUT, OUTPUT, one_sentence
from springblock.tables import read, write


@click.command("collect")
@click.argument("tables", type=INPUT, nargs=-1, required=True)
@click.option("--configuration", help="Digest of the configuration, where one matters.")
@click.option("--output", type=OUTPUT, required=True, help="Parquet file.")
def collect(tables: tuple[Path, ...], configuration: str | None, output: Path) -> None:
    """Collect TABLES of equal columns, made by the same code, in one."""
    with one_sentence():
        schemas = [pq.read_schema(table) for table in tables]
        versions = [(each.metadata or {}).get(b"code_version", b"?").decode() for each in schemas]
        if len({version.rpartition("+")[2] for version in versions}) > 1:
            named = ", ".join(sorted(set(versions)))
            raise ValueError(f"the tables must be made by the same code; theirs is {named}")
        metadata = {"code_version": versions[0]}
        if configuration is not None:
            metadata["configuration_digest"] = configuration
        write(read(tables, schemas[0].remove_metadata()), output, metadata)
