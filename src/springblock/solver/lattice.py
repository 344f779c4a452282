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

from springblock.material import Material
from springblock.solver.compilation import JIT
from springblock.solver.laws import Law, law_of
from springblock.solver.springs import (
    FORCE_X,
    FORCE_Y,
    LANES,
    ONE,
    Band,
    Springs,
    U,
    aligned,
    band_rows,
    pitch,
    scratch,
    width,
)

Array = NDArray[np.float64]


#: Places in the ledger: the slider's work, friction's heat, and velocities squared for damping's.
WORK, RUBBED, SQUARES = range(3)


class Blocks(NamedTuple):
    """What is known of each block; every array has N rows of `pitch` numbers."""

    ux: Array  #: displacement
    uy: Array
    wx: Array  #: velocity
    wy: Array
    t_det: Array  #: first detachment; infinite before
    static: Array  #: mu_s F_n; 0 where there is no contact
    dynamic: Array  #: mu_d F_n; infinite for phantoms, which therefore never move


class State(NamedTuple):
    """State of the lattice, and the room that an integrator works in."""

    blocks: Blocks
    scratch: Array  #: springs and forces of a band of rows, see `springs`
    work: tuple[Array, ...]  #: lattice-sized fields of the integrator's own
    ledger: Array  #: (3,) sums over steps, see `WORK`
    peak: Array | None  #: running maximum of |F_mot|², kept only for a prelude
    in_contact: NDArray[np.bool_]  #: (N,) rows that hold any block in contact
    law: Law  #: of friction; a prelude, whose blocks never let go, needs none

    def copy(self) -> "State":
        """Return a state that shares no memory with this one."""
        return deepcopy(self)


class Constants(NamedTuple):
    """Constants of one run."""

    n: np.uint64  #: N
    pitch: np.uint64
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
        """Room for `count` samples."""
        return cls(np.zeros(count), np.zeros(count), np.zeros(count, np.int64))


class Advance(Protocol):
    """How an integrator takes steps."""

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
    """A way to follow the blocks through time: a module of this package.

    CONTRIBUTING.md says how to add one.
    """

    FORCE_EVALUATIONS: int  #: per step
    WORK_FIELDS: int  #: lattice-sized fields that it keeps for itself

    def is_stable(self, step: float, omega: Array, gamma: float) -> bool:
        """Whether no mode of these angular frequencies, rad/s, grows with a step in s."""

    def force_time(self, step: float, gamma: float) -> float:
        """How long a force acts in one step, s."""

    @property
    def advance(self) -> Advance:
        """Follows the blocks on one core."""

    def at_step(self, state: State, constants: Constants, steps: int) -> tuple[Array, float]:
        """Velocity, (2, lattice), after `steps` steps, and friction's heat until then."""


#: Threshold of a contact block whose mu_s is zero: it lets go at once, and is seen to.
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
) -> tuple[State, Constants]:
    """Lay out one run, at rest and free of strain, in the kernels' units.

    `heading` is the unit vector of the slider's motion.
    """
    n = contact.shape[0]
    row = pitch(n)
    # m per step, per N
    compliance = step * integrator.force_time(step, material.gamma) / material.mass
    velocity_per_force = compliance / material.spacing
    load = material.block_load * n * n / np.count_nonzero(contact)  # F_n, N

    fields = count()

    def padded(values: Array, beyond: float) -> Array:
        lattice = field()
        lattice[:] = beyond
        unpadded(lattice, n)[:] = values
        return lattice

    def field() -> Array:
        return aligned(n * row, 9 * next(fields))

    static = np.where(contact, np.maximum(mu_static * load * velocity_per_force, _NO_THRESHOLD), 0)
    dynamic = np.where(contact, mu_dynamic * load * velocity_per_force, 0.0)
    state = State(
        blocks=Blocks(
            ux=field(),
            uy=field(),
            wx=field(),
            wy=field(),
            t_det=padded(np.full((n, n), np.inf), np.inf),
            static=padded(static, 0.0),
            dynamic=padded(dynamic, np.inf),
        ),
        scratch=scratch(),
        work=tuple(field() for _ in range(integrator.WORK_FIELDS)),
        ledger=np.zeros(3),
        peak=field() if keep_peak else None,
        in_contact=np.asarray(contact.any(axis=1)),
        law=None if keep_peak else law_of(material, step, field),
    )
    slide = material.slider_velocity * step / material.spacing
    constants = Constants(
        n=np.uint64(n),
        pitch=np.uint64(row),
        band_rows=np.uint64(band_rows(n)),
        springs=Springs.of(material.k_int * compliance, material.k_s * compliance),
        damping=material.gamma * step,
        slider_x=slide * heading[0],
        slider_y=slide * heading[1],
    )
    return state, constants


def unpadded(field: Array, n: int) -> Array:
    """View of a flat field as (N, N), [y, x], without its border."""
    return field.reshape(n, -1)[:, 1 : n + 1]


@njit(inline="always")
def band_from(start, constants):
    """Return the band that begins with row `start`."""
    n = constants.n
    stop = min(start + constants.band_rows, n)
    return Band(start, stop, n, constants.pitch, width(n))


@njit(inline="always")
def close_edge(ux, uy, i, n):
    """Let the spring across the eastern edge of a row be free of strain, and those of phantoms."""
    last_x, last_y = ux[i + n], uy[i + n]
    for lane in range(LANES):  # always as many, which takes no loop
        x = width(n) + U(2 + lane - LANES)
        ux[i + x] = last_x if x > n else ux[i + x]
        uy[i + x] = last_y if x > n else uy[i + x]


@njit(**JIT)
def keep_peaks(peak, band, s):
    """Keep the largest |F_mot|² of each block in a band, for a prelude."""
    if peak is not None:
        for row in range(band.start, band.stop):
            i, own = row * band.pitch, (row - band.start) * band.pitch
            for x in range(ONE, band.width + ONE):
                fx, fy = s[FORCE_X + own + x], s[FORCE_Y + own + x]
                peak[i + x] = max(peak[i + x], fx * fx + fy * fy)


@njit(**JIT)
def book(ledger, samples, constants, totals, switches, k, first, every):
    """Enter step k into the ledger, and into the samples where it ends an interval.

    Returns the switches that no sample holds yet.
    """
    blocks, k_s = constants.n * constants.n, constants.springs.k_s
    force_x = k_s * (blocks * constants.slider_x * (k + 1) - totals.x)
    force_y = k_s * (blocks * constants.slider_y * (k + 1) - totals.y)
    ledger[WORK] += force_x * constants.slider_x + force_y * constants.slider_y
    ledger[RUBBED] += totals.heat
    ledger[SQUARES] += totals.squares
    if (k + 1) % every != 0:
        return switches
    sample = (k - first) // every
    samples.force_x[sample], samples.force_y[sample] = force_x, force_y
    samples.switches[sample] = switches
    return 0
