"""Values of the full study's findings.

`make docs` copies the page to `FILE`, which all reports show.
"""

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from springblock.analysis.lowest import Lowest, lowest
from springblock.io.rows import Row, scene_of, select
from springblock.model.defaults import STEP
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
) -> dict[str, Any]:
    """Return what the template names, from the rows of four tables; `cells` is `continuum`."""
    shown = [row for part in judged(claims) for row in part.rows]
    limit = continuum.values(cells)

    def found(statement: str, **case: Any) -> list[Row]:
        """Return the findings on a statement, with their values as texts."""
        return select(shown, id=statement, **case)

    return {
        "found": found,
        "size": lowest_size(realisations),
        "usual": limit["usual"],
        "best": limit["best"],
        "last": max(abs(row["last"]) for row in limit["squares"]),
        "coulomb": limit["coulomb"]["least"],
        "errors": accuracy.errors(production),
        "seconds": max(row["cpu_seconds"] for row in select(production, step=STEP)),
    }


def lowest_size(realisations: Iterable[Row]) -> Lowest:
    """Return n_p of lowest static friction, with the paper's constants and gaps as wide as pillars.

    The sides of surfaces have 120 to 128 blocks, which are multiples of 2 n_p.
    """
    samples: dict[int, list[float]] = {}
    for row in realisations:
        scene = scene_of(row)
        even = Scene(scene.n_blocks, n_p=scene.n_p, n_s=scene.n_p)
        if scene.n_p and scene == even and 120 <= scene.n_blocks <= 128:
            samples.setdefault(scene.n_p, []).append(row["static_friction"])
    return lowest({n_p: np.array(samples[n_p]) for n_p in sorted(samples)})
