"""springblock claims: verdicts on the paper's statements."""

from functools import partial
from pathlib import Path

import click

from springblock.claims import STATEMENTS
from springblock.claims.table import SCHEMA, gathered, rows
from springblock.cli.options import INPUT, Output, load_as
from springblock.io.parquet import rows_to_table, write
from springblock.io.records import read_records
from springblock.io.rows import Row
from springblock.provenance import of_study


def _rows(name: str, table: Path | None) -> list[Row]:
    """Return the rows of a table, if any."""
    return load_as(name, table).to_pylist() if table else []


_table = partial(click.option, type=INPUT)


@click.command("claims")
@click.argument("batches", type=INPUT, nargs=-1, required=True)
@_table("--correlation", help="Table `correlation`.")
@_table("--correlation-length", help="Table `correlation_length`.")
@_table("--work-precision", help="Table `work_precision`.")
@click.option("--output", type=Output(".parquet"), required=True, help="Parquet file.")
def claims(
    batches: tuple[Path, ...],
    correlation: Path | None,
    correlation_length: Path | None,
    work_precision: Path | None,
    output: Path,
) -> None:
    """Test the paper's statements.

    The tests use BATCHES of realisations and tables. Statements whose data are missing are not
    tested.
    """
    evidence = gathered(
        read_records(batches, snapshots=True),
        correlation=_rows("correlation", correlation),
        correlation_length=_rows("correlation_length", correlation_length),
        precision=_rows("work_precision", work_precision),
    )
    write(rows_to_table(rows(STATEMENTS, evidence), SCHEMA), output, of_study("claims"))
