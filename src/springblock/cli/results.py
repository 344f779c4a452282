"""springblock verify, repair and archive: check, repair and pack results."""

from pathlib import Path

import click

from springblock.analysis.comparison import differences
from springblock.cli.options import INPUT, Output, defaulted
from springblock.io.parquet import load
from springblock.study import audit


@click.command("verify")
@click.argument("results", type=click.Path(exists=True, path_type=Path))
@click.argument("other", type=click.Path(exists=True, path_type=Path), required=False)
def verify(results: Path, other: Path | None) -> None:
    """Check a folder of results, or compare two to the bit.

    A folder is checked against the last configuration of its study, its checksums and the current
    code. With OTHER, the tables of two studies, or two files, are compared to the bit; `springblock
    compare` tests differences of means. The exit status is 0 without a fault or difference, and 1
    otherwise.
    """
    if results.is_file():
        if other is None or not other.is_file():
            raise ValueError(f"{results} is a file; give a second file to compare it with")
        good = _are_the_same(f"{results} and {other}", results, other)
    else:
        good = _is_sound(results, other)
    if not good:
        raise SystemExit(1)


def _is_sound(results: Path, other: Path | None) -> bool:
    """Print the faults of a folder, and how its tables differ from those of another."""
    found = [fault.reason for fault in audit.all_faults(results)]
    complete = f"{results}: all files are there, complete, in their place and of the current code"
    click.echo("\n".join(found or [complete]))
    same = []
    if other is not None:
        files = (file for each in (results, other) for file in each.glob("tables/[!.]*.parquet"))
        for name in sorted({f"tables/{file.name}" for file in files}):
            same.append(_are_the_same(name, results / name, other / name))
    return not found and all(same)


def _are_the_same(name: str, first: Path, second: Path) -> bool:
    """Print how two tables differ, and return whether they are equal to the bit."""
    for file, which in ((first, "first"), (second, "second")):
        if not file.exists():
            click.echo(f"{name}: missing in the {which}")
            return False
    table = load(first)
    found = differences(table, load(second))
    same = f"the same {table.num_rows} rows, to the bit"
    click.echo(f"{name}: " + ("\n".join(found) or same))
    return not found


@click.command("repair")
@click.argument("results", type=click.Path(exists=True, file_okay=False, path_type=Path))
def repair(results: Path) -> None:
    """Set aside the unusable files of a folder of results.

    They are moved to the folder `set-aside` of RESULTS, and `snakemake` makes those again that the
    study needs. Nothing is deleted.
    """
    found = list(audit.set_aside(results))
    for fault in found:
        click.echo(fault.reason)
    files = "1 file is" if len(found) == 1 else f"{len(found)} files are"
    click.echo(f"{files} set aside in {results / 'set-aside'}" if found else "no faults found")


@click.command("archive")
@click.argument("results", type=click.Path(exists=True, file_okay=False, path_type=Path))
@defaulted(
    "--configuration",
    type=INPUT,
    default=Path("config/config.yaml"),
    help="Configuration of the study.",
)
@click.option("--output", type=Output(".zip"), required=True, help="File of type .zip.")
def archive_study(results: Path, configuration: Path, output: Path) -> None:
    """Pack a study into one file, an RO-Crate.

    It contains the code in this folder, the configuration and the files of the study in RESULTS,
    in which `springblock verify` must find no fault.
    """
    from springblock.study.archive import archive  # needs the packages of the study

    found = audit.all_faults(results)
    for fault in found:
        click.echo(fault.reason)
    if found:
        raise ValueError(f"{results} cannot be archived: {len(found)} of its files are at fault")
    number = archive(Path.cwd(), results.absolute(), configuration.absolute(), output)
    click.echo(f"{output} holds {number} files, {output.stat().st_size / 1e6:.1f} MB")
