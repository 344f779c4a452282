"""Stiff and extreme cases: the rows of results/tables/stability.parquet.

Every case says what it expects, in a word, and measures what comes out. Most compare a number with
its closed form; how far it may be off follows from the order of the scheme, or from rounding:

- A release falls on the first step boundary beyond t = mu_s F_n/(K_s v), and a stop on the boundary
  of the step that holds it. What depends on them may be wrong by what changes in one step.
- While a block slides one way, or has no friction, both schemes are linear at small strains, and
  their own solution is known exactly (`scheme_path`). What is left is the strain, and rounding.

Each of these also bounds what may be missing from the energy balance (`Pull.may_miss`).

Units in the code below: forces in F_n, lengths in F_n/K_s, times in 1/omega with omega² = K_s/m,
and so speeds in F_n omega/K_s, unless they are said to be SI.

Call with `python -m validation.stability --output FILE` from the folder tests.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cache, partial
from pathlib import Path
from typing import Any

import click
import numpy as np
import pyarrow as pa
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.linalg import expm
from scipy.optimize import brentq
from scipy.sparse.linalg import LinearOperator, eigsh
from tqdm import tqdm

from scenes import flat, spring_forces, swing, uniform
from springblock import Material, Pattern, Realisation, SimulationError, draw_friction, simulate
from springblock.solver import INTEGRATORS
from springblock.solver.springs import MAX_BLOCKS
from springblock.sources import code_version
from springblock.tables import column, rows_to_table, write
from validation import reference

SCHEMA = pa.schema(
    [
        column("case", pa.string(), "1", "name of the case"),
        column("family", pa.string(), "1", "what is taken to its extremes"),
        column("integrator", pa.string(), "1", "leapfrog or rk4; both where no step is taken"),
        column(
            "parameter",
            pa.float64(),
            "1",
            "what varies within the family. step: h over the stability limit; stiffness: "
            "K_s/K_int; strain: F_n/(K_s l), how far a block slips over l; damping: gamma/omega, "
            "omega² = K_s/m; scatter: standard deviation of mu_s, twice that of mu_d; "
            "coefficients: mu_d/mu_s; speed: v K_s/(F_n omega); load: strain of the springs; "
            "size: N; rest: number of steps; overflow: the value that is too much",
        ),
        column("expected", pa.string(), "1", "outcome that the case must have"),
        column("outcome", pa.string(), "1", "outcome that it has"),
        column("energy_error", pa.float64(), "1", "energy missing over work; NaN without a run"),
        column("quantity", pa.string(), "1", "what value is"),
        column("value", pa.float64(), "1", "the quantity that is judged; NaN where there is none"),
        column("closed_form", pa.float64(), "1", "what it should be; NaN where that is unknown"),
        column("relative_error", pa.float64(), "1", "value/closed_form - 1; NaN without either"),
        column("tolerance", pa.float64(), "1", "largest relative_error that is accepted, or NaN"),
    ]
)

Array = NDArray[np.float64]

PAPER = Material()
UNDAMPED = Material(gamma=0.0)
SEED = 1
ROUNDING = 1e-12  #: relative, of a few hundred steps
#: Greatest stable omega h of a mode without damping.
STABLE = {"leapfrog": 2.0, "rk4": math.sqrt(8.0)}


@dataclass(frozen=True)
class Outcome:
    """What came out of a case."""

    outcome: str
    energy_error: float = math.nan
    value: float = math.nan
    closed_form: float = math.nan
    tolerance: float = math.nan

    @property
    def relative_error(self) -> float:
        """NaN where there is nothing to compare."""
        return self.value / self.closed_form - 1.0


@dataclass(frozen=True)
class Case:
    """One extreme, what is expected of it, and how to try."""

    name: str
    family: str
    integrator: str
    parameter: float  #: what varies within the family
    expected: str
    quantity: str  #: what `Outcome.value` is
    run: Callable[[], Outcome]

    def outcome(self) -> Outcome:
        """Run; an exception that the case did not ask for is an outcome too, and a bad one."""
        try:
            return self.run()
        except Exception as error:
            return Outcome(f"{type(error).__name__}: {error}")


# --- pulling and judging


@dataclass(frozen=True)
class Pull:
    """A material, an integrator and its step, s."""

    integrator: str
    material: Material
    step: float

    @classmethod
    def at(cls, share: float, integrator: str, material: Material) -> "Pull":
        """With this share of the largest stable step."""
        return cls(integrator, material, share * limit(integrator, material))

    @property
    def h(self) -> float:
        """The step in 1/omega."""
        return self.step * self.material.omega_min

    @property
    def slide(self) -> float:
        """What the slider goes in one step, m."""
        return self.material.slider_velocity * self.step

    def run(
        self, scene: Any, count: int | None = None, every: int = 0, **options: Any
    ) -> Realisation:
        """Take `count` steps and sample `every` so many, or at the end; without, to the minimum."""
        every = every or count or 5
        return simulate(
            *scene,
            material=self.material,
            integrator=self.integrator,
            step=self.step,
            sample_interval=every * self.step,
            duration=count and count * self.step,
            **options,
        )

    def may_miss(self, run: Realisation, contact: int) -> float:
        """What may be missing from the energy balance of `contact` blocks, over the work.

        Of a mode at a share of the stability limit, leapfrog shows between 1 - share² and all of
        its energy, to and fro; Runge-Kutta loses a share (omega h)⁶/72 in each step. The
        trapezoidal rule for the slider's work is of second order in both. High modes hold a tenth
        of the work, or two tenths. Where the run ends in the midst of sliding, friction and
        damping of one step are under way.
        """
        share = self.step / limit(self.integrator, self.material)
        drift = 0.1 * share**2 + (8.0 * share**5 if self.integrator == "rk4" else 0.0)
        speed = np.hypot(*run.velocity)
        drag = self.material.gamma * self.material.mass * float(np.sum(speed**2))
        rubbed = run.normal_force / contact * float(speed[np.isfinite(run.t_det)].sum())
        underway = (rubbed + drag) * self.step / run.energy.work_in
        return min(drift, 0.2) + underway + 1e-15 * run.steps  # rounding

    def judge(
        self,
        run: Realisation,
        value: float,
        closed_form: float,
        tolerance: float,
        contact: int | None = None,
    ) -> Outcome:
        """Compare with the closed form, and the energy residual with what it may be."""
        residual = run.energy.relative_residual
        word = "agrees"
        if not abs(residual) <= self.may_miss(run, contact or run.t_det.size):
            word = f"energy is off by {residual:.2g}"
        if not abs(value / closed_form - 1.0) <= tolerance:
            word = f"is off by {value / closed_form - 1.0:.2g}"
        return Outcome(word, residual, float(value), float(closed_form), float(tolerance))


def limit(integrator: str, material: Material) -> float:
    """Largest stable step, s, by bisection of the integrator's own criterion."""
    omega = np.linspace(material.omega_min, material.omega_max, 33)
    is_stable = INTEGRATORS[integrator].is_stable
    stable, unstable = 0.0, 4.0 * (1.0 + material.gamma / material.omega_max) / material.omega_max
    for _ in range(50):
        middle = 0.5 * (stable + unstable)
        if is_stable(middle, omega, material.gamma):
            stable = middle
        else:
            unstable = middle
    return stable


