"""Fourth-order Runge-Kutta, the paper's method, in a form that converges: (8) of docs/model.md.

With friction opposite to the velocity of each *stage* the method converges slowly or not at all:
the stage velocities of a slow block alternate in sign, and it creeps instead of coming to rest.
Here friction opposes one direction e through all four stages: that of the velocity of a sliding
block in the middle of the step, or of F_mot for a block that has just detached. Under weakening
laws its magnitude differs from stage to stage. A block whose velocity has reversed at the end of
the step stops there; a block at rest stays at rest through all stages. The method is of fourth
order without friction, and of second order across releases, which are placed within their steps
(`release`). Stops fall on step boundaries.
"""

import math
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from springblock.model.numbers import Array
from springblock.solver.compilation import add, kernel
from springblock.solver.lattice import (
    Constants,
    Lattice,
    Totals,
    band_from,
    close_edge,
    close_rows,
    index_of,
    slider_at,
    update_peaks,
)
from springblock.solver.laws import (
    resistance,
    state_at_release,
    state_in_stage,
    state_now,
    store_state,
)
from springblock.solver.release import Releases, make_releases, release_theta
from springblock.solver.springs import FORCE_X, FORCE_Y, ONE, Scratch, U, aligned, forces_on_band


class Stage(NamedTuple):
    """State of each block between the stages of a step, two components each."""

    ux: Array  #: displacement
    uy: Array
    vx: Array  #: velocity
    vy: Array
    dx: Array  #: weighted sum of velocities over stages: the displacement in this step
    dy: Array
    ax: Array  #: weighted sum of accelerations: the change of velocity
    ay: Array
    ex: Array  #: unit vector e, which friction opposes in this step
    ey: Array


#: Weight and node of each stage, and the node of the next one.
STAGES = (
    (1.0 / 6.0, 0.0, 0.5),
    (1.0 / 3.0, 0.5, 0.5),
    (1.0 / 3.0, 0.5, 1.0),
    (1.0 / 6.0, 1.0, 0.0),
)


@njit(inline="always")
def _friction_direction(law, fx, fy, vx, vy, static, friction, damping):
    """Unit vector e that friction opposes in this step; zero for a block that stays at rest.

    For a sliding block, its direction of motion in the middle of the step, unless it reverses
    before. Under weakening laws a block is slow just after its release and turns within a step: e
    is then the direction of its velocity in mid-step under friction along e, found implicitly.
    """
    speed = math.sqrt(vx * vx + vy * vy)
    if speed > 0.0:
        ex, ey = vx / speed, vy / speed
        half = 0.5 / (1.0 + damping) ** 2  # half a step, less under strong damping
        back = friction if law is None else 0.0
        mx, my = vx + half * (fx - back * ex), vy + half * (fy - back * ey)
        middle = math.sqrt(mx * mx + my * my)
        return (mx / middle, my / middle) if mx * ex + my * ey > 0.0 else (ex, ey)
    force = math.sqrt(fx * fx + fy * fy)
    if force > static and force > friction:  # the latter matters for blocks with mu_s < mu_d
        return fx / force, fy / force
    return 0.0, 0.0


