"""Exact non-linear springs in displacement form, one row of the lattice at a time.

A spring of stiffness k, rest length L and rest direction e (in units of the lattice spacing)
whose ends have moved apart by d pulls with F = k (1 - L/r) (e + d), r = |e + d| (section 2 of the
paper). Strains are 1e-2 and, in stiff materials, far less: computing r and then 1 - L/r would
cancel all but a few digits. With q = (2 e·d + d²)/L² = (r/L)² - 1,

    1 - L/r = 1 - (1 + q)^(-1/2) = q g(q),    g(q) = 1/((1 + q) + √(1 + q)),

has neither cancellation nor, with g as a short polynomial, a root or a division. Rows in which
the springs of some block leave the polynomial's range are computed again with the closed form.

Units here: lengths in l; forces as the change of velocity per step that they cause, in l per step.
"""

import numpy as np
from numba import njit
from numba.extending import register_jitable
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from springblock.solver.compilation import JIT

Array = NDArray[np.float64]

#: |q| up to which the polynomial stands for g; it is exact to rounding there.
SERIES_RANGE = 1.0 / 32.0
SERIES_DEGREE = 8

#: A spring may shrink to half its rest length and grow to twice it: -3/4 < q < 3.
Q_MIN, Q_MAX = -0.75, 3.0

#: A lattice row may hold at most this many blocks.
MAX_BLOCKS = 4096
#: Rows are worked on in bands of about this many blocks: all their springs, then all their
#: blocks. Sums that read what was written an instant ago would have to wait for it.
_BAND_BLOCKS = 512

U = np.uint64  # signed indices would be checked for wrap-around, and not vectorised
ONE = U(1)
# Fields of scratch: the springs of one band of rows and of the row below it. Their distance is a
# constant, so that the compiler can see that they do not overlap, and no power of two, so that
# they do not compete for the same cache lines.
_FIELD = 2 * MAX_BLOCKS + 72
EAST_X, EAST_Y, NORTH_X, NORTH_Y, NE_X, NE_Y, NW_X, NW_Y = (U(k * _FIELD) for k in range(8))
_TO_NEXT_ROW = (NORTH_X, NORTH_Y, NE_X, NE_Y, NW_X, NW_Y)
SCRATCH_SIZE = 8 * _FIELD


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


def coefficients(kappa: float) -> tuple[float, ...]:
    """Coefficients of kappa g(q), with kappa the velocity change per step by a force of K_int l."""
    return tuple((kappa * series()).tolist())


@njit(inline="always")
def _pull(q, c):
    """Return kappa q g(q) by the polynomial c: what an axial spring pulls with, over e + d."""
    c0, c1, c2, c3, c4, c5, c6, c7, c8 = c
    upper = c4 + q * (c5 + q * (c6 + q * (c7 + q * c8)))
    return q * (c0 + q * (c1 + q * (c2 + q * (c3 + q * upper))))


@njit(inline="always")
def _next_row(row, n):
    """Return the row to the north; the last one has none: any finite strain will do."""
    return min(row + ONE, n - ONE)


@njit(**JIT)
def _clear(s, own, n):
    """Set the forces from a row to the next one to zero."""
    for field in _TO_NEXT_ROW:
        for x in range(n + ONE):
            s[field + own + x] = 0.0


@njit(inline="always")
def _end_row(s, own, row, n):
    """Take away the springs beyond the eastern edge, and beyond the last row."""
    for field in (EAST_X, EAST_Y, NE_X, NE_Y, NW_X, NW_Y):
        s[field + own + n] = 0.0
    if row + ONE == n:
        _clear(s, own, n)


@njit(inline="always")
def slot(row, pitch, band):
    """Return where the springs of `row` stand in scratch: a ring of a band and the row below."""
    return row % (band + ONE) * pitch


@njit(inline="always")
def slot_below(own, pitch, band):
    """Return where the springs of the row below stand, from where those of a row do."""
    return own - pitch if own > 0 else band * pitch


