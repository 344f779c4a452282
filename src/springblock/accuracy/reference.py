"""Reference solution of the spring-block model, event by event, for small lattices.

It shares only constants with the solver, and is meant for up to about 20 x 20 blocks.
Between two events the equations of motion are smooth, and DOP853 (Hairer, Nørsett & Wanner 1993,
order 8) follows them to a relative tolerance of 1e-10; every detachment and every stop is located
on the dense output of the step that holds it, and integration starts afresh from there.

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

What a stop leads to depends on |F_mot| at that moment. Up to the static threshold the block
sticks: with |F_mot| < mu_d F_n it would come to rest within the next STOP_SPEED / |a| anyway; with
mu_d F_n < |F_mot| <= mu_s F_n it has reversed exactly, as in one dimension, and static friction
holds it. A block that reverses *nearly* does not stop: it turns around at a small speed, because
F_mot turns v away from -F_mot. Its least speed has a continuous distribution, so that STOP_SPEED
takes a turn for a stop only in a share of reversals of the order of STOP_SPEED itself (scaled): in
practice never. Beyond the static threshold the block starts afresh.

Everything is scaled: force P l² (the load of one block on a flat surface), length P l² / K_s, time
sqrt(m / K_s). The mass, K_s, and the displacement at which a block slips are then about 1. Time
is counted from the last event, so that events closer than the rounding error of t still resolve.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.integrate import DOP853, DenseOutput
from scipy.optimize import brentq, minimize_scalar

from springblock.model.defaults import SAMPLE_INTERVAL
from springblock.model.material import Material
from springblock.model.numbers import Array
from springblock.model.surface import Surface

Flags = NDArray[np.bool_]

FREE, STUCK, CREEPING, SLIDING = range(4)

# Scaled velocities: one is P l² / sqrt(K_s m), 0.53 m/s by default; the slider's own is 1e-3.
CREEP_ERROR = 1e-9  #: a much smaller one makes slow blocks stiff
CREEP_SPEED = 1e-2  #: beyond, v/|v| is not stiff
STOP_SPEED = 1e-8  #: well above the accuracy, or a step may pass a stop unseen
ACCURACY = 1e-10  #: relative tolerance of each step; the absolute one is a tenth of it, scaled
_MAX_STEP = 1.0  #: scaled; the period of the fastest lattice mode is 2 pi / sqrt(7) = 2.4
_SAMPLES = 8  #: points per step at which events are looked for
_RESTART_STEP = 1e-6  #: scaled; the error control multiplies it by up to 10 a step
_TIE = 1e-11  #: events this close (in the unit of the event function) count as simultaneous
_SLACK = 1e-9  #: share of F_n by which F_mot must fall below mu_d F_n for a start to be called off


@dataclass
class Reference:
    """Result of a run, in SI units. Arrays over blocks are indexed [y, x]."""

    time: Array  #: (n,) s, multiples of the sample interval
    force: Array  #: (n,) N, |sum of F_s| at these times
    t_det: Array  #: (N_y, N_x) s, first detachment; NaN where never or not in contact
    displacement: Array  #: (2, N_y, N_x) m, components x and y, at the end
    static_friction: float  #: greatest sampled force over P l² N_y N_x
    t_max: float  #: s, time of that sample
    t_avg: float  #: s, mean of t_det over the contact blocks that detached
    relative_residual: float  #: of the energy balance, over the work of the slider


def _units(material: Material) -> tuple[float, float, float]:
    """Return the SI values of one scaled force, length and time."""
    force = material.block_load
    return force, force / material.k_s, (material.mass / material.k_s) ** 0.5


class _Lattice:
    """Springs between blocks: a list of bonds and its incidence matrix for both components.

    Scaled units. Displacements have the shape (2, n, k): component, block (y * N_x + x), and any
    number k of states to be evaluated at once.
    """

    def __init__(self, contact: Flags, periodic: bool, spacing: float, stiffness: float) -> None:
        n_y, n_x = contact.shape
        block = np.arange(n_y * n_x).reshape(n_y, n_x)
        bonds = [
            (block[y, x], block[(y + dy) % n_y, (x + dx) % n_x], dx * spacing, dy * spacing, k)
            for dx, dy, k in ((1, 0, 1.0), (0, 1, 1.0), (1, 1, 0.5), (-1, 1, 0.5))
            for y, x in np.ndindex(n_y, n_x)
            if periodic or (y + dy < n_y and 0 <= x + dx < n_x)
        ]
        first, second, *axis, k = np.array(bonds, float).reshape(-1, 5).T
        bond, signs = np.tile(np.arange(len(bonds)), 2), np.repeat([-1.0, 1.0], len(bonds))
        ends = np.concatenate([first, second]).astype(int)
        one = sparse.csr_array((signs, (bond, ends)), shape=(len(bonds), block.size))
        # one product for both components: calls take most of the time
        self._difference = sparse.block_diag([one, one], format="csr")
        self._net = sparse.csr_array(-self._difference.T)
        self._axis = np.array(axis)[:, :, None]  # L e
        self._rest_squared = np.sum(self._axis**2, axis=0)  # L²
        self._stiffness = stiffness * k[:, None]

    def _stretch(self, u: Array) -> tuple[Array, Array]:
        """Bond vectors r, and q = r²/L² - 1 without the cancellation this form has."""
        d = _times(self._difference, u)
        q = (2.0 * self._axis + d) * d
        return self._axis + d, (q[0] + q[1]) / self._rest_squared

    def force(self, u: Array) -> Array:
        """F_int (2, n, k): the sum of k (r - L) r/|r| over the bonds of each block."""
        r, q = self._stretch(u)
        # 1 - L/r = 1 - (1 + q)^(-1/2), rationalised
        pull = self._stiffness * (q / ((1.0 + q) + np.sqrt(1.0 + q))) * r
        return _times(self._net, pull)

    def energy(self, u: Array) -> float:
        """Sum of k (r - L)² / 2 for one state, (2, n, 1)."""
        _, q = self._stretch(u)
        # r - L = L (sqrt(1 + q) - 1), rationalised
        squared = self._rest_squared * (q / (1.0 + np.sqrt(1.0 + q))) ** 2
        return 0.5 * float(np.sum(self._stiffness * squared))


def _times(matrix: sparse.csr_array, u: Array) -> Array:
    """Multiply both components of u (2, n, k)."""
    return (matrix @ u.reshape(-1, u.shape[2])).reshape(2, -1, u.shape[2])


class _System:
    """The equations of motion, scaled, and the events that end their validity.

    The state vector holds u (2, n), v (2, n), and three works: done by the slider, against
    friction, and against damping.
    """

    def __init__(self, surface: Surface, material: Material, times: Array) -> None:
        contact, mu_static, mu_dynamic = surface.contact, surface.mu_static, surface.mu_dynamic
        _, length, time = _units(material)
        self.n = contact.size
        stiffness = material.k_int / material.k_s
        self._lattice = _Lattice(contact, surface.periodic, material.spacing / length, stiffness)
        self._drift = np.array([[material.slider_velocity / (length / time)], [0.0]])
        self._gamma = material.gamma * time
        touching = contact.ravel()
        self.load = self.n / max(1, int(touching.sum()))  # F_n
        self._dynamic = np.where(touching, mu_dynamic.ravel(), 0.0) * self.load
        threshold = np.maximum(mu_static, mu_dynamic).ravel() * self.load
        self.threshold = np.where(touching, threshold, 0.0)
        self.state = np.where(touching, STUCK, FREE)
        self.offset = 0.0  # time of the last event; all other times count from there
        self.force: list[float] = []  # |sum of F_s| at `times`, so far
        self._times = times

    def split(self, y: Array) -> tuple[Array, Array]:
        """u and v, (2, n, k) each, from states (4 n + 3, k)."""
        half = 2 * self.n
        return y[:half].reshape(2, self.n, -1), y[half : 2 * half].reshape(2, self.n, -1)

    def _slider_force(self, t: Array, u: Array) -> Array:
        """F_s (2, n, k) at times t (k,) after the last event."""
        return self._drift[:, :, None] * (self.offset + t) - u

    def _turning(self, motive: Array, u: Array, v: Array) -> Array:
        """Rate phi' (n, k) at which F_mot turns."""
        # central difference along v: 1e-3 is small against the spacing and large against rounding
        ahead, behind = (self._lattice.force(u + sign * 1e-3 * v) for sign in (1.0, -1.0))
        rate = (ahead - behind) / 2e-3 + self._drift[:, :, None] - v
        return (motive[0] * rate[1] - motive[1] * rate[0]) / _positive(np.sum(motive**2, axis=0))

    def __call__(self, t: float, y: Array) -> Array:
        """Time derivative of the state vector."""
        u, v = self.split(y[:, None])
        pull = self._slider_force(np.array([t]), u)
        motive = self._lattice.force(u) + pull
        creeping = self.state == CREEPING
        direction = _unit(np.where(creeping[:, None], motive, v))
        friction = self._dynamic[:, None] * direction
        acceleration = motive - friction - self._gamma * v
        if creeping.any():
            # v = s e along F_mot has the rate s' e + s phi' n, whatever force that takes across
            across = np.stack([-direction[1], direction[0]])
            turn = np.sum(v * direction, axis=0) * self._turning(motive, u, v)
            along = np.sum(acceleration * direction, axis=0)
            led = along * direction + turn * across
            acceleration = np.where(creeping[:, None], led, acceleration)
        acceleration[:, self.state == STUCK] = 0.0
        work_in = np.sum(pull[:, :, 0] * self._drift)
        works = work_in, np.vdot(friction, v), self._gamma * np.vdot(v, v)
        return np.concatenate([v.ravel(), acceleration.ravel(), works])

    def _alarm(self, dense: DenseOutput, t: Array) -> Array:
        """Event functions (n, k) at times t (k,), one per block: negative while its state lasts."""
        u, v = self.split(dense(t))
        motive = self._lattice.force(u) + self._slider_force(t, u)
        force, speed = np.hypot(*motive), np.hypot(*v)
        released = (force - self.threshold[:, None]) / self.load
        stopped = 1.0 - speed / STOP_SPEED
        # the equation of a creeping block knows no stop: its speed would change sign
        stayed = 1.0 - np.sum(v * _unit(motive), axis=0) / STOP_SPEED
        fast, entered = self._creep_limits(motive, u, v)
        falling = (self._dynamic[:, None] - force) / self.load - _SLACK
        state = self.state[:, None]
        left_creeping = np.maximum(fast, np.minimum(stayed, falling))
        left_sliding = np.maximum(stopped, entered)
        states = [state == STUCK, state == CREEPING, state == SLIDING]
        return np.select(states, [released, left_creeping, left_sliding], -1.0)

    def _creep_limits(self, motive: Array, u: Array, v: Array) -> tuple[Array, Array]:
        """Event functions (n, k) for the end of creeping and, stricter, for its return."""
        speed = np.hypot(*v)
        slow = (self.state[:, None] >= CREEPING) & (speed < CREEP_SPEED)
        if not slow.any():
            return speed / CREEP_SPEED - 1.0, np.full_like(speed, -1.0)
        force = _positive(np.hypot(*motive))
        lag = speed**2 * np.abs(self._turning(motive, u, v)) / force / CREEP_ERROR
        aside = np.hypot(*(v - speed * motive / force)) / CREEP_ERROR
        fast = np.maximum(speed / CREEP_SPEED, lag) - 1.0
        entered = 1.0 - np.max([2.0 * speed / CREEP_SPEED, 4.0 * lag, aside], axis=0)
        return fast, entered

    def switch(self, y: Array, due: Flags) -> Flags:
        """Change the state of the blocks that are due at the last event.

        Returns those that detach, (n,) bool. Writes to `y` where a block stops or begins to creep.
        """
        u, v = self.split(y[:, None])  # views: what is written to v reaches y
        motive = self._lattice.force(u) + self._slider_force(np.zeros(1), u)
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
        v[:, entering] = (speed * _unit(motive))[:, entering]
        v[:, held | stopping] = 0.0
        return detaching

    def residual(self, y: Array) -> float:
        """Residual of the energy balance at the last event, over the work of the slider."""
        u, v = self.split(y[:, None])
        pull = self._slider_force(np.zeros(1), u)
        work_in, friction, viscous = (float(work) for work in y[-3:])
        elastic = self._lattice.energy(u) + 0.5 * float(np.sum(pull**2))
        spent = elastic + 0.5 * float(np.sum(v**2)) + friction + viscous
        return (work_in - spent) / work_in

    def advance(self, y: Array, left: float, accuracy: float) -> tuple[float, Array, Flags]:
        """Integrate to the next event, or for the time left, and sample the force on the way.

        Returns the time taken, the state then (4 n + 3,), and the blocks due to switch (n,).
        """
        tolerances = {"rtol": accuracy, "atol": 0.1 * accuracy}
        steps = {"first_step": min(_RESTART_STEP, left), "max_step": _MAX_STEP}
        solver = DOP853(self, 0.0, y, left, **tolerances, **steps)
        while solver.status == "running":
            message = solver.step()
            if solver.status == "failed":
                raise RuntimeError(f"at scaled time {self.offset + solver.t}: {message}")
            dense = solver.dense_output()
            event = self._first_event(dense, solver.t_old, solver.t)
            self._sample(dense, solver.t if event is None else event[0])
            if event is not None:
                time, due = event
                return time, dense(time), due
        return left, solver.y, np.zeros(self.n, dtype=bool)

    def _sample(self, dense: DenseOutput, end: float) -> None:
        """Add samples of |sum of F_s| at the next of `times` up to `end`, since the last event."""
        # the last sample must not be lost to the rounding of offset + end
        reach = (self.offset + end) * (1.0 + 1e-14)
        due = self._times[len(self.force) : np.searchsorted(self._times, reach, side="right")]
        if due.size:
            # nor may a sample come to lie a hair before the last event
            t = np.maximum(due - self.offset, 0.0)
            u, _ = self.split(dense(t))
            self.force.extend(np.hypot(*self._slider_force(t, u).sum(axis=1)))

    def _first_event(
        self, dense: DenseOutput, start: float, end: float
    ) -> tuple[float, Flags] | None:
        """Earliest time in a step at which an event function reaches zero, and the blocks due."""
        bracket = self._bracket(dense, np.linspace(start, end, _SAMPLES + 1))
        if bracket is None:
            return None
        time, after = bracket
        if time < after:
            ends = {"a": time, "b": after, "xtol": 1e-300, "rtol": 1e-15}
            time = brentq(lambda t: self._alarm(dense, np.array([t])).max(), **ends)
        alarm = self._alarm(dense, np.array([time]))[:, 0]
        # the root may fall a rounding error short of zero: the worst block is due in any case
        return time, alarm >= min(-_TIE, alarm.max())

    def _bracket(self, dense: DenseOutput, t: Array) -> tuple[float, float] | None:
        """Two times with no block due at the first and one at the second; equal if due at once."""
        alarm = self._alarm(dense, t)
        reached = np.flatnonzero((alarm >= 0.0).any(axis=0))
        last = reached[0] if reached.size else len(t) - 1
        if reached.size and last == 0:
            return t[0], t[0]
        # F_mot of a stuck block may pass its threshold and fall back between two samples. It cannot
        # exceed them by more than an eighth of their second difference; eight times that is safe.
        excess = np.abs(np.diff(alarm, 2, axis=1)).max(axis=1)
        grazing = (self.state == STUCK) & (alarm[:, : last + 1].max(axis=1) + excess > 0.0)
        found = [(t[last - 1], t[last])] if reached.size else []
        for block in np.flatnonzero(grazing):
            peak = int(alarm[block, : last + 1].argmax())
            low, high = t[max(peak - 1, 0)], t[min(peak + 1, last)]
            best = minimize_scalar(
                lambda time, block=block: -self._alarm(dense, np.array([time]))[block, 0],
                bounds=(low, high),
                options={"xatol": 1e-9 * (high - low)},
            )
            if best.fun <= 0.0 and best.x > low:
                found.append((low, float(best.x)))
        return min(found, key=lambda pair: pair[1], default=None)


