"""springblock accuracy: the page that says what to trust."""

from pathlib import Path

import click

from springblock.accuracy.page import page
from springblock.cli.options import INPUT, OUTPUT, one_sentence
from springblock.files import whole_file
from springblock.io.parquet import load


@click.command("accuracy")
@click.argument("precision", type=INPUT)
@click.argument("stability", type=INPUT)
@click.argument("realisations", type=INPUT)
@click.option("--production", type=INPUT, help="Table of errors at full size, if there is one.")
@click.option("--output", type=OUTPUT, required=True, help="Markdown file.")
def write_page(
    precision: Path, stability: Path, realisations: Path, production: Path | None, output: Path
) -> None:
    """Write the page from the tables PRECISION, STABILITY and REALISATIONS."""
    tables = [precision, stability, realisations] + ([production] if production else [])
    with one_sentence():
        text = page(*(load(table).to_pylist() for table in tables))
        with whole_file(output) as partial:
            partial.write_text(text, encoding="utf-8")
