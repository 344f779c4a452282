"""Leapfrog (kick-drift) with the exact Coulomb step: one force evaluation per step.

Displacements live at t_k = k h, velocities at t_k + h/2. Damping is integrated exactly,
a = exp(-gamma h); without friction the scheme is of second order in h and symplectic for
gamma = 0. Releases and stops fall on step boundaries, which makes it first order across them.
"""

import math

import numpy as np
from numba import njit

from springblock.solver.compilation import JIT
from springblock.solver.friction import coulomb
from springblock.solver.lattice import Array, Constants, Samples, State, row_sums
from springblock.solver.springs import (
    BANK,
    FIRST_BANK,
    HEAT,
    ONE,
    clear_bank,
    spring_force,
    spring_row,
)

FORCE_EVALUATIONS = 1
WORK_FIELDS = 0


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
def _move_row(blocks, peak, s, north, south, i, n, a, k_s, sx, sy, now):
    """Kick and drift one row; returns how many blocks went from rest to sliding."""
    ux, uy, wx, wy, static, dynamic, t_det = blocks
    switches = np.int64(0)
    for x in range(ONE, n + ONE):
        b = i + x
        fx, fy = spring_force(s, x, north, south)
        fx += k_s * (sx - ux[b])
        fy += k_s * (sy - uy[b])
        vx, vy = wx[b], wy[b]
        trial_x, trial_y = a * vx + fx, a * vy + fy
        left = coulomb(trial_x, trial_y, vx, vy, fx, fy, static[b], dynamic[b])
        new_x, new_y = left * trial_x, left * trial_y
        wx[b] = new_x
        wy[b] = new_y
        ux[b] += new_x
        uy[b] += new_y
        # Friction's work: the momentum that it takes, times the mean of the velocities around.
        taken = 0.5 * (1.0 - left)
        s[HEAT + x] = taken * (trial_x * (vx + new_x) + trial_y * (vy + new_y))
        slides = (left > 0.0) & (static[b] > 0.0)
        was_at_rest = (vx == 0.0) & (vy == 0.0)
        switches += np.int64(slides & was_at_rest)
        if peak is not None:
            peak[b] = max(peak[b], fx * fx + fy * fy)
    if switches > 0:
        _note_detachments(wx, wy, static, t_det, i, n, now)
    return switches


@njit(**JIT)
def _note_detachments(wx, wy, static, t_det, i, n, now):
    """Note the time for blocks of one row that slide and have not done so before."""
    for x in range(ONE, n + ONE):
        b = i + x
        slides = ((wx[b] != 0.0) | (wy[b] != 0.0)) & (static[b] > 0.0)
        first = t_det[b]
        t_det[b] = now if slides & (first > now) else first


@njit(**JIT)
def _move_free_row(ux, uy, wx, wy, s, north, south, i, n, a, k_s, sx, sy):
    """As `_move_row` for a row without contact, to the bit."""
    for x in range(ONE, n + ONE):
        b = i + x
        fx, fy = spring_force(s, x, north, south)
        fx += k_s * (sx - ux[b])
        fy += k_s * (sy - uy[b])
        new_x, new_y = a * wx[b] + fx, a * wy[b] + fy
        wx[b] = new_x
        wy[b] = new_y
        ux[b] += new_x
        uy[b] += new_y
        s[HEAT + x] = 0.0


@njit(**JIT)
def advance(state, constants, first, steps, every, samples):
    """Take `steps` steps from step `first`; returns (steps taken, row, column).

    The row is -1 if all went well, else that of the spring which no longer holds.
    """
    ux, uy, wx, wy, t_det, static, dynamic, s, _, ledger, peak, in_contact = state
    n, pitch, kappa, axial, diagonal, k_s, damping, slider_x, slider_y = constants
    blocks = (ux, uy, wx, wy, static, dynamic, t_det)
    a = math.exp(-damping)
    north, south = FIRST_BANK, FIRST_BANK + BANK
    clear_bank(s, south, n)
    switches, sample = 0, 0
    for k in range(first, first + steps):
        sx, sy = slider_x * k, slider_y * k
        total_x, total_y, heat, squares = 0.0, 0.0, 0.0, 0.0
        for row in range(n):
            beyond = spring_row(ux, uy, row, pitch, n, s, north, kappa, axial, diagonal)
            if beyond > 0:
                return k - first, np.int64(row), np.int64(beyond) - 1
            i = row * pitch
            if in_contact[row]:
                switches += _move_row(blocks, peak, s, north, south, i, n, a, k_s, sx, sy, k)
            else:
                _move_free_row(ux, uy, wx, wy, s, north, south, i, n, a, k_s, sx, sy)
            ux[i + n + ONE] = ux[i + n]
            uy[i + n + ONE] = uy[i + n]
            row_x, row_y, row_heat, row_squares = row_sums(ux, uy, wx, wy, s, i, HEAT, n)
            total_x += row_x
            total_y += row_y
            heat += row_heat
            squares += row_squares
            north, south = south, north
        force_x = k_s * (n * n * slider_x * (k + 1) - total_x)
        force_y = k_s * (n * n * slider_y * (k + 1) - total_y)
        ledger[0] += force_x * slider_x + force_y * slider_y
        ledger[1] += heat
        ledger[2] += squares
        if (k + 1) % every == 0:
            samples.force_x[sample] = force_x
            samples.force_y[sample] = force_y
            samples.switches[sample] = switches
            switches, sample = 0, sample + 1
    return steps, np.int64(-1), np.int64(-1)
