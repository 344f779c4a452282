"""Columns and surfaces: stiffness, strain, scatter, load, size, and numbers too large."""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import cache, partial
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from springblock.accuracy import kernels, reference
from springblock.accuracy.kernels import UNDAMPED
from springblock.accuracy.specimens import Array, flat, uniform
from springblock.accuracy.stability.cases import (
    FIRST,
    FRICTION,
    PAPER,
    ROUNDING,
    SEED,
    Case,
    Outcome,
    Pull,
    compared,
    named_after,
    pulled_at,
    refusal,
    release,
)
from springblock.model.material import Material
from springblock.model.pattern import MAX_BLOCKS
from springblock.simulation.run import Realisation
from springblock.simulation.simulate import SimulationError, simulate

#: Two columns of two blocks, the left one held fast. The free ones move by (a, b) and (a, -b): the
#: axial spring beside them, the one between them (strained by 2b), and a diagonal give K_int times
#: this matrix.
COLUMNS = np.array([[1.25, -0.25], [-0.25, 2.25]])
FREE_COLUMN = (
    np.array([[True, False], [True, False]]),
    np.array([[1e9, 0.0], [1e9, 0.0]]),
    np.zeros((2, 2)),
)
BURST, COLLAPSE = 3.0, -0.75  #: (r/L)² - 1 of a spring twice and half as long
DURATION = 30.0  #: of the column's motion, 1/omega


def stiffnesses(integrator: str) -> Iterator[Case]:
    """Stiffness, strain and scatter."""
    case, moved = partial(Case, "stiffness", integrator), "displacement, in steps of the slider"
    for ratio in (1e-4, 1e-2, 1.0, 1e2, 1e4):
        name, material = f"column at K_s/K_int = {ratio:g}", material_of(ratio, 1e-9)
        yield case(name, ratio, moved, free_column, (material,))
        name, material = f"surface at K_s/K_int = {ratio:g}", material_of(ratio, 1e-3, damping=True)
        yield case(name, ratio, FIRST, first_detachment, (material,))
    for ratio in (1e2, 1e4):
        name, mean = f"blocks on their own at K_s/K_int = {ratio:g}", "mean detachment, F_n/(K_s v)"
        yield case(name, ratio, mean, mean_detachment, (ratio,))
    case = partial(Case, "strain", integrator)
    for strain in (1e-1, 1e-2, 1e-3, 1e-5, 1e-7, 1e-9):
        name = f"column at a strain of {strain:g}"
        yield case(name, strain, moved, free_column, (material_of(1.0, strain),))
    for strain in (1e-1, 1e-5):
        name = f"surface at a strain of {strain:g}"
        yield case(name, strain, FRICTION, static_friction_at, (strain,))
    case = partial(Case, "scatter", integrator)
    yield case("surface with sigma = 0", 0.0, FIRST, everything_at_once, expected="symmetric")
    for sigma in (0.05, 0.1, 0.25, 0.5):
        name = f"surface with sigma = {sigma:g}"
        yield case(name, sigma, FIRST, first_detachment, (scattered(sigma),))
    name, sigma = "mirror image with sigma = 0.5", 0.5
    yield case(name, sigma, FRICTION, mirror_image, (sigma,), "symmetric")


def material_of(ratio: float, strain: float, damping: bool = False) -> Material:
    """Return the material with K_s/K_int = `ratio` whose blocks slip by `strain` spacings, slowly.

    The layer's thickness sets the ratio, and E the strain at the paper's pressure.
    """
    thickness = PAPER.spacing / math.sqrt(ratio)
    modulus = PAPER.pressure * thickness / PAPER.spacing / (0.75 * strain)
    material = Material(youngs_modulus=modulus, thickness=thickness)
    gamma = PAPER.gamma / PAPER.omega_min * material.omega_min if damping else 0.0
    return pulled_at(0.01, replace(material, gamma=gamma))


def scattered(sigma: float) -> Material:
    """Return the paper's material with another scatter; mu_d has half that of mu_s, as there."""
    return pulled_at(0.01, replace(PAPER, mu_static_std=sigma, mu_dynamic_std=sigma / 2.0))


