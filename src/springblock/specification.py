"""The model in NumPy, one equation per line, in the order and the symbols of docs/model.md.

All blocks are computed in all steps, in SI units and without optimisation. The compiled solver is
compared with it step by step (`tests/validation/test_specification.py`):

    from springblock import Pattern, Surface
    from springblock.specification import follow

    for state in follow(Surface.draw(Pattern.flat(6).contact, seed=0), steps=5000):
        ...
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from inspect import signature
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from springblock.model.direction import heading
from springblock.model.law import LawFile
from springblock.model.numbers import Array
from springblock.model.surface import Surface
from springblock.simulation.setup import DEFAULT, Setup

Mask = NDArray[np.bool_]
#: State variables of sliding blocks by name, (N_y, N_x) each.
Memory = dict[str, Array]

#: Neighbours of a block, as offsets along y and x.
_NEIGHBOURS = [(0, 1), (0, -1), (1, 0), (-1, 0), (1, 1), (-1, -1), (1, -1), (-1, 1)]
#: Nodes and weights of the Runge-Kutta method, and the node of the next stage.
_STAGES = ((0.0, 1 / 6, 0.5), (0.5, 1 / 3, 0.5), (0.5, 1 / 3, 1.0), (1.0, 1 / 6, 0.0))


# Laws of friction: mu of a sliding block, from arguments that are passed by name. Functions from
# files have the same form.


def coulomb(mu_dynamic: float) -> float:
    """Amontons-Coulomb friction, mu_d."""
    return mu_dynamic


def slip_weakening(
    mu_static: float,
    mu_dynamic: float,
    slip: float,
    speed: float,
    step: float,
    slip_distance: float,
) -> float:
    """Linear weakening over d_c; complete at once if V h >= 2 d_c in a step from rest."""
    if slip <= 1e-12 * speed * step and 0.5 * speed * step >= slip_distance:
        return mu_dynamic
    return mu_dynamic + max(mu_static - mu_dynamic, 0.0) * max(1.0 - slip / slip_distance, 0.0)


def velocity_weakening(
    mu_static: float, mu_dynamic: float, speed: float, speed_scale: float
) -> float:
    """Friction decreases with speed, at v_c by half of mu_s - mu_d."""
    return mu_dynamic + max(mu_static - mu_dynamic, 0.0) / (1.0 + speed / speed_scale)


def slipped(slip: float, speed: float, step: float) -> float:
    """Slip since the release of a block."""
    return slip + speed * step


class BuiltIn(NamedTuple):
    """A built-in law, with the attributes of a `LawFile`."""

    friction: Callable[..., float]
    constants: dict[str, Any]
    update: Callable[..., float] = slipped
    initial: dict[str, float] = {"slip": 0.0}  # noqa: RUF012 - never changed


FORMULAS: dict[str, Callable[..., float]] = {
    "coulomb": coulomb,
    "slip_weakening": slip_weakening,
    "velocity_weakening": velocity_weakening,
}


class Problem:
    """Surface, setup and sliding direction of a run, as the quantities of its equations."""

    # SI units: m in kg, l in m, gamma in 1/s, k_int and k_s in N/m, h in s, v_slider (2, 1, 1).
    # contact, mu, load, fresh and f_static have a value for each block, (N_y, N_x).

    def __init__(self, surface: Surface, setup: Setup, direction: str | float) -> None:
        material, contact = setup.material, surface.contact
        surface.check_material(material)
        self.contact, self.periodic = contact, surface.periodic
        self.m, self.l, self.gamma = material.mass, material.spacing, material.gamma
        self.k_int, self.k_s, self.h = material.k_int, material.k_s, setup.step
        velocity = material.slider_velocity * np.array(heading(direction))
        self.v_slider = velocity.reshape(2, 1, 1)  #: m/s
        #: a, and tau in s, of (7); in the Runge-Kutta method forces act for the whole step
        self.a = np.exp(-self.gamma * self.h)
        damped = self.gamma and setup.integrator == "leapfrog"
        self.tau = (1.0 - self.a) / self.gamma if damped else self.h
        #: F_n of each block, N: blocks in contact share the whole load, (4)
        self.load = np.where(contact, material.block_load * contact.size / contact.sum(), 0.0)
        self.mu = {"mu_static": surface.mu_static, "mu_dynamic": surface.mu_dynamic}
        law = material.law
        self.law = (
            law if isinstance(law, LawFile) else BuiltIn(FORMULAS[law], dict(material.items()))
        )
        #: whether a block that stops forgets its state
        self.heals = material.healing == "instant"
        #: state of blocks that detach for the first time
        self.fresh = {
            name: np.full(contact.shape, value) for name, value in self.law.initial.items()
        }
        self.f_static = surface.mu_static * self.load  #: mu_s F_n, N

    def thresholds(self, memory: Memory) -> tuple[Array, Array]:
        """Force that holds a block which turns back, and F_c beyond which one at rest slides, N.

        mu_s F_n, and that or, if larger, friction at rest; without healing both are friction at
        rest.
        """
        at_rest = resistance(self, memory, np.zeros(self.contact.shape)) * self.m / self.tau
        f_static = self.f_static if self.heals else at_rest
        return f_static, np.maximum(f_static, at_rest)

    def call(self, function: Callable[..., Any], memory: Memory, speed: Array, outputs: int) -> Any:
        """Call `friction` or `update` for each block, with the arguments that it names."""
        known = {**self.law.constants, **self.mu, **memory, "speed": speed, "step": self.h}
        arguments = [known[name] for name in signature(function).parameters]
        return np.vectorize(function, otypes="d" * outputs)(*arguments)

    def after(self, memory: Memory, speed: Array) -> Memory:
        """State of sliding blocks after a step at this mean speed."""
        if not memory:
            return {}
        after = self.call(self.law.update, memory, speed, len(memory))
        return dict(zip(memory, after if len(memory) > 1 else (after,), strict=True))


@dataclass
class State:
    """State of the blocks after k steps; in the leapfrog, v is the velocity half a step earlier."""

    k: int  #: steps taken
    u: Array  #: displacement, (2, N_y, N_x) m
    v: Array  #: velocity, (2, N_y, N_x) m/s
    memory: Memory  #: state variables of the law, of blocks that slide
    t_det: Array  #: first detachment, (N_y, N_x) s; infinite before
    switches: int = 0  #: switches to sliding so far, from rest or by turning back
    work: float = 0.0  #: work of the slider, J
    heat: float = 0.0  #: frictional heat, J
    path: float = 0.0  #: sum of v² h over blocks and steps, for the viscous heat, m²/s


def follow(
    surface: Surface, setup: Setup = DEFAULT, direction: str | float = "x", steps: int = 1000
) -> Iterator[State]:
    """Pull a surface from rest; yield its state after each of `steps` steps.

    Other arguments are those of `simulate`.
    """
    problem, zero = Problem(surface, setup, direction), np.zeros((2, *surface.contact.shape))
    state = State(0, zero, zero, problem.fresh, np.full(surface.contact.shape, np.inf))
    for _ in range(steps):
        state = SCHEMES[setup.integrator](problem, state)
        yield state


def motive_force(problem: Problem, u: Array, steps: float) -> Array:
    """F_mot at t = `steps` h, (1): F_int of the springs, (2), and F_s, (3); (2, N_y, N_x) N."""
    n_y, n_x = problem.contact.shape
    y, x = np.mgrid[:n_y, :n_x]
    force = problem.k_s * (problem.v_slider * problem.h * steps - u)
    for j, i in _NEIGHBOURS:
        there = (y + j) % n_y, (x + i) % n_x
        joined = problem.periodic | ((y + j == there[0]) & (x + i == there[1]))
        rest = np.array([i, j], float).reshape(2, 1, 1) * problem.l
        apart = u[:, *there] - u  # r_j - r_i less the rest vector
        length = np.hypot(*(rest + apart))
        # r - L without cancellation: (r² - L²)/(r + L)
        longer = np.sum((2.0 * rest + apart) * apart, axis=0) / (length + np.hypot(*rest))
        stiffness = problem.k_int if i * j == 0 else problem.k_int / 2.0
        force += np.where(joined, stiffness * longer / length, 0.0) * (rest + apart)
    return force


def resistance(problem: Problem, memory: Memory, speed: Array, slope: Array | float = 0.0) -> Array:
    """Velocity T that friction removes in one step, at the mean speed V = speed + slope T.

    Of several solutions V the largest is taken, which a decelerating block reaches first. Without a
    solution T is infinite: the block stops. If friction increases with V, the solution is unique.
    """

    def friction_at(mean: Array) -> Array:
        mu = problem.call(problem.law.friction, memory, mean, 1)
        return problem.tau / problem.m * problem.load * mu

    slope = np.asarray(slope)
    if not slope.any():
        return friction_at(speed)
    still = np.zeros_like(speed)
    low, high = still, np.maximum(speed, speed + slope * friction_at(still))
    mean, rises = high, friction_at(high) > friction_at(still)
    bisected = rises | (slope > 0.0)
    for _ in range(2000):  # pragma: no branch - ends long before: low and high meet
        right = speed + slope * friction_at(mean)
        low, high = np.where(mean < right, mean, low), np.where(mean < right, high, mean)
        found = np.maximum(np.where(bisected, 0.5 * (low + high), right), 0.0)
        if np.array_equal(found, mean):
            break
        mean = found
    return np.where(bisected | (mean > 0.0), friction_at(mean), np.inf)


def release_theta(problem: Problem, f_c: Array, now: Array, u_before: Array, k: int) -> Array:
    """Share θ of the step left after a release, (9), from F_c, |F_mot| at step k and u at k - 1.

    NaN if |F_mot| also exceeded F_c at k - 1: the block was at rest for an instant only.
    """
    before = np.hypot(*motive_force(problem, u_before, k - 1))
    with np.errstate(invalid="ignore", divide="ignore"):
        theta = np.maximum(now - f_c, 0.0) / (now - before)
    return np.where(before <= f_c, theta, np.nan)


def leapfrog(problem: Problem, state: State) -> State:
    """Take one step of the leapfrog, (7), with releases by (9) to (12)."""
    m, h, a, tau = problem.m, problem.h, problem.a, problem.tau
    k, u, v, contact = state.k, state.u, state.v, problem.contact
    fresh = problem.fresh if problem.heals else state.memory  # of blocks at rest
    f_static, f_c = problem.thresholds(fresh)
    force = motive_force(problem, u, k)
    w = a * v + tau / m * force
    w_dot_v = np.sum(v * w, axis=0)
    mean = np.where(w_dot_v > 0.0, v + w, w)
    weight = _end_weight(problem, state.memory, np.hypot(*v))
    at = np.where(w_dot_v > 0.0, (1.0 - weight) * v, 0.0) + weight * w
    friction = resistance(problem, state.memory, np.hypot(*at), -weight)
    held = (w_dot_v <= 0.0) & (np.hypot(*force) <= f_static)
    slides = (np.hypot(*w) > friction) & ~held
    with np.errstate(invalid="ignore"):
        new = np.where(slides, w - friction * mean / np.hypot(*mean), 0.0)
    memory = _where(slides, problem.after(state.memory, np.hypot(*new)), fresh)
    loss = m / tau * np.sum((w - new) * (v + new), axis=0) * h / 2.0
    t_det = np.where(contact & slides, np.minimum(state.t_det, k * h), state.t_det)
    switched = contact & slides & (w_dot_v <= 0.0)

    # Releases within the step, (9) to (12)
    u_before = u - h * _velocity_before(problem, state.memory, force, new)
    theta = release_theta(problem, f_c, np.hypot(*force), u_before, k)
    released = contact & slides & (np.hypot(*v) == 0.0) & np.isfinite(theta)
    theta = np.where(released, theta, 0.0)
    t_det = np.where(released & (t_det == k * h), (k - theta) * h, t_det)
    epsilon = h * tau / m * (problem.k_s + 6.0 * problem.k_int) / 4.0
    theta = theta + epsilon * (0.5 - theta)
    slip, speed, size = theta**2 / 2.0 - epsilon / 8.0, 0.5 + theta, np.hypot(*new)
    memory = _where(released, problem.after(fresh, (slip + speed) * size), memory)
    friction_work = m / tau * h * resistance(problem, fresh, 0.5 * size) * size
    stiffness = h * tau / m * (problem.k_s + 3.0 * problem.k_int)
    credit = 0.125 - epsilon / 8.0 - stiffness / 2.0 * slip**2
    heat = friction_work * (slip + (theta - 0.5) / 2.0) + m / tau * h * size**2 * credit
    loss = loss + np.where(released, heat, 0.0)
    u = u + h * np.where(released, slip + speed, 1.0) * new
    v = np.where(released, speed, 1.0) * new
    path = h * float(np.sum(v**2))
    return _with_ledger(problem, state, State(k + 1, u, v, memory, t_det), switched, loss, path)


def _with_ledger(
    problem: Problem, before: State, now: State, switched: Mask, loss: Array, path: float
) -> State:
    """Return `now` with the ledger of `before` and of this step; `loss` is frictional heat, J."""
    slide = problem.v_slider * problem.h
    pull = problem.k_s * (slide * now.k - now.u)
    now.switches = before.switches + int(switched.sum())
    now.work = before.work + float(np.sum(pull * slide))
    now.heat = before.heat + float(loss[problem.contact].sum())
    now.path = before.path + path
    return now


def _where(chosen: Mask, memory: Memory, other: Memory) -> Memory:
    """Combine two states: `memory` where blocks are chosen, `other` elsewhere."""
    return {name: np.where(chosen, memory[name], other[name]) for name in memory}


def _end_weight(problem: Problem, memory: Memory, speed: Array) -> Array:
    """Weight β of v⁺, the velocity after a step: friction acts at (1 - β) v + β v⁺.

    1/2, but more if friction increases so steeply with speed that the velocity would oscillate.
    """
    rise = resistance(problem, memory, 2.0 * speed) - resistance(problem, memory, speed)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where((speed > 0.0) & (rise > speed), np.maximum(0.5, 1.0 - speed / rise), 0.5)


def _velocity_before(problem: Problem, memory: Memory, force: Array, new: Array) -> Array:
    """Solve (7) for v, given the velocity after the step; zero for blocks that stop in it."""
    a, kick = problem.a, problem.tau / problem.m * force
    mean = (1.0 + a) * new - kick
    ahead = np.sign(np.sum(mean * new, axis=0))
    friction = resistance(problem, memory, ahead * np.hypot(*mean) / (2.0 * a), 1.0 / (2.0 * a))
    with np.errstate(invalid="ignore"):
        w = new + friction * ahead * mean / np.hypot(*mean)
    return np.where(new.any(axis=0), (w - kick) / a, 0.0)


def runge_kutta(problem: Problem, state: State) -> State:
    """Take one step of the Runge-Kutta method, (8), with releases by (9), (12) and (13)."""
    m, h, gamma = problem.m, problem.h, problem.gamma
    k, u, v, contact = state.k, state.u, state.v, problem.contact
    force = motive_force(problem, u, k)
    size, rests = np.hypot(*force), contact & (np.hypot(*v) == 0.0)
    at_rest = resistance(problem, state.memory, h / m * size / 2.0, -0.5)
    friction = np.where(rests, at_rest, resistance(problem, state.memory, np.hypot(*v)))
    f_static, f_c = problem.thresholds(problem.fresh)
    released = rests & (size > f_static) & (h / m * size > friction)
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
        friction = resistance(problem, memory, np.abs(v_e))
        force = motive_force(problem, stage_u, k + node)
        change = np.where(stuck, 0.0, h / m * force - gamma * h * stage_v - friction * e)
        du, dv = du + weight * h * stage_v, dv + weight * change
        friction_work = friction_work + weight * h * friction * v_e
        path += weight * h * float(np.sum(stage_v**2))
        stage_u, stage_v = u + reach * h * stage_v, v + reach * change

    # Releases before the step, (9), (12) and (13)
    v = np.where(released, 0.0, v)
    u_before = np.where(np.hypot(*v) > 0.0, u - h * (v - dv / 2.0), u)
    theta = release_theta(problem, f_c, size, u_before, k)
    theta = np.where(np.isnan(theta), 0.5, theta)
    t_det = np.where(released, np.minimum(state.t_det, (k - theta) * h), state.t_det)
    epsilon = h**2 / m * (problem.k_s + 6.0 * problem.k_int) / 8.0
    theta = theta + epsilon * (0.5 - theta)
    extra = np.where(released, theta**2 / 2.0 - 0.125 + theta - 0.5, 0.0)
    du = du + extra * h * a
    friction_work = friction_work + (extra + 0.125) * h * at_release * np.hypot(*a)
    v = np.where(released, theta * a, v)

    new, u = v + dv, u + du
    turned = contact & (np.sum(new * e, axis=0) <= 0.0)
    lost = np.where(turned, np.sum(new**2, axis=0) / 2.0, 0.0)
    slip = np.where(turned, 0.0, np.where(released, 0.0, slip) + np.sum(du * e, axis=0))
    new = np.where(turned, 0.0, new)
    after, loss = State(k + 1, u, new, {"slip": slip}, t_det), m * (friction_work / h + lost)
    return _with_ledger(problem, state, after, released, loss, path)


def _direction(problem: Problem, force: Array, v: Array, friction: Array, released: Mask) -> Array:
    """Unit vectors e: of the velocity in the middle of the step, or of the force at a release.

    Under weakening laws, that velocity is found with friction along e itself.
    """
    m, h, gamma = problem.m, problem.h, problem.gamma
    with np.errstate(invalid="ignore", divide="ignore"):
        ahead = v / np.hypot(*v)
        back = friction if problem.law.friction is coulomb else 0.0
        middle = v + (h / m * force - back * ahead) / (2.0 * (1.0 + gamma * h) ** 2)
        on = np.sum(middle * ahead, axis=0) > 0.0
        sliding = np.where(on, middle / np.hypot(*middle), ahead)
        e = np.where(released, force / np.hypot(*force), sliding)
    return np.where(problem.contact & (released | (np.hypot(*v) > 0.0)), e, 0.0)


SCHEMES = {"leapfrog": leapfrog, "rk4": runge_kutta}
