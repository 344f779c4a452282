"""springblock aggregate and correlation: tables of realisations and of their correlations."""

from itertools import chain, groupby
from operator import attrgetter
from pathlib import Path

import click

from springblock.analysis.correlations import correlations
from springblock.analysis.suspects import suspects
from springblock.cli.options import INPUT, Output
from springblock.io.parquet import read, rows_to_table, write
from springblock.io.records import read_records
from springblock.io.rows import scene_of
from springblock.io.schemas import CORRELATION, CORRELATION_LENGTH, SUMMARY
from springblock.provenance import ANALYSE, SIMULATE, of_study


@click.command("aggregate")
@click.argument("batches", type=INPUT, nargs=-1, required=True)
@click.option("--realisations", type=int, help="Expected number of realisations.")
@click.option("--output", type=Output(".parquet"), required=True, help="Parquet file.")
def aggregate(batches: tuple[Path, ...], realisations: int | None, output: Path) -> None:
    """Collect BATCHES in one table, one row per realisation, in their order."""
    table = read(batches, SUMMARY)
    if realisations not in (None, table.num_rows):
        raise ValueError(f"{table.num_rows} realisations in the batches; expected {realisations}")
    for row in suspects(table.to_pylist()):
        which = f"{scene_of(row)}, seed = {row['seed']}"
        click.echo(f"warning: energy residual {row['energy_error']:.1e} at {which}")
    write(table, output, of_study(SIMULATE))


@click.command("correlation")
@click.argument("batches", type=INPUT, nargs=-1, required=True)
@click.option(
    "--output-correlation", type=Output(".parquet"), required=True, help="Parquet file of c(r)."
)
@click.option(
    "--output-length", type=Output(".parquet"), required=True, help="Parquet file of l_c."
)
def correlation(batches: tuple[Path, ...], output_correlation: Path, output_length: Path) -> None:
    """Correlate detachment times along the sides of pillars.

    The BATCHES of each folder must hold one scene.
    """
    folders = groupby(batches, attrgetter("parent"))
    found = [correlations(read_records(files)) for _, files in folders]
    curves, lengths = (list(chain.from_iterable(rows)) for rows in zip(*found, strict=True))
    write(rows_to_table(curves, CORRELATION), output_correlation, of_study(ANALYSE))
    write(rows_to_table(lengths, CORRELATION_LENGTH), output_length, of_study(ANALYSE))
