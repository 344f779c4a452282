"""springblock table, compare and info: what tables hold, and how two differ."""

from collections.abc import Sequence
from pathlib import Path

import click
import pyarrow as pa
import pyarrow.parquet as pq
from pyarrow.csv import write_csv

from springblock.analysis.comparison import differences as row_differences
from springblock.analysis.ensembles import OBSERVABLES, changes, doubts, ensembles
from springblock.analysis.means import changes_from_first, differences, in_words, means
from springblock.analysis.statistics import Interval
from springblock.cli.options import INPUT, Output, defaulted, print_columns
from springblock.files import whole_file
from springblock.io.identity import refuse_misplaced
from springblock.io.parquet import load, origin_of, refuse_mixed_code
from springblock.io.rows import Row, limits
from springblock.io.schemas import SUMMARY, said
from springblock.model.scene import differing

_PATH = click.Path(exists=True, path_type=Path)
_SHOWN = 5  #: largest number of ensembles listed that only one side has
_OF = defaulted(
    "--of",
    type=click.Choice(OBSERVABLES),
    multiple=True,
    default=("static_friction", "t_max", "t_avg"),
    help="Observable. Can be repeated.",
)
_OUTPUT = click.option(
    "--output",
    type=Output(".csv", ".parquet"),
    help="CSV or Parquet file of all numbers, in SI units.",
)


@click.command("table")
@click.argument("paths", type=_PATH, nargs=-1, required=True)
@_OF
@click.option(
    "--by",
    multiple=True,
    help="Column that distinguishes ensembles; all by default. Can be repeated.",
)
@click.option(
    "--changes",
    "of_ends",
    is_flag=True,
    help="Show the changes from the first value of each parameter to the others instead.",
)
@_OUTPUT
def table(
    paths: tuple[Path, ...],
    of: tuple[str, ...],
    by: tuple[str, ...],
    of_ends: bool,
    output: Path | None,
) -> None:
    """Show the mean observables of each ensemble.

    PATHS are files or folders of realisations. Intervals are 95 % intervals of Student's t over
    seeds, without correction for the number of ensembles.
    """
    members = ensembles(_rows(paths), by)
    for doubt in doubts(members):
        click.echo(f"warning: {doubt}", err=True)
    rows = changes_from_first(members, of) if of_ends else means(members, of, by)
    if of_ends and not rows:
        raise ValueError("--changes: no parameter has two values")
    _report(rows, output)


@click.command("compare")
@click.argument("first", type=_PATH)
@click.argument("second", type=_PATH)
@_OF
@_OUTPUT
def compare(first: Path, second: Path, of: tuple[str, ...], output: Path | None) -> None:
    """Compare two tables, or the realisations of two folders.

    Says whether two tables are equal to the bit, CPU times apart, and otherwise in what they
    differ. For each ensemble of realisations in both: the difference of means with its 95 %
    interval, paired where seeds and friction coefficients are the same.
    """
    if first.is_file() and second.is_file():
        tables = [load(file) for file in (first, second)]
        apart = row_differences(*tables)
        click.echo("\n".join(apart) or f"the same {tables[0].num_rows} rows, to the bit")
        if not apart or not {*SUMMARY.names} <= {*tables[0].column_names}:
            return
    if first != second and (first in second.parents or second in first.parents):
        raise ValueError(f"{first} and {second} share their realisations; give two apart")
    one, other = (ensembles(_rows([path])) for path in (first, second))
    differ, found = changes(one, other)
    for name, values in differ.items():
        ours, theirs = ("none" if value is None else value for value in values)
        click.echo(f"{name}: {ours} in {first}, {theirs} in {second}")
    if not found:
        raise ValueError(f"{first} and {second} have no ensemble in common")
    shared = [id(part) for each in found for part in (each.first, each.second)]
    for path, members in ((first, one), (second, other)):
        names = differing(each.names for each in members)
        alone = [each for each in members if id(each) not in shared]
        for each in alone[:_SHOWN]:
            told = (f"{name} = {value}" for name in names if (value := each.names.get(name)))
            click.echo(f"only in {path}: {', '.join(told) or 'one ensemble'}")
        if len(alone) > _SHOWN:
            click.echo(f"only in {path}: {len(alone) - _SHOWN} more")
    click.echo("Second minus first:")
    _report(differences(found, of), output)


def _rows(paths: Sequence[Path]) -> list[Row]:
    """Return the summaries of all realisations in files and folders, made by the same code."""
    files = [file for path in paths for file in ([path] if path.is_file() else _files(path))]
    tables = [(file, load(file, SUMMARY.names)) for file in dict.fromkeys(files)]
    for file, table in tables:
        refuse_misplaced(file, table)
    refuse_mixed_code(tables)
    return [row for _, table in tables for row in table.to_pylist()]


def _files(folder: Path) -> list[Path]:
    """Return the tables of realisations in a folder: that of a study or of a sweep, or all."""
    for table in (folder / "tables/realisations.parquet", folder / "realisations.parquet"):
        if table.exists():
            return [table]
    every = [file for file in sorted(folder.rglob("*.parquet")) if not file.name.startswith(".")]
    held = [file for file in every if {*SUMMARY.names} <= {*_names(file)}]
    if not held:
        raise ValueError(f"{folder}: no realisations found")
    return held


def _names(file: Path) -> list[str]:
    """Return the columns of any Parquet file."""
    try:
        names: list[str] = pq.read_schema(file).names
    except pa.ArrowInvalid:
        raise ValueError(f"{file} is empty or not a table (Parquet); remove it") from None
    return names


def _report(rows: Sequence[Row], output: Path | None) -> None:
    """Print rows, times in µs, and write them in SI units if a file is given."""
    head, cells = in_words(rows)
    print_columns([head, *cells])
    if output:
        write = pq.write_table if output.suffix == ".parquet" else write_csv
        with whole_file(output) as partial:
            write(pa.Table.from_pylist(list(map(_numbers, rows))), partial)


def _numbers(row: Row) -> Row:
    """Return a row with separate columns for the limits of intervals, and times as text."""
    numbers: Row = {}
    for name, value in row.items():
        if isinstance(value, Interval):
            numbers |= limits(name, value)
        else:  # CSV has no lists
            numbers[name] = str(value) if isinstance(value, tuple) else value
    return numbers


@click.command("info")
@click.argument("file", type=INPUT)
def info(file: Path) -> None:
    """Describe a table: rows, origin, and columns with units.

    `springblock table` lists its ensembles.
    """
    if file.suffix in (".npz", ".nc"):
        raise ValueError(f"{file} is not a table; info describes Parquet files")
    table = load(file)
    click.echo(f"{file}: {table.num_rows} rows, {table.num_columns} columns")
    for key, value in origin_of(table).items():
        click.echo(f"{key}: {value}")
    kinds = [str(field.type).replace("element: ", "") for field in table.schema]
    print_columns(
        [[field.name, kind, *said(field)] for field, kind in zip(table.schema, kinds, strict=True)]
    )
