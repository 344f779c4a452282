"""What a case is, and what may come out of it."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from springblock.simulation.simulate import SimulationError

# Quantities that are judged in several modules.
FRICTION = "static friction"
FIRST = "first detachment, F_n/(K_s v)"
LARGEST = "omega_max times the largest step"


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
    attempt: Callable[[], Outcome]

    def outcome(self) -> Outcome:
        """Try; an exception that the case did not ask for is an outcome too, and a bad one."""
        try:
            return self.attempt()
        except Exception as error:
            return Outcome(f"{type(error).__name__}: {error}")


@dataclass(frozen=True)
class Family:
    """What is taken to its extremes, by one of the integrators."""

    name: str
    integrator: str

    def case(
        self,
        name: str,
        parameter: float,
        expected: str,
        quantity: str,
        attempt: Callable[..., Outcome],
        *arguments: Any,
    ) -> Case:
        """One of its cases; the attempt takes the integrator and these arguments."""
        call = partial(attempt, self.integrator, *arguments)
        named = f"{name}, {self.integrator}"
        return Case(named, self.name, self.integrator, parameter, expected, quantity, call)


def compared(
    value: float,
    closed_form: float,
    tolerance: float,
    words: tuple[str, str],
    energy_error: float = math.nan,
) -> Outcome:
    """The first of two words where `value` is close to the closed form, else the second."""
    close = abs(value / closed_form - 1.0) <= tolerance
    word = words[0] if close else words[1]
    return Outcome(word, energy_error, float(value), float(closed_form), float(tolerance))


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