def free_column(integrator: str, material: Material) -> Outcome:
    """The springs are non-linear by their strain, and that is all that is missing."""
    pull, count = Pull.at(0.1, integrator, material), 400
    run = pull.simulate(FREE_COLUMN, count)
    stiffness = material.k_s * np.eye(2) + material.k_int * COLUMNS
    values, modes = np.linalg.eigh(stiffness)
    phase = pull.step * np.sqrt(values / material.mass)
    share = material.k_s * modes[0] / values  # of the slider's path, by mode
    closed_form = float(modes[0] @ (share * kernels.path(integrator, phase, count)))
    value = float(run.displacement[0, 0, 1])
    slide = material.slider_velocity * pull.step
    tolerance = abs(value) / material.spacing + ROUNDING
    return pull.judge(run, value / slide, closed_form, tolerance)


def first_detachment(integrator: str, material: Material, n: int = 8) -> Outcome:
    """On a flat surface the weakest block lets go first, at its own threshold."""
    pull, surface = Pull.at(0.2, integrator, material), flat(n, SEED, material)
    run, weakest = pull.simulate(surface), np.maximum(*surface[1:]).min()
    return pull.judge(run, run.t_first / release(material), weakest, ROUNDING)


def mean_detachment(integrator: str, ratio: float) -> Outcome:
    """Far stiffer than the springs between them, the slider's springs pull each block alone.

    A block slips by about its threshold's share of F_n/K_s, and pulls its neighbours with
    K_int/K_s of that.
    """
    material = material_of(ratio, 1e-3, damping=True)
    pull, surface = Pull.at(0.2, integrator, material), flat(8, SEED, material)
    run = pull.simulate(surface)
    mean, unit = np.maximum(*surface[1:]).mean(), release(material)
    return pull.judge(run, run.t_avg / unit, mean, pull.step / (mean * unit) + 2.0 / ratio)


def static_friction_at(integrator: str, strain: float) -> Outcome:
    """Avalanches on a surface, beside those at a ten-thousandth of the strain."""
    runs = []
    for slip in (strain, 1e-4 * strain):
        material = material_of(1.0, slip, damping=True)
        pull = Pull.at(0.2, integrator, material)
        runs.append(pull.simulate(flat(6, SEED, material)))
    value, linear = (run.static_friction for run in runs)
    return pull.judge(runs[0], value, linear, strain + ROUNDING)


def everything_at_once(integrator: str) -> Outcome:
    """sigma = 0: all blocks let go and move alike, along the slide alone, to the last bit."""
    pull = Pull.at(0.2, integrator, scattered(0.0))
    run = pull.simulate(flat(8, SEED, pull.material))
    alike = np.unique(run.t_det).size == 1 and np.unique(run.displacement[0]).size == 1
    word = "symmetric" if alike and not run.displacement[1].any() else "asymmetric"
    unit = release(pull.material)
    return pull.judge(run, run.t_first / unit, 1.0, pull.step / unit, word)


def mirror_image(integrator: str, sigma: float) -> Outcome:
    """Mirrored across the slide, every avalanche is the mirror image, to the last bit."""
    pull = Pull.at(0.2, integrator, scattered(sigma))
    contact, *mu = flat(8, SEED, pull.material)
    run, mirrored = (
        pull.simulate((contact, static, dynamic))
        for static, dynamic in (mu, [field[::-1] for field in mu])
    )
    sign = np.array([1.0, -1.0])[:, None, None]
    same = np.array_equal(mirrored.t_det, run.t_det[::-1])
    same = same and np.array_equal(mirrored.displacement, sign * run.displacement[:, ::-1])
    word = "symmetric" if same else "asymmetric"
    # sums are taken in another order
    return pull.judge(run, mirrored.static_friction, run.static_friction, ROUNDING, word)


def loads(integrator: str) -> Iterator[Case]:
    """Springs that leave the range of their series, and springs that collapse or burst."""
    case = partial(Case, "load", integrator)
    for strain in (0.02, 0.1, 0.3, 0.6, -0.1, -0.3):
        name = f"column {'stretched' if strain > 0 else 'squeezed'} by {abs(strain):g}"
        yield case(name, abs(strain), "displacement, l", strained_column, (strain,))
    for strain, what in ((2.0, "stretched until it bursts"), (-1.0, "squeezed until it collapses")):
        name, when = f"column {what}", "time, 1/omega"
        yield case(name, abs(strain), when, broken_spring, (strain,), "raises")
    slip = 0.1 / 0.75, 5.0 / 0.75  # of a block, over l, with l_z = l
    yield case("surface at P/E = 0.1", slip[0], FRICTION, avalanche_beyond_the_series)
    yield case("surface at P/E = 5", slip[1], "none", avalanche_beyond_all, expected="raises")


