"""Reference solutions of the spring-block model, event by event, for up to about 20 x 20 blocks.

    python -m benchmarks.reference FILE    # compute the stored solutions again, in six CPU minutes

Nothing is shared with the solver but constants. Between events DOP853 (Hairer, Nørsett & Wanner
1993, order 8) integrates the equations of motion; every detachment and every stop is located on the
dense output of the step that holds it, and integration starts afresh from there.

A block is in one of four states:

FREE      not in contact: no friction, ever.
STUCK     at rest. Static friction balances F_mot = F_int + F_s. It ends when |F_mot| rises to
          max(mu_s, mu_d) F_n: with mu_s < mu_d, dynamic friction alone would hold the block.
CREEPING  detached, but slow. F_mot turns v into its own direction within m |v| / |F_mot|: no time
          at all for a slow block, and none at the start, where v = 0 has no direction. Such
          a block moves along F_mot; only its speed is integrated. That leaves out the angle
          m |v| phi' / |F_mot| by which v lags behind F_mot as this turns at the rate phi'. Past
          CREEP_ERROR in velocity, or past CREEP_SPEED, the block is SLIDING.
SLIDING   friction -mu_d F_n v/|v|. It ends when the speed falls below STOP_SPEED; or turns to
          CREEPING once |v| is low enough and v along F_mot. Without that, a block with
          mu_s < mu_d, which follows the slider slowly and steadily, would make the equations stiff.

A block that stops sticks if |F_mot| is below the static threshold, and starts afresh otherwise.
Units are scaled: force P l² (the load of one block on a flat surface), length P l² / K_s, time
sqrt(m / K_s). Time counts from the last event, so that close events still resolve.
"""

import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.integrate import DOP853, DenseOutput
from scipy.optimize import brentq
from tqdm import tqdm

from springblock.io.parquet import load, rows_to_table, write
from springblock.model.material import Material
from springblock.model.numbers import Array
from springblock.model.surface import Surface
from springblock.study.accuracy import solutions
from springblock.study.accuracy.conventions import SAMPLE_INTERVAL

Flags = NDArray[np.bool_]

FREE, STUCK, CREEPING, SLIDING = range(4)

# Scaled velocities: one is P l² / sqrt(K_s m), 0.53 m/s by default; the slider's own is 1e-3.
CREEP_ERROR = 1e-9  #: a much smaller one makes slow blocks stiff
CREEP_SPEED = 1e-2  #: beyond, v/|v| is not stiff
STOP_SPEED = 1e-8  #: well above the accuracy, or a step may pass a stop unseen
#: The period of the fastest lattice mode is 2 pi / sqrt(7) = 2.4.
TOLERANCES = {"rtol": 1e-10, "atol": 1e-11, "max_step": 1.0}
SAMPLES = 8  #: points per step at which events are looked for; shorter ones are not seen
RESTART_STEP = 1e-6  #: the error control multiplies it by up to 10 a step
TIE = 1e-11  #: events this close (in the unit of the event function) count as simultaneous
SLACK = 1e-9  #: share of F_n by which F_mot must fall below mu_d F_n for a start to be called off


