"""springblock aggregate: one table of all realisations."""

from pathlib import Path

import click

from springblock.accuracy.conventions import suspects
from springblock.cli.options import INPUT, OUTPUT, code_version, one_sentence
from springblock.io.parquet import read, write
from springblock.io.schemas import SUMMARY
from springblock.model.scene import COLUMNS


@click.command("aggregate")
@click.argument("batches", type=INPUT, nargs=-1, required=True)
@click.option("--configuration", required=True, help="Digest of the study's configuration.")
@click.option("--realisations", type=int, help="How many there must be.")
@click.option("--output", type=OUTPUT, required=True, help="Parquet file.")
def aggregate(
    batches: tuple[Path, ...], configuration: str, realisations: int | None, output: Path
) -> None:
    """Collect the summaries of all BATCHES into one table, a row per realisation."""
    with one_sentence():
        table = read(batches, SUMMARY)
        if realisations not in (None, table.num_rows):
            raise ValueError(f"the batches hold {table.num_rows} realisations, not {realisations}")
        table = table.sort_by([(name, "ascending") for name in [*COLUMNS, "seed"]])
        for row in suspects(table.to_pylist(), COLUMNS):
            which = ", ".join(f"{key} = {row[key]}" for key in [*COLUMNS, "seed"])
            click.echo(f"warning: energy residual {row['energy_error']:.1e} at {which}")
        metadata = {"code_version": code_version("simulate"), "configuration_digest": configuration}
        write(table, output, metadata)