def pulled_at(speed: float, material: Material) -> Material:
    """`material` under a slider of this speed."""
    unit = material.block_load * material.omega_min / material.k_s
    return replace(material, slider_velocity=speed * unit)


def release(material: Material, threshold: float) -> float:
    """Time at which a block lets go whose neighbours do not pull, s."""
    return threshold * material.block_load / (material.k_s * material.slider_velocity)


def refusal(call: Callable[[], object], reason: str) -> Outcome:
    """Whether a ValueError that says `reason` comes before any step."""
    return _end(call, reason, ValueError, "refused")


def failure(call: Callable[[], object], reason: str) -> Outcome:
    """Whether the run ends with a SimulationError that says `reason`."""
    return _end(call, reason, SimulationError, "raises")


def _end(call: Callable[[], object], reason: str, kind: type[Exception], word: str) -> Outcome:
    try:
        with np.errstate(all="ignore"):  # the exception has to come without NumPy's warnings
            call()
    except kind as error:
        return Outcome(word if reason in str(error) else str(error))
    return Outcome("ends as if nothing were wrong")


def turn(phase: Array | float) -> Any:
    """Factor of a mode per Runge-Kutta step: the Taylor polynomial of exp(i omega h)."""
    z = 1j * np.asarray(phase)
    return 1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0)))


def scheme_path(
    integrator: str, phase: Array, released: int, taken: int, friction: float = 0.0
) -> Array:
    """Displacement of modes (k,) of phase omega h, `taken` steps after step number `released`.

    Exact solution of the schemes for u" = omega² (t - friction - u), from u = u' = 0 at t =
    released; time in steps, length in what the slider goes in one. It is the straight line
    t - friction, and the scheme's own oscillation about it.
    """
    start = released - friction
    if integrator == "leapfrog":  # sin(theta/2) = omega h/2; u = 0 also one step before
        theta = 2.0 * np.arcsin(phase / 2.0)
        ahead = (1.0 - start * (1.0 - np.cos(theta))) / np.sin(theta)
        ringing = start * np.cos(taken * theta) + ahead * np.sin(taken * theta)
    else:
        turned = turn(phase) ** taken
        ringing = start * turned.real + turned.imag / phase
    return start + taken - ringing


# --- step: both stability limits

#: Avalanches on pillars excite the highest modes.
PILLARS = Pattern.pillars(8, 2, 2)
SHARES = (0.05, 0.1, 0.2, 0.5, 0.8, 0.9, 0.95, 0.99)
BEYOND = (1.001, 1.01, 1.5, 10.0)
SYRUP = Material(gamma=10.0 * PAPER.omega_max, slider_velocity=5e-3)
#: Ten times the paper's pressure, on a quarter of the blocks: they slip by 0.27 l.
HEAVY = pulled_at(1e-3, replace(PAPER, pressure=10.0 * PAPER.pressure))


def limit_of_damping(integrator: str, material: Material) -> float:
    """Largest stable step far overdamped, s.

    Leapfrog's omega² h/gamma stays below 2. In Runge-Kutta, the fastest decay of all, that of the
    lowest mode, stays within the real interval where |1 + z + z²/2 + z³/6 + z⁴/24| < 1.
    """
    gamma = material.gamma
    if integrator == "leapfrog":
        return 2.0 * gamma / material.omega_max**2
    decay = gamma / 2.0 + math.sqrt(gamma**2 / 4.0 - material.omega_min**2)
    return 2.785293563405282 / decay


def pull_pillars(pull: Pull) -> Realisation:
    """Until all pillars have slipped, sampled as in the paper."""
    scene = PILLARS.contact, *draw_friction(PILLARS.n_blocks, SEED)
    return pull.run(scene, every=max(1, round(2e-7 / pull.step)))


def near_the_limit(integrator: str, material: Material, share: float) -> Outcome:
    """Too long a step shows in the energy first."""
    pull = Pull.at(share, integrator, material)
    run = pull_pillars(pull)
    residual = run.energy.relative_residual
    bounded = abs(residual) <= pull.may_miss(run, np.count_nonzero(PILLARS.contact))
    return Outcome("stable" if bounded else "drifts", residual, run.static_friction)


def near_the_limit_of_damping(integrator: str, share: float) -> Outcome:
    """Static friction beside that at a fifth of the limit; overdamped, blocks only creep.

    It may be off by what the slider adds in a step, v h, and that is much for leapfrog.
    Energy is not asked for. Runge-Kutta's ledger takes the heat of damping from the velocities of
    the stages, which overshoot beyond gamma h = 1: close to the limit it books many times too much.
    """
    pull = Pull.at(share, integrator, SYRUP)
    run, fine = (pull_pillars(p) for p in (pull, Pull.at(0.2, integrator, SYRUP)))
    value, closed_form = run.static_friction, fine.static_friction
    tolerance = pull.step / release(SYRUP, 1.0) / closed_form
    word = "bounded" if abs(value / closed_form - 1.0) <= tolerance else "disagrees"
    return Outcome(word, run.energy.relative_residual, value, closed_form, tolerance)


def beyond_the_limit(integrator: str, material: Material, step: float, largest: float) -> Outcome:
    """The message names the limit in four digits, found by bisection to 1e-4; both in s."""
    try:
        pull_pillars(Pull(integrator, material, step))
    except ValueError as error:
        named, tolerance = float(str(error).split("less than ")[1].split()[0]), 1e-3
        word = "refused" if abs(named / largest - 1.0) <= tolerance else "names another limit"
        unit = 1.0 / material.omega_max
        return Outcome(word, math.nan, named / unit, largest / unit, tolerance)
    return Outcome("accepted")


