"""springblock table and compare: ensembles in a row each, and what changes between two tables."""

import csv
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click
import pyarrow as pa
import pyarrow.parquet as pq

from springblock.analysis.ensembles import (
    OBSERVABLES,
    Ensemble,
    Names,
    changes,
    ensembles,
    mean,
    telling,
)
from springblock.analysis.statistics import Interval
from springblock.beyond.question import number
from springblock.cli.options import OUTPUT, one_sentence
from springblock.files import whole_file
from springblock.io.parquet import load
from springblock.io.rows import Row
from springblock.io.schemas import SUMMARY

_PATH = click.Path(exists=True, path_type=Path)
_SHOWN = 5  #: ensembles of one table alone that are named
_OF = click.option(
    "--of",
    type=click.Choice(OBSERVABLES),
    multiple=True,
    default=("static_friction", "t_max", "t_avg"),
    show_default=True,
    help="Observable. May be given several times.",
)
_OUTPUT = click.option(
    "--output", type=OUTPUT, help="CSV or Parquet file of all numbers in SI units, by its suffix."
)


@click.command("table")
@click.argument("paths", type=_PATH, nargs=-1, required=True)
@_OF
@click.option("--by", multiple=True, help="Name to gather realisations by; all if unsaid.")
@_OUTPUT
def table(
    paths: tuple[Path, ...], of: tuple[str, ...], by: tuple[str, ...], output: Path | None
) -> None:
    """Show a row per ensemble of the realisations in PATHS: files, or folders with all they hold.

    Means have 95 % intervals of Student's t.
    """
    with one_sentence():
        members = ensembles(_rows(paths), by)
        names = list(by) or telling(each.names for each in members)
        columns = {"runs": [len(each.rows) for each in members]}
        intervals = {name: [mean(each, name) for each in members] for name in of}
        _show([each.names for each in members], names, columns, intervals)
        if output:
            _write([each.names for each in members], names, columns, intervals, output)


@click.command("compare")
@click.argument("first", type=_PATH)
@click.argument("second", type=_PATH)
@_OF
@_OUTPUT
def compare(first: Path, second: Path, of: tuple[str, ...], output: Path | None) -> None:
    """Say what changes from the realisations in FIRST to those in SECOND: files or folders.

    For each ensemble that both hold, the difference of means with its 95 % interval, seed by seed
    where both have the same seeds and friction coefficients. `springblock verify` compares to the
    bit.
    """
    with one_sentence():
        one, other = (ensembles(_rows([path])) for path in (first, second))
        differ, found = changes(one, other)
        for name, (ours, theirs) in differ.items():
            click.echo(f"{name}: {ours} in {first}, {theirs} in {second}")
        if not found:
            raise ValueError(f"{first} and {second} share no ensemble")
        shared = [id(part) for each in found for part in (each.first, each.second)]
        for path, members in ((first, one), (second, other)):
            _tell_alone(path, [each for each in members if id(each) not in shared])
        every = [each.names for each in found]
        names = telling(every)
        columns = {
            "runs": [f"{len(each.first.rows)}, {len(each.second.rows)}" for each in found],
            "difference": ["by seed" if each.paired else "of means" for each in found],
        }
        intervals = {name: [each.of(name) for each in found] for name in of}
        click.echo("Second minus first:")
        _show(every, names, columns, intervals)
        if output:
            _write(every, names, columns, intervals, output)


def _rows(paths: Sequence[Path]) -> list[Row]:
    """Summaries of all realisations in files and folders."""
    files = [
        file
        for path in paths
        for file in ([path] if path.is_file() else sorted(path.rglob("*.parquet")))
    ]
    held = [file for file in files if file in paths or _holds_realisations(file)]
    if not held:
        raise ValueError(f"{', '.join(map(str, paths))}: no realisations in there")
    return [row for file in held for row in load(file, SUMMARY.names).to_pylist()]


def _holds_realisations(file: Path) -> bool:
    return set(SUMMARY.names) <= set(pq.read_schema(file).names)


def _tell_alone(path: Path, members: Sequence[Ensemble]) -> None:
    """Name ensembles that one side alone has."""
    names = telling(each.names for each in members)
    for each in members[:_SHOWN]:
        told = {name: each.names[name] for name in names if each.names.get(name)}
        scene = ", ".join(f"{name} = {value}" for name, value in told.items())
        click.echo(f"only in {path}: {scene or 'one ensemble'}")
    if len(members) > _SHOWN:
        click.echo(f"only in {path}: {len(members) - _SHOWN} more")


def _show(
    members: Sequence[Names],
    names: Sequence[str],
    columns: dict[str, list[Any]],
    intervals: dict[str, list[Interval]],
) -> None:
    """Print a row per ensemble, times in µs."""
    told: dict[str, list[Any]] = {name: [each.get(name, "") for each in members] for name in names}
    told |= columns
    for name, found in intervals.items():
        unit, factor = (" (µs)", 1e6) if name.startswith("t_") else ("", 1.0)
        told[name + unit] = [number(each, factor=factor) for each in found]
    lines = [[name, *map(str, cells)] for name, cells in told.items()]
    padded = [[cell.ljust(max(map(len, line))) for cell in line] for line in lines]
    for row in zip(*padded, strict=True):
        click.echo("  ".join(row).rstrip())


def _write(
    members: Sequence[Names],
    names: Sequence[str],
    columns: dict[str, list[Any]],
    intervals: dict[str, list[Interval]],
    output: Path,
) -> None:
    """Write the same as CSV or Parquet, with the limits of intervals in columns of their own."""
    found: dict[str, list[Any]] = {name: [each.get(name) for each in members] for name in names}
    found |= columns
    for name, values in intervals.items():
        for i, end in enumerate(("", "_low", "_high")):
            found[name + end] = [float(each[i]) for each in values]
    with whole_file(output) as partial:
        if output.suffix == ".parquet":
            pq.write_table(pa.table(found), partial)
        elif output.suffix == ".csv":
            with partial.open("w", newline="", encoding="utf-8") as file:
                writer = csv.writer(file)
                writer.writerow(found)
                writer.writerows(zip(*found.values(), strict=True))
        else:
            raise ValueError(f"{output} must end in .csv or .parquet")
