"""springblock beyond: what was learnt beyond the paper, as a page."""

from pathlib import Path

import click

from springblock.beyond import QUESTIONS
from springblock.beyond.page import page
from springblock.beyond.question import by_scene
from springblock.cli.options import INPUT, OUTPUT, one_sentence
from springblock.files import whole_file
from springblock.io.records import read_records


@click.command("beyond")
@click.argument("batches", type=INPUT, nargs=-1, required=True)
@click.option("--output", type=OUTPUT, required=True, help="Markdown file.")
def beyond(batches: tuple[Path, ...], output: Path) -> None:
    """Answer questions beyond the paper from BATCHES of realisations, where they suffice."""
    with one_sentence():
        text = page(QUESTIONS, by_scene(read_records(batches)))
        with whole_file(output) as partial:
            partial.write_text(text, encoding="utf-8")