def _unit(vectors: Array) -> Array:
    """Unit vectors along the first axis; zero where the vector is zero."""
    return vectors / _positive(np.hypot(*vectors))


def _positive(lengths: Array) -> Array:
    """The same with ones in place of zeros, to divide by."""
    return np.where(lengths > 0.0, lengths, 1.0)


def solve(
    surface: Surface,
    material: Material = Material(),  # noqa: B008  (frozen)
    duration: float = 1.3e-4,
    sample_interval: float = SAMPLE_INTERVAL,
    accuracy: float = ACCURACY,
) -> Reference:
    """Solve the model for one surface, from rest at t = 0, pulled along x.

    Duration and interval are in s; `accuracy` is the relative tolerance of each step, the default
    or less, see `STOP_SPEED`.
    Raises ValueError where the law of friction is not Coulomb's.
    """
    if material.law != "coulomb":
        raise ValueError(f"law must be coulomb for the reference solution, not {material.law}")
    force_unit, length_unit, time_unit = _units(material)
    # a millionth of an interval keeps the last sample where the quotient is rounded down
    samples = np.arange(int(duration / sample_interval + 1e-6) + 1.0) * sample_interval
    times = np.minimum(samples, duration) / time_unit
    system = _System(surface, material, times)
    t_det = np.full(system.n, np.nan)
    y = np.zeros(4 * system.n + 3)  # at rest, unstrained
    while (left := duration / time_unit - system.offset) > 0.0:
        elapsed, y, due = system.advance(y, left, accuracy)
        system.offset = system.offset + elapsed if due.any() else duration / time_unit
        detaching = system.switch(y, due)
        t_det[detaching & np.isnan(t_det)] = system.offset * time_unit
    force = np.array(system.force)
    peak = int(force.argmax())
    return Reference(
        time=samples,
        force=force * force_unit,
        t_det=t_det.reshape(surface.contact.shape),
        displacement=length_unit * y[: 2 * system.n].reshape(2, *surface.contact.shape),
        static_friction=float(force[peak]) / system.n,
        t_max=float(samples[peak]),
        t_avg=float(np.nanmean(t_det)) if np.isfinite(t_det).any() else float("nan"),
        relative_residual=system.residual(y),
    )
