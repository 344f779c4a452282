"""Leapfrog (kick-drift) with the exact Coulomb step: one force evaluation per step.

Displacements are known at t_k = k h, velocities at t_k + h/2. With f for the velocity that F_mot
adds in one step, and T for that which friction removes, in l per step, a step is (7) of
docs/model.md,

    w = a v + f,    v⁺ = w - T (v + w)/|v + w|,    u⁺ = u + v⁺,    a = exp(-γh).

Damping is exact; without friction and damping the scheme is symplectic. It is of second order in h,
also across releases, which are placed within their steps (`release`), and across stops: the error
of the displacement of a block that stops within a step is at most (T + |f|)/8.
"""

import math
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from springblock.model.numbers import Array
from springblock.solver.compilation import add, kernel
from springblock.solver.friction import apply_friction
from springblock.solver.lattice import (
    Constants,
    Lattice,
    Totals,
    band_from,
    close_edge,
    close_rows,
    index_of,
    slider_at,
    unpadded,
    update_peaks,
)
from springblock.solver.laws import (
    MARGIN,
    resistance,
    state_at_release,
    state_before,
    state_now,
    store_state,
    strength_of,
    surely_holds,
    threshold_of,
)
from springblock.solver.release import Releases, force_in_patch, make_releases, release_theta
from springblock.solver.springs import FORCE_X, FORCE_Y, ONE, TURNS, Scratch, U, forces_on_band

#: Effectively infinite number of steps.
_FOREVER = 1e15


class Rows(NamedTuple):
    """State of each row of blocks."""

    in_contact: NDArray[np.bool_]  #: (N_y,) whether any block is in contact
    all_in_contact: NDArray[np.bool_]  #: (N_y,) whether all blocks are
    held: NDArray[np.bool_]  #: (N_y,) whether no block in contact moved in the last step
    awake: NDArray[np.bool_]  #: (N_y + 1,) whether its blocks are computed in this step
    due: NDArray[np.int64]  #: (N_y,) step in which it must be computed at the latest
    sliding: NDArray[np.bool_]  #: (N_y + 2,) whether any block moves, with a row beyond each edge
    x: Array  #: (N_y,) sums over its blocks, see `Totals`
    y: Array
    heat: Array
    squares: Array


def make_rows(contact: NDArray[np.bool_], periodic: bool) -> Rows:
    """Return the state of the rows of `contact`, (N_y, N_x), all computed in the first step."""
    n = len(contact)
    awake, sliding = np.ones(n + 1, np.bool_), np.ones(n + 2, np.bool_)
    awake[n] = periodic
    sliding[0] = sliding[n + 1] = False
    return Rows(
        in_contact=np.asarray(contact.any(axis=1)),
        all_in_contact=np.asarray(contact.all(axis=1)),
        held=np.zeros(n, np.bool_),
        awake=awake,
        due=np.zeros(n, np.int64),
        sliding=sliding,
        x=np.zeros(n),
        y=np.zeros(n),
        heat=np.zeros(n),
        squares=np.zeros(n),
    )


@njit(inline="always")
def _without_phantoms(ux, uy, i, grid, sum_x, sum_y):
    """Subtract the displacements of phantoms (see `lattice`) from the sums over a row."""
    if grid.periodic is not None:
        for x in range(grid.n_x + ONE, grid.width + ONE):
            sum_x, sum_y = sum_x - ux[i + x], sum_y - uy[i + x]
        return sum_x, sum_y
    phantoms, x = float(grid.width - grid.n_x), i + grid.n_x + ONE
    return sum_x - phantoms * ux[x], sum_y - phantoms * uy[x]


@kernel
def _list_releases(blocks, released, count, band, s, row):
    """List the blocks of a row that were at rest until this step; return the number listed so far.

    They have the velocity that F_mot and friction give a block at rest in one step.
    """
    for x in range(ONE, band.grid.n_x + ONE):
        b = row * band.grid.pitch + x
        slides = (blocks.vx[b] != 0.0 or blocks.vy[b] != 0.0) and blocks.static[b] > 0.0
        if slides and s.row[TURNS + x] == 0.0:
            released.row[count], released.x[count] = np.int64(row), np.int64(x)
            released.ax[count], released.ay[count] = blocks.vx[b], blocks.vy[b]
            count += 1
    return count


