"""The stability limit: steps up to it and beyond, and the highest mode, which sets it."""

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from springblock.accuracy import kernels
from springblock.accuracy.kernels import UNDAMPED
from springblock.accuracy.specimens import drawn
from springblock.accuracy.stability.cases import (
    FRICTION,
    LARGEST,
    PAPER,
    SEED,
    Case,
    Outcome,
    Pull,
    compared,
    named_after,
    pulled_at,
)
from springblock.model.material import Material
from springblock.model.pattern import Pattern
from springblock.simulation.run import Realisation

#: Avalanches on pillars excite the highest modes.
PILLARS = Pattern.pillars(8, 2, 2)
SYRUP = Material(gamma=10.0 * PAPER.omega_max, slider_velocity=5e-3)
#: Ten times the paper's pressure, on a quarter of the blocks: they slip by 0.27 l.
HEAVY = pulled_at(1e-3, replace(PAPER, pressure=10.0 * PAPER.pressure))
TINY = 1e-9  #: spacings, far within the linear range of the springs


def steps(integrator: str) -> Iterator[Case]:
    """Steps up to the stability limit and beyond, without damping and far overdamped."""
    case = partial(Case, "step", integrator)
    for share in (0.05, 0.1, 0.2, 0.5, 0.8, 0.9, 0.95, 0.99):
        name = f"pillars at {share:.0%} of the limit"
        yield case(name, share, FRICTION, near_the_limit, (PAPER, share), "stable")
    edge = kernels.STABLE[integrator] / PAPER.omega_max
    for share in (1.001, 1.01, 1.5, 10.0):
        name, arguments = f"pillars at {share:g} times the limit", (PAPER, share * edge, edge)
        yield case(name, share, LARGEST, beyond_the_limit, arguments, "refused")
    name, share = "strained pillars at 99% of the limit", 0.99
    yield case(name, share, FRICTION, near_the_limit, (HEAVY, share), "stable")
    edge = kernels.limit_of_damping(integrator, SYRUP)
    name, share = "overdamped pillars at 1.01 times the limit", 1.01
    yield case(name, share, LARGEST, beyond_the_limit, (SYRUP, share * edge, edge), "refused")
    for share, expected in ((0.99, "bounded"), (1.01, "grows")):
        name, quantity = f"highest mode at {share:.0%} of its limit", "amplitude after 30 steps"
        yield case(name, share, quantity, swing_of_the_highest_mode, (share,), expected)


def pull_pillars(pull: Pull) -> Realisation:
    """Pull until all pillars have slipped, sampled as in the paper."""
    return pull.simulate(drawn(PILLARS, SEED), every=max(1, round(2e-7 / pull.step)))


def near_the_limit(integrator: str, material: Material, share: float) -> Outcome:
    """Judge the energy balance, where too long a step shows first."""
    pull = Pull.at(share, integrator, material)
    run = pull_pillars(pull)
    word = "stable" if pull.keeps_energy(run) else "drifts"
    return Outcome(word, run.energy.relative_residual, run.static_friction)


def beyond_the_limit(integrator: str, material: Material, step: float, largest: float) -> Outcome:
    """Read the limit in the refusal: four digits, found by bisection to 1e-4; both in s."""
    try:
        pull_pillars(Pull(integrator, material, step))
    except ValueError as error:
        named, unit = named_after("less than ", error), 1.0 / material.omega_max
        return compared(named / unit, largest / unit, 1e-3, "refused")
    return Outcome("accepted")


def swing_of_the_highest_mode(integrator: str, share: float) -> Outcome:
    """Compare the wave that alternates along x, by the compiled loop, with the scheme's factor.

    The lattice is periodic. From 1e-9 spacings the wave grows to 2e-5, and is non-linear by the
    square of that.
    """
    taken, wave = 30, np.zeros((2, 8, 8))
    wave[0] = np.resize([1.0, -1.0], 8)
    phase = share * kernels.STABLE[integrator]
    step = phase / UNDAMPED.omega_max
    swung = kernels.swing(TINY * wave, taken, step, integrator, periodic=True)
    value = float(swung[0, 0, 0]) / TINY
    # leapfrog starts from rest half a step before, and so below its amplitude
    bound = 1.0
    if integrator == "leapfrog":
        bound /= abs(np.cos(np.arcsin(complex(phase / 2.0))))
    word = "bounded" if abs(value) <= bound else "grows"
    return compared(value, kernels.swing_factor(integrator, phase, taken), 1e-6, word)
