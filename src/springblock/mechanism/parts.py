"""What each part of the chapter's tables holds."""

from collections.abc import Iterator

import pyarrow as pa

from springblock.io.rows import Row
from springblock.mechanism import PEAK_JOBS, VARIANTS, budget, peaks, table


def measure(part: str) -> tuple[pa.Schema, Iterator[Row]]:
    """Return the columns of a part of `mechanism.TABLES`, and its rows as they are computed."""
    kind, _, job = part.partition("-")
    if kind == "peaks":
        return peaks.SCHEMA, peaks.peaks_rows(int(job), PEAK_JOBS)
    if kind == "budget":
        return budget.SCHEMA, budget.budget_rows()
    scenes = table.variant(part) if part in VARIANTS else [table.scene(int(part))]
    return table.SCHEMA, (row for scene in scenes for row in table.mechanism_rows(scene))
