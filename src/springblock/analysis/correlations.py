"""Rows of the tables of correlations, from the realisations of one scene."""

from collections.abc import Iterator, Sequence

import numpy as np

from springblock.analysis.correlation import Correlation, Length, groove_times, side_times
from springblock.io.identity import identity
from springblock.io.records import Record
from springblock.io.rows import Row, limits
from springblock.model.numbers import Array


def correlations(records: Sequence[Record]) -> tuple[list[Row], list[Row]]:
    """Return the rows of c(r) and of the correlation lengths of one scene."""
    curves: list[Row] = []
    lengths: list[Row] = []
    for side, times in _sides(records):
        found = Correlation(times)
        curves += [side | row for row in _curve(found)]
        lengths.append(side | _length(found.length()))
    return curves, lengths


def _sides(records: Sequence[Record]) -> Iterator[tuple[Row, Array]]:
    """Yield the columns that name each kind of side, and its detachment times."""
    scene = records[0].scene
    others = [record.scene for record in records if record.scene != scene]
    if others:
        raise ValueError(f"several scenes: {scene}, and {others[0]}; give batches of one")
    if not scene.sides:
        raise ValueError(f"{scene}: no whole sides of 6 blocks or more")
    columns = identity(scene) | {"realisations": len(records)}
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