@kernel
def _record_switches(blocks, released, count, band, s, row, now):
    """Record switches to sliding and first detachments in a row; list blocks released from rest.

    Scratch holds w·v of each block: negative if it has reversed, zero if it was at rest. Returns
    the switches, and the number of blocks released so far.
    """
    switches, from_rest = np.int64(0), False
    i, t_det = row * band.grid.pitch, blocks.t_det
    for x in range(ONE, band.grid.n_x + ONE):
        b = i + x
        slides = ((blocks.vx[b] != 0.0) | (blocks.vy[b] != 0.0)) & (blocks.static[b] > 0.0)
        switched = slides & (s.row[TURNS + x] <= 0.0)
        switches += np.int64(switched)
        t_det[b] = now if switched & (t_det[b] > now) else t_det[b]
        from_rest = from_rest | (slides & (s.row[TURNS + x] == 0.0))
    if from_rest:
        count = _list_releases(blocks, released, count, band, s, row)
    return switches, count


@njit(inline="always")
def _holds(blocks, law, s, own, i, n):
    """Return whether static friction holds all blocks in contact of a row at rest."""
    holds = True
    for x in range(ONE, n + ONE):
        b, fx, fy = i + x, s.force[FORCE_X + own + x], s.force[FORCE_Y + own + x]
        is_held = surely_holds(law, state_now(law, b), fx, fy, blocks.static[b], blocks.dynamic[b])
        holds = holds & (is_held | (blocks.static[b] == 0.0))
    return holds


@kernel
def _move_held_rows(blocks, law, rows, band, s, a):
    """Kick and drift the free blocks of those rows whose blocks in contact stay at rest.

    Blocks move as in `_move_rows_in_contact`, to the bit. Clears `held` of all other rows.
    """
    ux, uy, vx, vy = blocks.ux, blocks.uy, blocks.vx, blocks.vy
    for row in range(band.start, band.stop):
        i, own = row * band.grid.pitch, (row - band.start) * band.grid.pitch
        if not (rows.held[row] and rows.awake[row]):
            continue
        if not _holds(blocks, law, s, own, i, band.grid.n_x):
            rows.held[row] = False
            continue
        sum_x, sum_y, squares = 0.0, 0.0, 0.0
        for x in range(ONE, band.grid.width + ONE):
            b = i + x
            fx, fy = s.force[FORCE_X + own + x], s.force[FORCE_Y + own + x]
            old_x, old_y, from_x, from_y = vx[b], vy[b], ux[b], uy[b]
            is_free = blocks.static[b] + blocks.dynamic[b] == 0.0  # neither bound nor a phantom
            new_x, new_y = a * old_x + fx, a * old_y + fy
            new_x, new_y = new_x if is_free else 0.0, new_y if is_free else 0.0
            next_x, next_y = from_x + new_x, from_y + new_y
            vx[b] = new_x
            vy[b] = new_y
            ux[b] = next_x
            uy[b] = next_y
            sum_x = add(sum_x, next_x)
            sum_y = add(sum_y, next_y)
            squares = add(squares, new_x * new_x + new_y * new_y)
        rows.x[row], rows.y[row] = _without_phantoms(ux, uy, i, band.grid, sum_x, sum_y)
        rows.heat[row], rows.squares[row] = 0.0, squares


