"""springblock verify, repair and archive: results are checked, mended and packed."""

from pathlib import Path

import click

from springblock.analysis import comparison
from springblock.cli.options import INPUT, OUTPUT, one_sentence
from springblock.io.parquet import load
from springblock.study import audit

FOLDER = click.Path(exists=True, file_okay=False, path_type=Path)


@click.command("verify")
@click.argument("results", type=click.Path(exists=True, path_type=Path))
@click.argument("other", type=click.Path(exists=True, path_type=Path), required=False)
def verify(results: Path, other: Path | None) -> None:
    """Hold a folder of RESULTS against its checksums and the code of today.

    With OTHER say where the tables of two studies differ, and whether within their intervals; of
    two files, where they differ to the bit. The exit status is 0 where all is as it should be, or
    within, 1 otherwise.
    """
    with one_sentence():
        if results.is_file():
            _verify_bits(results, other)
            return
        found = [fault.reason for fault in audit.faults(results)]
        for line in found or [f"{results}: every file is whole, in its place and of today's code"]:
            click.echo(line)
        if other is not None:
            found += _differences(results, other)
    if found:
        raise SystemExit(1)


def _verify_bits(file: Path, other: Path | None) -> None:
    """Say where two files differ; rows of the same scene and seed are compared, to the bit."""
    if other is None or not other.is_file():
        raise ValueError(f"{file} is a file: another one must be given, to compare it with")
    found = comparison.compare(load(file), load(other))
    click.echo(f"{file} and {other}: {_in_words(found)}")
    if not found.same:
        raise SystemExit(1)


def _in_words(found: comparison.Comparison) -> str:
    if found.same:
        return f"the same {found.both} rows, to the bit"
    lines = [f"{found.both or 'no'} rows in both"]
    for rows, where in ((found.first, "first"), (found.second, "second")):
        lines[0] += f", {rows} in the {where} alone" if rows else ""
    for name, rows, largest, relative in found.differences:
        how_many = "1 row differs" if rows == 1 else f"{rows} rows differ"
        size = f"by {largest:.3g} at most, or {relative:.3g} of the first"
        lines.append(f"  {name}: {how_many}, {size}")
    return "\n".join(lines)


def _differences(results: Path, other: Path) -> list[str]:
    """Say where the tables of two studies differ; return what lies outside the intervals."""
    outside = []
    for file in sorted((results / "tables").rglob("*.parquet")):
        name = file.relative_to(results)
        if not (other / name).exists():
            click.echo(f"{name}: {other} has none")
            continue
        first, second = load(file), load(other / name)
        if comparison.compare(first, second).same:
            click.echo(f"{name}: the same {first.num_rows} rows, to the bit")
            continue
        found = comparison.discrepancies(first, second)
        apart = comparison.significant(found)
        click.echo(
            f"{name}: different; of {len(found)} values with intervals that differ, {len(apart)} "
            "do so by more than 95 % intervals of all of them together allow"
        )
        for each in apart:
            click.echo(f"  {each}")
        outside += [str(each) for each in apart]
    return outside


@click.command("repair")
@click.argument("results", type=FOLDER)
def repair(results: Path) -> None:
    """Set files of RESULTS aside that cannot be used, for `snakemake` to make them again.

    Nothing is removed: they keep their places in the folder `set-aside` of RESULTS.
    """
    with one_sentence():
        found = list(audit.set_aside(results))
    for fault in found:
        click.echo(fault.reason)
    files = "1 file is" if len(found) == 1 else f"{len(found)} files are"
    click.echo(f"{files} set aside in {results / 'set-aside'}" if found else "all is well")


@click.command("archive")
@click.argument("results", type=FOLDER)
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

    with one_sentence():
        number = archive(Path.cwd(), results.absolute(), configuration.absolute(), output)
    click.echo(f"{output} holds {number} files, {output.stat().st_size / 1e6:.1f} MB")
