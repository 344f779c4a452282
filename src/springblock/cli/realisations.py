"""springblock aggregate and correlation: tables of realisations and of their correlations."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click
import numpy as np

from springblock.accuracy.conventions import suspects
from springblock.analysis.correlation import Correlation, Length, groove_times, side_times
from springblock.cli.options import INPUT, TABLE, code_version
from springblock.io.parquet import load, origin_of, read, rows_to_table, write
from springblock.io.records import Record, read_records
from springblock.io.rows import Row, limits
from springblock.io.schemas import CORRELATION, CORRELATION_LENGTH, SUMMARY
from springblock.model.scene import COLUMNS


@click.command("aggregate")
@click.argument("batches", type=INPUT, nargs=-1, required=True)
@click.option("--configuration", required=True, help="Digest of the study's configuration.")
@click.option("--realisations", type=int, help="Expected number of realisations.")
@click.option("--output", type=TABLE, required=True, help="Parquet file.")
def aggregate(
    batches: tuple[Path, ...], configuration: str, realisations: int | None, output: Path
) -> None:
    """Collect BATCHES in one table, one row per realisation."""
    table = read(batches, SUMMARY)
    if realisations not in (None, table.num_rows):
        raise ValueError(f"{table.num_rows} realisations in the batches; expected {realisations}")
    table = table.sort_by([(name, "ascending") for name in [*COLUMNS, "seed"]])
    for row in suspects(table.to_pylist(), COLUMNS):
        which = ", ".join(f"{key} = {row[key]}" for key in [*COLUMNS, "seed"])
        click.echo(f"warning: energy residual {row['energy_error']:.1e} at {which}")
    metadata = {"code_version": code_version("simulate"), "configuration_digest": configuration}
    write(table, output, metadata)


@click.command("correlation")
@click.argument("batches", type=INPUT, nargs=-1, required=True)
@click.option("--output-correlation", type=TABLE, required=True, help="Parquet file of c(r).")
@click.option("--output-length", type=TABLE, required=True, help="Parquet file of l_c.")
def correlation(batches: tuple[Path, ...], output_correlation: Path, output_length: Path) -> None:
    """Correlate detachment times along the sides of pillars.

    BATCHES must hold one scene.
    """
    curves: list[Row] = []
    lengths: list[Row] = []
    for side, times in _sides(read_records(batches)):
        found = Correlation(times)
        curves += [side | row for row in _curve(found)]
        lengths.append(side | _length(found.length()))
    digest = origin_of(load(batches[0], []))["configuration_digest"]
    metadata = {"code_version": code_version("analyse"), "configuration_digest": digest}
    write(rows_to_table(curves, CORRELATION), output_correlation, metadata)
    write(rows_to_table(lengths, CORRELATION_LENGTH), output_length, metadata)


def _sides(records: list[Record]) -> Iterator[tuple[Row, Any]]:
    """Yield the columns that name each kind of side, and its detachment times."""
    scene = records[0].scene
    others = {record.scene.folder for record in records} - {scene.folder}
    if others:
        raise ValueError(f"several scenes: {scene.folder}, {others.pop()}; give batches of one")
    if not scene.sides:
        raise ValueError(f"{scene.folder} has no whole sides of 6 blocks or more")
    columns = {**scene.row, **records[0].constants, "realisations": len(records)}
    for side in scene.sides:
        yield columns | {"side": side}, side_times(records, scene.pattern, side)
    if scene.level == 2:
        yield columns | {"side": "grooves"}, groove_times(records, scene.pattern)


def _curve(found: Correlation) -> Iterator[Row]:
    k, pillars, sides, _ = found.times.shape
    for r, each in enumerate(np.transpose(found.interval)):
        yield {"r": r, **limits("correlation", each, "ci"), "samples": k * pillars * sides}


def _length(length: Length) -> Row:
    fits = limits("tail", length.tail) | limits("amplitude", length.amplitude)
    return {**limits("l_c", length.fitted, "ci"), **fits, "r_last": length.last}
