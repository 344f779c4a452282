"""Fourth-order Runge-Kutta, the paper's method, in a form that converges.

Taken literally, with friction opposite to the velocity of each *stage*, the method does not
converge: the stage velocities of a slow block alternate in sign, and it creeps instead of coming
to rest. Here friction keeps through all four stages the direction that it has at the start of
the step: against the velocity of a moving block, against F_mot of one that has just let go. A
block whose velocity has turned back at the end of the step stops there; a block at rest stays
through all stages. A block that lets go does so at the first step after its threshold, and has
been sliding for half a step on average: it starts with the velocity of half a step, without which
all detachments would lag behind. Without friction the method is of fourth order; releases and
stops fall on step boundaries, which makes it first order across them.
"""

import math

import numpy as np
from numba import njit

from springblock.solver.compilation import JIT, add
from springblock.solver.lattice import Array, Constants, State, book, close_edge, keep_peaks
from springblock.solver.springs import FORCE_X, FORCE_Y, ONE, U, forces_on_band

FORCE_EVALUATIONS = 4
#: Lattice-sized fields in `State.work`: displacement and velocity of the stage, their weighted
#: sums over the stages, and the direction of friction, two components each.
WORK_FIELDS = 10

WEIGHTS = (1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0)
NODES = (0.0, 0.5, 0.5, 1.0)  #: of the stages
REACHES = (0.5, 0.5, 1.0, 0.0)  #: from the step's start to the next stage


def is_stable(step: float, omega: np.ndarray, gamma: float) -> bool:
    """Whether no mode of angular frequency `omega` grows: |R(λh)| ≤ 1 for λ² + γλ + ω² = 0."""
    root = np.sqrt(np.asarray(gamma * gamma / 4.0 - omega * omega, dtype=complex))
    z = step * np.concatenate([-gamma / 2.0 + root, -gamma / 2.0 - root])
    growth = np.abs(1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0))))
    return bool(np.all(growth <= 1.0 + 1e-12))


def force_time(step: float, gamma: float) -> float:
    """Time for which a force acts in one step, s: damping is a force of its own here."""
    return step


def at_step(state: State, constants: Constants, steps: int) -> tuple[Array, float]:
    """Velocity (2, lattice) after `steps` steps, in l per step, and friction's heat until then."""
    return np.stack([state.wx, state.wy]), float(state.ledger[1])


@njit(inline="always")
def _friction_direction(fx, fy, wx, wy, static, dynamic):
    """Unit vector that friction opposes in this step; zero for a block that stays at rest."""
    speed = math.sqrt(wx * wx + wy * wy)
    if speed > 0.0:
        return wx / speed, wy / speed
    force = math.sqrt(fx * fx + fy * fy)
    # With mu_s < mu_d the block needs more than mu_d F_n to move at all.
    if force > static and force > dynamic:
        return fx / force, fy / force
    return 0.0, 0.0


@njit(**JIT)
def _set_out(blocks, fields, size, s, start, stop, now):
    """Choose friction's direction in rows [start, stop), and let go; returns how many let go.

    The stage's velocity is that of the step's start; all sums over stages are zero.
    """
    _, _, wx, wy, t_det, static, dynamic = blocks
    _, _, pu, pv, du, dv, _, _, ex, ey = fields
    n, pitch = size
    switches = 0
    for row in range(start, stop):
        i, own = row * pitch, (row - start) * pitch
        for x in range(ONE, n + ONE):
            b = i + x
            if static[b] == 0.0:
                continue
            fx, fy = s[FORCE_X + own + x], s[FORCE_Y + own + x]
            ex[b], ey[b] = _friction_direction(fx, fy, wx[b], wy[b], static[b], dynamic[b])
            if wx[b] == 0.0 and wy[b] == 0.0 and (ex[b] != 0.0 or ey[b] != 0.0):
                switches += 1
                t_det[b] = min(t_det[b], now)
                # It has slid since the threshold was reached, half a step ago on average.
                excess = fx * ex[b] + fy * ey[b] - dynamic[b]
                wx[b], wy[b] = 0.5 * excess * ex[b], 0.5 * excess * ey[b]
                pu[b], pv[b] = wx[b], wy[b]
                du[b], dv[b] = 0.125 * excess * ex[b], 0.125 * excess * ey[b]
    return switches