class System:
    """The equations of motion of u (2, n) and v (2, n), scaled, and the events that end them."""

    def __init__(self, surface: Surface, material: Material, times: Array) -> None:
        contact, touching = surface.contact, surface.contact.ravel()
        self.n = contact.size
        self.load = self.n / max(1, int(touching.sum()))  # F_n
        dynamic, static = surface.mu_dynamic.ravel(), surface.mu_static.ravel()
        self.dynamic = np.where(touching, dynamic, 0.0) * self.load
        self.threshold = np.where(touching, np.maximum(static, dynamic), 0.0) * self.load
        length, time = material.block_load / material.k_s, (material.mass / material.k_s) ** 0.5
        self.drift = np.array([[material.slider_velocity / (length / time)], [0.0]])
        self.gamma = material.gamma * time
        self.state = np.where(touching, STUCK, FREE)
        self.offset = 0.0  # time of the last event; all other times count from there
        self.times, self.force = times, list[float]()  # |sum of F_s| at `times`, so far
        self._connect(contact.shape, surface.periodic, material, length)

    def _connect(
        self, shape: tuple[int, int], periodic: bool, material: Material, length: float
    ) -> None:
        """Set up the bonds and their incidence matrix, for both components."""
        n_y, n_x = shape
        block, spacing = np.arange(self.n).reshape(shape), material.spacing / length
        bonds = [
            (block[y, x], block[(y + dy) % n_y, (x + dx) % n_x], dx * spacing, dy * spacing, k)
            for dx, dy, k in ((1, 0, 1.0), (0, 1, 1.0), (1, 1, 0.5), (-1, 1, 0.5))
            for y, x in np.ndindex(n_y, n_x)
            if periodic or (y + dy < n_y and 0 <= x + dx < n_x)
        ]
        first, second, *axis, k = np.array(bonds, float).reshape(-1, 5).T
        bond, signs = np.tile(np.arange(len(bonds)), 2), np.repeat([-1.0, 1.0], len(bonds))
        ends = np.concatenate([first, second]).astype(int)
        one = sparse.csr_array((signs, (bond, ends)), shape=(len(bonds), self.n))
        # one product for both components: calls take most of the time
        self._difference = sparse.block_diag([one, one], format="csr")
        self._net = sparse.csr_array(-self._difference.T)
        self._axis = np.array(axis)[:, :, None]  # L e
        self._rest_squared = np.sum(self._axis**2, axis=0)  # L²
        self._stiffness = material.k_int / material.k_s * k[:, None]

    def internal_force(self, u: Array) -> Array:
        """F_int (2, n, k) of k states u (2, n, k): the sum of k (r - L) r/|r| over the bonds."""
        d = (self._difference @ u.reshape(-1, u.shape[2])).reshape(2, -1, u.shape[2])
        q = ((2.0 * self._axis + d) * d).sum(axis=0) / self._rest_squared  # r²/L² - 1
        # 1 - L/r = 1 - (1 + q)^(-1/2), rationalised
        pull = self._stiffness * (q / ((1.0 + q) + np.sqrt(1.0 + q))) * (self._axis + d)
        return (self._net @ pull.reshape(-1, u.shape[2])).reshape(u.shape)

    def slider_force(self, t: Array, u: Array) -> Array:
        """F_s (2, n, k) at times t (k,) after the last event."""
        return self.drift[:, :, None] * (self.offset + t) - u

    def split(self, y: Array) -> tuple[Array, Array]:
        """u and v, (2, n, k) each, from states (4 n, k)."""
        u, v = y.reshape(2, 2, self.n, -1)
        return u, v

    def turning(self, motive: Array, u: Array, v: Array) -> Array:
        """Rate phi' (n, k) at which F_mot turns."""
        # central difference along v: 1e-3 is small against the spacing and large against rounding
        ahead, behind = (self.internal_force(u + sign * 1e-3 * v) for sign in (1.0, -1.0))
        rate = (ahead - behind) / 2e-3 + self.drift[:, :, None] - v
        return (motive[0] * rate[1] - motive[1] * rate[0]) / positive(np.sum(motive**2, axis=0))

    def __call__(self, t: float, y: Array) -> Array:
        """Time derivative of the state vector (4 n,)."""
        u, v = self.split(y)
        motive = self.internal_force(u) + self.slider_force(np.array([t]), u)
        creeping = self.state == CREEPING
        direction = unit(np.where(creeping[:, None], motive, v))
        acceleration = motive - self.dynamic[:, None] * direction - self.gamma * v
        if creeping.any():
            # v = s e along F_mot has the rate s' e + s phi' n, whatever force that takes across
            across = np.stack([-direction[1], direction[0]])
            turn = np.sum(v * direction, axis=0) * self.turning(motive, u, v)
            along = np.sum(acceleration * direction, axis=0)
            led = along * direction + turn * across
            acceleration = np.where(creeping[:, None], led, acceleration)
        acceleration[:, self.state == STUCK] = 0.0
        return np.concatenate([v.ravel(), acceleration.ravel()])

    def alarm(self, dense: DenseOutput, t: Array) -> Array:
        """Event functions (n, k) at times t (k,), one per block: negative while its state lasts."""
        u, v = self.split(dense(t))
        motive = self.internal_force(u) + self.slider_force(t, u)
        force, speed = np.hypot(*motive), np.hypot(*v)
        released = (force - self.threshold[:, None]) / self.load
        # the equation of a creeping block knows no stop: its speed would change sign
        stayed = 1.0 - np.sum(v * unit(motive), axis=0) / STOP_SPEED
        falling = (self.dynamic[:, None] - force) / self.load - SLACK
        fast, entered = self._creep_limits(motive, u, v)
        state = self.state[:, None]
        left_creeping = np.maximum(fast, np.minimum(stayed, falling))
        left_sliding = np.maximum(1.0 - speed / STOP_SPEED, entered)
        return np.choose(state, [-1.0, released, left_creeping, left_sliding])

    def _creep_limits(self, motive: Array, u: Array, v: Array) -> tuple[Array, Array]:
        """Event functions (n, k) for the end of creeping and, stricter, for its return."""
        speed = np.hypot(*v)
        slow = (self.state[:, None] >= CREEPING) & (speed < CREEP_SPEED)
        if not slow.any():
            return speed / CREEP_SPEED - 1.0, np.full_like(speed, -1.0)
        force = positive(np.hypot(*motive))
        lag = speed**2 * np.abs(self.turning(motive, u, v)) / force / CREEP_ERROR
        aside = np.hypot(*(v - speed * motive / force)) / CREEP_ERROR
        fast = np.maximum(speed / CREEP_SPEED, lag) - 1.0
        return fast, 1.0 - np.max([2.0 * speed / CREEP_SPEED, 4.0 * lag, aside], axis=0)

    def switch(self, y: Array, due: Flags) -> Flags:
        """Change the state of the blocks that are due at the last event.

        Returns those that detach, (n,) bool. Writes to `y` where a block stops or begins to creep.
        """
        u, v = self.split(y)  # views: what is written to v reaches y
        motive = self.internal_force(u) + self.slider_force(np.zeros(1), u)
        speed = np.hypot(*v)
        # a stop is located to the rounding of t, which the acceleration turns into speed
        slow = speed[:, 0] <= STOP_SPEED * 1.001
        weak = np.hypot(*motive)[:, 0] <= self.threshold
        detaching = due & (self.state == STUCK)
        stopping = due & (self.state == SLIDING) & slow
        held = weak & (stopping | (due & (self.state == CREEPING) & slow))
        entering = due & (self.state == SLIDING) & ~held
        leaving = due & (self.state == CREEPING) & ~held
        self.state[detaching | entering] = CREEPING
        self.state[leaving] = SLIDING
        self.state[held] = STUCK
        v[:, entering] = (speed * unit(motive))[:, entering]
        v[:, held | stopping] = 0.0
        return detaching

    def advance(self, y: Array, left: float) -> tuple[float, Array, Flags]:
        """Integrate to the next event, or for the time left, and sample the force on the way.

        Returns the time taken, the state then (4 n,), and the blocks due to switch (n,).
        """
        solver = DOP853(self, 0.0, y, left, first_step=min(RESTART_STEP, left), **TOLERANCES)
        while solver.status == "running":
            message = solver.step()
            if solver.status == "failed":
                raise RuntimeError(f"at scaled time {self.offset + solver.t}: {message}")
            dense = solver.dense_output()
            times = np.linspace(solver.t_old, solver.t, SAMPLES + 1)
            reached = np.flatnonzero((self.alarm(dense, times) >= 0.0).any(axis=0))
            if not reached.size:
                self._sample(dense, solver.t)
                continue
            time = times[reached[0]]
            if reached[0]:
                ends = {"a": times[reached[0] - 1], "b": time, "xtol": 1e-300, "rtol": 1e-15}
                time = brentq(lambda t, to=dense: self.alarm(to, np.array([t])).max(), **ends)
            self._sample(dense, time)
            alarm = self.alarm(dense, np.array([time]))[:, 0]
            # the root may fall a rounding error short of zero: the worst block is due in any case
            return time, dense(time), alarm >= min(-TIE, alarm.max())
        return left, solver.y, np.zeros(self.n, dtype=bool)

    def _sample(self, dense: DenseOutput, end: float) -> None:
        """Add |sum of F_s| at the next of `times` up to `end`, since the last event."""
        # the last sample must not be lost to the rounding of offset + end
        reach = (self.offset + end) * (1.0 + 1e-14)
        due = self.times[len(self.force) : np.searchsorted(self.times, reach, side="right")]
        if due.size:
            t = np.maximum(due - self.offset, 0.0)  # nor lie a hair before the last event
            u, _ = self.split(dense(t))
            self.force.extend(np.hypot(*self.slider_force(t, u).sum(axis=1)))


