"""Columns and surfaces: stiffness, strain, scatter, load, size, and sliders too fast."""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import cache, partial

import numpy as np
from scipy.integrate import solve_ivp

from springblock.accuracy import kernels
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
    release,
)
from springblock.model.material import Material
from springblock.model.surface import Surface
from springblock.simulation.motion import SimulationError
from springblock.simulation.run import Realisation
from springblock.solver.stability import limit

#: Two columns of two blocks, the left one held fast. The free ones move by (a, b) and (a, -b): the
#: axial spring beside them, the one between them (strained by 2b), and a diagonal give K_int times
#: this matrix.
COLUMNS = np.array([[1.25, -0.25], [-0.25, 2.25]])
FREE_COLUMN = Surface([[1, 0], [1, 0]], mu_static=1e9, mu_dynamic=0.0)
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
    case = partial(Case, "strain", integrator)
    for strain in (1e-1, 1e-2, 1e-3, 1e-5, 1e-7, 1e-9):
        name = f"column at a strain of {strain:g}"
        yield case(name, strain, moved, free_column, (material_of(1.0, strain),))
    case = partial(Case, "scatter", integrator)
    for sigma in (0.0, 0.05, 0.1, 0.25, 0.5):
        name = f"surface with sigma = {sigma:g}"
        yield case(name, sigma, FIRST, first_detachment, (scattered(sigma),))


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
    run, weakest = pull.simulate(surface), np.maximum(surface.mu_static, surface.mu_dynamic).min()
    return pull.judge(run, run.t_first / release(material), weakest, ROUNDING)


def loads(integrator: str) -> Iterator[Case]:
    """Springs that leave the range of their series, and springs that collapse or burst."""
    case = partial(Case, "load", integrator)
    for strain in (0.02, 0.1, 0.3, 0.6, -0.1, -0.3):
        name = f"column {'stretched' if strain > 0 else 'squeezed'} by {abs(strain):g}"
        yield case(name, abs(strain), "displacement, l", strained_column, (strain,))
    for strain, what in ((2.0, "stretched until it bursts"), (-1.0, "squeezed until it collapses")):
        name, when = f"column {what}", "time, 1/omega"
        yield case(name, abs(strain), when, broken_spring, (strain,), "raises")


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
    count = math.ceil(end / (0.01 * limit(integrator, material)))
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


def sizes(integrator: str) -> Iterator[Case]:
    """From one block to a million: alike, with scatter, and one in contact."""
    case = partial(Case, "size", integrator)
    for n in (2, 3, 1000):
        yield case(f"{n} x {n} blocks alike", n, "greatest force, P l² N²", blocks_alike, (n,))
    for n in (1, 2, 3):
        name = f"{n} x {n} blocks with scatter"
        yield case(name, n, FIRST, first_detachment, (scattered(0.1), n))
    yield case("one contact block", 6, FRICTION, one_contact_block)


def blocks_alike(integrator: str, n: int) -> Outcome:
    """No spring between blocks is ever strained: N² times one block, in the midst of its slip.

    To rounding, of one step and of a sum over all blocks.
    """
    pull, count = Pull.at(0.1, integrator, UNDAMPED), 40
    pull = pull.with_speed(4.0 / (count * pull.h))
    one, run = (pull.simulate(uniform(size, 1.0, 0.6), count) for size in (1, n))
    tolerance = ROUNDING + 1e-16 * n * n
    return pull.judge(run, run.static_friction, one.static_friction, tolerance)


def one_contact_block(integrator: str) -> Outcome:
    """It bears the whole load and holds all the others: static friction is its own.

    They are in balance, but for the swing that the slider's start has left, v each.
    """
    n, mu_static, speed = 6, 0.2, 1e-3
    contact = np.zeros((n, n), bool)
    contact[2, 3] = True
    pull = Pull.at(0.1, integrator, pulled_at(speed, PAPER))
    run = pull.simulate(Surface(contact, mu_static, 0.1))
    return pull.judge(run, run.static_friction, mu_static, 2.0 * speed / mu_static)


def overflows(integrator: str) -> Iterator[Case]:
    """Sliders too fast to follow."""
    case = partial(Case, "overflow", integrator)
    for name, n, speed in (
        ("speed whose energy overflows", 1, 1e160),
        ("largest speed", 1, 1e308),
        ("speed that tears the springs", 3, 1e160),
    ):
        yield case(name, speed, "none", too_fast, (n, speed), "raises")


def too_fast(integrator: str, n: int, speed: float) -> Outcome:
    """Ten steps under a slider of this speed, m/s, must end in an error that names its time."""
    pull = Pull(integrator, replace(PAPER, slider_velocity=speed), 2e-8)
    try:
        with np.errstate(all="ignore"):  # the error has to come without NumPy's warnings
            pull.simulate(flat(n, SEED), 10)
    except SimulationError as error:
        return Outcome("raises" if "at t = " in str(error) else str(error))
    return Outcome("ends as if nothing were wrong")
