"""Exact non-linear springs in displacement form, one band of rows at a time.

A spring of stiffness k, rest length L and rest direction e (in units of the lattice spacing)
whose ends have moved apart by d pulls with F = k (1 - L/r) (e + d), r = |e + d| (section 2 of the
paper). Strains are 1e-2 and, in stiff materials, far less: computing r and then 1 - L/r would
cancel all but a few digits. With q = (2 e·d + d²)/L² = (r/L)² - 1,

    1 - L/r = 1 - (1 + q)^(-1/2) = q g(q),    g(q) = 1/((1 + q) + √(1 + q)),

has neither cancellation nor, with g as a short polynomial, a root or a division. Rows in which
the springs of some block leave the polynomial's range are computed again with the closed form.

A band of rows is worked on in short loops, first what its springs pull with, then what its blocks
feel: in one long loop the processor would run out of registers before it could overlap the work on
several blocks.

Units here: lengths in l; forces as the change of velocity per step that they cause, in l per step.
"""

from typing import NamedTuple

import numpy as np
from numba import njit
from numba.extending import register_jitable
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from springblock.solver.compilation import JIT

Array = NDArray[np.float64]

#: |q| up to which the polynomial stands for g, and the most by which it is off, relatively: as much
#: as rounding leaves of a strain of 5e-4 between blocks that have moved by l.
SERIES_RANGE = 1.0 / 32.0
SERIES_ERROR = 4e-13
SERIES_DEGREE = 6

#: A spring may shrink to half its rest length and grow to twice it: -3/4 < q < 3.
Q_MIN, Q_MAX = -0.75, 3.0

#: A lattice row may hold at most this many blocks.
MAX_BLOCKS = 4096

#: Rows are worked on in bands of about this many blocks.
_BAND_BLOCKS = 2048

U = np.uint64  # signed indices would be checked for wrap-around, and not vectorised
ONE = U(1)
# Fields of scratch: a band of rows each, but for the last two, which are one row. Their distance
# is a constant, so that the compiler can see that they do not overlap, and no power of two, so that
# they do not compete for the same cache lines.
_FIELD = MAX_BLOCKS + 72
FORCE_X, FORCE_Y, EAST, NORTH, NE, NW, BELOW_X, BELOW_Y = (U(k * _FIELD) for k in range(8))


class Band(NamedTuple):
    """Rows [start, stop) of a lattice, which are worked on together."""

    start: np.uint64
    stop: np.uint64
    n: np.uint64  #: blocks of a row
    pitch: np.uint64  #: numbers from one row to the next


class Springs(NamedTuple):
    """Stiffness of the springs, as the velocity that a force adds in one step."""

    kappa: float  #: K_int l
    series: tuple[float, ...]  #: kappa times the polynomial of g
    k_s: float  #: K_s

    @classmethod
    def of(cls, kappa: float, k_s: float) -> "Springs":
        """With the coefficients of kappa g(q), lowest first."""
        return cls(kappa, tuple((kappa * series()).tolist()), k_s)


