"""springblock report: the report of a study."""

from pathlib import Path

import click

from springblock.cli.options import INPUT, Output
from springblock.files import write_text
from springblock.study.report.page import report_page


@click.command("report")
@click.argument("files", type=INPUT, nargs=-1, required=True)
@click.option(
    "--film",
    "films",
    type=(INPUT, INPUT),
    multiple=True,
    help="GIF file and the batch whose first run it shows. Can be repeated.",
)
@click.option("--own", is_flag=True, help="Report on a study with `study: own`.")
@click.option("--output", type=Output(".html"), required=True, help="HTML file.")
def report(
    files: tuple[Path, ...], films: tuple[tuple[Path, Path], ...], own: bool, output: Path
) -> None:
    """Write the HTML report of a study.

    FILES are pictures (PNG), pages (Markdown) and tables (Parquet). With --own the report begins
    with means and changes of the table `realisations`.
    """
    write_text(output, report_page(files, dict(films), own))
