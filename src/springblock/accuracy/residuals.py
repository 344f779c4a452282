"""What the energy balance of a realisation may miss."""

from collections import defaultdict
from collections.abc import Iterable
from statistics import median

from springblock.io.rows import Row

#: Energy residual, as a share of the slider's work, that no realisation should exceed.
ENERGY_TOLERANCE = 5e-4
#: How many times the median of its scene a residual may be.
OUT_OF_LINE = 10.0


def suspects(realisations: Iterable[Row], scene: Iterable[str]) -> list[Row]:
    """Rows whose energy residual is too large, or out of line with those of the same scene.

    `scene` names the columns that tell scenes apart.
    """
    keys, groups = list(scene), defaultdict(list)
    for row in realisations:
        groups[tuple(row[key] for key in keys)].append(row)
    found = []
    for rows in groups.values():
        usual = median(abs(row["energy_error"]) for row in rows)
        limit = min(ENERGY_TOLERANCE, OUT_OF_LINE * usual)
        found += [row for row in rows if not abs(row["energy_error"]) <= limit]
    return found
