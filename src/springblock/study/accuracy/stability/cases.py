"""Cases of the table, runs of the solver for them, and the judgement of outcomes."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from springblock.model.material import Material
from springblock.model.surface import Surface
from springblock.simulation.motion import SimulationError
from springblock.simulation.run import Realisation
from springblock.simulation.setup import Setup
from springblock.simulation.simulate import simulate
from springblock.solver.integrators import limit

PAPER, UNDAMPED = Material(), Material(gamma=0.0)


@dataclass(frozen=True)
class Outcome:
    """Outcome of a case, with a value and its closed form where there are any."""

    outcome: str
    energy_error: float = math.nan
    quantity: str = "none"  #: name of the value
    value: float = math.nan
    closed_form: float = math.nan
    tolerance: float = math.nan

    @property
    def relative_error(self) -> float:
        """Return value/closed_form - 1; NaN where there is nothing to compare."""
        return self.value / self.closed_form - 1.0


@dataclass(frozen=True)
class Case:
    """An extreme case, the function that runs it, and its expected outcome."""

    family: str
    integrator: str
    extreme: str
    parameter: float  #: what varies within the family
    attempt: Callable[[str], Outcome]  #: takes the integrator
    expected: str = "agrees"

    @property
    def name(self) -> str:
        """Return the unique name of the case."""
        return f"{self.extreme}, {self.integrator}"

    def outcome(self) -> Outcome:
        """Run the case; an unexpected exception is its outcome."""
        try:
            return self.attempt(self.integrator)
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
        """Return a run with this share of the largest stable step."""
        return cls(integrator, material, share * limit(integrator, material))

    @property
    def h(self) -> float:
        """Return the step in 1/omega."""
        return self.step * self.material.omega_min

    @property
    def speed(self) -> float:
        """Return the slider's speed in F_n omega/K_s."""
        return self.material.slider_velocity / speed_unit(self.material)

    def simulate(self, surface: Surface, count: int | None = None, every: int = 0) -> Realisation:
        """Take `count` steps, by default until all slide; sample each `every`."""
        interval = (every or 1) * self.step if every or count else None
        setup = Setup(self.material, self.integrator, self.step, interval)
        return simulate(surface, setup, duration=count and count * self.step)

    def keeps_energy(self, run: Realisation) -> bool:
        """Return whether the residual of the energy balance is within its bound.

        For a mode at a share of the stability limit, the energy of the leapfrog varies between
        1 - share² and all of its energy; Runge-Kutta loses a share (omega h)⁶/72 in each step. The
        trapezoidal rule for the work of the slider is of second order in both. High modes have one
        or two tenths of the work. If the run ends during sliding, the residual also holds friction
        and damping of one step.
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
        self, run: Realisation, quantity: str, value: float, closed_form: float, tolerance: float
    ) -> Outcome:
        """Compare a value, within a relative tolerance, and judge the energy balance."""
        residual, error = run.energy.relative_residual, value / closed_form - 1.0
        word = "agrees" if self.keeps_energy(run) else f"energy is off by {residual:.2g}"
        if not abs(error) <= tolerance:
            word = f"is off by {error:.2g}"
        return Outcome(word, residual, quantity, float(value), float(closed_form), float(tolerance))

    def ends_in_error(self, surface: Surface, count: int) -> Outcome:
        """Take `count` steps, one of which must raise an error that names its time."""
        try:
            with np.errstate(all="ignore"):  # the error must not depend on warnings of NumPy
                self.simulate(surface, count)
        except SimulationError as error:
            return Outcome("raises" if "at t = " in str(error) else str(error))
        return Outcome("ends as if nothing were wrong")


def speed_unit(material: Material) -> float:
    """Return F_n omega/K_s, m/s."""
    return material.block_load * material.omega_min / material.k_s


def pulled_at(speed: float, material: Material) -> Material:
    """Return `material` under a slider of this speed, F_n omega/K_s."""
    return replace(material, slider_velocity=speed * speed_unit(material))
