"""What an integrator works on: the state of all blocks and the constants of one run.

Arrays are flat with a border: block (y, x) stands at y pitch + x + 1, and the columns beyond a row
hold phantoms that fill up vectors, and make the springs across the edge strain-free. Lengths are in
l, velocities in l per step, times in steps, forces in the velocity that they add in one step.
"""

from copy import deepcopy
from itertools import count
from typing import NamedTuple, Protocol

import numpy as np
from numba import njit
from numpy.typing import NDArray

from springblock.model.material import Material
from springblock.solver.compilation import kernel
from springblock.solver.laws import Law, law_of
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
    scratch,
)

Array = NDArray[np.float64]


#: Places in the ledger: the slider's work, friction's heat, and velocities squared for damping's.
WORK, HEAT, SQUARES = range(3)


class Blocks(NamedTuple):
    """Fields of all blocks, each with N_y rows of `pitch` numbers.

    With periodic edges there is one more, an image of the first as `close_rows` leaves it.
    """

    ux: Array  #: displacement
    uy: Array
    wx: Array  #: velocity
    wy: Array
    t_det: Array  #: first detachment; infinite before
    static: Array  #: mu_s F_n; 0 where there is no contact
    dynamic: Array  #: mu_d F_n; infinite for phantoms, which therefore never move


class State(NamedTuple):
    """State of the lattice, and the work arrays of an integrator."""

    blocks: Blocks
    scratch: Array  #: springs and forces of a band of rows, see `springs`
    work: tuple[Array, ...]  #: lattice-sized fields of the integrator's own
    ledger: Array  #: (3,) sums over steps, see `WORK`
    peak: Array | None  #: running maximum of |F_mot|², kept only for a prelude
    in_contact: NDArray[np.bool_]  #: (N_y,) rows that hold any block in contact
    law: Law  #: of friction; a prelude, whose blocks never let go, needs none

    def copy(self) -> "State":
        """Return a state that shares no memory with this one, but for the law's functions."""
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
    heat: float  #: of friction
    squares: float  #: velocity squared


class Samples(NamedTuple):
    """What one call of an integrator records, one entry per sample interval."""

    force_x: Array  #: sum of F_s at the end of the interval
    force_y: Array
    switches: NDArray[np.int64]  #: blocks that went from rest to sliding within it

    @classmethod
    def empty(cls, count: int) -> "Samples":
        """Return zeroed arrays for `count` samples."""
        return cls(np.zeros(count), np.zeros(count), np.zeros(count, np.int64))


class Advance(Protocol):
    """Function by which an integrator takes steps."""

    def __call__(
        self,
        state: State,
        constants: Constants,
        first: int,
        steps: int,
        every: int,
        samples: Samples,
    ) -> tuple[int, int, int]:
        """Take `steps` steps from step `first` on, sampling each time `every` steps are full.

        Returns steps taken, and row and column of a spring that no longer holds; -1 if all do.
        """


class Integrator(Protocol):
    """Integration scheme: a module of this package.

    CONTRIBUTING.md says how to add one.
    """

    FORCE_EVALUATIONS: int  #: per step
    WORK_FIELDS: int  #: lattice-sized fields that it keeps for itself

    def force_time(self, step: float, gamma: float) -> float:
        """How long a force acts in one step, s."""

    @property
    def advance(self) -> Advance:
        """Follows the blocks on one core."""

    def at_step(self, state: State, constants: Constants, steps: int) -> tuple[Array, float]:
        """Velocity, (2, lattice), after `steps` steps, and friction's heat until then."""


#: Threshold of a contact block whose mu_s is zero: it detaches in the first step, and is counted.
_NO_THRESHOLD = 1e-300


