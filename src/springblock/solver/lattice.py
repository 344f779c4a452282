"""State of all blocks and constants of one run, as the integrators use them.

Fields are flat arrays with a border: block (y, x) has the index y pitch + x + 1. The columns beyond
a row hold phantom blocks, which fill up vectors and keep the springs across a free edge unstrained.
Lengths are in l, velocities in l per step, times in steps, and forces in the velocity that they add
in one step.
"""

from copy import deepcopy
from itertools import count
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from springblock.model.material import Material
from springblock.model.numbers import Array
from springblock.model.surface import Surface
from springblock.solver.compilation import kernel
from springblock.solver.integrators import Integrator
from springblock.solver.laws import KernelLaw, law_of
from springblock.solver.springs import (
    FORCE_X,
    FORCE_Y,
    LANES,
    ONE,
    Band,
    Grid,
    Springs,
    U,
    aligned,
)

#: Entries of the ledger: slider work, frictional heat, and squared velocities, for viscous heat.
WORK, HEAT, SQUARES = range(3)


class Blocks(NamedTuple):
    """Fields of all blocks, each with N_y rows of `pitch` numbers.

    With periodic edges there is one more row, an image of the first, which `close_rows` updates.
    """

    ux: Array  #: displacement
    uy: Array
    vx: Array  #: velocity
    vy: Array
    t_det: Array  #: time of first detachment; infinite before
    static: Array  #: mu_s F_n; 0 outside the contact
    dynamic: Array  #: mu_d F_n; infinite for phantoms, whose velocity stays zero


class Lattice(NamedTuple):
    """State of the lattice."""

    blocks: Blocks
    ledger: Array  #: (3,) sums over steps, see `WORK`
    peak: Array | None  #: running maximum of |F_mot|², for a prelude only
    law: KernelLaw  #: law of friction; None for a prelude, in which no block detaches

    def copy(self) -> "Lattice":
        """Return a copy that shares no memory with this state except the law's functions."""
        return deepcopy(self, {id(part): part for part in self.law or () if callable(part)})


class Constants(NamedTuple):
    """Constants of one run."""

    grid: Grid
    band_rows: np.uint64
    springs: Springs
    damping: float  #: gamma h
    slider_x: float  #: slider's displacement in one step
    slider_y: float


class Totals(NamedTuple):
    """Sums over all blocks after one step."""

    x: float  #: displacement
    y: float
    heat: float  #: frictional heat of the step
    squares: float  #: squared velocity


class Samples(NamedTuple):
    """Record of one call of an integrator, one entry per sample interval."""

    force_x: Array  #: sum of F_s at the end of the interval
    force_y: Array
    switches: NDArray[np.int64]  #: switches to sliding in the interval, from rest or by turning

    @classmethod
    def empty(cls, count: int) -> "Samples":
        """Return zeroed arrays for `count` samples."""
        return cls(np.zeros(count), np.zeros(count), np.zeros(count, np.int64))


#: Threshold of a contact block with mu_s = 0: not zero, which stands for no contact.
_NO_THRESHOLD = 1e-300


def prepare(
    surface: Surface,
    material: Material,
    heading: tuple[float, float],
    integrator: Integrator,
    step: float,
    keep_peak: bool = False,
) -> tuple[Lattice, Constants]:
    """Return state and constants of a run in the kernels' units, at rest and unstrained.

    `heading` is the unit vector of the slider velocity.
    """
    contact, periodic = surface.contact, surface.periodic
    grid = Grid.of(contact.shape, periodic)
    n_y, n_x = contact.shape
    # m per step, per N
    compliance = step * integrator.force_time(step, material.gamma) / material.mass
    velocity_per_force = compliance / material.spacing
    load = material.block_load * n_y * n_x / np.count_nonzero(contact)  # F_n, N
    shifts = count(step=9)  # see `aligned`

    def field(values: Array | float = 0.0, beyond: float = 0.0) -> Array:
        lattice = aligned((n_y + periodic) * int(grid.pitch), next(shifts))
        lattice[:] = beyond
        unpadded(lattice, grid)[:] = values
        return lattice

    static = np.maximum(surface.mu_static * load * velocity_per_force, _NO_THRESHOLD)
    dynamic = surface.mu_dynamic * load * velocity_per_force
    blocks = Blocks(
        ux=field(),
        uy=field(),
        vx=field(),
        vy=field(),
        t_det=field(np.inf, beyond=np.inf),
        static=field(np.where(contact, static, 0.0)),
        dynamic=field(dynamic, beyond=np.inf),
    )
    state = Lattice(
        blocks=blocks,
        ledger=np.zeros(3),
        peak=field() if keep_peak else None,
        law=None
        if keep_peak
        else law_of(material, step, load * velocity_per_force, blocks.static > 0.0),
    )
    slide = material.slider_velocity * step / material.spacing
    constants = Constants(
        grid=grid,
        band_rows=np.uint64(grid.band_rows),
        springs=Springs.of(material.k_int * compliance, material.k_s * compliance),
        damping=material.gamma * step,
        slider_x=slide * heading[0],
        slider_y=slide * heading[1],
    )
    return state, constants


