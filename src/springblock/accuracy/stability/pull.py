"""Pulling a surface with a material, an integrator and a step, and judging what comes out."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from springblock.accuracy.stability.cases import Outcome, compared
from springblock.accuracy.stability.schemes import limit
from springblock.accuracy.surfaces import Surface
from springblock.model.material import Material
from springblock.simulation.run import Realisation
from springblock.simulation.simulate import simulate

PAPER = Material()
SEED = 1
ROUNDING = 1e-12  #: relative, of a few hundred steps


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

    def with_speed(self, speed: float) -> "Pull":
        """The same under a slider of this speed."""
        return replace(self, material=pulled_at(speed, self.material))

    @property
    def h(self) -> float:
        """The step in 1/omega."""
        return self.step * self.material.omega_min

    def simulate(
        self, surface: Surface, count: int | None = None, every: int = 0, **options: Any
    ) -> Realisation:
        """Take `count` steps and sample `every` so many, or at the end; without, to the minimum."""
        every = every or count or 5
        return simulate(
            *surface,
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
        word: str = "agrees",
        contact: int | None = None,
    ) -> Outcome:
        """Say `word` if both the value and the energy residual are what they may be."""
        residual = run.energy.relative_residual
        if not abs(residual) <= self.may_miss(run, contact or run.t_det.size):
            word = f"energy is off by {residual:.2g}"
        words = word, f"is off by {value / closed_form - 1.0:.2g}"
        return compared(value, closed_form, tolerance, words, residual)


def pulled_at(speed: float, material: Material) -> Material:
    """`material` under a slider of this speed."""
    unit = material.block_load * material.omega_min / material.k_s
    return replace(material, slider_velocity=speed * unit)


def release(material: Material, threshold: float) -> float:
    """Time at which a block lets go whose neighbours do not pull, s."""
    return threshold * material.block_load / (material.k_s * material.slider_velocity)
