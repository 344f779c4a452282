"""What the tables of a study hold: every column with its unit and its meaning."""

from functools import cache
from typing import Any

import pyarrow as pa

from springblock.io.rows import markdown_table
from springblock.io.schemas import (
    BATCH,
    CORRELATION,
    CORRELATION_LENGTH,
    SCENE,
    SETUP,
    SNAPSHOTS,
    SUMMARY,
    said,
)

#: Columns that identify a scene and its constants.
_COMMON = pa.schema([*SCENE, *SETUP])
_BATCHES = "realisations/SCENE-DIGEST/SEEDS"  #: file of the batches


@cache
def kinds() -> dict[str, tuple[str, pa.Schema]]:
    """Return what a row is and the columns, by name of the table."""
    from springblock.accuracy import production, stability, work_precision
    from springblock.claims import table as claims
    from springblock.continuum import cases as continuum
    from springblock.mechanism import tables as mechanism
    from springblock.mechanism.sensitivities import SENSITIVITIES

    return {
        "batches": ("a realisation, with its curves and maps", pa.schema([*BATCH, *SNAPSHOTS])),
        "realisations": ("a realisation", SUMMARY),
        "correlation": ("a distance along a kind of side", CORRELATION),
        "correlation_length": ("a kind of side", CORRELATION_LENGTH),
        "claims": ("a finding on a statement of the paper", claims.SCHEMA),
        "work_precision": ("an error at one step", work_precision.SCHEMA),
        "production": ("an error with N = 120 at one step", production.SCHEMA),
        "mechanism": ("a seed on pillars of one size", mechanism.FRICTION),
        "mechanism_damped": ("a seed on pillars of one size, strongly damped", mechanism.FRICTION),
        "sensitivities": ("a quantity in one setting", SENSITIVITIES),
        "continuum": ("a unit cell of one stripe or pillar", continuum.CELLS),
        "stability": ("a stiff or extreme case", stability.SCHEMA),
    }


def contents() -> dict[str, Any]:
    """Return what the template of the page of all tables names."""
    tables = []
    for name, (row, schema) in kinds().items():
        own = [field for field in schema if field.name not in _COMMON.names]
        after = len(own) + len(_COMMON) == len(schema)  # after columns of scene and setup
        file = _BATCHES if name == "batches" else f"tables/{name}"
        shown = _table(pa.schema(own) if after else schema)
        tables.append({"name": name, "file": file, "row": row, "after": after, "columns": shown})
    return {"common": _table(_COMMON), "tables": tables}


def _table(schema: pa.Schema) -> str:
    return markdown_table(["column", "type", "unit", "meaning"], columns(schema))


def columns(schema: pa.Schema) -> list[list[str]]:
    """Return name, type, unit and meaning of each column."""
    return [
        [
            f"`{field.name}`",
            str(field.type).replace("element: ", ""),
            *(text.replace("|", "\\|") for text in said(field)),
        ]
        for field in schema
    ]