@kernel
def _move_rows_in_contact(blocks, law, rows, released, count, band, s, a, now):
    """Kick and drift the blocks of those rows of a band that are awake, hold contacts and are not
    held; record switches and first detachments, and list releases.

    Returns what `move_band` returns.
    """
    ux, uy, vx, vy = blocks.ux, blocks.uy, blocks.vx, blocks.vy
    static, dynamic, switches = blocks.static, blocks.dynamic, np.int64(0)
    for row in range(band.start, band.stop):
        if not (rows.in_contact[row] and rows.awake[row]) or rows.held[row]:
            continue
        i, own = row * band.grid.pitch, (row - band.start) * band.grid.pitch
        slide, switch = False, False
        sum_x, sum_y, heat, squares = 0.0, 0.0, 0.0, 0.0
        for x in range(ONE, band.grid.width + ONE):
            b = i + x
            fx, fy = s.force[FORCE_X + own + x], s.force[FORCE_Y + own + x]
            old_x, old_y = vx[b], vy[b]
            trial_x, trial_y = a * old_x + fx, a * old_y + fy
            new_x, new_y, slides, w_dot_v = apply_friction(
                law, b, trial_x, trial_y, old_x, old_y, fx, fy, static[b], dynamic[b]
            )
            next_x, next_y = ux[b] + new_x, uy[b] + new_y
            vx[b] = new_x
            vy[b] = new_y
            ux[b] = next_x
            uy[b] = next_y
            s.row[TURNS + x] = w_dot_v
            moves = slides & (static[b] > 0.0)
            slide = slide | moves
            switch = switch | (moves & (w_dot_v <= 0.0))
            sum_x = add(sum_x, next_x)
            sum_y = add(sum_y, next_y)
            # Friction work: the impulse of friction times the mean velocity of the step.
            impulse_x, impulse_y = trial_x - new_x, trial_y - new_y
            heat = add(heat, impulse_x * (old_x + new_x) + impulse_y * (old_y + new_y))
            squares = add(squares, new_x * new_x + new_y * new_y)
        rows.sliding[row + ONE] = slide or not rows.all_in_contact[row]
        rows.held[row] = not slide
        rows.x[row], rows.y[row] = _without_phantoms(ux, uy, i, band.grid, sum_x, sum_y)
        rows.heat[row], rows.squares[row] = 0.5 * heat, squares
        if switch:
            more, count = _record_switches(blocks, released, count, band, s, row, now)
            switches += more
    return switches, count


@kernel
def _move_free_rows(blocks, rows, band, s, a):
    """Kick and drift the rows without contact, which are computed in every step.

    Blocks move as in `_move_rows_in_contact`, to the bit; sums may be taken in another order.
    """
    ux, uy, vx, vy = blocks.ux, blocks.uy, blocks.vx, blocks.vy
    for row in range(band.start, band.stop):
        if rows.in_contact[row]:
            continue
        i, own = row * band.grid.pitch, (row - band.start) * band.grid.pitch
        sum_x, sum_y, squares = 0.0, 0.0, 0.0
        for x in range(ONE, band.grid.width + ONE):
            b = i + x
            fx, fy = s.force[FORCE_X + own + x], s.force[FORCE_Y + own + x]
            new_x, new_y = a * vx[b] + fx, a * vy[b] + fy
            new_x, new_y = (new_x, new_y) if x <= band.grid.n_x else (0.0, 0.0)
            next_x, next_y = ux[b] + new_x, uy[b] + new_y
            vx[b] = new_x
            vy[b] = new_y
            ux[b] = next_x
            uy[b] = next_y
            sum_x = add(sum_x, next_x)
            sum_y = add(sum_y, next_y)
            squares = add(squares, new_x * new_x + new_y * new_y)
        rows.x[row], rows.y[row] = _without_phantoms(ux, uy, i, band.grid, sum_x, sum_y)
        rows.squares[row] = squares


