"""Exact non-linear springs in displacement form, one row of the lattice at a time.

A spring of stiffness k, rest length L and rest direction e (in units of the lattice spacing)
whose ends have moved apart by d pulls with F = k (1 - L/r) (e + d), r = |e + d| (section 2 of the
paper). Strains are 1e-2 and, in stiff materials, far less: computing r and then 1 - L/r would
cancel all but a few digits. With q = (2 e·d + d²)/L² = (r/L)² - 1,

    1 - L/r = 1 - (1 + q)^(-1/2) = q g(q),    g(q) = 1/((1 + q) + √(1 + q)),

has neither cancellation nor, with g as a short polynomial, a root or a division. Rows in which
some |q| leaves the polynomial's range are computed again with the closed form.

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
_BAND_BLOCKS = 256

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


def coefficients(kappa: float) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Polynomials of p = e·d + d²/2 for axial (q = 2p) and diagonal (q = p) springs.

    `kappa` is the velocity change per step by a force of K_int l; p times the polynomial is the
    pull of a spring divided by its direction e + d.
    """
    powers = np.arange(SERIES_DEGREE + 1)
    axial = 2.0 * kappa * series() * 2.0**powers
    diagonal = 0.5 * kappa * series()
    return tuple(axial.tolist()), tuple(diagonal.tolist())


@njit(inline="always")
def _pull(p, c):
    c0, c1, c2, c3, c4, c5, c6, c7, c8 = c
    upper = c4 + p * (c5 + p * (c6 + p * (c7 + p * c8)))
    return p * (c0 + p * (c1 + p * (c2 + p * (c3 + p * upper))))


@njit(**JIT)
def _row_by_series(ux, uy, i, j, s, own, axial, diagonal, n):
    """Forces of the springs from row `i` east and to row `j`; the number of pairs out of range.

    Axial and diagonal springs take turns: one loop over all four would hold more numbers than a
    processor has registers for.
    """
    outside = np.int64(0)
    for x in range(ONE, n + ONE):
        ax, ay = ux[i + x], uy[i + x]
        dx, dy = ux[i + x + ONE] - ax, uy[i + x + ONE] - ay  # east
        p = dx + 0.5 * (dx * dx + dy * dy)
        f = _pull(p, axial)
        s[EAST_X + own + x] = f + f * dx
        s[EAST_Y + own + x] = f * dy
        pp = p * p

        dx, dy = ux[j + x] - ax, uy[j + x] - ay  # north
        p = dy + 0.5 * (dx * dx + dy * dy)
        f = _pull(p, axial)
        s[NORTH_X + own + x] = f * dx
        s[NORTH_Y + own + x] = f + f * dy
        outside += np.int64(not pp + p * p <= (0.5 * SERIES_RANGE) ** 2)
    for x in range(ONE, n + ONE):
        dx, dy = ux[j + x + ONE] - ux[i + x], uy[j + x + ONE] - uy[i + x]  # north-east
        p = (dy + dx) + 0.5 * (dx * dx + dy * dy)
        f = _pull(p, diagonal)
        s[NE_X + own + x] = f * dx + f
        s[NE_Y + own + x] = f + f * dy
        pp = p * p

        dx, dy = ux[j + x] - ux[i + x + ONE], uy[j + x] - uy[i + x + ONE]  # north-west
        p = (dy - dx) + 0.5 * (dx * dx + dy * dy)  # from the next block
        f = _pull(p, diagonal)
        s[NW_X + own + x] = f * dx - f
        s[NW_Y + own + x] = f + f * dy
        outside += np.int64(not pp + p * p <= SERIES_RANGE**2)
    return outside


@njit(inline="always")
def _is_whole(q):
    return (q > Q_MIN) & (q < Q_MAX)  # False for NaN


@njit(**JIT)
def _row_by_closed_form(ux, uy, i, j, s, own, kappa, n):
    """As `_row_by_series` at any strain; returns the first x with a spring beyond all, or 0."""
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
        f = 0.5 * kappa * q_ne * g(q_ne)
        s[NE_X + own + x] = f * dx + f
        s[NE_Y + own + x] = f + f * dy

        dx, dy = cx - bx, cy - by
        q_nw = (dy - dx) + 0.5 * (dx * dx + dy * dy)
        f = 0.5 * kappa * q_nw * g(q_nw)
        s[NW_X + own + x] = f * dx - f
        s[NW_Y + own + x] = f + f * dy

        if not (_is_whole(q_e) & _is_whole(q_n) & _is_whole(q_ne) & _is_whole(q_nw)):
            return x
    return U(0)


@njit(inline="always")
def slot(row, pitch, band):
    """Return where the springs of `row` stand in scratch: a ring of a band and the row below."""
    return row % (band + ONE) * pitch


@njit(**JIT)
def _clear(s, own, n):
    """Set the forces from a row to the next one to zero."""
    for field in _TO_NEXT_ROW:
        for x in range(n + ONE):
            s[field + own + x] = 0.0


@njit(**JIT)
def spring_band(ux, uy, start, stop, needed, size, s, kappa, axial, diagonal):
    """Put the forces of all springs from rows [start, stop) east and north into scratch `s`.

    Rows are left out where neither they nor the next row are `needed`. Returns row and column
    (from 1) of a spring that has collapsed, burst or become NaN; column 0 if there is none.
    """
    n, pitch, band = size
    if start == 0:
        _clear(s, slot(band, pitch, band), n)  # nothing lies below the first row
    for row in range(start, stop):
        if not (needed[row] or needed[row + ONE]):
            continue
        i, own = row * pitch, slot(row, pitch, band)
        last = row + ONE == n
        j = i if last else i + pitch  # the last row has no north: any finite strain will do
        if _row_by_series(ux, uy, i, j, s, own, axial, diagonal, n) > 0:
            beyond = _row_by_closed_form(ux, uy, i, j, s, own, kappa, n)
            if beyond > 0:
                return row, beyond
        s[EAST_X + own + n] = 0.0
        s[EAST_Y + own + n] = 0.0
        for field in (NE_X, NE_Y, NW_X, NW_Y):
            s[field + own + n] = 0.0
        if last:
            _clear(s, own, n)
    return start, U(0)


@njit(inline="always")
def spring_force(s, own, south):
    """Sum the eight springs of one block: the change of its velocity in one step.

    `own` is its place in scratch, `south` that of the block below. The order is the same seen from
    the north and from the south, so that a mirrored scene moves as a mirror image to the last bit.
    """
    west, south_west = own - ONE, south - ONE
    fx = (s[EAST_X + own] - s[EAST_X + west]) + (
        (s[NORTH_X + own] + (s[NE_X + own] + s[NW_X + west]))
        - (s[NORTH_X + south] + (s[NW_X + south] + s[NE_X + south_west]))
    )
    fy = (s[EAST_Y + own] - s[EAST_Y + west]) + (
        (s[NORTH_Y + own] + (s[NE_Y + own] + s[NW_Y + west]))
        - (s[NORTH_Y + south] + (s[NW_Y + south] + s[NE_Y + south_west]))
    )
    return fx, fy
