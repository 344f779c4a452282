"""springblock production: errors of ensembles of one scene at the study's own size."""

from pathlib import Path

import click

from springblock.accuracy.conventions import SCENES
from springblock.accuracy.production import SCHEMA, production_rows
from springblock.cli.options import OUTPUT, code_version, one_sentence
from springblock.io.parquet import rows_to_table, write


@click.command("production")
@click.option("--scene", type=click.Choice(SCENES), required=True)
@click.option("--output", type=OUTPUT, required=True, help="Parquet file.")
def production(scene: str, output: Path) -> None:
    """Measure biases, scatter and run times of ensembles with N = 120."""
    with one_sentence():
        table = rows_to_table(list(production_rows(scene)), SCHEMA)
        # there is nothing to configure
        write(table, output, {"code_version": code_version("accuracy")})