@njit(**JIT)
def _rows_by_series(ux, uy, start, stop, needed, size, s, c):
    """Forces of the springs from rows [start, stop) to the east and to the next row.

    Rows are left out where neither they nor the next row are `needed`. Returns the first row with
    a spring out of range, which is not finished, or `stop`. Diagonal springs are entered as if they
    were as stiff as axial ones; `spring_force` halves them.
    """
    n, pitch, band = size
    for row in range(start, stop):
        if not (needed[row] or needed[row + ONE]):
            continue
        own, i, j = slot(row, pitch, band), row * pitch, _next_row(row, n) * pitch
        outside = np.int64(0)
        for x in range(ONE, n + ONE):
            ax, ay = ux[i + x], uy[i + x]
            bx, by = ux[i + x + ONE], uy[i + x + ONE]
            cx, cy = ux[j + x], uy[j + x]

            dx, dy = bx - ax, by - ay  # east
            q = 2.0 * dx + (dx * dx + dy * dy)
            f = _pull(q, c)
            s[EAST_X + own + x] = f + f * dx
            s[EAST_Y + own + x] = f * dy
            qq = q * q

            dx, dy = cx - ax, cy - ay  # north
            q = 2.0 * dy + (dx * dx + dy * dy)
            f = _pull(q, c)
            s[NORTH_X + own + x] = f * dx
            s[NORTH_Y + own + x] = f + f * dy
            qq += q * q

            dx, dy = ux[j + x + ONE] - ax, uy[j + x + ONE] - ay  # north-east
            q = (dy + dx) + 0.5 * (dx * dx + dy * dy)
            f = _pull(q, c)
            s[NE_X + own + x] = f * dx + f
            s[NE_Y + own + x] = f + f * dy
            qq += q * q

            dx, dy = cx - bx, cy - by  # north-west, from the next block
            q = (dy - dx) + 0.5 * (dx * dx + dy * dy)
            f = _pull(q, c)
            s[NW_X + own + x] = f * dx - f
            s[NW_Y + own + x] = f + f * dy
            outside += np.int64(not qq + q * q <= SERIES_RANGE**2)
        if outside > 0:
            return row
        _end_row(s, own, row, n)
    return stop


@njit(inline="always")
def _is_whole(q):
    return (q > Q_MIN) & (q < Q_MAX)  # False for NaN


@njit(**JIT)
def _row_by_closed_form(ux, uy, i, j, s, own, kappa, n):
    """As `_rows_by_series`, one row, any strain; the first x with a spring beyond all, or 0."""
    for x in range(ONE, n + ONE):
        ax, ay = ux[i + x], uy[i + x]
        bx, by = ux[i + x + ONE], uy[i + x + ONE]
        cx, cy = ux[j + x], uy[j + x]

        dx, dy = bx - ax, by - ay
        q_e = 2.0 * dx + (dx * dx + dy * dy)
        f = kappa * q_e * g(q_e)
        s[EAST_X + own + x] = f + f * dx
        s[EAST_Y + own + x] = f * dy

        dx, dy = cx - ax, cy - ay
        q_n = 2.0 * dy + (dx * dx + dy * dy)
        f = kappa * q_n * g(q_n)
        s[NORTH_X + own + x] = f * dx
        s[NORTH_Y + own + x] = f + f * dy

        dx, dy = ux[j + x + ONE] - ax, uy[j + x + ONE] - ay
        q_ne = (dy + dx) + 0.5 * (dx * dx + dy * dy)
        f = kappa * q_ne * g(q_ne)
        s[NE_X + own + x] = f * dx + f
        s[NE_Y + own + x] = f + f * dy

        dx, dy = cx - bx, cy - by
        q_nw = (dy - dx) + 0.5 * (dx * dx + dy * dy)
        f = kappa * q_nw * g(q_nw)
        s[NW_X + own + x] = f * dx - f
        s[NW_Y + own + x] = f + f * dy

        if not (_is_whole(q_e) & _is_whole(q_n) & _is_whole(q_ne) & _is_whole(q_nw)):
            return x
    return U(0)


@njit(**JIT)
def spring_band(ux, uy, start, stop, needed, size, s, kappa, c):
    """Put the forces of all springs from rows [start, stop) east and north into scratch `s`.

    Rows are left out where neither they nor the next row are `needed`. Returns row and column
    (from 1) of a spring that has collapsed, burst or become NaN; column 0 if there is none.
    """
    n, pitch, band = size
    if start == 0:
        _clear(s, slot(band, pitch, band), n)  # nothing lies below the first row
    row = _rows_by_series(ux, uy, start, stop, needed, size, s, c)
    while row < stop:
        own, i, j = slot(row, pitch, band), row * pitch, _next_row(row, n) * pitch
        beyond = _row_by_closed_form(ux, uy, i, j, s, own, kappa, n)
        if beyond > 0:
            return row, beyond
        _end_row(s, own, row, n)
        row = _rows_by_series(ux, uy, row + ONE, stop, needed, size, s, c)
    return start, U(0)


@njit(inline="always")
def spring_force(s, own, south):
    """Sum the eight springs of one block: the change of its velocity in one step.

    `own` is its place in scratch, `south` that of the block below. The order is the same seen from
    the north and from the south, so that a mirrored scene moves as a mirror image to the last bit.
    """
    west, south_west = own - ONE, south - ONE
    fx = (s[EAST_X + own] - s[EAST_X + west]) + (
        (s[NORTH_X + own] + 0.5 * (s[NE_X + own] + s[NW_X + west]))
        - (s[NORTH_X + south] + 0.5 * (s[NW_X + south] + s[NE_X + south_west]))
    )
    fy = (s[EAST_Y + own] - s[EAST_Y + west]) + (
        (s[NORTH_Y + own] + 0.5 * (s[NE_Y + own] + s[NW_Y + west]))
        - (s[NORTH_Y + south] + 0.5 * (s[NW_Y + south] + s[NE_Y + south_west]))
    )
    return fx, fy