@kernel
def _begin_step(blocks, law, stage, released, count, band, s, damping, now):
    """Set the direction of friction in a band and release blocks; return the releases so far.

    On entry, stage velocities are those at the start of the step, and sums over stages are zero.
    Released blocks start with (10) of docs/speed.md for θ = 1/2, which `_place_releases` corrects.
    """
    vx, vy, static, dynamic = blocks.vx, blocks.vy, blocks.static, blocks.dynamic
    ex, ey, t_det = stage.ex, stage.ey, blocks.t_det
    for row in range(band.start, band.stop):
        i, own = row * band.grid.pitch, (row - band.start) * band.grid.pitch
        for x in range(ONE, band.grid.n_x + ONE):
            b = i + x
            if static[b] == 0.0:
                continue
            fx, fy = s.force[FORCE_X + own + x], s.force[FORCE_Y + own + x]
            rests = vx[b] == 0.0 and vy[b] == 0.0
            half_x, half_y = (0.5 * fx, 0.5 * fy) if rests else (vx[b], vy[b])
            speed = math.sqrt(half_x * half_x + half_y * half_y)
            slope = -0.5 if rests else 0.0  # see `laws.resistance`
            friction = resistance(law, state_now(law, b), speed, slope, static[b], dynamic[b])
            ex[b], ey[b] = _friction_direction(
                law, fx, fy, vx[b], vy[b], static[b], friction, damping
            )
            if rests and (ex[b] != 0.0 or ey[b] != 0.0):
                t_det[b] = min(t_det[b], now)
                excess = fx * ex[b] + fy * ey[b] - friction
                ax, ay = excess * ex[b], excess * ey[b]
                store_state(law, b, state_at_release(law, b), 0.125 * excess, True)
                vx[b], vy[b] = 0.5 * ax, 0.5 * ay
                stage.vx[b], stage.vy[b] = vx[b], vy[b]
                stage.dx[b], stage.dy[b] = 0.125 * ax, 0.125 * ay
                released.row[count], released.x[count] = np.int64(row), np.int64(x)
                released.ax[count], released.ay[count] = ax, ay
                count += 1
    return count


@kernel
def _reconstruct_displacements(blocks, stage, released, row, x, constants):
    """Reconstruct the displacements around a block at the start of the step, and one step before.

    A sliding block is taken to have the same mean acceleration in both steps.
    """
    now, before = released.now, released.before
    for j in range(3):
        for i in range(3):
            b = index_of(row + j - 1, x + i - 1, constants.grid)
            ux, uy = (blocks.ux[b], blocks.uy[b]) if b >= 0 else (np.nan, np.nan)
            now[0, j + 1, i + 1], now[1, j + 1, i + 1] = ux, uy
            if b >= 0 and (blocks.vx[b] != 0.0 or blocks.vy[b] != 0.0):
                ux, uy = (
                    ux - blocks.vx[b] + 0.5 * stage.ax[b],
                    uy - blocks.vy[b] + 0.5 * stage.ay[b],
                )
            before[0, j, i], before[1, j, i] = ux, uy


@kernel
def _place_releases(blocks, law, stage, released, count, constants, k):
    """Place the releases of `count` blocks at their times before step k, not half a step before.

    The stages have started from (10) of docs/speed.md with θ = 1/2. To second order, θ_ε changes
    the displacement at the end of the step by the changes of slip and velocity at its start,

        Δu = [(θ_ε²/2 - 1/8) + (θ_ε - 1/2)] a.                                  (13)

    Returns the friction work along the displacements that are not part of the stages.
    """
    slide = constants.slider_x, constants.slider_y
    slider = slide[0] * k, slide[1] * k
    epsilon = (constants.springs.k_s + 6.0 * constants.springs.kappa) / 8.0
    for m in range(count):
        b = index_of(released.row[m], released.x[m], constants.grid)
        blocks.vx[b], blocks.vy[b] = 0.0, 0.0  # at rest before the step, for its neighbours
        store_state(law, b, state_now(law, b), 0.0, False)
    for m in range(count):
        row, x = released.row[m], released.x[m]
        b = index_of(row, x, constants.grid)
        _reconstruct_displacements(blocks, stage, released, row, x, constants)
        threshold = max(blocks.static[b], blocks.dynamic[b])
        theta = release_theta(released, threshold, constants.springs, slider, slide)
        released.theta[m] = 0.5 if np.isnan(theta) else theta
    heat = 0.0
    for m in range(count):
        b, theta = index_of(released.row[m], released.x[m], constants.grid), released.theta[m]
        if blocks.t_det[b] == k:
            blocks.t_det[b] = k - theta
        theta += epsilon * (0.5 - theta)  # θ_ε of (12)
        further = 0.5 * theta * theta - 0.125 + theta - 0.5
        blocks.vx[b], blocks.vy[b] = theta * released.ax[m], theta * released.ay[m]
        stage.dx[b] += further * released.ax[m]
        stage.dy[b] += further * released.ay[m]
        speed = math.hypot(released.ax[m], released.ay[m])
        friction = resistance(
            law, state_now(law, b), 0.5 * speed, 0.0, blocks.static[b], blocks.dynamic[b]
        )
        heat += friction * (0.125 + further) * speed
    return heat


