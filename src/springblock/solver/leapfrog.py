"""Leapfrog (kick-drift) with the exact Coulomb step: one force evaluation per step.

Displacements live at t_k = k h, velocities at t_k + h/2. Damping is integrated exactly,
a = exp(-gamma h); without friction the scheme is symplectic for gamma = 0. It is of second order in
h, also across releases, which are placed within their steps, and across stops: a block that stops
within a step is off by no more than an eighth of what friction takes from it in one step.
"""

import math
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from springblock.solver.compilation import add, kernel
from springblock.solver.friction import slow_down
from springblock.solver.lattice import (
    HEAT,
    Array,
    Constants,
    Samples,
    State,
    Totals,
    band_from,
    book,
    close_edge,
    close_rows,
    keep_peaks,
    place,
)
from springblock.solver.laws import (
    fresh,
    keep,
    resistance,
    state_before,
    state_of,
    strength,
)
from springblock.solver.release import force_in, placed, room, share_of_step
from springblock.solver.springs import FORCE_X, FORCE_Y, ONE, U, forces_on_band, one_row
from springblock.solver.stability import leapfrog_force_time

FORCE_EVALUATIONS = 1
WORK_FIELDS = 0

#: How much earlier than computed a row is woken, against rounding.
_SLACK = 1e-9
#: Share of F_mot by which a block's velocity may differ from what F_mot alone has left it.
_SAME = 1e-12
#: Effectively infinite number of steps.
_FOREVER = 1e15


force_time = leapfrog_force_time


def at_step(state: State, constants: Constants, steps: int) -> tuple[Array, float]:
    """Velocity (2, lattice) after `steps` steps, in l per step, and friction's heat until then.

    Means of the half steps before and after; the one after is taken on a copy.
    """
    ahead, blocks = state.copy(), state.blocks
    advance(ahead, constants, steps, 1, 1, Samples.empty(1))
    velocity = np.stack([blocks.wx + ahead.blocks.wx, blocks.wy + ahead.blocks.wy]) / 2.0
    return velocity, float(state.ledger[HEAT] + ahead.ledger[HEAT]) / 2.0


class Rows(NamedTuple):
    """State of each row of blocks."""

    in_contact: NDArray[np.bool_]  #: (N_y,) whether it holds any block in contact
    awake: NDArray[np.bool_]  #: (N_y + 1,) whether it is looked at in this step
    wake: NDArray[np.int64]  #: (N,) step at which to wake it at the latest
    sliding: NDArray[np.bool_]  #: (N_y + 2,) whether any block slides, with a row beyond each edge
    switching: NDArray[np.int64]  #: (N,) blocks that slide from rest, if for an instant
    released: NDArray[np.int64]  #: (N,) those among them that were at rest before this step
    waiting: NDArray[np.bool_]  #: (N,) whether any block has yet to detach
    x: Array  #: (N,) sums as of `Totals`
    y: Array
    heat: Array
    squares: Array


def make_rows(in_contact: NDArray[np.bool_], periodic: bool) -> Rows:
    """Return the state of rows of which every one is awake."""
    n = len(in_contact)
    awake, sliding = np.ones(n + 1, np.bool_), np.ones(n + 2, np.bool_)
    awake[n] = periodic
    sliding[0] = sliding[n + 1] = False
    return Rows(
        in_contact=in_contact,
        awake=awake,
        wake=np.zeros(n, np.int64),
        sliding=sliding,
        switching=np.zeros(n, np.int64),
        released=np.zeros(n, np.int64),
        waiting=np.ones(n, np.bool_),
        x=np.zeros(n),
        y=np.zeros(n),
        heat=np.zeros(n),
        squares=np.zeros(n),
    )


@njit(inline="always")
def _without_phantoms(ux, uy, i, grid, sum_x, sum_y):
    """Sums over a row less those over its phantoms, which have not moved."""
    if grid.periodic is not None:
        for x in range(grid.n_x + ONE, grid.width + ONE):
            sum_x, sum_y = sum_x - ux[i + x], sum_y - uy[i + x]
        return sum_x, sum_y
    phantoms, x = float(grid.width - grid.n_x), i + grid.n_x + ONE
    return sum_x - phantoms * ux[x], sum_y - phantoms * uy[x]


@kernel
def _count_switches(blocks, turned, i, n):
    """Return how many blocks of a row slide that were at rest for an instant, and before the step.

    For each, the loop has left w·v: negative for one that has turned back, zero after rest.
    """
    switches, released = np.int64(0), np.int64(0)
    for x in range(ONE, n + ONE):
        b, along = i + x, turned[x]
        slides = ((blocks.wx[b] != 0.0) | (blocks.wy[b] != 0.0)) & (blocks.static[b] > 0.0)
        switches += np.int64(slides & (along <= 0.0))
        released += np.int64(slides & (along == 0.0))
    return switches, released


