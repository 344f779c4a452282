"""Exact non-linear springs in displacement form, one band of rows at a time.

A spring of stiffness k and rest vector e, |e| = L (in units of the lattice spacing), whose ends are
displaced by d relative to each other, exerts the force F = k (1 - L/r) (e + d), r = |e + d|
(section 2 of the paper; (2) of docs/model.md). Strains are 1e-2 or, in stiff materials, far
smaller: there 1 - L/r would lose most of its digits to cancellation. With
q = (2 e·d + d²)/L² = (r/L)² - 1,

    1 - L/r = 1 - (1 + q)^(-1/2) = q g(q),    g(q) = 1/((1 + q) + √(1 + q)),

does not cancel and, with a short polynomial for g, needs neither a root nor a division. Rows in
which the springs of some block leave the range of the polynomial are computed again with the closed
form.

A row takes two short loops, over the forces of its springs and over the sums on its blocks: one
long loop would need more registers than the processor has. Rows are filled up to whole vectors with
phantom blocks, which copy the displacement of the last block and have no diagonal springs. With
periodic edges they are images of the first blocks of the row, and an image of the first row follows
the last one, so that springs across the edges are computed like all others.

Lengths are in l, forces in the velocity that they add in one step, in l per step.
"""

from typing import Literal, NamedTuple

import numpy as np
from numba import njit
from numba.extending import register_jitable
from numpy.polynomial import chebyshev

from springblock.model.numbers import Array
from springblock.model.pattern import MAX_BLOCKS
from springblock.solver.compilation import kernel

#: Largest |q| for which g is computed by the polynomial. Its relative error is at most 1.7e-9, five
#: orders of magnitude below that of the default step.
SERIES_RANGE = 1.0 / 32.0
SERIES_DEGREE = 4

#: A spring may have 1/2 to 2 times its rest length: -3/4 < q < 3.
Q_MIN, Q_MAX = -0.75, 3.0

#: Rows are computed in bands of about this many blocks.
_BAND_BLOCKS = 2048

#: Rows are filled up with phantoms to a multiple of this many blocks, the longest vector.
LANES = 8

U = np.uint64  # signed indices would be checked for wrap-around, and not vectorised
ONE = U(1)
#: Numbers in a field of `Scratch`: constant, so that the compiler can exclude overlaps, and not a
#: power of two, so that fields do not share cache sets.
_FIELD = MAX_BLOCKS + 72
_OF_BAND = FORCE_X, FORCE_Y = tuple(U(k * _FIELD) for k in range(2))
_OF_ROW = tuple(U(k * _FIELD) for k in range(11))
EAST_X, EAST_Y, NORTH_X, NORTH_Y, NE_X, NE_Y, NW_X, NW_Y, BELOW_X, BELOW_Y, TURNS = _OF_ROW