@njit(inline="always")
def _friction_in_stage(blocks, law, stage, b):
    """Friction of block b at the slip and the speed of the current stage."""
    ex, ey = stage.ex[b], stage.ey[b]
    moved = (stage.ux[b] - blocks.ux[b]) * ex + (stage.uy[b] - blocks.uy[b]) * ey
    speed = abs(stage.vx[b] * ex + stage.vy[b] * ey)
    state = state_in_stage(law, b, moved)
    return resistance(law, state, speed, 0.0, blocks.static[b], blocks.dynamic[b])


@kernel
def _advance_stage(blocks, law, stage, weight, reach, band, s, damping):
    """Compute one stage in a band; return its share of the heat and of the squared velocities."""
    ux, uy, vx, vy, ex, ey = blocks.ux, blocks.uy, blocks.vx, blocks.vy, stage.ex, stage.ey
    total_heat, total = 0.0, 0.0
    for row in range(band.start, band.stop):
        i, own = row * band.grid.pitch, (row - band.start) * band.grid.pitch
        heat, squares = 0.0, 0.0
        for x in range(ONE, band.grid.n_x + ONE):
            b = i + x
            stage_x, stage_y = stage.vx[b], stage.vy[b]
            friction = (
                blocks.dynamic[b] if law is None else _friction_in_stage(blocks, law, stage, b)
            )
            ax = s.force[FORCE_X + own + x] - damping * stage_x - friction * ex[b]
            ay = s.force[FORCE_Y + own + x] - damping * stage_y - friction * ey[b]
            rests = (ex[b] == 0.0) & (ey[b] == 0.0)
            ax, ay = 0.0 if rests else ax, 0.0 if rests else ay
            stage.dx[b] += weight * stage_x
            stage.dy[b] += weight * stage_y
            stage.ax[b] += weight * ax
            stage.ay[b] += weight * ay
            if law is not None:  # Coulomb's heat is known at the end of the step
                heat = add(heat, friction * (stage_x * ex[b] + stage_y * ey[b]))
            squares = add(squares, stage_x * stage_x + stage_y * stage_y)
            stage.ux[b] = ux[b] + reach * stage_x
            stage.uy[b] = uy[b] + reach * stage_y
            stage.vx[b] = vx[b] + reach * ax
            stage.vy[b] = vy[b] + reach * ay
        total_heat, total = total_heat + heat, total + squares
        close_edge(stage.ux, stage.uy, row, band.grid)
    return weight * total_heat, weight * total


@kernel
def _displacement_of_row(ux, uy, i, n):
    """Sums over a row, in the same order with a law and without; preludes have none."""
    sum_x, sum_y = 0.0, 0.0
    for x in range(ONE, n + ONE):
        sum_x, sum_y = add(sum_x, ux[i + x]), add(sum_y, uy[i + x])
    return sum_x, sum_y


