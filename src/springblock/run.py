"""What statistics and figures need to know of a run."""

from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Counts = NDArray[np.integer[Any]]


class Run(Protocol):
    """One realisation in SI units, computed just now or read back from a file."""

    @property
    def time(self) -> Array:
        """(n,) s, evenly spaced."""

    @property
    def force(self) -> Array:
        """(n,) N, force of the slider."""

    @property
    def normal_force(self) -> float:
        """P l² N², N."""

    @property
    def detachments(self) -> Counts:
        """(n,) blocks that detached for the first time in the interval that ends at `time`."""

    @property
    def switches(self) -> Counts:
        """(n,) blocks that went from rest to sliding in the interval, again or not."""

    @property
    def t_det(self) -> Array:
        """(N, N) s, [y, x], first detachment; NaN where never or not in contact."""

    @property
    def t_max(self) -> float:
        """Time of the force maximum, s."""

    @property
    def t_avg(self) -> float:
        """Mean of `t_det`, s."""

    @property
    def static_friction(self) -> float:
        """Maximum of the force over P l² N²."""


def friction(run: Run) -> Array:
    """Friction force over normal force, (n,)."""
    return run.force / run.normal_force


def percent(run: Run, blocks: Counts) -> Array:
    """Counts of blocks as a share of all that detach in the run, %.

    These are all contact blocks where the run has gone on until everything slides.
    """
    return 100.0 * blocks / np.count_nonzero(np.isfinite(run.t_det))