@cache
def highest_mode(n: int) -> tuple[float, Array]:
    """Largest m omega²/K_int of the actual springs, and its mode (2, N, N)."""
    tiny, size = 1e-9, 2 * n * n

    def pull_back(mode: Array) -> Array:
        return -spring_forces(tiny * mode.reshape(2, n, n)).ravel() / tiny

    start = np.random.default_rng(SEED).standard_normal(size)
    springs = LinearOperator((size, size), matvec=pull_back, dtype=float)
    values, modes = eigsh(springs, k=1, which="LA", v0=start, tol=1e-9)
    return float(values[0]), modes[:, 0].reshape(2, n, n)


def limit_of_the_springs(n: int) -> Outcome:
    """A finite lattice has a mode close to (π, 0), and none beyond; it is off by some (π/N)²."""
    omega = math.sqrt((PAPER.k_s + PAPER.k_int * highest_mode(n)[0]) / PAPER.mass)
    value, tolerance = omega / PAPER.omega_max, (math.pi / n) ** 2
    word = "just below" if 1.0 - tolerance <= value <= 1.0 else "elsewhere"
    return Outcome(word, math.nan, value, 1.0, tolerance)


def swing_of_the_highest_mode(integrator: str, share: float) -> Outcome:
    """The highest mode of 8 x 8 blocks alone, by the compiled loop, beside the scheme's factor.

    From 1e-9 spacings it grows to 2e-5, and is non-linear by the square of that.
    """
    steps, tiny, tolerance = 30, 1e-9, 1e-6
    eigenvalue, mode = highest_mode(8)
    omega = math.sqrt((UNDAMPED.k_s + UNDAMPED.k_int * eigenvalue) / UNDAMPED.mass)
    phase = share * STABLE[integrator]
    value = float(np.vdot(mode, swing(tiny * mode, steps, phase / omega, integrator))) / tiny
    if integrator == "leapfrog":  # from rest half a step before: cos((k + 1/2) theta)
        half = np.arcsin(complex(phase / 2.0))
        closed_form = float((np.cos((2 * steps + 1) * half) / np.cos(half)).real)
        bound = 1.0 / abs(np.cos(half))
    else:
        closed_form, bound = float((turn(phase) ** steps).real), 1.0
    word = "bounded" if abs(value) <= bound else "grows"
    if not abs(value / closed_form - 1.0) <= tolerance:
        word = "disagrees"
    return Outcome(word, math.nan, value, closed_form, tolerance)


def step_cases(integrator: str) -> Iterator[Case]:
    """Up to the limit and beyond."""
    case = partial(Case, family="step", integrator=integrator)
    friction, largest = "static friction", "omega_max times the largest step"
    for share in SHARES:
        yield case(
            name=f"pillars at {share:.0%} of the limit, {integrator}",
            parameter=share,
            expected="stable",
            quantity=friction,
            run=partial(near_the_limit, integrator, PAPER, share),
        )
    edge = STABLE[integrator] / PAPER.omega_max
    for share in BEYOND:
        yield case(
            name=f"pillars at {share:g} times the limit, {integrator}",
            parameter=share,
            expected="refused",
            quantity=largest,
            run=partial(beyond_the_limit, integrator, PAPER, share * edge, edge),
        )
    yield case(
        name=f"strained pillars at 99% of the limit, {integrator}",
        parameter=0.99,
        expected="stable",
        quantity=friction,
        run=partial(near_the_limit, integrator, HEAVY, 0.99),
    )
    yield case(
        name=f"overdamped pillars at 99% of the limit, {integrator}",
        parameter=0.99,
        expected="bounded",
        quantity=friction,
        run=partial(near_the_limit_of_damping, integrator, 0.99),
    )
    edge = limit_of_damping(integrator, SYRUP)
    yield case(
        name=f"overdamped pillars at 1.01 times the limit, {integrator}",
        parameter=1.01,
        expected="refused",
        quantity=largest,
        run=partial(beyond_the_limit, integrator, SYRUP, 1.01 * edge, edge),
    )
    for share, expected in ((0.99, "bounded"), (1.01, "grows")):
        yield case(
            name=f"highest mode at {share:.0%} of its limit, {integrator}",
            parameter=share,
            expected=expected,
            quantity="amplitude after 30 steps",
            run=partial(swing_of_the_highest_mode, integrator, share),
        )


# --- damping, speed, coefficients: one block


def force_at_the_end(pull: Pull, run: Realisation) -> float:
    """Spring force on the one block, along the slide."""
    length = pull.material.block_load / pull.material.k_s
    end = pull.material.slider_velocity * run.time[-1]
    return float(end - run.displacement[0, 0, 0]) / length


def damped(gamma: float) -> Array:
    """Motion of (x, x') for x" + gamma x' + x = 0."""
    return np.array([[0.0, 1.0], [-1.0, -gamma]])


def force_while_slipping(integrator: str, gamma: float) -> Outcome:
    """x = F - mu_d - gamma v swings or creeps back from mu_s with the slope v.

    A release late by up to h, and leapfrog's half a step early, shift it by h at most.
    Runge-Kutta must resolve the damping; leapfrog integrates it exactly and needs not.
    """
    speed, mu_static, mu_dynamic = 0.01, 1.0, 0.6
    material = pulled_at(speed, replace(PAPER, gamma=gamma * PAPER.omega_min))
    slow = max(1.0, gamma)  # time in which the force falls
    step = 1e-3 * slow / material.omega_min
    if integrator == "rk4":
        step = min(step, 0.5 * limit(integrator, material))
    pull = Pull(integrator, material, step)
    count = math.ceil((mu_static / speed + slow) / pull.h)
    run = pull.run(uniform(1, mu_static, mu_dynamic), count)
    tau, far = count * pull.h - mu_static / speed, mu_dynamic + gamma * speed
    x = expm(tau * damped(gamma)) @ [mu_static - far, speed]
    closed_form, steepest = far + x[0], max(abs(mu_static - far) / slow, speed)
    tolerance = 2.0 * steepest * pull.h / closed_form
    return pull.judge(run, force_at_the_end(pull, run), closed_form, tolerance)