def slow_speed(strain: float) -> float:
    """Return the speed at which the column has moved by about `strain` spacings in the end."""
    return strain * (1.0 + COLUMNS[0, 0]) / DURATION


@cache
def column_by_newton(strain: float, until: float = math.inf) -> tuple[float, float]:
    """Follow the free column, K_s = K_int, from the vectors between blocks; lengths here in l.

    For `DURATION`, or until (r/L)² - 1 of the axial springs reaches `until`. Returns the time and
    the displacement there.
    """
    speed = slow_speed(strain)

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


def pull_column(integrator: str, strain: float) -> tuple[Pull, Realisation]:
    """Pull the same column in a hundredth of the stable step; backwards for strain < 0."""
    velocity = abs(slow_speed(strain)) * UNDAMPED.spacing * UNDAMPED.omega_min
    material = replace(UNDAMPED, slider_velocity=velocity)
    end = DURATION / material.omega_min
    count = math.ceil(end / (0.01 * kernels.limit(integrator, material)))
    pull = Pull(integrator, material, end / count)
    return pull, pull.simulate(FREE_COLUMN, count, direction=180 if strain < 0.0 else 0)


def strained_column(integrator: str, strain: float) -> Outcome:
    """Leapfrog may be off by its order, (omega_max h)², Runge-Kutta by (omega_max h)⁴.

    At ten times its range, where q is 0.6, the polynomial is off by more than either.
    """
    pull, run = pull_column(integrator, strain)
    _, closed_form = column_by_newton(strain)
    value = float(run.displacement[0, 0, 1]) / pull.material.spacing
    order = {"leapfrog": 2, "rk4": 4}[integrator]
    return pull.judge(run, value, closed_form, (pull.material.omega_max * pull.step) ** order)


def broken_spring(integrator: str, strain: float) -> Outcome:
    """The error names the time, in four digits."""
    try:
        pull_column(integrator, strain)
    except SimulationError as error:
        closed_form, _ = column_by_newton(strain, BURST if strain > 0.0 else COLLAPSE)
        time = named_after("t = ", error) * UNDAMPED.omega_min
        return compared(time, closed_form, 2e-3, "raises")
    return Outcome("holds")


def avalanche_beyond_the_series(integrator: str) -> Outcome:
    """Twenty times the paper's load: a slip of 0.13 l, beside the reference solution.

    Static friction is off by no more than the slider adds in a step.
    """
    material = pulled_at(0.01, replace(PAPER, pressure=20.0 * PAPER.pressure))
    surface, end = flat(3, SEED), 1.1 * release(material)
    exact = reference.solve(*surface, material=material, duration=end, sample_interval=end / 1000)
    interval = float(exact.time[1])
    pull = Pull(integrator, material, interval / math.ceil(interval / 1e-8))
    every = round(interval / pull.step)
    run = pull.simulate(surface, 1000 * every, every)
    tolerance = pull.step / release(material, exact.static_friction)
    return pull.judge(run, run.static_friction, exact.static_friction, tolerance)


def avalanche_beyond_all(integrator: str) -> Outcome:
    """A thousand times the paper's load: a block that lets go slides by several spacings."""
    material = pulled_at(1e-3, replace(PAPER, pressure=1000.0 * PAPER.pressure))
    pull = Pull.at(0.2, integrator, material)
    return refusal(lambda: pull.simulate(flat(4, SEED)), "has collapsed")


def sizes(integrator: str) -> Iterator[Case]:
    """From one block to a million: alike, with scatter, one in contact, and sizes refused."""
    case = partial(Case, "size", integrator)
    for n in (2, 3, 1000):
        yield case(f"{n} x {n} blocks alike", n, "greatest force, P l² N²", blocks_alike, (n,))
    for n in (1, 2, 3):
        name = f"{n} x {n} blocks with scatter"
        yield case(name, n, FIRST, first_detachment, (scattered(0.1), n))
    yield case("1000 x 1000 blocks with scatter", 1000, FIRST, first_of_a_million)
    yield case("one contact block", 6, FRICTION, one_contact_block)
    for n, reason in ((0, "contact"), (MAX_BLOCKS + 1, f"at most {MAX_BLOCKS}")):
        yield case(f"{n} x {n} blocks", n, "none", refused_size, (n, reason), "refused")