@kernel
def _move_rows_in_contact(blocks, law, rows, band, s, turned, a):
    """Kick and drift those rows of a band that are awake and hold blocks in contact.

    `turned` is room for w·v of a row.
    """
    ux, uy, wx, wy = blocks.ux, blocks.uy, blocks.wx, blocks.wy
    static, dynamic = blocks.static, blocks.dynamic
    for row in range(band.start, band.stop):
        if not (rows.in_contact[row] and rows.awake[row]):
            continue
        i, own = row * band.grid.pitch, (row - band.start) * band.grid.pitch
        slide, switch = False, False
        sum_x, sum_y, heat, squares = 0.0, 0.0, 0.0, 0.0
        for x in range(ONE, band.grid.width + ONE):
            b = i + x
            fx, fy = s[FORCE_X + own + x], s[FORCE_Y + own + x]
            vx, vy = wx[b], wy[b]
            trial_x, trial_y = a * vx + fx, a * vy + fy
            new_x, new_y, slides, along = slow_down(
                law, b, trial_x, trial_y, vx, vy, fx, fy, static[b], dynamic[b]
            )
            there_x, there_y = ux[b] + new_x, uy[b] + new_y
            wx[b] = new_x
            wy[b] = new_y
            ux[b] = there_x
            uy[b] = there_y
            turned[x] = along
            slide = slide | slides
            switch = switch | (slides & (along <= 0.0) & (static[b] > 0.0))
            sum_x = add(sum_x, there_x)
            sum_y = add(sum_y, there_y)
            # Friction's work: the momentum that it removes times the mean velocity.
            lost_x, lost_y = trial_x - new_x, trial_y - new_y
            heat = add(heat, lost_x * (vx + new_x) + lost_y * (vy + new_y))
            squares = add(squares, new_x * new_x + new_y * new_y)
        rows.sliding[row + ONE] = slide
        more = (
            _count_switches(blocks, turned, i, band.grid.n_x)
            if switch
            else (np.int64(0), np.int64(0))
        )
        rows.switching[row], rows.released[row] = more
        rows.x[row], rows.y[row] = _without_phantoms(ux, uy, i, band.grid, sum_x, sum_y)
        rows.heat[row], rows.squares[row] = 0.5 * heat, squares


@kernel
def _move_free_rows(blocks, rows, band, s, a):
    """As `_move_rows_in_contact` for the other rows, which are always awake.

    To the bit, but for the order of the sums.
    """
    ux, uy, wx, wy = blocks.ux, blocks.uy, blocks.wx, blocks.wy
    for row in range(band.start, band.stop):
        if rows.in_contact[row]:
            continue
        i, own = row * band.grid.pitch, (row - band.start) * band.grid.pitch
        sum_x, sum_y, squares = 0.0, 0.0, 0.0
        for x in range(ONE, band.grid.width + ONE):
            b = i + x
            fx, fy = s[FORCE_X + own + x], s[FORCE_Y + own + x]
            new_x, new_y = a * wx[b] + fx, a * wy[b] + fy
            new_x, new_y = (new_x, new_y) if x <= band.grid.n_x else (0.0, 0.0)
            there_x, there_y = ux[b] + new_x, uy[b] + new_y
            wx[b] = new_x
            wy[b] = new_y
            ux[b] = there_x
            uy[b] = there_y
            sum_x = add(sum_x, there_x)
            sum_y = add(sum_y, there_y)
            squares = add(squares, new_x * new_x + new_y * new_y)
        rows.x[row], rows.y[row] = _without_phantoms(ux, uy, i, band.grid, sum_x, sum_y)
        rows.squares[row] = squares


@kernel
def _find_released(blocks, law, released, count, band, s, row):
    """Add the blocks of a row that were at rest until this step; returns their number so far.

    Nothing but F_mot has moved them: friction has left them its direction.
    """
    i, own = row * band.grid.pitch, (row - band.start) * band.grid.pitch
    for x in range(ONE, band.grid.n_x + ONE):
        b = i + x
        wx, wy = blocks.wx[b], blocks.wy[b]
        if blocks.static[b] > 0.0 and (wx != 0.0 or wy != 0.0):
            fx, fy = s[FORCE_X + own + x], s[FORCE_Y + own + x]
            force = math.hypot(fx, fy)
            friction = resistance(
                law, fresh(law), 0.5 * force, -0.5, blocks.static[b], blocks.dynamic[b]
            )
            left = 1.0 - friction / force
            if math.hypot(wx - left * fx, wy - left * fy) <= _SAME * math.hypot(fx, fy):
                released.row[count], released.x[count] = np.int64(row), np.int64(x)
                released.ax[count], released.ay[count] = wx, wy
                count += 1
    return count