def force_after_slip(
    integrator: str, speed: float, mu_static: float, mu_dynamic: float, gamma: float = 0.0
) -> Outcome:
    """What the spring is left with, at any speed: 2 mu_d - mu_s without damping.

    Then, seen from the slider, the block leaves and arrives with -v, and the slip lasts
    2 (π - atan((mu_s - mu_d)/v)). With damping, the block is at rest when x' is v again. Its
    start and its stop fall on step boundaries, each worth 2 v h, and the stop misses the turning
    point by (mu_s - mu_d) h².
    """
    drop, far = mu_static - mu_dynamic, mu_dynamic + gamma * speed
    material = pulled_at(speed, replace(PAPER, gamma=gamma * PAPER.omega_min))
    pull = Pull(integrator, material, min(0.02, 2e-3 / speed) / material.omega_min)
    lasts, closed_form = 2.0 * (math.pi - math.atan(drop / speed)), 2.0 * mu_dynamic - mu_static
    if gamma:
        start = [mu_static - far, speed]
        lasts = brentq(lambda t: (expm(t * damped(gamma)) @ start)[1] - speed, 2.0, 5.0)
        closed_form = far + (expm(lasts * damped(gamma)) @ start)[0]
    stop = mu_static / speed + lasts
    count = math.ceil((stop + min(1.0, drop / speed)) / pull.h)  # before it lets go again
    run = pull.run(uniform(1, mu_static, mu_dynamic), count)
    value = force_at_the_end(pull, run) - speed * (count * pull.h - stop)
    tolerance = (4.0 * speed * pull.h + drop * pull.h**2) / abs(closed_form)
    return pull.judge(run, value, closed_form, tolerance)


def greatest_force(integrator: str, mu_static: float, mu_dynamic: float) -> Outcome:
    """With mu_s <= mu_d there is no drop: the block leaves at mu_d with v (1 - cos t).

    The force swings up by v; the block, late by h at most, starts with v h too much.
    """
    speed = 0.1
    material = pulled_at(speed, UNDAMPED)
    pull = Pull(integrator, material, 2e-3 / material.omega_min)
    count = math.ceil((mu_dynamic / speed + 6.0) / pull.h)
    run = pull.run(uniform(1, mu_static, mu_dynamic), count, every=1)
    closed_form = mu_dynamic + speed
    tolerance = 2.0 * speed * pull.h / closed_form
    return pull.judge(run, run.static_friction, closed_form, tolerance)


def path_without_friction(integrator: str) -> Outcome:
    """mu_s = mu_d = 0: an oscillator under a moving slider, u = v (t - sin t).

    At first no force is there to let it go: it may start late by h.
    """
    speed, end = 0.1, 6.0
    material = pulled_at(speed, UNDAMPED)
    pull = Pull(integrator, material, 0.01 / material.omega_min)
    run = pull.run(uniform(1, 0.0, 0.0), round(end / pull.h))
    value = speed * run.steps * pull.h - force_at_the_end(pull, run)
    path = end - math.sin(end)
    return pull.judge(run, value, speed * path, 2.0 * pull.h / path)


def block_cases(integrator: str) -> Iterator[Case]:
    """Everything that has a closed form."""
    case = partial(Case, integrator=integrator, expected="agrees")
    for gamma in (0.0, 0.01, 0.1, 1.0, 2.0, 10.0, 100.0, 1e4):
        if gamma > 100.0 and integrator == "rk4":
            material = replace(PAPER, gamma=gamma * PAPER.omega_min)
            step, edge = (limit_of_damping(name, material) for name in ("leapfrog", "rk4"))
            yield case(
                name=f"pillars with gamma = {gamma:g} omega at leapfrog's limit, {integrator}",
                family="damping",
                parameter=gamma,
                expected="refused",
                quantity="omega_max times the largest step",
                run=partial(beyond_the_limit, integrator, material, step, edge),
            )
            continue
        yield case(
            name=f"block with gamma = {gamma:g} omega, {integrator}",
            family="damping",
            parameter=gamma,
            quantity="spring force during the slip, F_n",
            run=partial(force_while_slipping, integrator, gamma),
        )
    left = "spring force after the slip, F_n"
    for speed in (1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0):
        yield case(
            name=f"block at v = {speed:g} F_n omega/K_s, {integrator}",
            family="speed",
            parameter=speed,
            quantity=left,
            run=partial(force_after_slip, integrator, speed, 1.0, 0.6),
        )
    case = partial(case, family="coefficients")
    for ratio in (0.3, 0.6, 0.99):
        yield case(
            name=f"block with mu_d = {ratio:g} mu_s, {integrator}",
            parameter=ratio,
            quantity=left,
            run=partial(force_after_slip, integrator, 0.01, 1.0, ratio),
        )
    yield case(
        name=f"block with mu_d = 0, {integrator}",
        parameter=0.0,
        quantity=left,
        run=partial(force_after_slip, integrator, 1e-3, 1.0, 0.0, gamma=0.1),
    )
    for mu_static, mu_dynamic in ((1.0, 1.0), (1.0, 2.0), (0.0, 0.6)):
        yield case(
            name=f"block with mu_s = {mu_static:g}, mu_d = {mu_dynamic:g}, {integrator}",
            parameter=mu_dynamic / mu_static if mu_static else math.inf,
            quantity="greatest force, F_n",
            run=partial(greatest_force, integrator, mu_static, mu_dynamic),
        )
    yield case(
        name=f"block without friction, {integrator}",
        parameter=math.nan,
        quantity="path, F_n/K_s",
        run=partial(path_without_friction, integrator),
    )


# --- stiffness, strain, scatter: two columns of which one moves, and flat surfaces

#: Two columns of two blocks, the left one held fast. The free ones move by (a, b) and (a, -b): the
#: axial spring beside them, the one between them (strained by 2b), and a diagonal give K_int times
#: this matrix.
COLUMNS = np.array([[1.25, -0.25], [-0.25, 2.25]])
FREE_COLUMN = (
    np.array([[True, False], [True, False]]),
    np.array([[1e9, 0.0], [1e9, 0.0]]),
    np.zeros((2, 2)),
)


def material_of(ratio: float, strain: float, damping: bool = False) -> Material:
    """Material with K_s/K_int = `ratio` whose blocks slip by `strain` spacings, pulled slowly.

    The layer's thickness sets the ratio, and E the strain at the paper's pressure.
    """
    thickness = PAPER.spacing / math.sqrt(ratio)
    modulus = PAPER.pressure * thickness / PAPER.spacing / (0.75 * strain)
    material = Material(youngs_modulus=modulus, thickness=thickness)
    gamma = PAPER.gamma / PAPER.omega_min * material.omega_min if damping else 0.0
    return pulled_at(0.01, replace(material, gamma=gamma))


def surface(n: int, material: Material) -> tuple[Any, Any, Any]:
    """Flat surface with the scatter of `material`."""
    return np.ones((n, n), bool), *draw_friction(n, SEED, material)


