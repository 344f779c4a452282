"""The model in NumPy, one equation per line, in the order and the symbols of docs/model.md.

All blocks are computed in all steps, in SI units and without optimisation. The compiled solver is
compared with it step by step (`tests/validation/test_specification.py`):

    from springblock import Pattern, Surface
    from springblock.specification import follow

    for state in follow(Surface.draw(Pattern.flat(6).contact, seed=0), steps=5000):
        ...
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from inspect import signature
from typing import Any

import numpy as np
from numpy.typing import NDArray

from springblock.model.direction import heading
from springblock.model.law import LawFile
from springblock.model.material import Material
from springblock.model.surface import Surface
from springblock.simulation.setup import DEFAULT, Setup

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
#: State variables of sliding blocks by name, (N_y, N_x) each.
Memory = dict[str, Array]

#: Neighbours of a block, as offsets along y and x.
_NEIGHBOURS = [(0, 1), (0, -1), (1, 0), (-1, 0), (1, 1), (-1, -1), (1, -1), (-1, 1)]
#: Nodes and weights of the Runge-Kutta method, and the node of the next stage.
_STAGES = ((0.0, 1 / 6, 0.5), (0.5, 1 / 3, 0.5), (0.5, 1 / 3, 1.0), (1.0, 1 / 6, 0.0))


@dataclass(frozen=True)
class Law:
    """A law of friction; its functions receive constants, state and motion by argument name."""

    friction: Callable[..., Any]  #: mu of blocks that slide
    update: Callable[..., Any] | None  #: state after a step, in the order of `initial`
    initial: dict[str, float]  #: state of a block that detaches
    constants: dict[str, Any]

    @classmethod
    def of(cls, material: Material) -> "Law":
        """Return the law of a material; functions from a file take numbers, not arrays."""
        law = material.law
        if not isinstance(law, LawFile):
            return cls(LAWS[law], slipped, {"slip": 0.0}, dict(material.items()))
        return cls(law.friction, law.update if law.initial else None, law.initial, law.constants)

    def call(self, function: Callable[..., Any], memory: Memory, **motion: Any) -> Any:
        """Call `friction` or `update` with the arguments that it names."""
        known = {**self.constants, **memory, **motion}
        arguments = [known[name] for name in signature(function).parameters]
        return (function if function in OF_ARRAYS else np.vectorize(function))(*arguments)

    def after(self, memory: Memory, speed: Array, step: float) -> Memory:
        """State after a step at this mean speed."""
        if self.update is None:
            return {}
        after = self.call(self.update, memory, speed=speed, step=step)
        return dict(zip(self.initial, after if len(self.initial) > 1 else (after,), strict=True))


@dataclass(frozen=True)
class Problem:
    """Surface, setup and sliding direction of a run, as arguments of `simulate`."""

    surface: Surface
    setup: Setup
    direction: str | float

    @property
    def material(self) -> Material:
        """Material of the setup."""
        return self.setup.material

    @cached_property
    def law(self) -> Law:
        """Law of the material."""
        return Law.of(self.material)

    @cached_property
    def load(self) -> Array:
        """F_n of each block, N: blocks in contact share the whole load, (4)."""
        contact = self.surface.contact
        load = self.material.block_load * contact.size / contact.sum()
        return np.where(contact, load, 0.0)

    @cached_property
    def strength(self) -> Array:
        """mu_s F_n of each block, N."""
        return self.surface.mu_static * self.load

    @property
    def fresh(self) -> Memory:
        """State of blocks that detach."""
        return {name: np.full_like(self.load, value) for name, value in self.law.initial.items()}

    def slider(self, steps: float) -> Array:
        """Displacement v t of the slider at t = `steps` h, (2, 1, 1) m."""
        velocity = self.material.slider_velocity * np.array(heading(self.direction))
        return velocity.reshape(2, 1, 1) * self.setup.step * steps


@dataclass
class State:
    """State of the blocks after k steps; in the leapfrog, v is the velocity half a step earlier."""

    k: int  #: steps taken
    u: Array  #: displacement, (2, N_y, N_x) m
    v: Array  #: velocity, (2, N_y, N_x) m/s
    memory: Memory  #: state variables of the law, of blocks that slide
    t_det: Array  #: first detachment, (N_y, N_x) s; infinite before
    switches: int = 0  #: switches from rest to sliding so far
    work: float = 0.0  #: work of the slider, J
    heat: float = 0.0  #: frictional heat, J
    path: float = 0.0  #: sum of v² h over blocks and steps, for the viscous heat, m²/s


def coulomb(mu_dynamic: Array) -> Array:
    """Amontons-Coulomb friction, mu_d."""
    return mu_dynamic


def slip_weakening(
    mu_static: Array,
    mu_dynamic: Array,
    slip: Array,
    speed: Array,
    step: float,
    slip_distance: float,
) -> Array:
    """Linear weakening over d_c; complete at once if a step from rest slips beyond d_c."""
    d_c, drop = slip_distance, np.maximum(mu_static - mu_dynamic, 0.0)
    at_once = (slip <= 1e-12 * speed * step) & (0.5 * speed * step >= d_c)
    return mu_dynamic + drop * np.where(at_once, 0.0, np.maximum(1.0 - slip / d_c, 0.0))


def velocity_weakening(
    mu_static: Array, mu_dynamic: Array, speed: Array, speed_scale: float
) -> Array:
    """Friction decreases with speed, at v_c by half of mu_s - mu_d."""
    return mu_dynamic + np.maximum(mu_static - mu_dynamic, 0.0) / (1.0 + speed / speed_scale)


def slipped(slip: Array, speed: Array, step: float) -> Array:
    """Slip since the release of a block."""
    return slip + speed * step


LAWS: dict[str, Callable[..., Array]] = {
    "coulomb": coulomb,
    "slip_weakening": slip_weakening,
    "velocity_weakening": velocity_weakening,
}
OF_ARRAYS = (*LAWS.values(), slipped)  #: functions that take arrays


def follow(
    surface: Surface, setup: Setup = DEFAULT, direction: str | float = "x", steps: int = 1000
) -> Iterator[State]:
    """Pull a surface from rest; yield its state after each of `steps` steps.

    Other arguments are those of `simulate`.
    """
    problem, shape = Problem(surface, setup, direction), surface.contact.shape
    zero, never = np.zeros((2, *shape)), np.full(shape, np.inf)
    state = State(0, zero, zero, problem.fresh, never)
    for _ in range(steps):
        state = INTEGRATORS[setup.integrator](problem, state)
        yield state


def spring_force(problem: Problem, u: Array) -> Array:
    """Sum of F_int over the springs of each block, (2); (2, N_y, N_x) N."""
    (n_y, n_x), k_int = problem.surface.contact.shape, problem.material.k_int
    y, x = np.mgrid[:n_y, :n_x]
    force = np.zeros_like(u)
    for j, i in _NEIGHBOURS:
        there = (y + j) % n_y, (x + i) % n_x
        joined = problem.surface.periodic | ((y + j == there[0]) & (x + i == there[1]))
        rest = np.array([i, j], float).reshape(2, 1, 1) * problem.material.spacing
        apart = u[:, *there] - u  # r_j - r_i less the rest vector
        length = np.hypot(*(rest + apart))
        # r - L without cancellation: (r² - L²)/(r + L)
        longer = np.sum((2.0 * rest + apart) * apart, axis=0) / (length + np.hypot(*rest))
        stiffness = k_int if i * j == 0 else k_int / 2.0
        force += np.where(joined, stiffness * longer / length, 0.0) * (rest + apart)
    return force


def motive_force(problem: Problem, u: Array, steps: float) -> Array:
    """F_mot = F_int + K_s (v t - u) at t = `steps` h, (1) and (3); (2, N_y, N_x) N."""
    return spring_force(problem, u) + problem.material.k_s * (problem.slider(steps) - u)


def resistance(
    problem: Problem, tau: float, memory: Memory, speed: Array, share: Array | float
) -> Array:
    """Velocity T that friction removes in one step, at the mean speed V = speed + share T.

    Of several solutions V the largest is taken, which a decelerating block reaches first. Without a
    solution T is infinite: the block stops. If friction increases with V, the solution is unique.
    """
    law, surface = problem.law, problem.surface
    own = {"mu_static": surface.mu_static, "mu_dynamic": surface.mu_dynamic}

    def friction_at(mean: Array) -> Array:
        mu = law.call(law.friction, memory, **own, speed=mean, step=problem.setup.step) + 0.0 * mean
        return tau / problem.material.mass * problem.load * mu

    share = np.asarray(share)
    if not share.any():
        return friction_at(speed)
    still = np.zeros_like(speed)
    low, high = still, np.maximum(speed, speed + share * friction_at(still))
    mean, rises = high, friction_at(high) > friction_at(still)
    bisected = rises | (share > 0.0)
    for _ in range(2000):  # pragma: no branch - far fewer halvings leave no number between
        right = speed + share * friction_at(mean)
        low, high = np.where(mean < right, mean, low), np.where(mean < right, high, mean)
        found = np.maximum(np.where(bisected, 0.5 * (low + high), right), 0.0)
        if np.array_equal(found, mean):
            break
        mean = found
    return np.where(bisected | (mean > 0.0), friction_at(mean), np.inf)


def leapfrog(problem: Problem, state: State) -> State:
    """Take one step of the leapfrog, (7), with releases by (9) to (12)."""
    m, h, gamma = problem.material.mass, problem.setup.step, problem.material.gamma
    a = np.exp(-gamma * h)
    tau = (1.0 - a) / gamma if gamma else h
    k, u, v, contact = state.k, state.u, state.v, problem.surface.contact
    force = motive_force(problem, u, k)
    w = a * v + tau / m * force
    w_dot_v = np.sum(v * w, axis=0)
    mean = np.where(w_dot_v > 0.0, v + w, w)
    end = _share_of_end(problem, tau, state.memory, np.hypot(*v))
    at = np.where(w_dot_v > 0.0, (1.0 - end) * v, 0.0) + end * w
    friction = resistance(problem, tau, state.memory, np.hypot(*at), -end)
    fresh = problem.fresh
    held = (w_dot_v <= 0.0) & (np.hypot(*force) <= problem.strength)
    slides = (np.hypot(*w) > friction) & ~held
    with np.errstate(invalid="ignore"):
        new = np.where(slides, w - friction * mean / np.hypot(*mean), 0.0)
    memory = _where(slides, problem.law.after(state.memory, np.hypot(*new), h), fresh)
    loss = m / tau * np.sum((w - new) * (v + new), axis=0) * h / 2.0
    t_det = np.where(contact & slides, np.minimum(state.t_det, k * h), state.t_det)
    switched = contact & slides & (w_dot_v <= 0.0)

    # Releases within the step, (9) to (12)
    released = contact & slides & (np.hypot(*v) == 0.0)
    at_rest = resistance(problem, tau, fresh, 0.0 * w_dot_v, 0.0) * m / tau
    threshold = np.maximum(problem.strength, at_rest)
    before = u - h * _velocity_before(problem, tau, state.memory, force, new)
    before = np.hypot(*motive_force(problem, before, k - 1))
    released &= before <= threshold
    theta = np.where(released, np.hypot(*force) - threshold, 0.0)
    theta = np.maximum(theta, 0.0) / np.where(released, np.hypot(*force) - before, 1.0)
    t_det = np.where(released & (t_det == k * h), (k - theta) * h, t_det)
    k_int, k_s = problem.material.k_int, problem.material.k_s
    epsilon = h * tau / m * (k_s + 6.0 * k_int) / 4.0
    theta = theta + epsilon * (0.5 - theta)
    slip, speed, size = theta**2 / 2.0 - epsilon / 8.0, 0.5 + theta, np.hypot(*new)
    memory = _where(released, problem.law.after(fresh, (slip + speed) * size, h), memory)
    friction_work = m / tau * h * resistance(problem, tau, fresh, 0.5 * size, 0.0) * size
    credit = 0.125 - epsilon / 8.0 - h * tau / m * (k_s + 3.0 * k_int) / 2.0 * slip**2
    heat = friction_work * (slip + (theta - 0.5) / 2.0) + m / tau * h * size**2 * credit
    loss = loss + np.where(released, heat, 0.0)
    u = u + h * np.where(released, slip + speed, 1.0) * new
    v = np.where(released, speed, 1.0) * new
    path = h * float(np.sum(v**2))
    return _with_ledger(problem, State(k + 1, u, v, memory, t_det), state, switched, loss, path)


def _with_ledger(
    problem: Problem, now: State, before: State, switched: Mask, loss: Array, path: float
) -> State:
    """Return `now` with the ledger of `before` and of this step; `loss` is frictional heat, J."""
    pull = problem.material.k_s * (problem.slider(now.k) - now.u)
    return replace(
        now,
        switches=before.switches + int(switched.sum()),
        work=before.work + float(np.sum(pull * problem.slider(1))),
        heat=before.heat + float(loss[problem.surface.contact].sum()),
        path=before.path + path,
    )


def _where(chosen: Mask, memory: Memory, other: Memory) -> Memory:
    """Combine two states: `memory` where blocks are chosen, `other` elsewhere."""
    return {name: np.where(chosen, memory[name], other[name]) for name in memory}


def _share_of_end(problem: Problem, tau: float, memory: Memory, speed: Array) -> Array:
    """Weight of the velocity after a step in the velocity at which friction is evaluated.

    1/2, but more if friction increases so steeply with speed that the velocity would oscillate.
    """
    slow = resistance(problem, tau, memory, speed, 0.0)
    rise = resistance(problem, tau, memory, 2.0 * speed, 0.0) - slow
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where((speed > 0.0) & (rise > speed), np.maximum(0.5, 1.0 - speed / rise), 0.5)


def _velocity_before(
    problem: Problem, tau: float, memory: Memory, force: Array, new: Array
) -> Array:
    """Solve (7) for v, given the velocity after the step; zero for blocks that stop in it."""
    m, a = problem.material.mass, np.exp(-problem.material.gamma * problem.setup.step)
    mean = (1.0 + a) * new - tau / m * force
    ahead = np.sign(np.sum(mean * new, axis=0))
    speed = ahead * np.hypot(*mean) / (2.0 * a)
    friction = resistance(problem, tau, memory, speed, 1.0 / (2.0 * a))
    with np.errstate(invalid="ignore"):
        w = new + friction * ahead * mean / np.hypot(*mean)
    return np.where(new.any(axis=0), (w - tau / m * force) / a, 0.0)


def runge_kutta(problem: Problem, state: State) -> State:
    """Take one step of the Runge-Kutta method, (8), with releases by (9), (12) and (13)."""
    m, h, gamma = problem.material.mass, problem.setup.step, problem.material.gamma
    k, u, v, contact = state.k, state.u, state.v, problem.surface.contact
    force = motive_force(problem, u, k)
    size, rests = np.hypot(*force), contact & (np.hypot(*v) == 0.0)
    at_rest = resistance(problem, h, state.memory, h / m * size / 2.0, -0.5)
    friction = np.where(rests, at_rest, resistance(problem, h, state.memory, np.hypot(*v), 0.0))
    released = rests & (size > problem.strength) & (h / m * size > friction)
    e = _direction(problem, force, v, friction, released)
    stuck = rests & ~released

    friction = np.where(stuck, 0.0, friction)
    a = np.where(released, h / m * force - friction * e, 0.0)
    slip = np.where(released, h * np.hypot(*a) / 8.0, state.memory["slip"])
    v = np.where(released, a / 2.0, v)  # (10) with theta = 1/2
    at_release, stage_u, stage_v = friction, u, v
    du, dv, path, friction_work = h * a / 8.0, 0.0 * v, 0.0, 0.0 * size
    for node, weight, reach in _STAGES:
        memory = {"slip": slip + np.sum((stage_u - u) * e, axis=0)}
        v_e = np.sum(stage_v * e, axis=0)
        friction = resistance(problem, h, memory, np.abs(v_e), 0.0)
        force = motive_force(problem, stage_u, k + node)
        change = np.where(stuck, 0.0, h / m * force - gamma * h * stage_v - friction * e)
        du, dv = du + weight * h * stage_v, dv + weight * change
        friction_work = friction_work + weight * h * friction * v_e
        path += weight * h * float(np.sum(stage_v**2))
        stage_u, stage_v = u + reach * h * stage_v, v + reach * change

    # Releases before the step, (9), (12) and (13)
    v = np.where(released, 0.0, v)
    threshold = np.maximum(problem.strength, problem.surface.mu_dynamic * problem.load)
    before = np.where(np.hypot(*v) > 0.0, u - h * (v - dv / 2.0), u)
    before = np.hypot(*motive_force(problem, before, k - 1))
    now = np.hypot(*motive_force(problem, u, k))
    theta = np.maximum(now - threshold, 0.0) / np.where(released, now - before, 1.0)
    theta = np.where(before <= threshold, theta, 0.5)
    t_det = np.where(released, np.minimum(state.t_det, (k - theta) * h), state.t_det)
    epsilon = h**2 / m * (problem.material.k_s + 6.0 * problem.material.k_int) / 8.0
    theta = theta + epsilon * (0.5 - theta)
    extra = np.where(released, theta**2 / 2.0 - 0.125 + theta - 0.5, 0.0)
    du = du + extra * h * a
    friction_work = friction_work + (extra + 0.125) * h * at_release * np.hypot(*a)
    v = np.where(released, theta * a, v)

    new, u = v + dv, u + du
    turned = contact & (np.sum(new * e, axis=0) <= 0.0)
    lost = np.where(turned, np.sum(new**2, axis=0) / 2.0, 0.0)
    du_e = np.sum(du * e, axis=0)
    slip = np.where(turned, 0.0, np.where(released, 0.0, slip) + du_e)
    new = np.where(turned, 0.0, new)
    after, loss = State(k + 1, u, new, {"slip": slip}, t_det), m * (friction_work / h + lost)
    return _with_ledger(problem, after, state, released, loss, path)


def _direction(problem: Problem, force: Array, v: Array, friction: Array, released: Mask) -> Array:
    """Unit vectors e: of the velocity in the middle of the step, or of the force at a release.

    Under weakening laws, the velocity in the middle of the step solves the implicit equation.
    """
    m, h, gamma = problem.material.mass, problem.setup.step, problem.material.gamma
    with np.errstate(invalid="ignore", divide="ignore"):
        ahead = v / np.hypot(*v)
        back = friction if problem.law.friction is coulomb else 0.0
        middle = v + (h / m * force - back * ahead) / (2.0 * (1.0 + gamma * h) ** 2)
        on = np.sum(middle * ahead, axis=0) > 0.0
        sliding = np.where(on, middle / np.hypot(*middle), ahead)
        e = np.where(released, force / np.hypot(*force), sliding)
    return np.where(problem.surface.contact & (released | (np.hypot(*v) > 0.0)), e, 0.0)


INTEGRATORS = {"leapfrog": leapfrog, "rk4": runge_kutta}
