"""What the tables of a study hold: every column with its unit and its meaning."""

from functools import cache

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

_PAGE = """# The tables

Every table but `means.csv` is a Parquet file, read by

    import pandas as pd

    pd.read_parquet("results/tables/realisations.parquet")
    pd.read_parquet("results/realisations")  # all batches at once, with curves and maps

This page lists the columns of the Parquet tables. Units are SI, blocks, %, or 1 for pure numbers.
`springblock info FILE` prints the columns and the origin of a file; `springblock dictionary` writes
this page.

## Scene and setup

Most tables begin with the columns of the scene and its constants:

{common}

{sections}
"""
#: Columns that identify a scene and its constants.
_COMMON = pa.schema([*SCENE, *SETUP])
_BATCHES = "realisations/SCENE/batch-NUMBER"  #: file of the batches


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


def dictionary_page() -> str:
    """Write the dictionary of all tables, in Markdown."""
    sections = []
    for name, (row, schema) in kinds().items():
        file = _BATCHES if name == "batches" else f"tables/{name}"
        sections.append(_section(name, file, row, schema))
    return _PAGE.format(common=_table(_COMMON), sections="\n\n".join(sections))


def _section(name: str, file: str, row: str, schema: pa.Schema) -> str:
    """Describe a kind of table: where a study keeps it, what one row is, and its columns."""
    head = f"## {name}\n\n`results/{file}.parquet`: each row is {row}."
    own = [field for field in schema if field.name not in _COMMON.names]
    if len(own) + len(_COMMON) == len(schema):
        head += "\n\nColumns after those of [scene and setup](#scene-and-setup):"
        schema = pa.schema(own)
    return f"{head}\n\n{_table(schema)}"


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