def unit(vectors: Array) -> Array:
    """Unit vectors along the first axis; zero where the vector is zero."""
    return vectors / positive(np.hypot(*vectors))


def positive(lengths: Array) -> Array:
    """The same with ones in place of zeros, to divide by."""
    return np.where(lengths > 0.0, lengths, 1.0)


class Reference(NamedTuple):
    """Result of a run, in SI units. Arrays over blocks are indexed [y, x]."""

    time: Array  #: (n,) s, multiples of the sample interval
    force: Array  #: (n,) N, |sum of F_s| at these times
    t_det: Array  #: (N_y, N_x) s, first detachment; NaN where never or not in contact
    displacement: Array  #: (2, N_y, N_x) m, components x and y, at the end


def solve(
    surface: Surface, material: Material, duration: float, sample_interval: float
) -> Reference:
    """Solve the model with Coulomb friction from rest at t = 0, pulled along x; times in s."""
    length, unit_time = material.block_load / material.k_s, (material.mass / material.k_s) ** 0.5
    # a millionth of an interval keeps the last sample where the quotient is rounded down
    samples = np.arange(int(duration / sample_interval + 1e-6) + 1.0) * sample_interval
    system = System(surface, material, np.minimum(samples, duration) / unit_time)
    t_det, y = np.full(system.n, np.nan), np.zeros(4 * system.n)  # at rest, unstrained
    while (left := duration / unit_time - system.offset) > 0.0:
        elapsed, y, due = system.advance(y, left)
        system.offset = system.offset + elapsed if due.any() else duration / unit_time
        detaching = system.switch(y, due)
        t_det[detaching & np.isnan(t_det)] = system.offset * unit_time
    force, shape = np.array(system.force) * material.block_load, surface.contact.shape
    u = length * system.split(y)[0].reshape(2, *shape)
    return Reference(samples, force, t_det.reshape(shape), u)


