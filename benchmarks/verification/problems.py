"""The problems: three surfaces that differ in their pattern, small enough for the reference."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from springblock.accuracy.specimens import Array
from springblock.model.defaults import SAMPLE_INTERVAL
from springblock.model.material import Material
from springblock.model.pattern import Pattern


@dataclass(frozen=True)
class Problem:
    """One surface of N x N blocks, pulled along x from rest."""

    name: str
    pattern: Pattern
    seed: int  #: from 0 to 2, the one with which most blocks let go before t_max
    duration: float  #: s

    @property
    def folder(self) -> Path:
        """Where its files are."""
        return Path(__file__).parent / self.name

    @property
    def time(self) -> Array:
        """(n,) s, times of the force curve."""
        return SAMPLE_INTERVAL * np.arange(round(self.duration / SAMPLE_INTERVAL) + 1.0)

    @property
    def normal_force(self) -> float:
        """P l² N², N."""
        return Material().block_load * self.pattern.n_blocks**2


_ALL = (
    Problem("flat", Pattern.flat(6), seed=2, duration=1.3e-4),
    Problem("pillared", Pattern.pillars(8, 4, 4), seed=1, duration=4e-4),
    Problem("grooved", Pattern.pillars(6, 5, 1).grooved(2, 1), seed=1, duration=2e-4),
)
PROBLEMS = {problem.name: problem for problem in _ALL}
