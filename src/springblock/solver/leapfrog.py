"""Leapfrog (kick-drift) with the exact Coulomb step: one force evaluation per step.

Displacements live at t_k = k h, velocities at t_k + h/2. Damping is integrated exactly,
a = exp(-gamma h); without friction the scheme is of second order in h and symplectic for
gamma = 0. Releases and stops fall on step boundaries, which makes it first order across them.
"""

import math

import numpy as np
from numba import njit

from springblock.solver.compilation import JIT, add
from springblock.solver.friction import coulomb
from springblock.solver.lattice import (
    Array,
    Constants,
    Samples,
    State,
    book,
    close_edge,
    keep_peaks,
)
from springblock.solver.springs import FORCE_X, FORCE_Y, ONE, U, forces_on_band

FORCE_EVALUATIONS = 1
WORK_FIELDS = 0

#: How much earlier than computed a row is woken, against rounding.
_SLACK = 1e-9
#: Steps, more than any run has.
_FOREVER = 1e15


def is_stable(step: float, omega: np.ndarray, gamma: float) -> bool:
    """Whether no mode of angular frequency `omega` grows.

    With u for the displacement, u⁺ - (1 + a - c) u + a u⁻ = 0 with c = ω² h (1 - a)/γ: both
    roots lie within the unit circle while c < 2 (1 + a); h < 2/ω without damping.
    """
    c = np.asarray(omega) ** 2 * step * force_time(step, gamma)
    return bool(np.all(c < 2.0 * (1.0 + math.exp(-gamma * step))))


def force_time(step: float, gamma: float) -> float:
    """Time for which a force acts in one step, s: (1 - exp(-γh))/γ, h without damping."""
    return -math.expm1(-gamma * step) / gamma if gamma > 0.0 else step


def at_step(state: State, constants: Constants, steps: int) -> tuple[Array, float]:
    """Velocity (2, lattice) after `steps` steps, in l per step, and friction's heat until then.

    Means of the half steps before and after; the one after is taken on a copy.
    """
    ahead = state.copy()
    advance(ahead, constants, steps, 1, 1, Samples.empty(1))
    velocity = np.stack([state.wx + ahead.wx, state.wy + ahead.wy]) / 2.0
    return velocity, float(state.ledger[1] + ahead.ledger[1]) / 2.0


@njit(**JIT)
def _move_rows_in_contact(blocks, rows, size, s, a, start, stop):
    """Kick and drift those rows of [start, stop) that are awake and hold blocks in contact."""
    ux, uy, wx, wy, static, dynamic, _ = blocks
    n, pitch = size
    in_contact, awake, _, sliding, switching, _, sums = rows
    for row in range(start, stop):
        if not (in_contact[row] and awake[row]):
            continue
        i, own = row * pitch, (row - start) * pitch
        slide, switch = np.int64(0), np.int64(0)
        sum_x, sum_y, heat, squares = 0.0, 0.0, 0.0, 0.0
        for x in range(ONE, n + ONE):
            b = i + x
            fx, fy = s[FORCE_X + own + x], s[FORCE_Y + own + x]
            vx, vy = wx[b], wy[b]
            trial_x, trial_y = a * vx + fx, a * vy + fy
            left, slides, along, speed2 = coulomb(
                trial_x, trial_y, vx, vy, fx, fy, static[b], dynamic[b]
            )
            new_x, new_y = left * trial_x, left * trial_y
            there_x, there_y = ux[b] + new_x, uy[b] + new_y
            wx[b] = new_x
            wy[b] = new_y
            ux[b] = there_x
            uy[b] = there_y
            slide += np.int64(slides)
            switch += np.int64(slides & (along <= 0.0) & (static[b] > 0.0))
            sum_x = add(sum_x, there_x)
            sum_y = add(sum_y, there_y)
            # Friction's work: the momentum that it takes, times the mean of the velocities around.
            kept = left * speed2
            heat = add(heat, (1.0 - left) * (along + kept))
            squares = add(squares, left * kept)
        sliding[row + ONE], switching[row] = slide, switch
        sums[0, row], sums[1, row], sums[2, row], sums[3, row] = sum_x, sum_y, 0.5 * heat, squares


@njit(**JIT)
def _move_free_rows(blocks, rows, size, s, a, start, stop):
    """As `_move_rows_in_contact` for the other rows, which are always awake.

    To the bit, but for the order of the sums.
    """
    ux, uy, wx, wy = blocks[:4]
    n, pitch = size
    in_contact, sums = rows[0], rows[6]
    for row in range(start, stop):
        if in_contact[row]:
            continue
        i, own = row * pitch, (row - start) * pitch
        sum_x, sum_y, squares = 0.0, 0.0, 0.0
        for x in range(ONE, n + ONE):
            b = i + x
            fx, fy = s[FORCE_X + own + x], s[FORCE_Y + own + x]
            new_x, new_y = a * wx[b] + fx, a * wy[b] + fy
            there_x, there_y = ux[b] + new_x, uy[b] + new_y
            wx[b] = new_x
            wy[b] = new_y
            ux[b] = there_x
            uy[b] = there_y
            sum_x = add(sum_x, there_x)
            sum_y = add(sum_y, there_y)
            squares = add(squares, new_x * new_x + new_y * new_y)
        sums[0, row], sums[1, row], sums[3, row] = sum_x, sum_y, squares


