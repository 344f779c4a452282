"""springblock aggregate: one table of all realisations."""

from pathlib import Path

import click
import pyarrow as pa

from springblock.accuracy.conventions import suspects
from springblock.cli.options import INPUT, OUTPUT, one_sentence
from springblock.io.parquet import read, write
from springblock.io.schemas import SUMMARY
from springblock.model.scene import COLUMNS
from springblock.provenance import code_version


@click.command("aggregate")
@click.argument("batches", type=INPUT, nargs=-1, required=True)
@click.option("--configuration", required=True, help="Digest of the study's configuration.")
@click.option("--output", type=OUTPUT, required=True, help="Parquet file.")
def aggregate(batches: tuple[Path, ...], configuration: str, output: Path) -> None:
    """Collect the summaries of all BATCHES into one table, a row per realisation."""
    with one_sentence():
        table = read(batches, SUMMARY)
        table = table.sort_by([(name, "ascending") for name in [*COLUMNS, "seed"]])
        _refuse_duplicates(table)
        for row in suspects(table.to_pylist(), COLUMNS):
            which = ", ".join(f"{key} = {row[key]}" for key in [*COLUMNS, "seed"])
            click.echo(f"warning: energy residual {row['energy_error']:.1e} at {which}")
        metadata = {"code_version": code_version(__name__), "configuration_digest": configuration}
        write(table, output, metadata, batches)


def _refuse_duplicates(table: pa.Table) -> None:
    counts = table.group_by([*COLUMNS, "seed"]).aggregate([([], "count_all")])
    repeated = [row for row in counts.to_pylist() if row["count_all"] > 1]
    if repeated:
        raise ValueError(f"the batches hold this realisation more than once: {repeated[0]}")
