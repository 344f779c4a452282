"""Values of the full study's findings, whose sentences are in `pages/findings.md`.

`make docs` renders them into `FILE`, which README and all reports show.
"""

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from springblock.analysis.lowest import Lowest, lowest
from springblock.claims.summary import judged
from springblock.io.rows import Row, select
from springblock.model.material import Material
from springblock.model.scene import Scene

FILE = Path(__file__).with_suffix(".md")


def values(claims: Sequence[Row], realisations: Iterable[Row]) -> dict[str, Any]:
    """Return what the template names, from the rows of the tables."""
    shown = [row for part in judged(claims) for row in part.rows]

    def found(statement: str, **case: Any) -> list[Row]:
        """Return the findings on a statement, with their values as texts."""
        return select(shown, id=statement, **case)

    return {"found": found, "sizes": sizes(realisations)}


def sizes(realisations: Iterable[Row]) -> dict[float, Lowest]:
    """Return the size of pillars of lowest static friction, by thickness of the layer, µm.

    Pillars are as far apart as they are wide. The sides of surfaces have 120 to 128 blocks with the
    paper's layer, and 60 with other layers.
    """
    samples: dict[float, dict[int, list[float]]] = {}
    for row in realisations:
        scene = Scene.from_row(row)
        layer = dict(scene.varied) or {"thickness": Material().thickness}
        side = range(60, 61) if scene.varied else range(120, 129)
        even = Scene(scene.n_blocks, n_p=scene.n_p, n_s=scene.n_p, varied=scene.varied)
        if layer.keys() == {"thickness"} and scene.n_blocks in side and scene.n_p and scene == even:
            by_size = samples.setdefault(round(1e6 * layer["thickness"], 3), {})
            by_size.setdefault(scene.n_p, []).append(row["static_friction"])
    return {
        thickness: lowest({n_p: np.array(by_size[n_p]) for n_p in sorted(by_size)})
        for thickness, by_size in samples.items()
    }
