"""springblock aggregate: one table of all realisations."""

from pathlib import Path

import click
import pyarrow as pa

from springblock.commands.options import INPUT, OUTPUT, one_sentence
from springblock.sources import code_version
from springblock.tables import SUMMARY, read, write

#: A realisation whose energy residual exceeds this is reported.
ENERGY_TOLERANCE = 5e-4


@click.command("aggregate")
@click.argument("batches", type=INPUT, nargs=-1, required=True)
@click.option("--configuration", required=True, help="Digest of the study's configuration.")
@click.option("--output", type=OUTPUT, required=True, help="Parquet file.")
def aggregate(batches: tuple[Path, ...], configuration: str, output: Path) -> None:
    """Collect the summaries of all BATCHES into one table, a row per realisation."""
    with one_sentence():
        table = read(batches, SUMMARY)
        keys = [name for name in SUMMARY.names if name in KEYS]
        table = table.sort_by([(name, "ascending") for name in keys])
        _refuse_duplicates(table, keys)
        for row in table.to_pylist():
            if not abs(row["energy_error"]) <= ENERGY_TOLERANCE:
                scene = ", ".join(f"{key} = {row[key]}" for key in keys)
                click.echo(f"warning: energy residual {row['energy_error']:.1e} at {scene}")
        write(
            table,
            output,
            {"code_version": code_version(__name__), "configuration_digest": configuration},
        )


#: What tells one realisation from another.
KEYS = ("n_blocks", "level", "n_p", "n_s", "n_p2", "n_s2", "direction", "seed")


def _refuse_duplicates(table: pa.Table, keys: list[str]) -> None:
    counts = table.group_by(keys).aggregate([([], "count_all")])
    repeated = [row for row in counts.to_pylist() if row["count_all"] > 1]
    if repeated:
        raise ValueError(f"the batches hold this realisation more than once: {repeated[0]}")