def solution(scene: str, seed: int) -> dict[str, object]:
    """Return one row of the stored table, computed."""
    surface, duration = solutions.SMALL[scene].surface(seed), solutions.SMALL[scene].duration
    run = solve(surface, Material(), duration, SAMPLE_INTERVAL)
    curves = {"force": run.force.astype(np.float32).tolist(), "t_det": run.t_det.ravel().tolist()}
    means = {
        "static_friction": run.force.max() / Material().block_load / run.t_det.size,
        "t_max": run.time[run.force.argmax()],
        "t_avg": np.nanmean(run.t_det),
    }
    return {"scene": scene, "seed": seed, **means, **curves}


def differences(row: dict[str, object], stored: dict[str, object]) -> dict[str, float]:
    """Return the largest difference of each value from the stored one, over its largest value."""
    names = [name for name in stored if name not in ("scene", "seed")]
    pairs = {name: np.nan_to_num([row[name], stored[name]]) for name in names}
    return {name: abs(a - b).max() / b.max() for name, (a, b) in pairs.items()}


def main(file: Path) -> None:
    """Compute all solutions, print their differences from the stored ones, and write them."""
    table, rows = load(solutions.FILE), []
    for stored in tqdm(table.to_pylist()):
        rows.append(solution(stored["scene"], stored["seed"]))
        found = differences(rows[-1], stored)
        tqdm.write(
            f"{stored['scene']} {stored['seed']}: largest difference {max(found.values()):.1e}"
        )
    write(rows_to_table(rows, table.schema.remove_metadata()), file, {})


if __name__ == "__main__":
    main(Path(sys.argv[1]))
