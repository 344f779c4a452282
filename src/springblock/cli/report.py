"""springblock report: the page that shows a study."""

from pathlib import Path

import click

from springblock.cli.options import INPUT, OUTPUT, one_sentence
from springblock.files import whole_file


@click.command("report")
@click.argument("files", type=INPUT, nargs=-1, required=True)
@click.option(
    "--film",
    "films",
    type=(INPUT, INPUT),
    multiple=True,
    help="MP4 file, and the batch whose first run it shows. Can be repeated.",
)
@click.option("--output", type=OUTPUT, required=True, help="HTML file.")
def report(files: tuple[Path, ...], films: tuple[tuple[Path, Path], ...], output: Path) -> None:
    """Show FILES of a study in one page: pictures (PNG), pages (Markdown) and tables (Parquet)."""
    from springblock.report.page import page  # needs what the study needs

    with one_sentence():
        text = page(files, dict(films))
        with whole_file(output) as partial:
            partial.write_text(text, encoding="utf-8")