@kernel
def _finish_step(blocks, law, stage, grid, heat, squares):
    """Complete the step, clear the sums over stages, and return the totals.

    Sums are taken row by row, which limits rounding; `heat` and `squares` are those of the stages.
    """
    ux, uy, vx, vy = blocks.ux, blocks.uy, blocks.vx, blocks.vy
    static, ex, ey = blocks.static, stage.ex, stage.ey
    su, sv, pu, pv = stage.ux, stage.uy, stage.vx, stage.vy
    du, dv, qu, qv = stage.dx, stage.dy, stage.ax, stage.ay
    total_x, total_y = 0.0, 0.0
    for row in range(grid.n_y):
        i = row * grid.pitch
        heat_of_row = 0.0
        for x in range(ONE, grid.n_x + ONE):
            b = i + x
            new_x, new_y = vx[b] + qu[b], vy[b] + qv[b]
            turned = (static[b] > 0.0) & (new_x * ex[b] + new_y * ey[b] <= 0.0)
            lost = 0.5 * (new_x * new_x + new_y * new_y)  # kinetic energy of a block that reverses
            further = du[b] * ex[b] + dv[b] * ey[b]
            work = blocks.dynamic[b] * further if law is None else 0.0
            store_state(law, b, state_now(law, b), further, not turned)
            heat_of_row = add(heat_of_row, work + (lost if turned else 0.0))
            new_x, new_y = 0.0 if turned else new_x, 0.0 if turned else new_y
            next_x, next_y = ux[b] + du[b], uy[b] + dv[b]
            ux[b], uy[b], su[b], sv[b] = next_x, next_y, next_x, next_y
            vx[b], vy[b], pu[b], pv[b] = new_x, new_y, new_x, new_y
            du[b], dv[b], qu[b], qv[b] = 0.0, 0.0, 0.0, 0.0
        sum_x, sum_y = _displacement_of_row(ux, uy, i, grid.n_x)
        total_x, total_y, heat = total_x + sum_x, total_y + sum_y, heat + heat_of_row
        close_edge(ux, uy, row, grid)
        close_edge(su, sv, row, grid)
    return Totals(total_x, total_y, heat, squares)


class Work(NamedTuple):
    """Work arrays of the Runge-Kutta method."""

    stage: Stage
    every_row: NDArray[np.bool_]  #: (N_y + 1,) all true
    scratch: Scratch
    released: Releases

    @classmethod
    def of(cls, state: Lattice, constants: Constants) -> "Work":
        """Return work arrays for the steps of one call."""
        (n_y, n_x), size = constants.grid.shape, len(state.blocks.ux)
        stage = Stage(*(aligned(size, 9 * k) for k in range(len(Stage._fields))))
        for field, values in zip(stage[:4], state.blocks[:4], strict=True):
            field[:] = values
        stage.ex[:] = 1.0  # without friction e has no effect
        return cls(stage, np.ones(n_y + 1, np.bool_), Scratch.empty(), make_releases(n_y * n_x))

    @staticmethod
    def take_step(work, state, constants, k):
        """Take step k, see `integrators`."""
        blocks, law, grid, damping = state.blocks, state.law, constants.grid, constants.damping
        stage, s, heat, squares, count = work.stage, work.scratch, 0.0, 0.0, np.int64(0)
        for weight, node, reach in STAGES:
            slider = slider_at(constants, k + node)
            close_rows(stage.ux, stage.uy, grid)
            for start in range(U(0), grid.n_y, constants.band_rows):
                band = band_from(start, constants)
                row, column = forces_on_band(
                    stage.ux, stage.uy, band, work.every_row, s, constants.springs, slider
                )
                if column > 0:
                    return Totals(0.0, 0.0, heat, squares), count, row, column
                if node == 0.0:
                    update_peaks(state.peak, band, s)
                    count = _begin_step(
                        blocks, law, stage, work.released, count, band, s, damping, k
                    )
                more, speeds = _advance_stage(blocks, law, stage, weight, reach, band, s, damping)
                heat, squares = heat + more, squares + speeds
        if count > 0:
            early = _place_releases(blocks, law, stage, work.released, count, constants, k)
            heat += 0.0 if law is None else early
        return _finish_step(blocks, law, stage, grid, heat, squares), count, U(0), U(0)