@njit(**JIT)
def _note_detachments(blocks, i, n, now):
    """Note the time for blocks of one row that slide for the first time; are others yet to?"""
    _, _, wx, wy, static, _, t_det = blocks
    remaining = np.int64(0)
    for x in range(ONE, n + ONE):
        b = i + x
        slides = ((wx[b] != 0.0) | (wy[b] != 0.0)) & (static[b] > 0.0)
        first = t_det[b]
        t_det[b] = now if slides & (first > now) else first
        remaining += np.int64((static[b] > 0.0) & (t_det[b] > now))
    return remaining > 0


@njit(**JIT)
def _steps_at_rest(static, s, own, i, n, pull):
    """Steps for which a row at rest among rows at rest is sure to stay there.

    As long as nothing moves, only the slider changes F_mot of a block, by `pull` per step.
    """
    least = np.inf
    for x in range(ONE, n + ONE):
        fx, fy = s[FORCE_X + own + x], s[FORCE_Y + own + x]
        least = min(least, static[i + x] - math.sqrt(fx * fx + fy * fy))
    return np.int64(min((1.0 - _SLACK) * least / pull, _FOREVER))


@njit(**JIT)
def _settle(blocks, rows, size, s, pull, start, stop, now):
    """See to what rows of [start, stop) have done; return their switches from rest to sliding."""
    n, pitch = size
    in_contact, awake, wake, sliding, switching, waiting, _ = rows
    switches = np.int64(0)
    for row in range(start, stop):
        i = row * pitch
        if in_contact[row] and awake[row]:
            switches += switching[row]
            if switching[row] > 0 and waiting[row]:
                waiting[row] = _note_detachments(blocks, i, n, now)
            elif sliding[row + ONE] == 0 and wake[row] <= now:
                own = (row - start) * pitch
                wake[row] = now + _steps_at_rest(blocks[4], s, own, i, n, pull)
        close_edge(blocks[0], blocks[1], i, n)
    return switches


@njit(**JIT)
def _wake_rows(rows, now):
    """Choose the rows that move, lie beside one that does, or may let go in step `now`."""
    _, awake, wake, sliding, _, _, _ = rows
    for row in range(len(wake)):
        disturbed = sliding[row] + sliding[row + 1] + sliding[row + 2] > 0
        if disturbed:
            wake[row] = now + 1  # and look again when all is at rest
        awake[row] = disturbed or wake[row] <= now


@njit(**JIT)
def _row_books(in_contact, n):
    """What is kept of each row, see `advance`: as if every one of them moved."""
    awake, wake = np.ones(n + 1, np.bool_), np.zeros(n, np.int64)
    awake[n] = False
    sliding = np.ones(n + 2, np.int64)
    sliding[0] = sliding[n + 1] = 0
    switching, waiting = np.zeros(n, np.int64), np.ones(n, np.bool_)
    return in_contact, awake, wake, sliding, switching, waiting, np.zeros((4, n))


@njit(**JIT)
def _totals(sums):
    """Sum over rows, in their order."""
    x, y, heat, squares = 0.0, 0.0, 0.0, 0.0
    for row in range(sums.shape[1]):
        x += sums[0, row]
        y += sums[1, row]
        heat += sums[2, row]
        squares += sums[3, row]
    return x, y, heat, squares


@njit(**JIT)
def advance(state, constants, first, steps, every, samples):
    """Take `steps` steps from step `first`; returns (steps taken, row, column).

    The row is -1 if all went well, else that of the spring which no longer holds.

    A row at rest among rows at rest is left alone until one of its blocks may let go, which
    changes no bit. The books of all rows: whether they hold contact, whether they are awake and
    when to wake them, how many blocks slide (with a row beyond each edge), how many of them come
    from rest and whether any has yet to detach, and the sums of displacement, friction's heat and
    squared velocity.
    """
    ux, uy, wx, wy, t_det, static, dynamic, s, _, ledger, peak, in_contact = state
    n, pitch, band, kappa, series, k_s, damping, slider_x, slider_y = constants
    blocks, size = (ux, uy, wx, wy, static, dynamic, t_det), (n, pitch)
    a, pull = math.exp(-damping), k_s * math.hypot(slider_x, slider_y)
    rows = _row_books(in_contact, np.int64(n))
    awake, sums = rows[1], rows[6]
    switches, sample = 0, 0
    for k in range(first, first + steps):
        sx, sy = slider_x * k, slider_y * k
        if peak is None:  # a prelude looks at every block in every step
            _wake_rows(rows, k)
        for start in range(U(0), n, band):
            stop = min(start + band, n)
            row, column = forces_on_band(
                ux, uy, start, stop, awake, size, s, kappa, series, k_s, sx, sy
            )
            if column > 0:
                return k - first, np.int64(row), np.int64(column) - 1
            keep_peaks(peak, size, s, start, stop)
            _move_rows_in_contact(blocks, rows, size, s, a, start, stop)
            _move_free_rows(blocks, rows, size, s, a, start, stop)
            switches += _settle(blocks, rows, size, s, pull, start, stop, k)
        force = book(ledger, constants, k, _totals(sums))
        if (k + 1) % every == 0:
            samples.force_x[sample], samples.force_y[sample] = force
            samples.switches[sample] = switches
            switches, sample = 0, sample + 1
    return steps, np.int64(-1), np.int64(-1)