def free_column(integrator: str, material: Material) -> Outcome:
    """The springs are non-linear by their strain, and that is all that is missing."""
    pull, count = Pull.at(0.1, integrator, material), 400
    run = pull.run(FREE_COLUMN, count)
    stiffness = material.k_s * np.eye(2) + material.k_int * COLUMNS
    values, modes = np.linalg.eigh(stiffness)
    phase = pull.step * np.sqrt(values / material.mass)
    share = material.k_s * modes[0] / values  # of the slider's path, by mode
    closed_form = float(modes[0] @ (share * scheme_path(integrator, phase, 0, count)))
    value = float(run.displacement[0, 0, 1])
    strain = abs(value) / material.spacing
    return pull.judge(run, value / pull.slide, closed_form, strain + ROUNDING)


def first_detachment(integrator: str, material: Material, n: int = 8) -> Outcome:
    """On a flat surface the weakest block lets go first, at its own threshold and in that step."""
    pull, scene = Pull.at(0.2, integrator, material), surface(n, material)
    run = pull.run(scene)
    threshold = np.maximum(*scene[1:]).min()
    value, unit = run.t_first, release(material, 1.0)
    tolerance = pull.step / release(material, threshold)
    return pull.judge(run, value / unit, threshold, tolerance)


def mean_detachment(integrator: str, ratio: float) -> Outcome:
    """Far stiffer than the springs between them, the slider's springs pull each block alone.

    A block slips by about its threshold's share of F_n/K_s, and pulls its neighbours with
    K_int/K_s of that.
    """
    material = material_of(ratio, 1e-3, damping=True)
    pull, scene = Pull.at(0.2, integrator, material), surface(8, material)
    run = pull.run(scene)
    mean, unit = np.maximum(*scene[1:]).mean(), release(material, 1.0)
    return pull.judge(run, run.t_avg / unit, mean, pull.step / (mean * unit) + 2.0 / ratio)


def static_friction_at(integrator: str, strain: float) -> Outcome:
    """Avalanches on a surface, beside those at a ten-thousandth of the strain."""
    runs = []
    for slip in (strain, 1e-4 * strain):
        material = material_of(1.0, slip, damping=True)
        pull = Pull.at(0.2, integrator, material)
        runs.append(pull.run(surface(6, material)))
    value, linear = (run.static_friction for run in runs)
    return pull.judge(runs[0], value, linear, strain + ROUNDING)


def scattered(sigma: float) -> Material:
    """The paper's material with another scatter; mu_d has half that of mu_s, as in the paper."""
    return pulled_at(0.01, replace(PAPER, mu_static_std=sigma, mu_dynamic_std=sigma / 2.0))


def everything_at_once(integrator: str) -> Outcome:
    """sigma = 0: all blocks let go and move alike, along the slide alone, to the last bit."""
    pull = Pull.at(0.2, integrator, scattered(0.0))
    run = pull.run(surface(8, pull.material))
    alike = np.unique(run.t_det).size == 1 and np.unique(run.displacement[0]).size == 1
    unit = release(pull.material, 1.0)
    outcome = pull.judge(run, run.t_first / unit, 1.0, pull.step / unit)
    if outcome.outcome == "agrees":
        straight = not run.displacement[1].any()
        outcome = replace(outcome, outcome="symmetric" if alike and straight else "asymmetric")
    return outcome


def mirror_image(integrator: str, sigma: float) -> Outcome:
    """Mirrored across the slide, every avalanche is the mirror image, to the last bit."""
    pull = Pull.at(0.2, integrator, scattered(sigma))
    contact, *mu = surface(8, pull.material)
    run, mirrored = (pull.run((contact, *m)) for m in (mu, [field[::-1] for field in mu]))
    sign = np.array([1.0, -1.0])[:, None, None]
    same = np.array_equal(mirrored.t_det, run.t_det[::-1])
    same = same and np.array_equal(mirrored.displacement, sign * run.displacement[:, ::-1])
    value, closed_form = mirrored.static_friction, run.static_friction
    outcome = pull.judge(run, value, closed_form, ROUNDING)  # sums are taken in another order
    if outcome.outcome == "agrees":
        outcome = replace(outcome, outcome="symmetric" if same else "asymmetric")
    return outcome


def surface_cases(integrator: str) -> Iterator[Case]:
    """Stiffness, strain and scatter."""
    case = partial(Case, integrator=integrator, expected="agrees")
    path, first = "displacement, in steps of the slider", "first detachment, F_n/(K_s v)"
    for ratio in (1e-4, 1e-2, 1.0, 1e2, 1e4):
        yield case(
            name=f"column at K_s/K_int = {ratio:g}, {integrator}",
            family="stiffness",
            parameter=ratio,
            quantity=path,
            run=partial(free_column, integrator, material_of(ratio, 1e-9)),
        )
        material = material_of(ratio, 1e-3, damping=True)
        yield case(
            name=f"surface at K_s/K_int = {ratio:g}, {integrator}",
            family="stiffness",
            parameter=ratio,
            quantity=first,
            run=partial(first_detachment, integrator, material),
        )
    for ratio in (1e2, 1e4):
        yield case(
            name=f"blocks on their own at K_s/K_int = {ratio:g}, {integrator}",
            family="stiffness",
            parameter=ratio,
            quantity="mean detachment, F_n/(K_s v)",
            run=partial(mean_detachment, integrator, ratio),
        )
    for strain in (1e-1, 1e-2, 1e-3, 1e-5, 1e-7, 1e-9):
        yield case(
            name=f"column at a strain of {strain:g}, {integrator}",
            family="strain",
            parameter=strain,
            quantity=path,
            run=partial(free_column, integrator, material_of(1.0, strain)),
        )
    for strain in (1e-1, 1e-5):
        yield case(
            name=f"surface at a strain of {strain:g}, {integrator}",
            family="strain",
            parameter=strain,
            quantity="static friction",
            run=partial(static_friction_at, integrator, strain),
        )
    yield case(
        name=f"surface with sigma = 0, {integrator}",
        family="scatter",
        parameter=0.0,
        expected="symmetric",
        quantity=first,
        run=partial(everything_at_once, integrator),
    )
    for sigma in (0.05, 0.1, 0.25, 0.5):
        yield case(
            name=f"surface with sigma = {sigma:g}, {integrator}",
            family="scatter",
            parameter=sigma,
            quantity=first,
            run=partial(first_detachment, integrator, scattered(sigma)),
        )
    yield case(
        name=f"mirror image with sigma = 0.5, {integrator}",
        family="scatter",
        parameter=0.5,
        expected="symmetric",
        quantity="static friction",
        run=partial(mirror_image, integrator, 0.5),
    )


