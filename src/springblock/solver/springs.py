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

from springblock.solver.compilation import JIT

#: |q| up to which the polynomial stands for g; its relative error there is below 2e-15.
SERIES_RANGE = 1.0 / 16.0
SERIES_DEGREE = 9

#: A spring may shrink to half its rest length and grow to twice it: -3/4 < q < 3.
Q_MIN, Q_MAX = -0.75, 3.0

#: A lattice row may hold at most this many blocks: the rows of scratch lie this far apart.
#: A constant, so that the compiler can see that the rows do not overlap, and no power of two,
#: so that they do not compete for the same cache lines.
MAX_BLOCKS = 4096
PITCH = MAX_BLOCKS + 24

U = np.uint64  # signed indices would be checked for wrap-around, and not vectorised
ONE = U(1)
# Rows of scratch. East springs belong to one row; those to the next row are kept for it, in two
# banks that take turns.
EAST_X, EAST_Y, HEAT = U(0), U(PITCH), U(2 * PITCH)
NORTH_X, NORTH_Y, NE_X, NE_Y, NW_X, NW_Y = (U(k * PITCH) for k in range(6))
BANK = U(6 * PITCH)
FIRST_BANK = U(3 * PITCH)
SCRATCH_SIZE = 15 * PITCH


@register_jitable
def g(q):
    """Return g(q) = (1 - (1 + q)^(-1/2))/q without cancellation."""
    return 1.0 / ((1.0 + q) + np.sqrt(1.0 + q))


def series() -> np.ndarray:
    """Coefficients of g as a polynomial in q, lowest first (Chebyshev interpolation)."""
    in_unit_range = chebyshev.chebinterpolate(lambda x: g(SERIES_RANGE * x), SERIES_DEGREE)
    return chebyshev.cheb2poly(in_unit_range) / SERIES_RANGE ** np.arange(SERIES_DEGREE + 1)


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
    c0, c1, c2, c3, c4, c5, c6, c7, c8, c9 = c
    upper = c5 + p * (c6 + p * (c7 + p * (c8 + p * c9)))
    return p * (c0 + p * (c1 + p * (c2 + p * (c3 + p * (c4 + p * upper)))))


@njit(**JIT)
def _row_by_series(ux, uy, i, j, s, bank, axial, diagonal, n):
    """Forces of the springs from row `i` east and to row `j`; the number of cells out of range."""
    limit = (0.5 * SERIES_RANGE) ** 2
    outside = np.int64(0)
    for x in range(ONE, n + ONE):
        ax, ay = ux[i + x], uy[i + x]
        bx, by = ux[i + x + ONE], uy[i + x + ONE]
        cx, cy = ux[j + x], uy[j + x]

        dx, dy = bx - ax, by - ay  # east
        p = dx + 0.5 * (dx * dx + dy * dy)
        f = _pull(p, axial)
        s[EAST_X + x] = f + f * dx
        s[EAST_Y + x] = f * dy
        pp = p * p

        dx, dy = cx - ax, cy - ay  # north
        p = dy + 0.5 * (dx * dx + dy * dy)
        f = _pull(p, axial)
        s[bank + NORTH_X + x] = f * dx
        s[bank + NORTH_Y + x] = f + f * dy
        pp += p * p

        dx, dy = ux[j + x + ONE] - ax, uy[j + x + ONE] - ay  # north-east
        p = (dy + dx) + 0.5 * (dx * dx + dy * dy)
        f = _pull(p, diagonal)
        s[bank + NE_X + x] = f * dx + f
        s[bank + NE_Y + x] = f + f * dy
        pp += p * p

        dx, dy = cx - bx, cy - by  # north-west, from the next block
        p = (dy - dx) + 0.5 * (dx * dx + dy * dy)
        f = _pull(p, diagonal)
        s[bank + NW_X + x] = f * dx - f
        s[bank + NW_Y + x] = f + f * dy
        pp += p * p

        outside += np.int64(not pp <= limit)
    return outside