@kernel
def _reconstruct_displacements(blocks, law, released, row, x, constants, slider):
    """Reconstruct the displacements around a block at steps k and k - 1.

    Blocks have already moved to step k + 1. The velocity before step k follows from (7), solved
    for v, with the direction of friction known from v⁺.
    """
    now, before = released.now, released.before
    grid, a = constants.grid, math.exp(-constants.damping)
    for j in range(5):
        for i in range(5):
            b = index_of(row + j - 2, x + i - 2, grid)
            now[0, j, i] = blocks.ux[b] - blocks.vx[b] if b >= 0 else np.nan
            now[1, j, i] = blocks.uy[b] - blocks.vy[b] if b >= 0 else np.nan
    for j in range(3):
        for i in range(3):
            b = index_of(row + j - 1, x + i - 1, grid)
            before[0, j, i], before[1, j, i] = now[0, j + 1, i + 1], now[1, j + 1, i + 1]
            if b < 0 or (blocks.vx[b] == 0.0 and blocks.vy[b] == 0.0):
                continue
            fx, fy = force_in_patch(now, j + 1, i + 1, constants.springs, slider)
            vx, vy = blocks.vx[b], blocks.vy[b]
            # Friction acted along v + w ∥ (1 + a) v⁺ - f, on the side of v⁺.
            mean_x, mean_y = (1.0 + a) * vx - fx, (1.0 + a) * vy - fy
            size, forwards = math.hypot(mean_x, mean_y), mean_x * vx + mean_y * vy
            kept, slope = state_before(law, b), 1.0 / (2.0 * a)
            speed = math.copysign(size, forwards) / (2.0 * a)
            friction = resistance(law, kept, speed, slope, blocks.static[b], blocks.dynamic[b])
            scale = math.copysign(friction / size, forwards)
            before[0, j, i] -= (vx + scale * mean_x - fx) / a
            before[1, j, i] -= (vy + scale * mean_y - fy) / a


@kernel
def place_releases(blocks, law, rows, released, count, constants, k):
    """Place the releases of `count` blocks at their times within the step, not at its end.

    The loop moved each by a = (ax, ay) since step k. By (10) to (12) of docs/speed.md it slips by s
    until step k and then moves at (1/2 + θ_ε) a. Heat grows by Q and the additional friction work.
    """
    springs, slide = constants.springs, (constants.slider_x, constants.slider_y)
    slider, stiffness = (slide[0] * k, slide[1] * k), springs.k_s + 3.0 * springs.kappa
    epsilon = (springs.k_s + 6.0 * springs.kappa) / 4.0
    for m in range(count):
        row, x = released.row[m], released.x[m]
        b = index_of(row, x, constants.grid)
        _reconstruct_displacements(blocks, law, released, row, x, constants, slider)
        kept = state_at_release(law, b)
        threshold = threshold_of(law, kept, blocks.static[b], blocks.dynamic[b])
        released.theta[m] = release_theta(released, threshold, springs, slider, slide)
    for m in range(count):
        row, theta = released.row[m], released.theta[m]
        b = index_of(row, released.x[m], constants.grid)
        if np.isnan(theta):
            continue
        ax, ay = released.ax[m], released.ay[m]
        if blocks.t_det[b] == k:
            blocks.t_det[b] = k - theta
        theta += epsilon * (0.5 - theta)  # θ_ε of (12)
        slip, speed = 0.5 * theta * theta - epsilon / 8.0, 0.5 + theta  # in units of a
        further = slip + speed - 1.0  # displacement beyond that of the loop
        blocks.ux[b] += further * ax
        blocks.uy[b] += further * ay
        blocks.vx[b], blocks.vy[b] = speed * ax, speed * ay
        rows.x[row] += further * ax
        rows.y[row] += further * ay
        a2 = ax * ax + ay * ay
        a1 = math.sqrt(a2)
        kept = state_at_release(law, b)
        friction = resistance(law, kept, 0.5 * a1, 0.0, blocks.static[b], blocks.dynamic[b])
        store_state(law, b, kept, (slip + speed) * a1, True)
        work = friction * a1 * (slip + 0.5 * (theta - 0.5))  # along s + (θ_ε - 1/2) a/2
        extra = a2 * (0.125 - epsilon / 8.0 - 0.5 * stiffness * slip * slip)  # Q of (12)
        rows.heat[row] += work + extra
        rows.squares[row] += (speed * speed - 1.0) * a2
        close_edge(blocks.ux, blocks.uy, U(row), constants.grid)


@kernel
def _steps_at_rest(blocks, law, s, own, i, n, pull):
    """Lower bound on the steps for which a row stays at rest if its neighbours do.

    As long as no block moves, only the slider changes F_mot of a block, by `pull` per step.
    """
    least = np.inf
    for x in range(ONE, n + ONE):
        b, fx, fy = i + x, s.force[FORCE_X + own + x], s.force[FORCE_Y + own + x]
        strength = strength_of(law, state_now(law, b), blocks.static[b], blocks.dynamic[b])
        least = min(least, strength - math.sqrt(fx * fx + fy * fy))
    return np.int64(min((1.0 - MARGIN) * least / pull, _FOREVER))