@kernel
def _look_around(blocks, law, released, row, x, constants, slider):
    """Reconstruct the displacements around a block at step k, and before it."""
    now, before = released.now, released.before
    grid, a = constants.grid, math.exp(-constants.damping)
    for j in range(5):
        for i in range(5):
            b = place(row + j - 2, x + i - 2, grid)
            now[0, j, i] = blocks.ux[b] - blocks.wx[b] if b >= 0 else np.nan
            now[1, j, i] = blocks.uy[b] - blocks.wy[b] if b >= 0 else np.nan
    for j in range(3):
        for i in range(3):
            b = place(row + j - 1, x + i - 1, grid)
            before[0, j, i], before[1, j, i] = now[0, j + 1, i + 1], now[1, j + 1, i + 1]
            if b < 0 or (blocks.wx[b] == 0.0 and blocks.wy[b] == 0.0):
                continue
            fx, fy = force_in(now, j + 1, i + 1, constants.springs, slider)
            wx, wy = blocks.wx[b], blocks.wy[b]
            # Friction acted along this vector, on the same side as w.
            mean_x, mean_y = (1.0 + a) * wx - fx, (1.0 + a) * wy - fy
            size, forwards = math.hypot(mean_x, mean_y), mean_x * wx + mean_y * wy
            state = state_before(law, state_of(law, b), math.hypot(wx, wy))
            speed, share = math.copysign(size, forwards) / (2.0 * a), 1.0 / (2.0 * a)
            friction = resistance(law, state, speed, share, blocks.static[b], blocks.dynamic[b])
            along = math.copysign(friction / size, forwards)
            before[0, j, i] -= (wx + along * mean_x - fx) / a
            before[1, j, i] -= (wy + along * mean_y - fy) / a


@kernel
def place_releases(blocks, law, rows, released, count, constants, k):
    """Let `count` blocks go at their times within the step, not at its end.

    At step k they have slipped by θ² a/2, and then move with (1/2 + θ) a. `release` says why the
    slip is less near the stability limit, and what energy a start is credited with.
    """
    springs, slide = constants.springs, (constants.slider_x, constants.slider_y)
    slider, stiffness = (slide[0] * k, slide[1] * k), springs.k_s + 3.0 * springs.kappa
    epsilon = (springs.k_s + 6.0 * springs.kappa) / 4.0
    for m in range(count):
        row, x = released.row[m], released.x[m]
        b = place(row, x, constants.grid)
        _look_around(blocks, law, released, row, x, constants, slider)
        threshold = strength(law, blocks.static[b], blocks.dynamic[b])
        released.share[m] = share_of_step(released, threshold, springs, slider, slide)
    for m in range(count):
        row, share = released.row[m], released.share[m]
        b = place(row, released.x[m], constants.grid)
        if np.isnan(share):
            continue
        ax, ay = released.ax[m], released.ay[m]
        if blocks.t_det[b] == k:
            blocks.t_det[b] = k - share
        share = placed(share, epsilon)
        slip, speed = 0.5 * share * share - epsilon / 8.0, 0.5 + share
        further = slip + speed - 1.0  # than the loop has moved it
        blocks.ux[b] += further * ax
        blocks.uy[b] += further * ay
        blocks.wx[b], blocks.wy[b] = speed * ax, speed * ay
        rows.x[row] += further * ax
        rows.y[row] += further * ay
        a2 = ax * ax + ay * ay
        a1 = math.sqrt(a2)
        state = fresh(law)
        friction = resistance(law, state, 0.5 * a1, 0.0, blocks.static[b], blocks.dynamic[b])
        keep(law, b, state, (slip + speed) * a1, True)
        work = friction * a1 * (slip + 0.5 * (share - 0.5))
        credit = a2 * (0.125 - epsilon / 8.0 - 0.5 * stiffness * slip * slip)
        rows.heat[row] += work + credit
        rows.squares[row] += (speed * speed - 1.0) * a2
        close_edge(blocks.ux, blocks.uy, U(row), constants.grid)


@kernel
def _note_detachments(blocks, i, n, now):
    """Record first detachments in one row; return whether any of its blocks is still stuck."""
    wx, wy, static, t_det = blocks.wx, blocks.wy, blocks.static, blocks.t_det
    remaining = np.int64(0)
    for x in range(ONE, n + ONE):
        b = i + x
        slides = ((wx[b] != 0.0) | (wy[b] != 0.0)) & (static[b] > 0.0)
        first = t_det[b]
        t_det[b] = now if slides & (first > now) else first
        remaining += np.int64((static[b] > 0.0) & (t_det[b] > now))
    return remaining > 0