def band_rows(n: int) -> int:
    """Rows of n blocks in one band."""
    return min(n, 1 + (_BAND_BLOCKS - 1) // n)


@register_jitable
def g(q):
    """Return g(q) = (1 - (1 + q)^(-1/2))/q without cancellation."""
    return 1.0 / ((1.0 + q) + np.sqrt(1.0 + q))


def _slope(q):
    """Return (g(q) - 1/2)/q without cancellation."""
    s = np.sqrt(1.0 + q)
    return -(s + 2.0) / (2.0 * s * (s + 1.0) ** 2)


def series() -> Array:
    """Coefficients of g as a polynomial in q, lowest first; g(0) = 1/2 to the last bit."""
    in_unit_range = chebyshev.chebinterpolate(lambda x: _slope(SERIES_RANGE * x), SERIES_DEGREE - 1)
    rising = chebyshev.cheb2poly(in_unit_range) / SERIES_RANGE ** np.arange(SERIES_DEGREE)
    return np.concatenate([[0.5], rising])


@njit(inline="always")
def _horner(p, q, c):
    """Return c + q p for four springs: side by side, for one alone would wait for itself."""
    return c + q[0] * p[0], c + q[1] * p[1], c + q[2] * p[2], c + q[3] * p[3]


@njit(inline="always")
def _series(q, c):
    """Return kappa g(q) of four springs by the polynomial c."""
    c0, c1, c2, c3, c4, c5, c6 = c
    p = _horner((c6, c6, c6, c6), q, c5)
    p = _horner(p, q, c4)
    p = _horner(p, q, c3)
    p = _horner(p, q, c2)
    p = _horner(p, q, c1)
    return _horner(p, q, c0)


@njit(inline="always")
def _stretch(ux, uy, i, j, x):
    """Return q of the four springs from block (i, x) to the east, north, and along diagonals.

    Row j is the next one; the last spring goes north-west from the block to the east.
    """
    ax, ay = ux[i + x], uy[i + x]
    bx, by = ux[i + x + ONE], uy[i + x + ONE]
    cx, cy = ux[j + x], uy[j + x]
    dx, dy = bx - ax, by - ay
    east = 2.0 * dx + (dx * dx + dy * dy)
    dx, dy = cx - ax, cy - ay
    north = 2.0 * dy + (dx * dx + dy * dy)
    dx, dy = ux[j + x + ONE] - ax, uy[j + x + ONE] - ay
    ne = (dy + dx) + 0.5 * (dx * dx + dy * dy)
    dx, dy = cx - bx, cy - by
    nw = (dy - dx) + 0.5 * (dx * dx + dy * dy)
    return east, north, ne, nw


@njit(inline="always")
def _places(row, band):
    """Return where a row and the next one stand.

    The last row has no next one: with itself in its place, northern springs are free of strain.
    """
    i = row * band.pitch
    return i, i + band.pitch if row + ONE < band.n else i


@njit(inline="always")
def _cut(s, own, row, n):
    """Take away the diagonal springs beyond the eastern edge, and beyond the last row."""
    s[NE + own + n] = s[NW + own + n] = 0.0
    if row + ONE == n:
        for x in range(ONE, n):
            s[NE + own + x] = s[NW + own + x] = 0.0


@njit(**JIT)
def _pulls_by_series(ux, uy, first, band, needed, s, c):
    """Enter kappa q g(q), which a spring pulls with over e + d, in a band from row `first` on.

    Rows are left out where neither they nor the next row are `needed`. Returns the first row with
    a spring out of range, which is not finished, or the band's stop. Diagonal springs are entered
    as if they were as stiff as axial ones; `_forces` halves them.
    """
    n = band.n
    for row in range(first, band.stop):
        if not (needed[row] or needed[row + ONE]):
            continue
        i, j = _places(row, band)
        own, outside = (row - band.start) * band.pitch, np.int64(0)
        for x in range(ONE, n + ONE):
            q = _stretch(ux, uy, i, j, x)
            p = _series(q, c)
            q_squared = (q[0] * q[0] + q[1] * q[1]) + (q[2] * q[2] + q[3] * q[3])
            outside += np.int64(not q_squared <= SERIES_RANGE**2)  # also for NaN
            s[EAST + own + x], s[NORTH + own + x] = q[0] * p[0], q[1] * p[1]
            s[NE + own + x], s[NW + own + x] = q[2] * p[2], q[3] * p[3]
        if outside > 0:
            return row
        _cut(s, own, row, n)
    return band.stop


@njit(inline="always")
def _is_whole(q):
    return (q > Q_MIN) & (q < Q_MAX)  # False for NaN


@njit(**JIT)
def _pulls_by_closed_form(ux, uy, row, band, s, kappa):
    """As `_pulls_by_series`, one row, any strain; returns the first x of a broken spring, or 0."""
    n = band.n
    i, j = _places(row, band)
    own, broken = (row - band.start) * band.pitch, np.int64(n + ONE)
    for x in range(ONE, n + ONE):
        q = _stretch(ux, uy, i, j, x)
        s[EAST + own + x], s[NORTH + own + x] = kappa * q[0] * g(q[0]), kappa * q[1] * g(q[1])
        s[NE + own + x], s[NW + own + x] = kappa * q[2] * g(q[2]), kappa * q[3] * g(q[3])
        cut = (x == n) | (row + ONE == n)
        whole = _is_whole(q[0]) & _is_whole(q[1]) & (cut | _is_whole(q[2]) & _is_whole(q[3]))
        broken = min(broken, np.int64(n + ONE) if whole else np.int64(x))
    _cut(s, own, row, n)
    return U(broken) % (n + ONE)


@njit(**JIT)
def _forces(ux, uy, band, needed, s, k_s, slider):
    """Enter F_mot of the blocks of a band, in those of its rows that are `needed`.

    What the springs from a row pull the next one with waits in BELOW. The order of sums is the same
    seen from the north and from the south, from the east and from the west, so that a mirrored
    scene moves as a mirror image to the last bit.
    """
    n, (sx, sy) = band.n, slider
    if band.start == 0:  # nothing lies below the first row
        for x in range(ONE, n + ONE):
            s[BELOW_X + x], s[BELOW_Y + x] = 0.0, 0.0
    for row in range(band.start, band.stop):
        if not (needed[row] or needed[row + ONE]):
            continue
        i, j = _places(row, band)
        own = (row - band.start) * band.pitch
        e_x = e_y = ne_x = ne_y = nw_x = nw_y = 0.0
        for x in range(ONE, n + ONE):
            ax, ay = ux[i + x], uy[i + x]
            bx, by = ux[i + x + ONE], uy[i + x + ONE]
            cx, cy = ux[j + x], uy[j + x]
            # Of the column to the west: east, north-east, and the one that goes there from here.
            w_x, w_y, wne_x, wne_y, wnw_x, wnw_y = e_x, e_y, ne_x, ne_y, nw_x, nw_y
            pull = s[EAST + own + x]
            e_x, e_y = pull + pull * (bx - ax), pull * (by - ay)
            pull = s[NORTH + own + x]
            n_x, n_y = pull * (cx - ax), pull + pull * (cy - ay)
            pull = s[NE + own + x]
            ne_x, ne_y = pull + pull * (ux[j + x + ONE] - ax), pull + pull * (uy[j + x + ONE] - ay)
            pull = s[NW + own + x]
            nw_x, nw_y = pull * (cx - bx) - pull, pull + pull * (cy - by)

            north_x, north_y = n_x + 0.5 * (ne_x + wnw_x), n_y + 0.5 * (ne_y + wnw_y)
            fx = (e_x - w_x) + (north_x - s[BELOW_X + x])
            fy = (e_y - w_y) + (north_y - s[BELOW_Y + x])
            s[FORCE_X + own + x] = fx + k_s * (sx - ax)
            s[FORCE_Y + own + x] = fy + k_s * (sy - ay)
            s[BELOW_X + x], s[BELOW_Y + x] = n_x + 0.5 * (nw_x + wne_x), n_y + 0.5 * (nw_y + wne_y)


@njit(**JIT)
def forces_on_band(ux, uy, band, needed, s, springs, slider):
    """Put F_mot of a band, under a slider at (x, y), into FORCE_X and FORCE_Y of scratch `s`.

    Bands come in ascending order. Rows that are not `needed`, (N + 1,), are not computed, or not
    right. Returns row and column (from 1) of a spring that has collapsed, burst or become NaN;
    column 0 if there is none.
    """
    row = _pulls_by_series(ux, uy, band.start, band, needed, s, springs.series)
    while row < band.stop:
        broken = _pulls_by_closed_form(ux, uy, row, band, s, springs.kappa)
        if broken > 0:
            return row, broken
        row = _pulls_by_series(ux, uy, row + ONE, band, needed, s, springs.series)
    _forces(ux, uy, band, needed, s, springs.k_s, slider)
    return row, U(0)


def scratch() -> Array:
    """Room for what is known of one band of rows."""
    return aligned(8 * _FIELD)


def aligned(size: int) -> Array:
    """Zeros, the second of which begins a cache line."""
    raw = np.zeros(size + 8)
    start = (-(raw.ctypes.data // 8) - 1) % 8
    return raw[start : start + size]