# --- load: springs that leave the series, and springs that collapse or burst

BURST, COLLAPSE = 3.0, -0.75  #: (r/L)² - 1 of a spring twice and half as long
DURATION = 30.0


@cache
def column_by_newton(speed: float, until: float) -> tuple[float, float]:
    """Follow the free column, K_s = K_int, from the vectors between blocks; lengths here in l.

    The slider goes at `speed`, lengths per 1/omega, for `DURATION`, or until (r/L)² - 1 of the
    axial springs reaches `until`. Returns the time and the displacement there.
    """

    def motion(time: float, state: Array) -> Array:
        a, b = state[:2]  # of the upper block; the lower one is its mirror image
        bonds = (
            (1.0, 1.0, 1.0 + a, b),
            (1.0, 1.0, 0.0, 1.0 + 2.0 * b),
            (0.5, math.sqrt(2.0), 1.0 + a, 1.0 + b),
        )
        force = np.array([speed * time - a, -b])
        for stiffness, rest, x, y in bonds:
            force -= stiffness * (1.0 - rest / math.hypot(x, y)) * np.array([x, y])
        return np.concatenate([state[2:], force])

    def left(time: float, state: Array) -> float:
        return (1.0 + state[0]) ** 2 + state[1] ** 2 - 1.0 - until

    left.terminal = True  # type: ignore[attr-defined]
    span, accuracy = (0.0, DURATION), {"rtol": 1e-12, "atol": 1e-14}
    solution = solve_ivp(motion, span, np.zeros(4), "DOP853", events=left, **accuracy)
    return float(solution.t[-1]), float(solution.y[0, -1])


def pull_column(integrator: str, speed: float) -> tuple[Pull, Realisation]:
    """The same by the package, in a hundredth of the stable step; backwards for speed < 0."""
    velocity = abs(speed) * UNDAMPED.spacing * UNDAMPED.omega_min
    material = replace(UNDAMPED, slider_velocity=velocity)
    end = DURATION / material.omega_min
    count = math.ceil(end / (0.01 * limit(integrator, material)))
    pull = Pull(integrator, material, end / count)
    return pull, pull.run(FREE_COLUMN, count, direction=180 if speed < 0.0 else 0)


def slow_column(strain: float) -> float:
    """Speed at which the column has moved by about `strain` spacings in the end."""
    return strain * (1.0 + COLUMNS[0, 0]) / DURATION


def exact_form(integrator: str, strain: float) -> Outcome:
    """Leapfrog may be off by its order, (omega_max h)², Runge-Kutta by (omega_max h)⁴.

    At ten times its range, where q is 0.6, the polynomial is off by more than either.
    """
    speed = slow_column(strain)
    pull, run = pull_column(integrator, speed)
    _, closed_form = column_by_newton(speed, math.inf)
    value = float(run.displacement[0, 0, 1]) / pull.material.spacing
    order = {"leapfrog": 2, "rk4": 4}[integrator]
    tolerance = (pull.material.omega_max * pull.step) ** order
    return pull.judge(run, value, closed_form, tolerance)


def broken_spring(integrator: str, strain: float) -> Outcome:
    """The error names the time, in four digits."""
    speed = slow_column(strain)
    try:
        pull_column(integrator, speed)
    except SimulationError as error:
        value = float(str(error).split("t = ")[1].split()[0]) * UNDAMPED.omega_min
        closed_form, _ = column_by_newton(speed, BURST if speed > 0.0 else COLLAPSE)
        tolerance = 2e-3
        word = "raises" if abs(value / closed_form - 1.0) <= tolerance else "raises at another time"
        return Outcome(word, math.nan, value, closed_form, tolerance)
    return Outcome("holds")


@cache
def heavy_surface() -> tuple[Material, Any, Any]:
    """Twenty times the paper's load on 3 x 3 blocks: a slip of 0.13 l; the reference solution."""
    material = pulled_at(0.01, replace(PAPER, pressure=20.0 * PAPER.pressure))
    scene = flat(3, SEED)
    end = 1.1 * release(material, 1.0)
    exact = reference.solve(*scene, material=material, duration=end, sample_interval=end / 1000)
    return material, scene, exact


def avalanche_beyond_the_series(integrator: str) -> Outcome:
    """Static friction is off by no more than the slider adds in a step."""
    material, scene, exact = heavy_surface()
    interval = float(exact.time[1])
    pull = Pull(integrator, material, interval / math.ceil(interval / 1e-8))
    run = pull.run(scene, 1000 * round(interval / pull.step), every=round(interval / pull.step))
    tolerance = pull.step / release(material, exact.static_friction)
    return pull.judge(run, run.static_friction, exact.static_friction, tolerance)


def avalanche_beyond_all(integrator: str) -> Outcome:
    """A thousand times the paper's load: a block that lets go slides by several spacings."""
    material = pulled_at(1e-3, replace(PAPER, pressure=1000.0 * PAPER.pressure))
    pull = Pull.at(0.2, integrator, material)
    return failure(lambda: pull.run(flat(4, SEED)), "has collapsed")


def load_cases(integrator: str) -> Iterator[Case]:
    """From strains within the range of the series to broken springs."""
    case = partial(Case, family="load", integrator=integrator)
    for strain in (0.02, 0.1, 0.3, 0.6, -0.1, -0.3):
        yield case(
            name=f"column {'stretched' if strain > 0 else 'squeezed'} by {abs(strain):g}, "
            f"{integrator}",
            parameter=abs(strain),
            expected="agrees",
            quantity="displacement, l",
            run=partial(exact_form, integrator, strain),
        )
    for strain, what in ((2.0, "stretched until it bursts"), (-1.0, "squeezed until it collapses")):
        yield case(
            name=f"column {what}, {integrator}",
            parameter=abs(strain),
            expected="raises",
            quantity="time, 1/omega",
            run=partial(broken_spring, integrator, strain),
        )
    yield case(
        name=f"surface at P/E = 0.1, {integrator}",
        parameter=slip(0.1),
        expected="agrees",
        quantity="static friction",
        run=partial(avalanche_beyond_the_series, integrator),
    )
    yield case(
        name=f"surface at P/E = 5, {integrator}",
        parameter=slip(5.0),
        expected="raises",
        quantity="none",
        run=partial(avalanche_beyond_all, integrator),
    )


