"""What statistics and figures need to know of a run, and how one looks at it."""

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from matplotlib.figure import Figure

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
    def contact(self) -> NDArray[np.bool_]:
        """(N_y, N_x), [y, x], blocks in contact with the substrate."""

    @property
    def detachments(self) -> Counts:
        """(n,) blocks that detached for the first time in the interval that ends at `time`."""

    @property
    def switches(self) -> Counts:
        """(n,) blocks that went from rest to sliding in the interval, again or not."""

    @property
    def t_det(self) -> Array:
        """(N_y, N_x) s, [y, x], first detachment; NaN where never or not in contact."""

    @property
    def t_max(self) -> float:
        """Time of the force maximum, s."""

    @property
    def t_avg(self) -> float:
        """Mean of `t_det`, s."""

    @property
    def static_friction(self) -> float:
        """Maximum of the force over P l² N²."""

    @property
    def snapshot_times(self) -> Array:
        """(k,) s, when displacements were kept."""

    @property
    def snapshots(self) -> Array:
        """(k, 2, N_y, N_x) m, [time, component, y, x], displacements at these times."""

    @property
    def name(self) -> str:
        """What it is a run of."""


class Visible:
    """A run that can be looked at.

    Pictures are imported by their names when they are asked for: they take no part in a result,
    whose digest (`sources`) follows imports, and would slow down those who draw nothing.
    """

    @property
    def name(self: Run) -> str:
        """What it is a run of."""
        rows, columns = self.t_det.shape
        return f"{columns} x {rows} blocks"

    def __repr__(self: Run) -> str:
        detached = np.count_nonzero(np.isfinite(self.t_det))
        times = f"t_max {1e6 * self.t_max:.1f} µs, " + (
            f"t_avg {1e6 * self.t_avg:.1f} µs" if detached else "nothing has detached"
        )
        return f"<{self.name}: static friction {self.static_friction:.4f}, {times}>"

    def plot(self: Run) -> "Figure":
        """Draw force, detachments, the map of first detachment times, and snapshots if any.

        A matplotlib figure without pyplot: `run.plot().savefig("run.png")`. Notebooks show it after
        `%matplotlib inline`.
        """
        return import_module("springblock.plotting.runs.still").draw(self)

    def animate(self: Run, path: str | Path) -> None:
        """Write a film of the blocks that let go, beside the force: .gif or .mp4.

        Raises
        ------
        ValueError
            Where the suffix is another one.
        """
        import_module("springblock.plotting.runs.film").write(self, Path(path))


def friction(run: Run) -> Array:
    """Friction force over normal force, (n,)."""
    return run.force / run.normal_force


def percent(run: Run, blocks: Counts) -> Array:
    """Counts of blocks as a share of all that detach in the run, %.

    These are all contact blocks where the run has gone on until everything slides.
    """
    return 100.0 * blocks / np.count_nonzero(np.isfinite(run.t_det))
