"""What the tables of a study hold: every column with its unit and its meaning."""

import pyarrow as pa

from springblock.io.rows import markdown_table
from springblock.io.schemas import BATCH, CORRELATION, CORRELATION_LENGTH, SUMMARY, said

_PAGE = """# The tables

`springblock dictionary` writes this page from the schemas of the files. Every table is a Parquet
file, read by

    import pandas as pd

    pd.read_parquet("results/tables/realisations.parquet")
    pd.read_parquet("results/realisations")  # all batches at once, curves and fields included

`springblock info FILE` describes the content and the origin of a table. Units are SI, blocks,
or 1 for pure numbers.

{sections}
"""
_SECTION = "## {name}\n\n`results/{file}.parquet`: each row is {row}.\n\n{table}"


def page() -> str:
    """Write the dictionary of all tables, in Markdown."""
    from springblock.accuracy import production, stability, work_precision
    from springblock.claims import table as claims
    from springblock.mechanism import tables as mechanism

    kinds = {
        "batches": ("a realisation, with its curves and fields", BATCH),
        "realisations": ("a realisation", SUMMARY),
        "correlation": ("a distance along a kind of side", CORRELATION),
        "correlation_length": ("a kind of side", CORRELATION_LENGTH),
        "claims": ("a finding on a statement of the paper", claims.SCHEMA),
        "work_precision": ("an error at one step", work_precision.SCHEMA),
        "production": ("an error at full size at one step", production.SCHEMA),
        "mechanism": ("a seed on pillars of one size", mechanism.FRICTION),
        "mechanism_variants": ("the same with other gaps and constants", mechanism.FRICTION),
        "mechanism_peaks": ("a seed on one surface with grooves", mechanism.PEAKS),
        "mechanism_budget": ("a moment of one seed of one model", mechanism.BUDGET),
        "stability": ("a stiff or extreme case", stability.SCHEMA),
    }
    files = {"batches": "realisations/SCENE/batch-NUMBER"}  # all others are in `tables`
    sections = [
        _SECTION.format(
            name=name,
            file=files.get(name, f"tables/{name}"),
            row=row,
            table=markdown_table(["column", "type", "unit", "meaning"], columns(schema)),
        )
        for name, (row, schema) in kinds.items()
    ]
    return _PAGE.format(sections="\n\n".join(sections))


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
