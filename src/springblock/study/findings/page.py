"""Values of the full study's findings.

`make docs` copies the page to `FILE`, which all reports show.
"""

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from springblock.analysis.lowest import lowest
from springblock.analysis.statistics import mean_interval
from springblock.io.rows import Row, scene_of, select
from springblock.model.numbers import Array
from springblock.model.scene import Scene
from springblock.study.accuracy import page as accuracy
from springblock.study.claims.page import judged
from springblock.study.continuum import page as continuum

FILE = Path(__file__).with_name("full_study.md")


def values(
    claims: Sequence[Row],
    realisations: Iterable[Row],
    cells: Sequence[Row],
    production: Sequence[Row],
    edges: Sequence[Row],
) -> dict[str, Any]:
    """Return what the template names, from rows of tables.

    `cells` is the table `continuum`, `edges` the table `precursors`.
    """
    parts = judged(claims)
    shown = [row for part in parts for row in part.rows]
    samples = by_size(realisations)
    (chain,) = select(edges, edge="along", what="paper", quantity="l_c")

    def found(statement: str, **case: Any) -> list[Row]:
        """Return the findings on a statement, with their values as texts."""
        return select(shown, id=statement, **case)

    return {
        "found": found,
        "counts": Counter(part.verdict for part in parts),
        "size": lowest({n_p: samples[n_p] for n_p in samples if n_p}),
        "friction": {n_p: mean_interval(samples[n_p]) for n_p in samples},
        "chain": chain,
        "limit": continuum.values(cells),
        "errors": accuracy.errors(production),
    }


def by_size(realisations: Iterable[Row]) -> dict[int, Array]:
    """Return static friction by n_p, 0 for flat, with the paper's constants and equal gaps.

    The sides of surfaces have 120 to 128 blocks, which are multiples of 2 n_p.
    """
    samples: dict[int, list[float]] = {}
    for row in realisations:
        scene = replace(scene_of(row), duration=0.0, snapshot_times=())
        even = Scene(scene.n_blocks, n_p=scene.n_p, n_s=scene.n_p)
        if scene == even and 120 <= scene.n_blocks <= 128:
            samples.setdefault(scene.n_p, []).append(row["static_friction"])
    return {n_p: np.array(samples[n_p]) for n_p in sorted(samples)}