def prepare(
    contact: NDArray[np.bool_],
    mu_static: Array,
    mu_dynamic: Array,
    material: Material,
    heading: tuple[float, float],
    integrator: Integrator,
    step: float,
    keep_peak: bool = False,
    periodic: bool = False,
) -> tuple[State, Constants]:
    """Lay out one run, at rest and free of strain, in the kernels' units.

    `heading` is the unit vector of the slider's motion; opposite edges are joined if `periodic`.
    """
    grid = Grid.of(contact.shape, periodic)
    n_y, n_x = contact.shape
    # m per step, per N
    compliance = step * integrator.force_time(step, material.gamma) / material.mass
    velocity_per_force = compliance / material.spacing
    load = material.block_load * n_y * n_x / np.count_nonzero(contact)  # F_n, N

    fields = count()

    def padded(values: Array, beyond: float) -> Array:
        lattice = field()
        lattice[:] = beyond
        unpadded(lattice, grid)[:] = values
        return lattice

    def field() -> Array:
        return aligned((n_y + periodic) * int(grid.pitch), 9 * next(fields))

    static = np.where(contact, np.maximum(mu_static * load * velocity_per_force, _NO_THRESHOLD), 0)
    dynamic = np.where(contact, mu_dynamic * load * velocity_per_force, 0.0)
    blocks = Blocks(
        ux=field(),
        uy=field(),
        wx=field(),
        wy=field(),
        t_det=padded(np.full((n_y, n_x), np.inf), np.inf),
        static=padded(static, 0.0),
        dynamic=padded(dynamic, np.inf),
    )
    state = State(
        blocks=blocks,
        scratch=scratch(),
        work=tuple(field() for _ in range(integrator.WORK_FIELDS)),
        ledger=np.zeros(3),
        peak=field() if keep_peak else None,
        in_contact=np.asarray(contact.any(axis=1)),
        law=None
        if keep_peak
        else law_of(material, step, load * velocity_per_force, blocks.static > 0.0, field),
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
    """View of a flat field as (N_y, N_x), [y, x], without its border."""
    n_y, n_x = grid.shape
    return field.reshape(-1, int(grid.pitch))[:n_y, 1 : n_x + 1]


@njit(inline="always")
def band_from(start, constants):
    """Return the band that begins with row `start`."""
    grid = constants.grid
    return Band(start, min(start + constants.band_rows, grid.n_y), grid)


@njit(inline="always")
def close_edge(ux, uy, row, grid):
    """Let the spring across the eastern edge of a row be free of strain, and those of phantoms.

    On a periodic surface the row goes on from its beginning.
    """
    i, n = row * grid.pitch, grid.n_x
    if grid.periodic is not None:
        for x in range(n + ONE, grid.width + U(2)):
            ux[i + x], uy[i + x] = ux[i + x - n], uy[i + x - n]
        return
    last_x, last_y = ux[i + n], uy[i + n]
    for lane in range(LANES):  # always as many, which takes no loop
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
    """Let an image of the first row follow the last one, on a periodic surface.

    To be done before blocks move: the last row still needs the first one when that has moved.
    """
    if grid.periodic is not None:
        beyond = grid.n_y * grid.pitch
        for x in range(grid.pitch):
            ux[beyond + x], uy[beyond + x] = ux[x], uy[x]


@njit(inline="always")
def place(y, x, grid):
    """Return where block (y, x), x from 1, or its image stands; -1 beyond a free edge."""
    n_y, n_x = np.int64(grid.n_y), np.int64(grid.n_x)
    if grid.periodic is not None:
        y, x = y % n_y, (x - 1) % n_x + 1
    return y * np.int64(grid.pitch) + x if 0 <= y < n_y and 1 <= x <= n_x else np.int64(-1)


@kernel
def keep_peaks(peak, band, s):
    """Keep the largest |F_mot|² of each block in a band, for a prelude."""
    if peak is not None:
        for row in range(band.start, band.stop):
            i, own = row * band.grid.pitch, (row - band.start) * band.grid.pitch
            for x in range(ONE, band.grid.width + ONE):
                fx, fy = s[FORCE_X + own + x], s[FORCE_Y + own + x]
                peak[i + x] = max(peak[i + x], fx * fx + fy * fy)


@kernel
def book(ledger, samples, constants, totals, switches, k, first, every):
    """Enter step k into the ledger, and into the samples where it ends an interval.

    Returns the switches that no sample holds yet.
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
