"""Columns of the tables, with their units and meanings."""

from dataclasses import fields
from typing import Any

import pyarrow as pa

from springblock.model.scene import Scene


def column(name: str, kind: pa.DataType, unit: str, meaning: str) -> pa.Field:
    """Return a column with unit and meaning in its metadata."""
    return pa.field(name, kind, nullable=False, metadata={"unit": unit, "meaning": meaning})


def numbers(unit: str, **meanings: str) -> list[pa.Field]:
    """Return columns of numbers with the same unit."""
    return [column(name, pa.float64(), unit, meaning) for name, meaning in meanings.items()]


def lists(kind: pa.DataType, unit: str, **meanings: str) -> list[pa.Field]:
    """Return columns of lists with the same type and unit."""
    return [column(name, pa.list_(kind), unit, meaning) for name, meaning in meanings.items()]


def texts(**meanings: str) -> list[pa.Field]:
    """Return columns of text."""
    return [column(name, pa.string(), "1", meaning) for name, meaning in meanings.items()]


def said(field: pa.Field) -> tuple[str, str]:
    """Return the unit and the meaning of a column; "" where it has none."""
    metadata = field.metadata or {}
    return metadata.get(b"unit", b"").decode(), metadata.get(b"meaning", b"").decode()


def _limits(name: str, unit: str) -> list[pa.Field]:
    """Return the columns of the limits of an interval."""
    meanings = {f"{name}_low": "lower limit of its 95 % interval", f"{name}_high": "upper limit"}
    return numbers(unit, **meanings)


#: Types of columns by those of the fields of `Scene`; all others are stored as text.
_KINDS: dict[Any, pa.DataType] = {
    int: pa.int32(),
    float: pa.float64(),
    tuple[float, ...]: pa.list_(pa.float64()),
}
#: Columns of a scene: all that decides the numbers of a run besides the seed.
SCENE = pa.schema(
    [
        column("level", pa.int8(), "1", "number of levels of the pattern; 0 if flat, -1 for masks"),
        *(
            column(
                each.name,
                _KINDS.get(each.type, pa.string()),
                each.metadata["unit"],
                each.metadata["meaning"],
            )
            for each in fields(Scene)
        ),
    ]
)

N_BLOCKS = SCENE.field("n_blocks")

#: One row per realisation, with the paper's names of t_* and *_friction.
SUMMARY = pa.schema(
    [
        *SCENE,
        column("seed", pa.int64(), "1", "seed of the friction coefficients"),
        *numbers(
            "1",
            contact_fraction="share of the blocks in contact",
            static_friction="largest friction force of the onset over the normal force",
            dynamic_friction="mean friction force over the normal force from 1.5 times the largest "
            "t_det on; NaN unless this lasts for one reloading",
            prominence="drop of the force between two load peaks, those of at least 0.9 of the "
            "largest force, from the lower one, over the largest force",
        ),
        column("t_max", pa.float64(), "s", "time of the largest force of the onset"),
        column("t_avg", pa.float64(), "s", "mean time of first detachment of blocks in contact"),
        *numbers(
            "s",
            t_first="time of the first detachment",
            t_quiet="time from one load peak to the other; NaN with a prominence below 0.01",
            t_width="time from the first to the last force of at least 0.9 of the largest one",
        ),
        column("energy_error", pa.float64(), "1", "residual of the energy balance over the work"),
        column("steps", pa.int64(), "1", "number of integration steps"),
    ]
)

_SIDE = [
    *SCENE,
    column(
        "side",
        pa.string(),
        "x, y or grooves",
        "axis of the sides of pillars; grooves: edges of the grooves within pillars",
    ),
    column("realisations", pa.int32(), "1", "number of realisations"),
]

#: One row per scene, side and distance.
CORRELATION = pa.schema(
    [
        *_SIDE,
        column("r", pa.int32(), "blocks", "distance from blocks within n_p/10 of a side's middle"),
        column("correlation", pa.float64(), "1", "c(r) of first detachment times, c(0) = 1"),
        *_limits("ci", "1"),
        column("samples", pa.int32(), "1", "number of sides, or of edges along grooves"),
    ]
)

#: One row per scene and side; a length of 0.1 means no correlation, infinity c(r) = 1.
CORRELATION_LENGTH = pa.schema(
    [
        *_SIDE,
        *numbers("blocks", l_c="correlation length: weighted least-squares fit of exp(-r/l_c)"),
        *_limits("ci", "blocks"),
        column(
            "r_last", pa.int32(), "blocks", "last r of the fits, from 1: 6, or n_p/3 if n_p < 20"
        ),
        *numbers(
            "blocks",
            tail="decay length: the same fit with A exp(-r/tail) and A free; NaN if r_last < 3",
        ),
        *_limits("tail", "blocks"),
        column("amplitude", pa.float64(), "1", "A in A exp(-r/tail)"),
        *_limits("amplitude", "1"),
    ]
)

#: One row per realisation of a batch, with curves and fields for the figures.
BATCH = pa.schema(
    [
        *SUMMARY,
        *lists(pa.float64(), "N", force="friction force |ΣF_s|, one per sample from t = 0"),
        *lists(
            pa.int32(),
            "blocks",
            detachments="number of first detachments since the previous sample",
            switches="number of switches to sliding since then, from rest or by turning back",
        ),
        *lists(
            pa.float64(),
            "s",
            t_det="time of first detachment of each block, row by row from y = 0; NaN without one",
        ),
        column("normal_force", pa.float64(), "N", "normal force P l² N_x N_y"),
        column("onset_end", pa.float64(), "s", "end of the onset; NaN if it has not ended"),
        *lists(pa.bool_(), "1", contact="whether each block is in contact, row by row from y = 0"),
    ]
)

#: Further column of a batch with snapshots.
SNAPSHOTS = pa.schema(
    lists(
        pa.float64(),
        "m",
        snapshots="displacements at the snapshot_times, in turn: the components along x, row by "
        "row from y = 0, then those along y",
    )
)
