"""Event-located solutions of the small runs, as data that the package brings along.

`python -m benchmarks.reference` computes them again. They depend on the paper's constants and on
how coefficients are drawn.
"""

from pathlib import Path
from typing import NamedTuple

import numpy as np

from springblock.io.parquet import load
from springblock.io.rows import select
from springblock.model.numbers import Array
from springblock.model.pattern import Pattern
from springblock.model.surface import Surface
from springblock.study.accuracy.conventions import MEANS, SAMPLE_INTERVAL

FILE = Path(__file__).with_name("solutions.parquet")


class Small(NamedTuple):
    """Surfaces of a scene that are small enough for the reference solution."""

    pattern: Pattern
    duration: float  #: s
    seeds: int  #: each takes 5 to 60 CPU s

    def surface(self, seed: int) -> Surface:
        """Return the surface of this seed."""
        return Surface.draw(self.pattern.contact, seed)


SMALL = {
    "flat": Small(Pattern.flat(12), 1.25e-4, 4),
    "pillared": Small(Pattern.pillars(8, 4, 4), 3.5e-4, 6),
    "grooved": Small(Pattern.pillars(6, 5, 1).grooved(2, 1), 2.0e-4, 6),
}


class Solution(NamedTuple):
    """Solution of one run, names as in `Realisation`. Arrays over blocks are indexed [y, x]."""

    time: Array  #: (n,) s, multiples of the sample interval
    force: Array  #: (n,) N, |sum of F_s| at these times; stored in single precision
    t_det: Array  #: (N_y, N_x) s, first detachment; NaN where never or not in contact
    static_friction: float  #: greatest sampled force over P l² N_y N_x
    t_max: float  #: s, time of that sample
    t_avg: float  #: s, mean of t_det over the contact blocks that detached
    steps: int = 0  #: number of integration steps; not stored


def solutions(scene: str) -> list[Solution]:
    """Return the stored solutions of a scene, by seed."""
    shape = SMALL[scene].pattern.contact.shape
    found = []
    for row in select(load(FILE).to_pylist(), scene=scene):
        force, t_det = np.array(row["force"]), np.array(row["t_det"]).reshape(shape)
        time = SAMPLE_INTERVAL * np.arange(float(len(force)))
        found.append(Solution(time, force, t_det, *(row[name] for name in MEANS)))
    return found