@njit(**JIT)
def _stage(blocks, fields, weight, reach, size, s, start, stop, damping):
    """Take one stage on rows [start, stop); returns the squared speed."""
    ux, uy, wx, wy, _, _, dynamic = blocks
    su, sv, pu, pv, du, dv, qu, qv, ex, ey = fields
    n, pitch = size
    total = 0.0
    for row in range(start, stop):
        i, own = row * pitch, (row - start) * pitch
        squares = 0.0
        for x in range(ONE, n + ONE):
            b = i + x
            vx, vy = pu[b], pv[b]
            ax = s[FORCE_X + own + x] - damping * vx - dynamic[b] * ex[b]
            ay = s[FORCE_Y + own + x] - damping * vy - dynamic[b] * ey[b]
            rests = (ex[b] == 0.0) & (ey[b] == 0.0)
            ax, ay = 0.0 if rests else ax, 0.0 if rests else ay
            du[b] += weight * vx
            dv[b] += weight * vy
            qu[b] += weight * ax
            qv[b] += weight * ay
            squares = add(squares, vx * vx + vy * vy)
            su[b] = ux[b] + reach * vx
            sv[b] = uy[b] + reach * vy
            pu[b] = wx[b] + reach * ax
            pv[b] = wy[b] + reach * ay
        total += squares
        close_edge(su, sv, i, n)
    return weight * total


@njit(**JIT)
def _finish(blocks, fields, size):
    """Complete the step and clear the sums over stages.

    Returns the sums of displacement and of friction's heat, row by row lest rounding adds up.
    """
    ux, uy, wx, wy, _, static, dynamic = blocks
    su, sv, pu, pv, du, dv, qu, qv, ex, ey = fields
    n, pitch = size
    total_x, total_y, total_heat = 0.0, 0.0, 0.0
    for row in range(n):
        i = row * pitch
        sum_x, sum_y, heat = 0.0, 0.0, 0.0
        for x in range(ONE, n + ONE):
            b = i + x
            new_x, new_y = wx[b] + qu[b], wy[b] + qv[b]
            turned = (static[b] > 0.0) & (new_x * ex[b] + new_y * ey[b] <= 0.0)
            lost = 0.5 * (new_x * new_x + new_y * new_y)  # what it still had when it turned back
            work = dynamic[b] * (du[b] * ex[b] + dv[b] * ey[b])
            heat = add(heat, work + (lost if turned else 0.0))
            new_x, new_y = 0.0 if turned else new_x, 0.0 if turned else new_y
            there_x, there_y = ux[b] + du[b], uy[b] + dv[b]
            sum_x, sum_y = add(sum_x, there_x), add(sum_y, there_y)
            ux[b], uy[b], su[b], sv[b] = there_x, there_y, there_x, there_y
            wx[b], wy[b], pu[b], pv[b] = new_x, new_y, new_x, new_y
            du[b], dv[b], qu[b], qv[b] = 0.0, 0.0, 0.0, 0.0
        total_x, total_y, total_heat = total_x + sum_x, total_y + sum_y, total_heat + heat
        close_edge(ux, uy, i, n)
        close_edge(su, sv, i, n)
    return total_x, total_y, total_heat


@njit(**JIT)
def advance(state, constants, first, steps, every, samples):
    """Take `steps` steps from step `first`; returns (steps taken, row, column).

    The row is -1 if all went well, else that of the spring which no longer holds.
    """
    ux, uy, wx, wy, t_det, static, dynamic, s, w, ledger, peak, _ = state
    n, pitch, band, kappa, series, k_s, damping, slider_x, slider_y = constants
    blocks = (ux, uy, wx, wy, t_det, static, dynamic)
    fields = (w[0], w[1], w[2], w[3], w[4], w[5], w[6], w[7], w[8], w[9])
    su, sv, pu, pv, _, _, _, _, ex, ey = fields
    su[:], sv[:], pu[:], pv[:], ex[:], ey[:] = ux, uy, wx, wy, 1.0, 0.0
    size, every_row = (n, pitch), np.ones(n + ONE, np.bool_)
    switches, sample = 0, 0
    for k in range(first, first + steps):
        squares = 0.0
        for stage in range(4):
            sx, sy = slider_x * (k + NODES[stage]), slider_y * (k + NODES[stage])
            weight, reach = WEIGHTS[stage], REACHES[stage]
            for start in range(U(0), n, band):
                stop = min(start + band, n)
                row, column = forces_on_band(
                    su, sv, start, stop, every_row, size, s, kappa, series, k_s, sx, sy
                )
                if column > 0:
                    return k - first, np.int64(row), np.int64(column) - 1
                if stage == 0:
                    keep_peaks(peak, size, s, start, stop)
                    switches += _set_out(blocks, fields, size, s, start, stop, k)
                squares += _stage(blocks, fields, weight, reach, size, s, start, stop, damping)
        total_x, total_y, heat = _finish(blocks, fields, size)
        force = book(ledger, constants, k, (total_x, total_y, heat, squares))
        if (k + 1) % every == 0:
            samples.force_x[sample], samples.force_y[sample] = force
            samples.switches[sample] = switches
            switches, sample = 0, sample + 1
    return steps, np.int64(-1), np.int64(-1)
