"""Overflow: numbers that are none, and numbers that become none."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from springblock.accuracy.stability.cases import Case, Family, Outcome, failure, refusal
from springblock.accuracy.stability.pull import PAPER, SEED, Pull
from springblock.accuracy.surfaces import flat
from springblock.simulation.run import Realisation


def ten_steps(
    integrator: str, n: int, changes: Mapping[str, Any], mu_static: float = 1.0
) -> Realisation:
    """Ten steps of the paper's surface; one threshold and some constants are others."""
    contact, thresholds, mu_dynamic = flat(n, SEED)
    thresholds[0, 0] = mu_static
    pull = Pull(integrator, replace(PAPER, **changes), 2e-8)
    return pull.simulate((contact, thresholds, mu_dynamic), 10)


def refused_threshold(integrator: str, value: float) -> Outcome:
    """Before any step."""
    return refusal(lambda: ten_steps(integrator, 3, {}, value), "mu_static must be finite")


def refused_constants(integrator: str, reason: str, changes: Mapping[str, float]) -> Outcome:
    """Before any step."""
    return refusal(lambda: ten_steps(integrator, 3, changes), reason)


def failing_constants(integrator: str, n: int, changes: Mapping[str, float]) -> Outcome:
    """The error names the time."""
    return failure(lambda: ten_steps(integrator, n, changes), "at t = ")


def cases(integrator: str) -> Iterator[Case]:
    """A threshold, then constants, then a slider too fast to follow."""
    case, refused, none = Family("overflow", integrator).case, "refused", "none"
    for value in (math.nan, math.inf, -1.0):
        name = f"mu_s = {value} in one block"
        yield case(name, value, refused, none, refused_threshold, value)
    for key, value in (("pressure", math.nan), ("slider_velocity", math.inf), ("spacing", 0.0)):
        name, reason = f"{key} = {value}", f"Material.{key} must be finite"
        yield case(name, value, refused, none, refused_constants, reason, {key: value})
    for what, derived, changes in (
        ("stiffness", "k_int", {"youngs_modulus": 1e308, "thickness": 1e5}),
        ("mass", "mass", {"density": 1e308, "spacing": 1e3}),
        ("load", "block_load", {"pressure": 1e308, "spacing": 1e10, "thickness": 1e10}),
    ):
        reason = f"Material.{derived} beyond floating point"
        name = f"{what} beyond the largest float"
        yield case(name, 1e308, refused, none, refused_constants, reason, changes)
    for name, n, speed in (
        ("speed whose energy overflows", 1, 1e160),
        ("largest speed", 1, 1e308),
        ("speed that tears the springs", 3, 1e160),
    ):
        yield case(name, speed, "raises", none, failing_constants, n, {"slider_velocity": speed})
