"""springblock measure: errors of integrators, in one comparison on one scene."""

from pathlib import Path

import click

from springblock.accuracy.conventions import COMPARISONS, SCENES
from springblock.accuracy.work_precision import ROWS, SCHEMA
from springblock.cli.options import OUTPUT, code_version, one_sentence
from springblock.io.parquet import rows_to_table, write


@click.command("measure")
@click.option("--comparison", type=click.Choice(COMPARISONS), required=True)
@click.option("--scene", type=click.Choice(SCENES), required=True)
@click.option("--output", type=OUTPUT, required=True, help="Parquet file.")
def measure(comparison: str, scene: str, output: Path) -> None:
    """Measure errors and run times in one comparison on one scene."""
    with one_sentence():
        table = rows_to_table(list(ROWS[comparison](scene)), SCHEMA)
        # there is nothing to configure
        write(table, output, {"code_version": code_version("accuracy")})