def unpadded(field: Array, grid: Grid) -> Array:
    """View of a flat field as (N_y, N_x), [y, x], without border and phantoms."""
    n_y, n_x = grid.shape
    return field.reshape(-1, int(grid.pitch))[:n_y, 1 : n_x + 1]


@njit(inline="always")
def band_from(start, constants):
    """Return the band that begins with row `start`."""
    grid = constants.grid
    return Band(start, min(start + constants.band_rows, grid.n_y), grid)


@njit(inline="always")
def slider_at(constants, k):
    """Return the slider's displacement after k steps."""
    return constants.slider_x * k, constants.slider_y * k


@njit(inline="always")
def close_edge(ux, uy, row, grid):
    """Displace the phantoms of a row with its last block, so that their springs are unstrained.

    On a periodic surface they are images of the first blocks of the row.
    """
    i, n = row * grid.pitch, grid.n_x
    if grid.periodic is not None:
        for x in range(n + ONE, grid.width + U(2)):
            ux[i + x], uy[i + x] = ux[i + x - n], uy[i + x - n]
        return
    last_x, last_y = ux[i + n], uy[i + n]
    for lane in range(LANES):  # a constant number, so that the loop is unrolled
        x = grid.width + U(2 + lane - LANES)
        ux[i + x] = last_x if x > n else ux[i + x]
        uy[i + x] = last_y if x > n else uy[i + x]


@kernel
def close_edges(ux, uy, grid):
    """Apply `close_edge` to every row."""
    for row in range(grid.n_y):
        close_edge(ux, uy, row, grid)


@kernel
def close_rows(ux, uy, grid):
    """Copy the first row beyond the last one, on a periodic surface.

    Call it before blocks move: the last band needs the first row as at the start of the step.
    """
    if grid.periodic is not None:
        beyond = grid.n_y * grid.pitch
        for x in range(grid.pitch):
            ux[beyond + x], uy[beyond + x] = ux[x], uy[x]


@njit(inline="always")
def index_of(y, x, grid):
    """Return the index of block (y, x), x from 1, or of its periodic image; -1 beyond an edge."""
    n_y, n_x = np.int64(grid.n_y), np.int64(grid.n_x)
    if grid.periodic is not None:
        y, x = y % n_y, (x - 1) % n_x + 1
    return y * np.int64(grid.pitch) + x if 0 <= y < n_y and 1 <= x <= n_x else np.int64(-1)


@kernel
def update_peaks(peak, band, s):
    """Update the running maximum of |F_mot|² of each block in a band, for a prelude."""
    if peak is not None:
        for row in range(band.start, band.stop):
            i, own = row * band.grid.pitch, (row - band.start) * band.grid.pitch
            for x in range(ONE, band.grid.width + ONE):
                fx, fy = s.force[FORCE_X + own + x], s.force[FORCE_Y + own + x]
                peak[i + x] = max(peak[i + x], fx * fx + fy * fy)


@kernel
def tally(ledger, samples, constants, totals, switches, k, first, every):
    """Add step k, up to (k + 1) h, to the ledger, and to the samples if it ends an interval.

    Returns the switches that belong to the interval still open.
    """
    blocks, k_s = constants.grid.n_y * constants.grid.n_x, constants.springs.k_s
    force_x = k_s * (blocks * constants.slider_x * (k + 1) - totals.x)
    force_y = k_s * (blocks * constants.slider_y * (k + 1) - totals.y)
    ledger[WORK] += force_x * constants.slider_x + force_y * constants.slider_y
    ledger[HEAT] += totals.heat
    ledger[SQUARES] += totals.squares
    if (k + 1) % every != 0:
        return switches
    sample = (k - first) // every
    samples.force_x[sample], samples.force_y[sample] = force_x, force_y
    samples.switches[sample] = switches
    return 0