@njit(inline="always")
def _is_whole(q):
    return (q > Q_MIN) & (q < Q_MAX)  # False for NaN


@njit(**JIT)
def _row_by_closed_form(ux, uy, i, j, s, bank, kappa, n):
    """As `_row_by_series` at any strain; returns the first x with a spring beyond all, or 0."""
    for x in range(ONE, n + ONE):
        ax, ay = ux[i + x], uy[i + x]
        bx, by = ux[i + x + ONE], uy[i + x + ONE]
        cx, cy = ux[j + x], uy[j + x]

        dx, dy = bx - ax, by - ay
        q_e = 2.0 * dx + (dx * dx + dy * dy)
        f = kappa * q_e * g(q_e)
        s[EAST_X + x] = f + f * dx
        s[EAST_Y + x] = f * dy

        dx, dy = cx - ax, cy - ay
        q_n = 2.0 * dy + (dx * dx + dy * dy)
        f = kappa * q_n * g(q_n)
        s[bank + NORTH_X + x] = f * dx
        s[bank + NORTH_Y + x] = f + f * dy

        dx, dy = ux[j + x + ONE] - ax, uy[j + x + ONE] - ay
        q_ne = (dy + dx) + 0.5 * (dx * dx + dy * dy)
        f = 0.5 * kappa * q_ne * g(q_ne)
        s[bank + NE_X + x] = f * dx + f
        s[bank + NE_Y + x] = f + f * dy

        dx, dy = cx - bx, cy - by
        q_nw = (dy - dx) + 0.5 * (dx * dx + dy * dy)
        f = 0.5 * kappa * q_nw * g(q_nw)
        s[bank + NW_X + x] = f * dx - f
        s[bank + NW_Y + x] = f + f * dy

        if not (_is_whole(q_e) & _is_whole(q_n) & _is_whole(q_ne) & _is_whole(q_nw)):
            return x
    return U(0)


@njit(**JIT)
def clear_bank(s, bank, n):
    """Set the forces between two rows to zero: beyond the first and the last row there are none."""
    for field in range(6):
        for x in range(n + ONE):
            s[bank + U(field) * U(PITCH) + x] = 0.0


@njit(**JIT)
def spring_row(ux, uy, row, pitch, n, s, bank, kappa, axial, diagonal):
    """Put the forces of all springs from `row` east and north into scratch `s`.

    Returns the column (from 1) of a spring that has collapsed, burst or become NaN, else 0.
    """
    i = row * pitch
    last = row + ONE == n
    j = i if last else i + pitch  # the last row has no north: any finite strain will do
    beyond = U(0)
    if _row_by_series(ux, uy, i, j, s, bank, axial, diagonal, n) > 0:
        beyond = _row_by_closed_form(ux, uy, i, j, s, bank, kappa, n)
    s[EAST_X + n] = 0.0
    s[EAST_Y + n] = 0.0
    for field in (NE_X, NE_Y, NW_X, NW_Y):
        s[bank + field + n] = 0.0
    if last:
        clear_bank(s, bank, n)
    return beyond


@njit(inline="always")
def spring_force(s, x, north, south):
    """Sum the eight springs of the block in column x: the change of its velocity in one step.

    The order is the same seen from the north and from the south, so that a mirrored scene moves
    as a mirror image to the last bit.
    """
    w = x - ONE
    fx = (s[EAST_X + x] - s[EAST_X + w]) + (
        (s[north + NORTH_X + x] + (s[north + NE_X + x] + s[north + NW_X + w]))
        - (s[south + NORTH_X + x] + (s[south + NW_X + x] + s[south + NE_X + w]))
    )
    fy = (s[EAST_Y + x] - s[EAST_Y + w]) + (
        (s[north + NORTH_Y + x] + (s[north + NE_Y + x] + s[north + NW_Y + w]))
        - (s[south + NORTH_Y + x] + (s[south + NW_Y + x] + s[south + NE_Y + w]))
    )
    return fx, fy
