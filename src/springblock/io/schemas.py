"""Columns of the tables, with their units and meanings."""

from dataclasses import fields

import pyarrow as pa

from springblock.model.material import Material
from springblock.solver.integrators import INTEGRATORS


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


N_BLOCKS = column("n_blocks", pa.int32(), "blocks", "side N of the surface")

#: Columns that identify a scene, by the names of `Scene`.
SCENE = pa.schema(
    [
        column("level", pa.int8(), "1", "number of levels of the pattern; 0 if flat, -1 for masks"),
        column("n_p", pa.int32(), "blocks", "side of a pillar; 0 without pillars"),
        column("n_s", pa.int32(), "blocks", "distance between pillars; 0 without pillars"),
        column("n_p2", pa.int32(), "blocks", "width of a pawl; 0 without grooves"),
        column("n_s2", pa.int32(), "blocks", "width of a groove; 0 without grooves"),
        column(
            "n_p3",
            pa.int32(),
            "blocks",
            "size of the parts of a pawl between grooves of level 3, or 0",
        ),
        column("n_s3", pa.int32(), "blocks", "width of a groove of level 3, or 0"),
        column("along_3", pa.string(), "x or y", "direction of the grooves of level 3, or ''"),
        column("varied", pa.string(), "name=value", "constants that differ from the study's"),
        column("direction", pa.string(), "x, y or degrees", "sliding direction"),
        column("n_blocks", pa.int32(), "blocks", "side N of the surface along x"),
        column("n_rows", pa.int32(), "blocks", "side of the surface along y"),
        column("edges", pa.string(), "free or periodic", "edges of the surface"),
        column("mask", pa.string(), "name", "file and digest of the contact mask, or ''"),
        column("mu_static_field", pa.string(), "name", "file and digest of mu_static; '' if drawn"),
        column("mu_dynamic_field", pa.string(), "name", "the same for mu_dynamic; '' if drawn"),
    ]
)

#: Constants of a realisation, see `Setup.constants`.
SETUP = pa.schema(
    [
        *(
            column(
                each.name,
                pa.string() if "choices" in each.metadata else pa.float64(),
                each.metadata["unit"],
                each.metadata["meaning"],
            )
            for each in fields(Material)
        ),
        column("integrator", pa.string(), "1", " or ".join(INTEGRATORS)),
        column("step", pa.float64(), "s", "integration step h"),
        column("sample_interval", pa.float64(), "s", "time between samples of the force"),
    ]
)

#: What was asked of a run besides, see `springblock.io.identity`.
ASKED = pa.schema(
    numbers(
        "s",
        duration="simulated time; 0: until after the force peak",
        last_snapshot="time until which a run without duration lasts at least; 0 without one",
    )
)

#: Possible axes of figures: columns that are numbers, and the direction.
AXES = [field.name for field in (*SCENE, *SETUP) if not pa.types.is_string(field.type)]
AXES = [name for name in AXES if name != "level"] + ["direction"]

#: One row per realisation, with the paper's names of t_* and *_friction.
SUMMARY = pa.schema(
    [
        *SCENE,
        *SETUP,
        *ASKED,
        column("seed", pa.int64(), "1", "seed of the friction coefficients"),
        *numbers(
            "1",
            static_friction="largest friction force over the normal force",
            dynamic_friction="mean friction force over the normal force, from the first minimum "
            "after the peak to the end of the run; NaN if the force does not rise from a minimum "
            "by a tenth of its drop",
        ),
        column("t_max", pa.float64(), "s", "time of the force peak"),
        column("t_avg", pa.float64(), "s", "mean time of first detachment of blocks in contact"),
        column("t_first", pa.float64(), "s", "time of the first detachment"),
        column("energy_error", pa.float64(), "1", "residual of the energy balance over the work"),
        column("steps", pa.int64(), "1", "number of integration steps"),
    ]
)

_SIDE = [
    *SCENE,
    *SETUP,
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

#: One row per scene and side; a length of 0.1 means no correlation.
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
        *lists(pa.bool_(), "1", contact="whether each block is in contact, row by row from y = 0"),
    ]
)

#: Further columns of a batch with snapshots.
SNAPSHOTS = pa.schema(
    [
        *lists(pa.float64(), "s", snapshot_times="times of the snapshots, if there are any"),
        *lists(
            pa.float64(),
            "m",
            snapshots="displacements at these times, in turn: the components along x, row by row "
            "from y = 0, then those along y",
        ),
    ]
)
