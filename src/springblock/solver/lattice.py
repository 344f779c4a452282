"""What an integrator works on: the state of all blocks and the constants of one run.

Arrays are flat with a border: block (y, x) stands at y pitch + x + 1, and the two columns beside
a row hold what makes the springs across the edge strain-free. Lengths are in l, velocities in l
per step, times in steps, forces in the velocity that they add in one step.
"""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from springblock.material import Material
from springblock.solver.compilation import JIT
from springblock.solver.springs import (
    FORCE_X,
    FORCE_Y,
    ONE,
    aligned,
    band_rows,
    coefficients,
    scratch,
)

Array = NDArray[np.float64]


class State(NamedTuple):
    """State of the lattice; every array has N rows of `pitch` numbers."""

    ux: Array  #: displacement
    uy: Array
    wx: Array  #: velocity
    wy: Array
    t_det: Array  #: first detachment; infinite before
    static: Array  #: mu_s F_n; 0 where there is no contact
    dynamic: Array  #: mu_d F_n
    scratch: Array  #: springs and forces of a band of rows, see `springs`
    work: Array  #: lattice-sized fields of the integrator's own
    ledger: Array  #: slider's work, friction's and damping's heat, each summed over steps
    peak: Array | None  #: running maximum of |F_mot|², kept only for a prelude
    in_contact: NDArray[np.bool_]  #: (N,) rows that hold any block in contact

    def copy(self) -> "State":
        """Return a state that shares no memory with this one."""
        return State._make(None if field is None else field.copy() for field in self)


class Constants(NamedTuple):
    """Constants of one run."""

    n: np.uint64  #: N
    pitch: np.uint64
    band: np.uint64  #: rows of a band, see `springs`
    kappa: float  #: K_int l
    series: tuple[float, ...]  #: kappa times the polynomial of the springs
    k_s: float  #: K_s
    damping: float  #: gamma h
    slider_x: float  #: slider's displacement in one step
    slider_y: float


class Samples(NamedTuple):
    """What one call of an integrator records, one entry per sample interval."""

    force_x: Array  #: sum of F_s at the end of the interval
    force_y: Array
    switches: NDArray[np.int64]  #: blocks that went from rest to sliding within it

    @classmethod
    def empty(cls, count: int) -> "Samples":
        """Room for `count` samples."""
        return cls(np.zeros(count), np.zeros(count), np.zeros(count, np.int64))


#: Threshold of a contact block whose mu_s is zero: it lets go at once, and is seen to.
_NO_THRESHOLD = 1e-300


def prepare(
    contact: NDArray[np.bool_],
    mu_static: Array,
    mu_dynamic: Array,
    material: Material,
    heading: tuple[float, float],
    step: float,
    force_time: float,
    work_fields: int,
    keep_peak: bool = False,
) -> tuple[State, Constants]:
    """Lay out one run, at rest and free of strain, in the kernels' units.

    `heading` is the unit vector of the slider's motion, `force_time` the time in s for which the
    integrator lets a force act in one step.
    """
    n = contact.shape[0]
    pitch = -(-(n + 2) // 4) * 4
    compliance = step * force_time / material.mass  # m per step, per N
    velocity_per_force = compliance / material.spacing
    load = material.block_load * n * n / np.count_nonzero(contact)  # F_n, N

    def padded(values: Array) -> Array:
        lattice = field()
        unpadded(lattice, n)[:] = values
        return lattice

    def field() -> Array:
        return aligned(n * pitch)

    static = np.where(contact, np.maximum(mu_static * load * velocity_per_force, _NO_THRESHOLD), 0)
    state = State(
        ux=field(),
        uy=field(),
        wx=field(),
        wy=field(),
        t_det=field() + np.inf,
        static=padded(static),
        dynamic=padded(np.where(contact, mu_dynamic * load * velocity_per_force, 0.0)),
        scratch=scratch(),
        work=np.zeros((work_fields, n * pitch)),
        ledger=np.zeros(3),
        peak=field() if keep_peak else None,
        in_contact=np.asarray(contact.any(axis=1)),
    )
    kappa = material.k_int * compliance
    slide = material.slider_velocity * step / material.spacing
    constants = Constants(
        n=np.uint64(n),
        pitch=np.uint64(pitch),
        band=np.uint64(band_rows(n)),
        kappa=kappa,
        series=coefficients(kappa),
        k_s=material.k_s * compliance,
        damping=material.gamma * step,
        slider_x=slide * heading[0],
        slider_y=slide * heading[1],
    )
    return state, constants


def unpadded(field: Array, n: int) -> Array:
    """View of a flat field as (N, N), [y, x], without its border."""
    return field.reshape(n, -1)[:, 1 : n + 1]


@njit(inline="always")
def close_edge(ux, uy, i, n):
    """Let the spring across the eastern edge of a row be free of strain."""
    ux[i + n + ONE] = ux[i + n]
    uy[i + n + ONE] = uy[i + n]


@njit(**JIT)
def keep_peaks(peak, size, s, start, stop):
    """Keep the largest |F_mot|² of each block in rows [start, stop), for a prelude."""
    if peak is not None:
        n, pitch = size
        for row in range(start, stop):
            i, own = row * pitch, (row - start) * pitch
            for x in range(ONE, n + ONE):
                fx, fy = s[FORCE_X + own + x], s[FORCE_Y + own + x]
                peak[i + x] = max(peak[i + x], fx * fx + fy * fy)


@njit(**JIT)
def book(ledger, constants, k, totals):
    """Enter step k into the ledger; return the slider's force at the end of the step.

    `totals` are the sums of displacement, friction's heat and squared velocity.
    """
    total_x, total_y, heat, squares = totals
    blocks = constants.n * constants.n
    force_x = constants.k_s * (blocks * constants.slider_x * (k + 1) - total_x)
    force_y = constants.k_s * (blocks * constants.slider_y * (k + 1) - total_y)
    ledger[0] += force_x * constants.slider_x + force_y * constants.slider_y
    ledger[1] += heat
    ledger[2] += squares
    return force_x, force_y