@kernel
def _steps_at_rest(static, s, own, i, n, pull):
    """Steps for which a row at rest among rows at rest is sure to stay there.

    As long as nothing moves, only the slider changes F_mot of a block, by `pull` per step.
    """
    least = np.inf
    for x in range(ONE, n + ONE):
        fx, fy = s[FORCE_X + own + x], s[FORCE_Y + own + x]
        least = min(least, static[i + x] - math.sqrt(fx * fx + fy * fy))
    return np.int64(min((1.0 - _SLACK) * least / pull, _FOREVER))


@kernel
def _settle(blocks, law, rows, released, count, band, s, pull, now):
    """Record switches, releases and detachments in a band; return what `move_band` returns."""
    n, switches = band.grid.n_x, np.int64(0)
    for row in range(band.start, band.stop):
        i = row * band.grid.pitch
        if rows.in_contact[row] and rows.awake[row]:
            switches += rows.switching[row]
            if rows.released[row] > 0:
                count = _find_released(blocks, law, released, count, band, s, row)
            if rows.switching[row] > 0 and rows.waiting[row]:
                rows.waiting[row] = _note_detachments(blocks, i, n, now)
            elif not rows.sliding[row + ONE] and rows.wake[row] <= now:
                own = (row - band.start) * band.grid.pitch
                rows.wake[row] = now + _steps_at_rest(blocks.static, s, own, i, n, pull)
        close_edge(blocks.ux, blocks.uy, row, band.grid)
    return switches, count


@kernel
def move_band(blocks, law, peak, rows, released, count, band, s, constants, now):
    """Move a band whose forces are in scratch `s`.

    Returns its switches from rest to sliding, and the number of blocks released so far.
    """
    a = math.exp(-constants.damping)
    pull = constants.springs.k_s * math.hypot(constants.slider_x, constants.slider_y)
    keep_peaks(peak, band, s)
    _move_rows_in_contact(blocks, law, rows, band, s, one_row(s), a)
    _move_free_rows(blocks, rows, band, s, a)
    return _settle(blocks, law, rows, released, count, band, s, pull, now)


@kernel
def wake(rows, now, periodic):
    """Choose the rows that move, lie beside one that does, or may let go in step `now`."""
    n = len(rows.wake)
    if periodic:
        rows.sliding[0], rows.sliding[n + 1] = rows.sliding[n], rows.sliding[1]
    for row in range(n):
        disturbed = rows.sliding[row] or rows.sliding[row + 1] or rows.sliding[row + 2]
        if disturbed:
            rows.wake[row] = now + 1  # and look again when all is at rest
        rows.awake[row] = disturbed or rows.wake[row] <= now
    if periodic:
        rows.awake[n] = rows.awake[0]


@kernel
def totals(rows):
    """Sum over rows, in their order."""
    x, y, heat, squares = 0.0, 0.0, 0.0, 0.0
    for row in range(len(rows.x)):
        x += rows.x[row]
        y += rows.y[row]
        heat += rows.heat[row]
        squares += rows.squares[row]
    return Totals(x, y, heat, squares)


@kernel
def _follow(state, constants, first, steps, every, samples, rows, released):
    """As `advance`, with room for rows and for the blocks that let go."""
    blocks, law, s, grid = state.blocks, state.law, state.scratch, constants.grid
    switches = np.int64(0)
    for k in range(first, first + steps):
        slider, count = (constants.slider_x * k, constants.slider_y * k), np.int64(0)
        if state.peak is None:  # a prelude looks at every block in every step
            wake(rows, k, grid.periodic is not None)
        close_rows(blocks.ux, blocks.uy, grid)
        for start in range(U(0), grid.n_y, constants.band_rows):
            band = band_from(start, constants)
            row, column = forces_on_band(
                blocks.ux, blocks.uy, band, rows.awake, s, constants.springs, slider
            )
            if column > 0:
                return k - first, np.int64(row), np.int64(column) - 1
            more, count = move_band(
                blocks, law, state.peak, rows, released, count, band, s, constants, k
            )
            switches += more
        if count > 0:
            place_releases(blocks, law, rows, released, count, constants, k)
        switches = book(state.ledger, samples, constants, totals(rows), switches, k, first, every)
    return steps, np.int64(-1), np.int64(-1)


def advance(
    state: State, constants: Constants, first: int, steps: int, every: int, samples: Samples
) -> tuple[int, int, int]:
    """See `Integrator.advance`.

    A row at rest among rows at rest is left alone until one of its blocks may let go, which
    changes no bit.
    """
    n_y, n_x = constants.grid.shape
    rows = make_rows(state.in_contact, constants.grid.periodic is not None)
    return _follow(state, constants, first, steps, every, samples, rows, room(n_y * n_x))
