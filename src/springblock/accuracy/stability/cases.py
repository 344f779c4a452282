"""A case of the table, how a surface is pulled in it, and how its outcome is judged."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from springblock.model.material import Material
from springblock.model.surface import Surface
from springblock.simulation.run import Realisation
from springblock.simulation.setup import Setup
from springblock.simulation.simulate import simulate
from springblock.solver.stability import limit

PAPER = Material()
SEED = 1
ROUNDING = 1e-12  #: relative, of a few hundred steps

# Quantities that are judged in several families.
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
        """Return value/closed_form - 1; NaN where there is nothing to compare."""
        return self.value / self.closed_form - 1.0


@dataclass(frozen=True)
class Case:
    """One extreme, the attempt that shows it, and the outcome that is expected."""

    family: str
    integrator: str
    extreme: str
    parameter: float  #: what varies within the family
    quantity: str  #: what `Outcome.value` is
    attempt: Callable[..., Outcome]  #: takes the integrator and the arguments
    arguments: tuple[Any, ...] = ()
    expected: str = "agrees"

    @property
    def name(self) -> str:
        """Return the name of the case, which no other one has."""
        return f"{self.extreme}, {self.integrator}"

    def outcome(self) -> Outcome:
        """Run the attempt; an exception that it did not ask for is an outcome too."""
        try:
            return self.attempt(self.integrator, *self.arguments)
        except Exception as error:
            return Outcome(f"{type(error).__name__}: {error}")


@dataclass(frozen=True)
class Pull:
    """A material, an integrator and its step, s."""

    integrator: str
    material: Material
    step: float

    @classmethod
    def at(cls, share: float, integrator: str, material: Material) -> "Pull":
        """Take this share of the largest stable step."""
        return cls(integrator, material, share * limit(integrator, material))

    def with_speed(self, speed: float) -> "Pull":
        """Return the same pull with a slider of this speed."""
        return replace(self, material=pulled_at(speed, self.material))

    @property
    def h(self) -> float:
        """Return the step in 1/omega."""
        return self.step * self.material.omega_min

    @property
    def speed(self) -> float:
        """Return the slider's speed in F_n omega/K_s."""
        return 1.0 / (release(self.material) * self.material.omega_min)

    def simulate(
        self, surface: Surface, count: int | None = None, every: int = 0, **options: Any
    ) -> Realisation:
        """Take `count` steps, sampling `every` so many or at the end; by default until all slid."""
        every = every or count or 5
        setup = Setup(self.material, self.integrator, self.step, every * self.step)
        return simulate(surface, setup, duration=count and count * self.step, **options)

    def keeps_energy(self, run: Realisation) -> bool:
        """Judge the error of the energy balance, as a share of the work.

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
        load = run.normal_force / np.count_nonzero(run.contact)
        heat = load * float(speed[np.isfinite(run.t_det)].sum())
        underway = (heat + drag) * self.step / run.energy.work_in
        bound = min(drift, 0.2) + underway + 1e-15 * run.steps  # rounding
        return bool(abs(run.energy.relative_residual) <= bound)

    def judge(
        self,
        run: Realisation,
        value: float,
        closed_form: float,
        tolerance: float,
        word: str = "agrees",
    ) -> Outcome:
        """Return `word` if both the value and the energy balance are within their bounds."""
        residual = run.energy.relative_residual
        if not self.keeps_energy(run):
            word = f"energy is off by {residual:.2g}"
        return compared(value, closed_form, tolerance, word, residual)


def compared(
    value: float, closed_form: float, tolerance: float, word: str, energy_error: float = math.nan
) -> Outcome:
    """Return `word` where `value` is as close to the closed form as its tolerance."""
    error = value / closed_form - 1.0
    word = word if abs(error) <= tolerance else f"is off by {error:.2g}"
    return Outcome(word, energy_error, float(value), float(closed_form), float(tolerance))


def named_after(words: str, error: Exception) -> float:
    """Return the number that follows these words in an error."""
    return float(str(error).split(words)[1].split()[0])


def pulled_at(speed: float, material: Material) -> Material:
    """Return `material` under a slider of this speed."""
    unit = material.block_load * material.omega_min / material.k_s
    return replace(material, slider_velocity=speed * unit)


def release(material: Material, threshold: float = 1.0) -> float:
    """Return the time at which a block lets go whose neighbours do not pull, s."""
    return threshold * material.block_load / (material.k_s * material.slider_velocity)