def slip(load: float) -> float:
    """How far a block slips at P/E = `load`, over l, with l_z = l."""
    return load / 0.75


# --- size


def blocks_alike(integrator: str, n: int) -> Outcome:
    """No spring between blocks is ever strained: N² times one block, in the midst of its slip.

    To rounding, of one step and of a sum over all blocks.
    """
    pull, count = Pull.at(0.1, integrator, UNDAMPED), 40
    pull = replace(pull, material=pulled_at(4.0 / (count * pull.h), UNDAMPED))
    one, run = (pull.run(uniform(size, 1.0, 0.6), count) for size in (1, n))
    tolerance = ROUNDING + 1e-16 * n * n
    return pull.judge(run, run.static_friction, one.static_friction, tolerance)


def first_of_a_million(integrator: str, n: int) -> Outcome:
    """Forty steps, in the middle of which the weakest of N² blocks lets go."""
    pull, scene = Pull.at(0.2, integrator, PAPER), surface(n, PAPER)
    threshold, count = float(np.maximum(*scene[1:]).min()), 40
    pull = replace(pull, material=pulled_at(threshold / (0.5 * count * pull.h), PAPER))
    run = pull.run(scene, count)
    tolerance = pull.step / release(pull.material, threshold)
    return pull.judge(run, run.t_first / release(pull.material, 1.0), threshold, tolerance)


def one_contact_block(integrator: str) -> Outcome:
    """It bears the whole load and holds all the others: static friction is its own.

    They are in balance, but for the swing that the slider's start has left, v each.
    """
    n, mu_static, speed = 6, 0.2, 1e-3
    contact = np.zeros((n, n), bool)
    contact[2, 3] = True
    pull = Pull.at(0.1, integrator, pulled_at(speed, PAPER))
    run = pull.run((contact, *uniform(n, mu_static, 0.1)[1:]))
    tolerance = 2.0 * speed / mu_static
    return pull.judge(run, run.static_friction, mu_static, tolerance, contact=1)


def refused_size(integrator: str, n: int, reason: str) -> Outcome:
    """The arrays take no memory."""
    scene = (np.broadcast_to(kind, (n, n)) for kind in (np.True_, 1.0, 0.6))
    return refusal(lambda: simulate(*scene, integrator=integrator), reason)


def size_cases(integrator: str) -> Iterator[Case]:
    """From one block to a million."""
    case = partial(Case, family="size", integrator=integrator, expected="agrees")
    for n in (2, 3, 1000):
        yield case(
            name=f"{n} x {n} blocks alike, {integrator}",
            parameter=n,
            quantity="greatest force, P l² N²",
            run=partial(blocks_alike, integrator, n),
        )
    for n in (1, 2, 3, 1000):
        run = partial(first_detachment, integrator, scattered(0.1), n)
        if n == 1000:
            run = partial(first_of_a_million, integrator, n)
        yield case(
            name=f"{n} x {n} blocks with scatter, {integrator}",
            parameter=n,
            quantity="first detachment, F_n/(K_s v)",
            run=run,
        )
    yield case(
        name=f"one contact block, {integrator}",
        parameter=6,
        quantity="static friction",
        run=partial(one_contact_block, integrator),
    )
    for n, reason in ((0, "contact"), (MAX_BLOCKS + 1, f"goes up to {MAX_BLOCKS}")):
        yield case(
            name=f"{n} x {n} blocks, {integrator}",
            parameter=n,
            expected="refused",
            quantity="none",
            run=partial(refused_size, integrator, n, reason),
        )


# --- rest


def stuck(integrator: str, count: int) -> Outcome:
    """Nothing moves by one bit, and the force is K_s v t N²."""
    pull = Pull.at(0.2, integrator, PAPER)
    run = pull.run(uniform(2, 1e9, 0.6), count)
    closed_form = 4.0 * PAPER.k_s * PAPER.slider_velocity * run.time[-1] / run.normal_force
    outcome = pull.judge(run, run.static_friction, closed_form, ROUNDING)
    still = not (run.displacement.any() or run.velocity.any() or run.switches.any())
    return replace(outcome, outcome="at rest" if still and outcome.outcome == "agrees" else "moves")


def stuck_among_others(integrator: str, count: int) -> Outcome:
    """The middle one of nine is held for good; the others slip past several times, and ring."""
    pull = Pull.at(0.2, integrator, UNDAMPED)
    pull = replace(pull, material=pulled_at(4.0 / (count * pull.h), UNDAMPED))
    contact, mu_static, mu_dynamic = uniform(3, 1.0, 0.6)
    mu_static[1, 1] = 1e9
    run = pull.run((contact, mu_static, mu_dynamic), count)
    moved = np.abs(run.displacement[:, 1, 1]).max() > 0.0 or np.isfinite(run.t_det[1, 1])
    slipped = np.count_nonzero(np.isfinite(run.t_det)) == 8
    residual = run.energy.relative_residual
    kept = abs(residual) <= pull.may_miss(run, 9)
    word = "at rest" if slipped and kept and not moved else "moves"
    return Outcome(word, residual)


def held_after_slip(integrator: str, count: int) -> Outcome:
    """Between two slips a block does not move by one bit."""
    pull = Pull.at(0.1, integrator, UNDAMPED)
    speed, every = 0.7 / (count * pull.h), count // 100  # 0.8/v lie between
    pull = replace(pull, material=pulled_at(speed, UNDAMPED))
    landed = math.ceil((1.0 / speed + 10.0) / (every * pull.h)) * every
    steps = np.array([landed, landed + count])
    run = pull.run(uniform(1, 1.0, 0.6), steps[1], every, snapshot_times=steps * pull.step)
    before, after = run.snapshots[:, 0, 0, 0] * pull.material.k_s / pull.material.block_load
    outcome = pull.judge(run, after, before, 0.0)
    still = outcome.outcome == "agrees" and before > 0.0 and run.switches.sum() == 1
    return replace(outcome, outcome="at rest" if still else "moves")


def threshold_reached(integrator: str, count: int, excess: float) -> Outcome:
    """After `count` steps the force K_s v t is 1 + excess times the threshold; then one more."""
    pull = Pull.at(0.2, integrator, UNDAMPED)
    pull = replace(pull, material=pulled_at(1.0 / (count * pull.h), UNDAMPED))
    run = pull.run(uniform(1, 1.0 / (1.0 + excess), 0.6), count + 1)
    moved = np.isfinite(run.t_first) and run.displacement.any()
    residual = run.energy.relative_residual
    if not moved:
        return Outcome("at rest", residual)
    return Outcome("lets go", residual, run.t_first / pull.step, count, 1.0 / count)


