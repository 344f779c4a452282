"""Load: springs that leave the range of their series, and springs that collapse or burst."""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import cache

import numpy as np
from scipy.integrate import solve_ivp

from springblock.accuracy import reference
from springblock.accuracy.kernels import UNDAMPED
from springblock.accuracy.stability.cases import FRICTION, Case, Family, Outcome, compared, failure
from springblock.accuracy.stability.pull import PAPER, SEED, Pull, pulled_at, release
from springblock.accuracy.stability.schemes import limit
from springblock.accuracy.stability.surface import COLUMNS, FREE_COLUMN
from springblock.accuracy.surfaces import Array, Surface, flat
from springblock.model.material import Material
from springblock.simulation.run import Realisation
from springblock.simulation.simulate import SimulationError

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
    return pull, pull.simulate(FREE_COLUMN, count, direction=180 if speed < 0.0 else 0)


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
        return compared(value, closed_form, 2e-3, ("raises", "raises at another time"))
    return Outcome("holds")


@cache
def heavy_surface() -> tuple[Material, Surface, reference.Reference]:
    """Twenty times the paper's load on 3 x 3 blocks: a slip of 0.13 l; the reference solution."""
    material = pulled_at(0.01, replace(PAPER, pressure=20.0 * PAPER.pressure))
    surface, end = flat(3, SEED), 1.1 * release(material, 1.0)
    exact = reference.solve(*surface, material=material, duration=end, sample_interval=end / 1000)
    return material, surface, exact


def avalanche_beyond_the_series(integrator: str) -> Outcome:
    """Static friction is off by no more than the slider adds in a step."""
    material, surface, exact = heavy_surface()
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
    return failure(lambda: pull.simulate(flat(4, SEED)), "has collapsed")


def slip(load: float) -> float:
    """How far a block slips at P/E = `load`, over l, with l_z = l."""
    return load / 0.75


def cases(integrator: str) -> Iterator[Case]:
    """From strains within the range of the series to broken springs."""
    case, agrees, raises = Family("load", integrator).case, "agrees", "raises"
    for strain in (0.02, 0.1, 0.3, 0.6, -0.1, -0.3):
        name = f"column {'stretched' if strain > 0 else 'squeezed'} by {abs(strain):g}"
        yield case(name, abs(strain), agrees, "displacement, l", exact_form, strain)
    for strain, what in ((2.0, "stretched until it bursts"), (-1.0, "squeezed until it collapses")):
        name = f"column {what}"
        yield case(name, abs(strain), raises, "time, 1/omega", broken_spring, strain)
    name = "surface at P/E = 0.1"
    yield case(name, slip(0.1), agrees, FRICTION, avalanche_beyond_the_series)
    yield case("surface at P/E = 5", slip(5.0), raises, "none", avalanche_beyond_all)