def blocks_alike(integrator: str, n: int) -> Outcome:
    """No spring between blocks is ever strained: N² times one block, in the midst of its slip.

    To rounding, of one step and of a sum over all blocks.
    """
    pull, count = Pull.at(0.1, integrator, UNDAMPED), 40
    pull = pull.with_speed(4.0 / (count * pull.h))
    one, run = (pull.simulate(uniform(size, 1.0, 0.6), count) for size in (1, n))
    tolerance = ROUNDING + 1e-16 * n * n
    return pull.judge(run, run.static_friction, one.static_friction, tolerance)


def first_of_a_million(integrator: str) -> Outcome:
    """Forty steps, in the middle of which the weakest of 1000² blocks lets go."""
    pull, surface, count = Pull.at(0.2, integrator, PAPER), flat(1000, SEED), 40
    threshold = float(np.maximum(*surface[1:]).min())
    pull = pull.with_speed(threshold / (0.5 * count * pull.h))
    run = pull.simulate(surface, count)
    tolerance = pull.step / release(pull.material, threshold)
    return pull.judge(run, run.t_first / release(pull.material), threshold, tolerance)


def one_contact_block(integrator: str) -> Outcome:
    """It bears the whole load and holds all the others: static friction is its own.

    They are in balance, but for the swing that the slider's start has left, v each.
    """
    n, mu_static, speed = 6, 0.2, 1e-3
    contact = np.zeros((n, n), bool)
    contact[2, 3] = True
    pull = Pull.at(0.1, integrator, pulled_at(speed, PAPER))
    run = pull.simulate((contact, *uniform(n, mu_static, 0.1)[1:]))
    return pull.judge(run, run.static_friction, mu_static, 2.0 * speed / mu_static)


def refused_size(integrator: str, n: int, reason: str) -> Outcome:
    """The arrays take no memory."""
    contact, *mu = (np.broadcast_to(kind, (n, n)) for kind in (np.True_, 1.0, 0.6))
    return refusal(lambda: simulate(contact, mu[0], mu[1], integrator=integrator), reason)


def overflows(integrator: str) -> Iterator[Case]:
    """Thresholds and constants that are no numbers, and sliders too fast to follow."""
    case = partial(Case, "overflow", integrator)
    for value in (math.nan, math.inf, -1.0):
        name, reason = f"mu_s = {value} in one block", "mu_static must be finite"
        yield case(name, value, "none", ten_steps, (reason, {}, 3, value), "refused")
    for key, value in (("pressure", math.nan), ("slider_velocity", math.inf), ("spacing", 0.0)):
        name, reason = f"{key} = {value}", f"Material.{key} must be finite"
        yield case(name, value, "none", ten_steps, (reason, {key: value}), "refused")
    for what, derived, changes in (
        ("stiffness", "k_int", {"youngs_modulus": 1e308, "thickness": 1e5}),
        ("mass", "mass", {"density": 1e308, "spacing": 1e3}),
        ("load", "block_load", {"pressure": 1e308, "spacing": 1e10, "thickness": 1e10}),
    ):
        name = f"{what} beyond the largest float"
        reason = f"Material.{derived} outside the range"
        yield case(name, 1e308, "none", ten_steps, (reason, changes), "refused")
    for name, n, speed in (
        ("speed whose energy overflows", 1, 1e160),
        ("largest speed", 1, 1e308),
        ("speed that tears the springs", 3, 1e160),
    ):
        fast = {"slider_velocity": speed}
        yield case(name, speed, "none", ten_steps, ("at t = ", fast, n), "raises")


def ten_steps(
    integrator: str, reason: str, changes: dict[str, Any], n: int = 3, mu_static: float = 1.0
) -> Outcome:
    """Pull the paper's surface with other constants and one other threshold, which must fail."""
    contact, thresholds, mu_dynamic = flat(n, SEED)
    thresholds[0, 0] = mu_static

    def pull() -> Realisation:
        surface, material = (contact, thresholds, mu_dynamic), replace(PAPER, **changes)
        return Pull(integrator, material, 2e-8).simulate(surface, 10)

    return refusal(pull, reason)