def stick_slip_forever(integrator: str, count: int) -> Outcome:
    """The force saws between mu_s and 2 mu_d - mu_s: its mean is mu_d, but for the first rise."""
    speed, mu_dynamic = 0.01, 0.6
    pull = Pull(integrator, pulled_at(speed, UNDAMPED), 0.02 / UNDAMPED.omega_min)
    run = pull.run(uniform(1, 1.0, mu_dynamic), count, every=20)
    cycles = speed * count * pull.h / 0.8
    return pull.judge(run, run.force.mean() / run.normal_force, mu_dynamic, 1.0 / cycles)


def rest_cases(integrator: str) -> Iterator[Case]:
    """A million steps, and one step more."""
    case = partial(Case, family="rest", integrator=integrator)
    million, tenth = 1_000_000, 100_000
    yield case(
        name=f"stuck for a million steps, {integrator}",
        parameter=million,
        expected="at rest",
        quantity="force, P l² N²",
        run=partial(stuck, integrator, million),
    )
    long = million if integrator == "leapfrog" else tenth
    yield case(
        name=f"stuck among others that slip for {long} steps, {integrator}",
        parameter=long,
        expected="at rest",
        quantity="none",
        run=partial(stuck_among_others, integrator, long),
    )
    yield case(
        name=f"stuck between two slips for {tenth} steps, {integrator}",
        parameter=tenth,
        expected="at rest",
        quantity="displacement, F_n/K_s",
        run=partial(held_after_slip, integrator, tenth),
    )
    yield case(
        name=f"sticking and slipping for a million steps, {integrator}",
        parameter=million,
        expected="agrees",
        quantity="mean force, F_n",
        run=partial(stick_slip_forever, integrator, million),
    )
    for excess, word, expected in ((-1e-12, "missed", "at rest"), (1e-12, "passed", "lets go")):
        yield case(
            name=f"threshold {word} by 1e-12 after {tenth} steps, {integrator}",
            parameter=tenth,
            expected=expected,
            quantity="first detachment, steps",
            run=partial(threshold_reached, integrator, tenth, excess),
        )


# --- overflow


def ten_steps(integrator: str, n: int, mu_static: float = 1.0, **changes: float) -> Realisation:
    """Ten steps of the paper's surface; one threshold and some constants are others."""
    contact, thresholds, mu_dynamic = surface(n, PAPER)
    thresholds[0, 0] = mu_static
    pull = Pull(integrator, replace(PAPER, **changes), 2e-8)
    return pull.run((contact, thresholds, mu_dynamic), 10)


def overflow_cases(integrator: str) -> Iterator[Case]:
    """Numbers that are none, and numbers that become none."""
    case = partial(Case, family="overflow", integrator=integrator, quantity="none")
    for value in (math.nan, math.inf, -1.0):
        call = partial(ten_steps, integrator, 3, mu_static=value)
        yield case(
            name=f"mu_s = {value} in one block, {integrator}",
            parameter=value,
            expected="refused",
            run=partial(refusal, call, "mu_static must be finite"),
        )
    for name, value in (("pressure", math.nan), ("slider_velocity", math.inf), ("spacing", 0.0)):
        call = partial(ten_steps, integrator, 3, **{name: value})
        yield case(
            name=f"{name} = {value}, {integrator}",
            parameter=value,
            expected="refused",
            run=partial(refusal, call, f"Material.{name} must be finite"),
        )
    for name, derived, changes in (
        ("stiffness", "k_int", {"youngs_modulus": 1e308, "thickness": 1e5}),
        ("mass", "mass", {"density": 1e308, "spacing": 1e3}),
        ("load", "block_load", {"pressure": 1e308, "spacing": 1e10, "thickness": 1e10}),
    ):
        call = partial(ten_steps, integrator, 3, **changes)
        yield case(
            name=f"{name} beyond the largest float, {integrator}",
            parameter=1e308,
            expected="refused",
            run=partial(refusal, call, f"Material.{derived} beyond floating point"),
        )
    for name, n, changes in (
        ("speed whose energy overflows", 1, {"slider_velocity": 1e160}),
        ("largest speed", 1, {"slider_velocity": 1e308}),
        ("speed that tears the springs", 3, {"slider_velocity": 1e160}),
    ):
        call = partial(ten_steps, integrator, n, **changes)
        yield case(
            name=f"{name}, {integrator}",
            parameter=max(changes.values()),
            expected="raises",
            run=partial(failure, call, "at t = "),
        )


# --- all of them


def all_cases() -> Iterator[Case]:
    """Every family, by both integrators."""
    yield Case(
        name="highest mode of 32 x 32 blocks",
        family="step",
        integrator="both",
        parameter=1.0,
        expected="just below",
        quantity="frequency, omega_max",
        run=partial(limit_of_the_springs, 32),
    )
    families = (
        step_cases,
        block_cases,
        surface_cases,
        load_cases,
        size_cases,
        rest_cases,
        overflow_cases,
    )
    for family in families:
        for integrator in INTEGRATORS:
            yield from family(integrator)


CASES = list(all_cases())


def row(case: Case, outcome: Outcome) -> dict[str, Any]:
    """One row of the table."""
    return {
        "case": case.name,
        "family": case.family,
        "integrator": case.integrator,
        "parameter": case.parameter,
        "expected": case.expected,
        "outcome": outcome.outcome,
        "energy_error": outcome.energy_error,
        "quantity": case.quantity,
        "value": outcome.value,
        "closed_form": outcome.closed_form,
        "relative_error": outcome.relative_error,
        "tolerance": outcome.tolerance,
    }


@click.command()
@click.option("--output", type=click.Path(path_type=Path), required=True)
def main(output: Path) -> None:
    """Try all cases, and write their table if each one comes out as expected."""
    rows = []
    for case in tqdm(CASES, unit="case"):
        rows.append(row(case, case.outcome()))
        tqdm.write(f"{case.name}: {rows[-1]['outcome']}")
    wrong = [row for row in rows if row["outcome"] != row["expected"]]
    for each in wrong:
        click.echo("{case}: expected {expected!r}, not {outcome!r}".format(**each), err=True)
    if wrong:
        raise SystemExit(1)
    # nothing of the configuration matters here
    version = {"code_version": code_version("springblock.simulation")}
    write(rows_to_table(rows, SCHEMA), output, version)


if __name__ == "__main__":
    main()
