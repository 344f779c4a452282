"""springblock correlation: correlations of detachment times on one scene."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click
import numpy as np

from springblock.analysis.correlation import (
    Correlation,
    Length,
    design_effect,
    groove_times,
    side_times,
)
from springblock.cli.options import INPUT, OUTPUT, code_version, one_sentence
from springblock.io.parquet import load, origin_of, rows_to_table, write
from springblock.io.records import Record, read_records
from springblock.io.rows import Row
from springblock.io.schemas import CORRELATION, CORRELATION_LENGTH


@click.command("correlation")
@click.argument("batches", type=INPUT, nargs=-1, required=True)
@click.option("--output-correlation", type=OUTPUT, required=True, help="Parquet file of c(r).")
@click.option("--output-length", type=OUTPUT, required=True, help="Parquet file of l_c.")
def correlation(batches: tuple[Path, ...], output_correlation: Path, output_length: Path) -> None:
    """Correlate detachment times along the sides of pillars; BATCHES hold one scene."""
    with one_sentence():
        curves: list[Row] = []
        lengths: list[Row] = []
        for side, times in _sides(read_records(batches)):
            found = Correlation(times)
            length = found.length()
            curves += [side | row for row in _curve(found, length)]
            lengths.append(side | _length(length) | {"design_effect": design_effect(times)})
        digest = origin_of(load(batches[0], []))["configuration_digest"]
        metadata = {"code_version": code_version("analyse"), "configuration_digest": digest}
        write(rows_to_table(curves, CORRELATION), output_correlation, metadata)
        write(rows_to_table(lengths, CORRELATION_LENGTH), output_length, metadata)


def _sides(records: list[Record]) -> Iterator[tuple[Row, Any]]:
    """Columns that name each kind of side, and its detachment times."""
    scene = records[0].scene
    others = {record.scene.folder for record in records} - {scene.folder}
    if others:
        raise ValueError(f"one scene is correlated, not {scene.folder} and {others.pop()}")
    if not scene.sides:
        raise ValueError(f"{scene.folder} has no whole sides of 6 blocks or more")
    columns = {**scene.row, **records[0].constants, "realisations": len(records)}
    for side in scene.sides:
        yield columns | {"side": side}, side_times(records, scene.pattern, side)
    if scene.level == 2 and scene.sides:
        yield columns | {"side": "grooves"}, groove_times(records, scene.pattern)


def _curve(found: Correlation, length: Length) -> Iterator[Row]:
    k, pillars, sides, _ = found.times.shape
    residuals = np.full((3, len(found.mean)), np.nan)
    residuals[:, 1 : length.last + 1] = length.residual
    for r, (mean, low, high, bias) in enumerate(zip(*found.interval, found.bias, strict=True)):
        yield {
            "r": r,
            "correlation": mean,
            "ci_low": low,
            "ci_high": high,
            "bias": bias,
            **dict(
                zip(("residual", "residual_low", "residual_high"), residuals[:, r], strict=True)
            ),
            "samples": k * pillars * sides,
        }


def _length(length: Length) -> Row:
    names = ["l_c", "ci_low", "ci_high"]
    names += [
        f"{key}{end}" for key in ("integral", "tail", "amplitude") for end in ("", "_low", "_high")
    ]
    values = map(float, (*length.fitted, *length.integral, *length.tail, *length.amplitude))
    return {
        **dict(zip(names, values, strict=True)),
        "bias": length.bias,
        "r_last": length.last,
        "deviation": length.deviation,
    }
