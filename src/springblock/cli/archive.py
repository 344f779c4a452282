"""springblock archive: one file to deposit."""

from pathlib import Path

import click

from springblock.cli.options import INPUT, OUTPUT, one_sentence


@click.command("archive")
@click.argument("results", type=click.Path(exists=True, file_okay=False, path_type=Path))
@click.option(
    "--configuration",
    type=INPUT,
    default=Path("config/config.yaml"),
    show_default=True,
    help="What the study was run with.",
)
@click.option("--output", type=OUTPUT, required=True, help="File of type .zip.")
def archive_study(results: Path, configuration: Path, output: Path) -> None:
    """Pack the study in this folder, its code and its RESULTS into one file, an RO-Crate."""
    from springblock.study.archive import archive  # needs what the study needs

    study = Path.cwd()
    with one_sentence():
        number = archive(study, results.absolute(), configuration.absolute(), output)
    click.echo(f"{output} holds {number} files, {output.stat().st_size / 1e6:.1f} MB")
