"""Results of one run."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from springblock.model.notebook import Shown
from springblock.model.numbers import Array
from springblock.simulation.energy import Energy
from springblock.simulation.fields import Fields, dataset
from springblock.simulation.peaks import both_peaks, prominence, width

if TYPE_CHECKING:
    import xarray

Counts = NDArray[np.integer]


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Run(Shown):
    """One run in SI units, computed or read back from a file. Fields are indexed [y, x]."""

    time: Array  #: (n,) s, multiples of the sample interval, from zero
    force: Array  #: (n,) N, |ΣF_s|
    detachments: Counts  #: (n,) first detachments in the interval that ends at `time`
    switches: Counts  #: (n,) switches to sliding in it, from rest or by turning back
    t_det: Array  #: (N_y, N_x) s, first detachment; NaN without one, or outside the contact
    normal_force: float  #: P l² N_y N_x, N
    contact: NDArray[np.bool_]  #: (N_y, N_x) blocks in contact with the substrate
    snapshot_times: Array  #: (k,) s, times of the stored displacements
    snapshots: Array  #: (k, 2, N_y, N_x) m, [time, component, y, x], displacements at these times
    #: s, end of the onset of sliding, see `springblock.simulation.onset`; NaN if it has not ended
    onset_end: float = math.nan
    #: Mean of the force over P l² N_y N_x from 1.5 times the largest t_det on; NaN unless the run
    #: lasts for one reloading from then on
    dynamic_friction: float = math.nan

    @property
    def name(self) -> str:
        """Title of the run: the size of its surface."""
        rows, columns = self.t_det.shape
        return f"{columns} x {rows} blocks"

    @property
    def onset(self) -> slice:
        """Samples up to the end of the onset; all of them if it has not ended."""
        if math.isnan(self.onset_end):
            return slice(None)
        return slice(round(self.onset_end / float(self.time[1])) + 1)

    @property
    def t_max(self) -> float:
        """Time of the largest force of the onset, s."""
        return float(self.time[np.argmax(self.force[self.onset])])

    @property
    def static_friction(self) -> float:
        """Global static friction coefficient: the largest force of the onset over P l² N_y N_x."""
        return float(self.force[self.onset].max()) / self.normal_force

    @property
    def t_avg(self) -> float:
        """Mean of t_det over the contact blocks that have detached, s; NaN if none has."""
        detached = self.t_det[np.isfinite(self.t_det)]
        return float(detached.mean()) if detached.size else math.nan

    @property
    def t_first(self) -> float:
        """Time of the first detachment, s; NaN without one."""
        detached = self.t_det[np.isfinite(self.t_det)]
        return float(detached.min()) if detached.size else math.nan

    @property
    def prominence(self) -> float:
        """Drop of the force between two load peaks, from the lower one, over the largest force."""
        return prominence(self.force[self.onset])

    @property
    def t_quiet(self) -> float:
        """Time from one load peak to the other, s; NaN unless the force drops by 1 % between."""
        peaks = both_peaks(self.force[self.onset])
        return float(self.time[peaks.second] - self.time[peaks.first]) if peaks else math.nan

    @property
    def t_width(self) -> float:
        """Time from the first to the last force of at least 0.9 of the largest one, s."""
        return float(self.time[width(self.force[self.onset])])

    def to_xarray(self) -> "xarray.Dataset":
        """Return force and detachments in time, and the map of first detachments, with units."""
        return dataset(
            [
                (["time"], "time", self.time, "s", "time since the slider began to move"),
                (["time"], "force", self.force, "N", "friction force"),
                (["time"], "detachments", self.detachments, "1", "first detachments"),
                (["time"], "switches", self.switches, "1", "switches to sliding"),
                (["y", "x"], "t_det", self.t_det, "s", "time of the first detachment"),
                (["y", "x"], "contact", self.contact, "1", "in contact with the substrate"),
            ]
        )

    def __repr__(self) -> str:
        times = f"t_max {1e6 * self.t_max:.1f} µs, " + (
            "nothing has detached" if math.isnan(self.t_avg) else f"t_avg {1e6 * self.t_avg:.1f} µs"
        )
        return f"<{self.name}: static friction {self.static_friction:.4f}, {times}>"


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Realisation(Run):
    """A run as it was computed, with results that a `Record` lacks."""

    energy: Energy  #: at the end, J
    steps: int  #: number of integration steps
    displacement: Array  #: (2, N_y, N_x) m, components x and y, at the end
    velocity: Array  #: (2, N_y, N_x) m/s, at the end
    fields: Fields  #: velocity, stress, slip and state of the blocks at `snapshot_times`


def friction(run: Run) -> Array:
    """Friction force over normal force, (n,)."""
    return run.force / run.normal_force


def percent(run: Run, blocks: Counts) -> Array:
    """Numbers of blocks as a share of all that detach in the run, %.

    These are all contact blocks, if the run lasts until all of them have detached.
    """
    return 100.0 * blocks / max(1, int(np.isfinite(run.t_det).sum()))
