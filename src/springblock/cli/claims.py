"""springblock claims: verdicts on the paper's statements."""

from collections.abc import Iterable
from functools import partial
from itertools import chain
from pathlib import Path

import click

from springblock.claims import STATEMENTS
from springblock.claims.table import SCHEMA, gathered, rows
from springblock.cli.options import INPUT, Output, code_version, load_as
from springblock.io.parquet import load, refuse_mixture, rows_to_table, write
from springblock.io.records import read_records
from springblock.io.rows import Row


def _rows(name: str, tables: Iterable[Path]) -> list[Row]:
    return list(chain.from_iterable(load_as(name, table).to_pylist() for table in tables))


_files = partial(click.option, type=INPUT, multiple=True)


@click.command("claims")
@click.argument("batches", type=INPUT, nargs=-1, required=True)
@_files("--correlation", help="Table `correlation`. Can be repeated.")
@_files("--correlation-length", help="Table `correlation_length`. Can be repeated.")
@_files("--work-precision", help="Table `work_precision`. Can be repeated.")
@click.option("--configuration", required=True, help="Digest of the study's configuration.")
@click.option("--output", type=Output(".parquet"), required=True, help="Parquet file.")
def claims(
    batches: tuple[Path, ...],
    correlation: tuple[Path, ...],
    correlation_length: tuple[Path, ...],
    work_precision: tuple[Path, ...],
    configuration: str,
    output: Path,
) -> None:
    """Test the paper's statements.

    The tests use BATCHES of realisations and tables. Statements whose data are missing are not
    tested.
    """
    refuse_mixture((file, load(file)) for file in (batches[0], *correlation, *correlation_length))
    evidence = gathered(
        read_records(batches, snapshots=True),
        correlation=_rows("correlation", correlation),
        correlation_length=_rows("correlation_length", correlation_length),
        precision=_rows("work_precision", work_precision),
    )
    origin = {"code_version": code_version("claims"), "configuration_digest": configuration}
    write(rows_to_table(rows(STATEMENTS, evidence), SCHEMA), output, origin)