@kernel
def _settle_rows(blocks, law, rows, band, s, pull, now):
    """Estimate for how long rows at rest stay so, and close the edges of all rows of a band."""
    for row in range(band.start, band.stop):
        i, own = row * band.grid.pitch, (row - band.start) * band.grid.pitch
        computed = rows.in_contact[row] and rows.awake[row]
        if computed and not rows.sliding[row + ONE] and rows.due[row] <= now:
            steps = _steps_at_rest(blocks, law, s, own, i, band.grid.n_x, pull)
            rows.due[row] = now + steps
        close_edge(blocks.ux, blocks.uy, row, band.grid)


@kernel
def move_band(blocks, law, peak, rows, released, count, band, s, constants, now):
    """Advance the blocks of a band by one step, under the forces in scratch `s`.

    Returns the switches to sliding, from rest or by turning back, and the number of blocks released
    so far.
    """
    a = math.exp(-constants.damping)
    pull = constants.springs.k_s * math.hypot(constants.slider_x, constants.slider_y)
    update_peaks(peak, band, s)
    _move_held_rows(blocks, law, rows, band, s, a)
    switches, count = _move_rows_in_contact(blocks, law, rows, released, count, band, s, a, now)
    _move_free_rows(blocks, rows, band, s, a)
    _settle_rows(blocks, law, rows, band, s, pull, now)
    return switches, count


@kernel
def wake(rows, now, periodic):
    """Mark the rows in which a block moves, may detach in step `now`, or has a moving neighbour.

    Only these are computed. Rows without contact count as moving throughout.
    """
    n = len(rows.x)
    if periodic:
        rows.sliding[0], rows.sliding[n + 1] = rows.sliding[n], rows.sliding[1]
    for row in range(n):
        disturbed = rows.sliding[row] or rows.sliding[row + 1] or rows.sliding[row + 2]
        if disturbed:
            rows.due[row] = now + 1  # estimated again when all are at rest
        rows.awake[row] = disturbed or rows.due[row] <= now
    if periodic:
        rows.awake[n] = rows.awake[0]


@kernel
def totals(rows):
    """Sum over rows, in ascending order."""
    x, y, heat, squares = 0.0, 0.0, 0.0, 0.0
    for row in range(len(rows.x)):
        x += rows.x[row]
        y += rows.y[row]
        heat += rows.heat[row]
        squares += rows.squares[row]
    return Totals(x, y, heat, squares)


class Work(NamedTuple):
    """Work arrays of the leapfrog."""

    rows: Rows
    scratch: Scratch
    released: Releases

    @classmethod
    def of(cls, state: Lattice, constants: Constants) -> "Work":
        """Return work arrays for the steps of one call."""
        contact = unpadded(state.blocks.static, constants.grid) > 0.0
        rows = make_rows(contact, constants.grid.periodic is not None)
        return cls(rows, Scratch.empty(), make_releases(contact.size))

    @staticmethod
    def take_step(work, state, constants, k):
        """Take step k, see `integrators`.

        A row at rest among rows at rest is skipped until one of its blocks may detach; the result
        is the same to the bit.
        """
        blocks, law, rows, s = state.blocks, state.law, work.rows, work.scratch
        grid, springs = constants.grid, constants.springs
        slider, switches, count = slider_at(constants, k), np.int64(0), np.int64(0)
        if state.peak is None:  # a prelude computes every block in every step
            wake(rows, k, grid.periodic is not None)
        close_rows(blocks.ux, blocks.uy, grid)
        for start in range(U(0), grid.n_y, constants.band_rows):
            band = band_from(start, constants)
            row, column = forces_on_band(blocks.ux, blocks.uy, band, rows.awake, s, springs, slider)
            if column > 0:
                return totals(rows), switches, row, column
            more, count = move_band(
                blocks, law, state.peak, rows, work.released, count, band, s, constants, k
            )
            switches += more
        if count > 0:
            place_releases(blocks, law, rows, work.released, count, constants, k)
        return totals(rows), switches, U(0), U(0)
