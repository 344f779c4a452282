"""Realisations whose balance of energy does not close."""

from collections import defaultdict
from collections.abc import Iterable
from statistics import median

from springblock.io.rows import Row, scene_of

#: Energy residual, as a share of the slider's work, that no realisation should exceed.
ENERGY_TOLERANCE = 5e-4
#: Largest residual over the median of its scene.
OUT_OF_LINE = 10.0


def suspects(realisations: Iterable[Row]) -> list[Row]:
    """Return rows whose energy residual is too large, or out of line with those of their scene."""
    groups = defaultdict(list)
    for row in realisations:
        groups[scene_of(row)].append(row)
    found = []
    for rows in groups.values():
        usual = median(abs(row["energy_error"]) for row in rows)
        limit = min(ENERGY_TOLERANCE, OUT_OF_LINE * usual)
        found += [row for row in rows if not abs(row["energy_error"]) <= limit]
    return found