class Grid(NamedTuple):
    """Memory layout of a lattice."""

    n_y: np.uint64  #: rows
    n_x: np.uint64  #: blocks of a row
    width: np.uint64  #: blocks of a row with its phantoms
    pitch: np.uint64  #: numbers from one row to the next: border, width and border
    #: Whether opposite edges are joined; None if they are free, so that kernels are compiled
    #: without the branches for periodic edges.
    periodic: Literal[True] | None

    @classmethod
    def of(cls, shape: tuple[int, int], periodic: bool = False) -> "Grid":
        """Return the layout of (N_y, N_x) blocks."""
        n_y, n_x = shape
        width = -(-n_x // LANES) * LANES
        return cls(U(n_y), U(n_x), U(width), U(width + LANES), periodic or None)

    @property
    def shape(self) -> tuple[int, int]:
        """(N_y, N_x)."""
        return int(self.n_y), int(self.n_x)

    @property
    def band_rows(self) -> int:
        """Rows of one band."""
        fit = min(1 + (_BAND_BLOCKS - 1) // int(self.n_x), _FIELD // int(self.pitch))
        return min(int(self.n_y), fit)


class Band(NamedTuple):
    """Rows [start, stop) of a lattice, computed together."""

    start: np.uint64
    stop: np.uint64
    grid: Grid


class Scratch(NamedTuple):
    """Work arrays of one band of rows; each consists of fields, whose offsets have names."""

    force: Array  #: F_mot on the blocks of the band, rows of `pitch` numbers: `FORCE_X`, `FORCE_Y`
    #: For the row that is being computed, forces of springs on its blocks (to the east, north,
    #: north-east, and north-west of the block to the east), forces on them from the row below, and
    #: w·v, see `leapfrog`.
    row: Array

    @classmethod
    def empty(cls) -> "Scratch":
        """Return zeroed arrays."""
        memory = aligned((len(_OF_BAND) + len(_OF_ROW)) * _FIELD)
        return cls(memory[: len(_OF_BAND) * _FIELD], memory[len(_OF_BAND) * _FIELD :])


class Springs(NamedTuple):
    """Stiffness of the springs, in the kernels' units."""

    kappa: float  #: K_int
    series: tuple[float, ...]  #: kappa times the polynomial of g
    k_s: float  #: K_s

    @classmethod
    def of(cls, kappa: float, k_s: float) -> "Springs":
        """Return the springs with the coefficients of kappa g(q), lowest order first."""
        return cls(kappa, tuple((kappa * series()).tolist()), k_s)


@register_jitable
def g(q):
    """Return g(q) = (1 - (1 + q)^(-1/2))/q without cancellation."""
    return 1.0 / ((1.0 + q) + np.sqrt(1.0 + q))


def _slope(q):
    """Return (g(q) - 1/2)/q without cancellation."""
    s = np.sqrt(1.0 + q)
    return -(s + 2.0) / (2.0 * s * (s + 1.0) ** 2)


def series() -> Array:
    """Coefficients of the polynomial for g(q), lowest order first; g(0) = 1/2 exactly."""
    in_unit_range = chebyshev.chebinterpolate(lambda x: _slope(SERIES_RANGE * x), SERIES_DEGREE - 1)
    rising = chebyshev.cheb2poly(in_unit_range) / SERIES_RANGE ** np.arange(SERIES_DEGREE)
    return np.concatenate([[0.5], rising])


@njit(inline="always")
def _horner(p, q, c):
    """Return c + q p for four springs, interleaved to hide the latency of each operation."""
    return c + q[0] * p[0], c + q[1] * p[1], c + q[2] * p[2], c + q[3] * p[3]


@njit(inline="always")
def _series(q, c):
    """Return kappa g(q) of four springs by the polynomial with coefficients c."""
    c0, c1, c2, c3, c4 = c
    p = _horner((c4, c4, c4, c4), q, c3)
    p = _horner(p, q, c2)
    p = _horner(p, q, c1)
    return _horner(p, q, c0)


@njit(inline="always")
def _relative_displacements(ux, uy, i, j, x):
    """Relative displacements d of the springs of block (i, x) to the east, north and north-east.

    The fourth spring joins its eastern and northern neighbours; j is the offset of the next row.
    """
    ax, ay = ux[i + x], uy[i + x]
    bx, by = ux[i + x + ONE], uy[i + x + ONE]
    cx, cy = ux[j + x], uy[j + x]
    dx, dy = ux[j + x + ONE], uy[j + x + ONE]
    return (bx - ax, by - ay), (cx - ax, cy - ay), (dx - ax, dy - ay), (cx - bx, cy - by)


@njit(inline="always")
def _stretch(relative):
    """Return q of the four springs."""
    (ex, ey), (nx, ny), (nex, ney), (nwx, nwy) = relative
    east = 2.0 * ex + (ex * ex + ey * ey)
    north = 2.0 * ny + (nx * nx + ny * ny)
    ne = (ney + nex) + 0.5 * (nex * nex + ney * ney)
    nw = (nwy - nwx) + 0.5 * (nwx * nwx + nwy * nwy)
    return east, north, ne, nw


@njit(inline="always")
def _store_pulls(pulls, x, relative, east, north, ne, nw):
    """Store the forces F = pull (e + d) of the four springs."""
    (ex, ey), (nx, ny), (nex, ney), (nwx, nwy) = relative
    pulls[EAST_X + x], pulls[EAST_Y + x] = east + east * ex, east * ey
    pulls[NORTH_X + x], pulls[NORTH_Y + x] = north * nx, north + north * ny
    pulls[NE_X + x], pulls[NE_Y + x] = ne + ne * nex, ne + ne * ney
    pulls[NW_X + x], pulls[NW_Y + x] = nw * nwx - nw, nw + nw * nwy


@njit(inline="always")
def _row_offsets(row, grid):
    """Return the offsets of a row and of the next one.

    At a free edge the next one is the row itself, so that northern springs are unstrained.
    """
    i = row * grid.pitch
    return i, i + grid.pitch if row + ONE < grid.n_y or grid.periodic is not None else i


@njit(inline="always")
def _end_of_diagonals(row, grid):
    """Return the first x without diagonal springs to the north.

    With free edges this is the last block, or the first one in the last row.
    """
    if grid.periodic is not None:
        return grid.width + ONE
    return grid.n_x if row + ONE < grid.n_y else ONE


@njit(inline="always")
def _largest(q):
    """Return the largest |q| of four springs, NaN if that to the east is NaN.

    A NaN in a displacement makes q of the block's spring to the east NaN. Each comparison is one
    instruction, which keeps its second operand if one of them is NaN.
    """
    east, north, ne, nw = abs(q[0]), abs(q[1]), abs(q[2]), abs(q[3])
    diagonal = ne if ne > nw else nw
    largest = diagonal if diagonal > north else north
    return largest if largest > east else east


@njit(inline="always")
def _clear_diagonals(pulls, edge, grid):
    """Clear the forces of diagonal springs beyond an edge."""
    for x in range(edge, grid.width + ONE):
        pulls[NE_X + x], pulls[NE_Y + x], pulls[NW_X + x], pulls[NW_Y + x] = 0.0, 0.0, 0.0, 0.0


@njit(inline="always")
def _pulls_by_series(ux, uy, row, band, s, c):
    """Store the spring forces kappa q g(q) (e + d) of a row; return whether all q are in range.

    Forces of diagonal springs have the stiffness of axial ones; `_sum_forces` halves them.
    """
    i, j = _row_offsets(row, band.grid)
    within = True
    for x in range(ONE, band.grid.width + ONE):
        relative = _relative_displacements(ux, uy, i, j, x)
        q = _stretch(relative)
        p = _series(q, c)
        within = within & (_largest(q) <= SERIES_RANGE)
        _store_pulls(s.row, x, relative, q[0] * p[0], q[1] * p[1], q[2] * p[2], q[3] * p[3])
    _clear_diagonals(s.row, _end_of_diagonals(row, band.grid), band.grid)
    return within


@njit(inline="always")
def _is_intact(q):
    return (q > Q_MIN) & (q < Q_MAX)  # False for NaN


@kernel
def _pulls_by_closed_form(ux, uy, row, band, s, kappa):
    """Store the spring forces of a row at any strain; return the x of a broken spring, or 0."""
    n = band.grid.n_x
    i, j = _row_offsets(row, band.grid)
    edge, broken = _end_of_diagonals(row, band.grid), np.int64(n + ONE)
    for x in range(ONE, band.grid.width + ONE):
        relative = _relative_displacements(ux, uy, i, j, x)
        q = _stretch(relative)
        inside = x < edge
        east, north = kappa * q[0] * g(q[0]), kappa * q[1] * g(q[1])
        ne, nw = (kappa * q[2] * g(q[2]), kappa * q[3] * g(q[3])) if inside else (0.0, 0.0)
        _store_pulls(s.row, x, relative, east, north, ne, nw)
        diagonals = _is_intact(q[2]) & _is_intact(q[3])
        whole = _is_intact(q[0]) & _is_intact(q[1]) & (diagonals | (not inside))
        broken = min(broken, np.int64(n + ONE) if whole else np.int64(x))
    return U(broken) % (n + ONE)


@njit(inline="always")
def _close_springs(pulls, grid):
    """Connect the springs of the last block of a row to the first one, on a periodic surface.

    With free edges these entries stay zero.
    """
    if grid.periodic is not None:
        for field in (EAST_X, EAST_Y, NE_X, NE_Y, NW_X, NW_Y):
            pulls[field] = pulls[field + grid.n_x]


@njit(inline="always")
def _sum_forces(ux, uy, row, band, s, k_s, slider):
    """Store F_mot of the blocks of a row, summed over its springs and those from the row below.

    The forces of its springs on the next row are kept in BELOW. The order of summation is invariant
    under reflections in x and in y, so that a mirrored scene moves as the mirror image to the last
    bit.
    """
    (sx, sy), force, pulls = slider, s.force, s.row
    i, own = row * band.grid.pitch, (row - band.start) * band.grid.pitch
    e_x, e_y, ne_x, ne_y = pulls[EAST_X], pulls[EAST_Y], pulls[NE_X], pulls[NE_Y]
    nw_x, nw_y = pulls[NW_X], pulls[NW_Y]
    for x in range(ONE, band.grid.width + ONE):
        # Springs from the column to the west: east, north-east, and north-west from this block.
        w_x, w_y, wne_x, wne_y, wnw_x, wnw_y = e_x, e_y, ne_x, ne_y, nw_x, nw_y
        e_x, e_y = pulls[EAST_X + x], pulls[EAST_Y + x]
        n_x, n_y = pulls[NORTH_X + x], pulls[NORTH_Y + x]
        ne_x, ne_y, nw_x, nw_y = pulls[NE_X + x], pulls[NE_Y + x], pulls[NW_X + x], pulls[NW_Y + x]
        north_x, north_y = n_x + 0.5 * (ne_x + wnw_x), n_y + 0.5 * (ne_y + wnw_y)
        fx = (e_x - w_x) + (north_x - pulls[BELOW_X + x])
        fy = (e_y - w_y) + (north_y - pulls[BELOW_Y + x])
        force[FORCE_X + own + x] = fx + k_s * (sx - ux[i + x])
        force[FORCE_Y + own + x] = fy + k_s * (sy - uy[i + x])
        pulls[BELOW_X + x] = n_x + 0.5 * (nw_x + wne_x)
        pulls[BELOW_Y + x] = n_y + 0.5 * (nw_y + wne_y)


@kernel
def _forces_on_rows(ux, uy, band, needed, s, springs, slider):
    """Store F_mot of a band, given the forces on its first row from the row below.

    A row is skipped if neither it nor the next one is `needed`.
    """
    for row in range(band.start, band.stop):
        if needed[row] or needed[row + ONE]:
            if not _pulls_by_series(ux, uy, row, band, s, springs.series):
                broken = _pulls_by_closed_form(ux, uy, row, band, s, springs.kappa)
                if broken > 0:
                    return row, broken
            _close_springs(s.row, band.grid)
            _sum_forces(ux, uy, row, band, s, springs.k_s, slider)
    return band.stop, U(0)


@kernel
def forces_on_band(ux, uy, band, needed, s, springs, slider):
    """Store F_mot of a band, under a slider at (x, y), in the scratch `s`.

    Call it for bands in ascending order. Forces are valid only in rows that are `needed`,
    (N_y + 1,). Returns row and column (from 1) of a spring outside the allowed strains or NaN;
    column 0 if there is none.
    """
    grid = band.grid
    if band.start == 0:
        for x in range(ONE, grid.width + ONE):
            s.row[BELOW_X + x], s.row[BELOW_Y + x] = 0.0, 0.0
        if grid.periodic is not None:  # the last row is below the first
            last = Band(grid.n_y - ONE, grid.n_y, grid)
            row, broken = _forces_on_rows(ux, uy, last, needed, s, springs, slider)
            if broken > 0:
                return row, broken
    return _forces_on_rows(ux, uy, band, needed, s, springs, slider)


def aligned(size: int, shift: int = 0) -> Array:
    """Return zeros whose second element begins a cache line, shifted by `shift` lines.

    Arrays with different shifts avoid 4K aliasing: a load would wait for a store to an address that
    differs by a multiple of 4096 B.
    """
    raw = np.zeros(size + 8 * (shift + 1))
    start = (-(raw.ctypes.data // 8) - 1) % 8 + 8 * shift
    return raw[start : start + size]
