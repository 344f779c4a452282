"""springblock table and compare: a row per ensemble, and differences between two tables."""

import csv
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click
import pyarrow as pa
import pyarrow.parquet as pq

from springblock.analysis.ensembles import (
    OBSERVABLES,
    Change,
    Ensemble,
    Names,
    changes,
    ensembles,
    extremes,
    mean,
    telling,
)
from springblock.analysis.statistics import Interval
from springblock.beyond.question import number
from springblock.cli.options import OUTPUT, defaulted
from springblock.files import whole_file
from springblock.io.parquet import load
from springblock.io.rows import Row
from springblock.io.schemas import SUMMARY

_PATH = click.Path(exists=True, path_type=Path)
_SHOWN = 5  #: largest number of unpaired ensembles listed
_OF = defaulted(
    "--of",
    type=click.Choice(OBSERVABLES),
    multiple=True,
    default=("static_friction", "t_max", "t_avg"),
    help="Observable. Can be repeated.",
)
_OUTPUT = click.option(
    "--output", type=OUTPUT, help="CSV or Parquet file of all numbers, in SI units."
)


@click.command("table")
@click.argument("paths", type=_PATH, nargs=-1, required=True)
@_OF
@click.option(
    "--by", multiple=True, help="Column that defines ensembles; all by default. Can be repeated."
)
@click.option(
    "--changes",
    "of_ends",
    is_flag=True,
    help="Show the changes from the lowest to the highest value of each parameter instead.",
)
@_OUTPUT
def table(
    paths: tuple[Path, ...],
    of: tuple[str, ...],
    by: tuple[str, ...],
    of_ends: bool,
    output: Path | None,
) -> None:
    """Show the mean observables of each ensemble in PATHS, files or folders of realisations.

    Intervals are 95 % intervals of Student's t over seeds; each holds by itself.
    """
    members = ensembles(_rows(paths), by)
    if of_ends:
        _report_changes(members, of, output)
        return
    names = list(by) or telling(each.names for each in members)
    columns = {"runs": [len(each.rows) for each in members]}
    intervals = {name: [mean(each, name) for each in members] for name in of}
    _report([each.names for each in members], names, columns, intervals, output)


def _report_changes(members: list[Ensemble], of: tuple[str, ...], output: Path | None) -> None:
    """Print a row for each change between the ends of a parameter."""
    found = list(extremes(members))
    if not found:
        raise ValueError("--changes: no parameter has two values")
    changed = [each for *_, each in found]
    columns: dict[str, list[Any]] = {
        "from": [f"{name} = {low}" for name, low, _, _ in found],
        "to": [high for _, _, high, _ in found],
        **_sizes(changed),
    }
    intervals = {name: [each.of(name) for each in changed] for name in of}
    every = [each.names for each in changed]
    _report(every, telling(every), columns, intervals, output)


def _sizes(changed: Sequence[Change]) -> dict[str, list[Any]]:
    """Return the columns that say what the differences are from."""
    return {
        "runs": [f"{len(each.first.rows)}, {len(each.second.rows)}" for each in changed],
        "difference": ["by seed" if each.paired else "of means" for each in changed],
    }


@click.command("compare")
@click.argument("first", type=_PATH)
@click.argument("second", type=_PATH)
@_OF
@_OUTPUT
def compare(first: Path, second: Path, of: tuple[str, ...], output: Path | None) -> None:
    """Compare the realisations in FIRST and SECOND, files or folders.

    For each ensemble in both: the difference of means with its 95 % interval, paired where seeds
    and friction coefficients are the same. `springblock verify` compares to the bit.
    """
    if first != second and (first in second.parents or second in first.parents):
        raise ValueError(f"{first} and {second} share their realisations; give two apart")
    one, other = (ensembles(_rows([path])) for path in (first, second))
    differ, found = changes(one, other)
    for name, (ours, theirs) in differ.items():
        click.echo(f"{name}: {ours} in {first}, {theirs} in {second}")
    if not found:
        raise ValueError(f"{first} and {second} have no ensemble in common")
    shared = [id(part) for each in found for part in (each.first, each.second)]
    for path, members in ((first, one), (second, other)):
        _tell_alone(path, [each for each in members if id(each) not in shared])
    every = [each.names for each in found]
    names = telling(every)
    intervals = {name: [each.of(name) for each in found] for name in of}
    click.echo("Second minus first:")
    _report(every, names, _sizes(found), intervals, output)


def _rows(paths: Sequence[Path]) -> list[Row]:
    """Return the summaries of all realisations in files and folders."""
    files = [
        file
        for path in paths
        for file in ([path] if path.is_file() else sorted(path.rglob("*.parquet")))
    ]
    held = [file for file in files if file in paths or _holds_realisations(file)]
    if not held:
        raise ValueError(f"{', '.join(map(str, paths))}: no realisations found")
    return [row for file in held for row in load(file, SUMMARY.names).to_pylist()]


def _holds_realisations(file: Path) -> bool:
    return set(SUMMARY.names) <= set(pq.read_schema(file).names)


def _tell_alone(path: Path, members: Sequence[Ensemble]) -> None:
    """List the ensembles that only one side has."""
    names = telling(each.names for each in members)
    for each in members[:_SHOWN]:
        told = {name: each.names[name] for name in names if each.names.get(name)}
        scene = ", ".join(f"{name} = {value}" for name, value in told.items())
        click.echo(f"only in {path}: {scene or 'one ensemble'}")
    if len(members) > _SHOWN:
        click.echo(f"only in {path}: {len(members) - _SHOWN} more")


def _report(
    members: Sequence[Names],
    names: Sequence[str],
    columns: dict[str, list[Any]],
    intervals: dict[str, list[Interval]],
    output: Path | None,
) -> None:
    """Print a row per ensemble, times in µs, and write it in SI units if a file is given.

    The file has separate columns for the limits of intervals.
    """
    told: dict[str, list[Any]] = {name: [each.get(name, "") for each in members] for name in names}
    kept: dict[str, list[Any]] = {name: [each.get(name) for each in members] for name in names}
    told, kept = told | columns, kept | columns
    for name, found in intervals.items():
        unit, factor = (" (µs)", 1e6) if name.startswith("t_") else ("", 1.0)
        told[name + unit] = [number(each, factor=factor) for each in found]
        for i, end in enumerate(("", "_low", "_high")):
            kept[name + end] = [float(each[i]) for each in found]
    lines = [[name, *map(str, cells)] for name, cells in told.items()]
    padded = [[cell.ljust(max(map(len, line))) for cell in line] for line in lines]
    for row in zip(*padded, strict=True):
        click.echo("  ".join(row).rstrip())
    if output:
        _write(kept, output)


def _write(columns: dict[str, list[Any]], output: Path) -> None:
    """Write a table as CSV or Parquet."""
    with whole_file(output) as partial:
        if output.suffix == ".parquet":
            pq.write_table(pa.table(columns), partial)
        elif output.suffix == ".csv":
            with partial.open("w", newline="", encoding="utf-8") as file:
                writer = csv.writer(file)
                writer.writerow(columns)
                writer.writerows(zip(*columns.values(), strict=True))
        else:
            raise ValueError(f"{output}: unknown type of file; choose .csv or .parquet")
