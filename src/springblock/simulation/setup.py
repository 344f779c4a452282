"""Setup of a run: material, integrator, step and sample interval."""

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from springblock.model.defaults import INTEGRATOR, SAMPLE_INTERVAL, STEP
from springblock.model.law import LawFile
from springblock.model.material import Material
from springblock.simulation.checks import check_positive, check_type, whole_multiple
from springblock.solver.stability import IS_STABLE, is_stable, limit

PAPER = Material()
#: Largest number of steps times blocks, and the number that takes one core a year.
_MOST_STEPS, _STEPS_PER_YEAR = 1e16, 7e15
#: Largest number of samples, the limit of a cell of a table.
_MOST_SAMPLES = 2**31 - 1


@dataclass(frozen=True)
class Setup:
    """Material and numerical parameters of a run.

    Parameters
    ----------
    material : Material
    integrator : "leapfrog" or "rk4"
    step : s
        Integration step h.
    sample_interval : s
        Time between samples of the force; a multiple of the step.

    Raises
    ------
    TypeError, ValueError
        If a value is not valid, or the step is unstable.
    """

    material: Material = PAPER
    integrator: str = INTEGRATOR
    step: float = STEP
    sample_interval: float = SAMPLE_INTERVAL

    def __post_init__(self) -> None:
        check_type("material", self.material, Material)
        if self.integrator not in IS_STABLE:
            known = ", ".join(IS_STABLE)
            raise ValueError(f"integrator must be one of {known}, not {self.integrator!r}")
        check_positive("step", self.step)
        self._check_law()
        if not is_stable(self.integrator, self.step, self.material):
            stable = limit(self.integrator, self.material)
            raise ValueError(
                f"step = {self.step:.4g} s is unstable: "
                f"{self.integrator} needs less than {stable:.4g} s here"
            )
        _ = self.every

    def vary(self, constants: Mapping[str, Any]) -> "Setup":
        """Return a setup with other constants of the material, another integrator or step."""
        own = {key: constants[key] for key in ("integrator", "step") if key in constants}
        others = {name: value for name, value in constants.items() if name not in own}
        return replace(self, material=self.material.vary(others), **own)

    @property
    def constants(self) -> dict[str, Any]:
        """Constants of the material, integrator, step and sample interval, by name."""
        own = {field.name: getattr(self, field.name) for field in fields(self)}
        return {**dict(own.pop("material").items()), **own}

    @property
    def every(self) -> int:
        """Steps per sample."""
        return whole_multiple("sample_interval", self.sample_interval, "step", self.step)

    def loading_time(self, contact: NDArray[np.bool_], threshold: float) -> float:
        """Time t = mu F_n/(K_s v), s, at which a block without neighbours would detach.

        `threshold` is mu; the blocks in contact share the load on all (N_y, N_x).
        """
        load = self.material.block_load * contact.size / np.count_nonzero(contact)
        with np.errstate(all="ignore"):  # infinite where the slider hardly moves
            rate = np.float64(self.material.k_s * self.material.slider_velocity)
            return float(threshold * load / rate)

    def check_length(
        self,
        contact: NDArray[np.bool_],
        threshold: float,
        duration: float | None = None,
        until: float = 0.0,
    ) -> None:
        """Refuse a run that would be too long.

        Without a duration, a run lasts for the loading time of its strongest block, whose
        coefficient is `threshold`, and at least `until` its last snapshot, s.

        Raises
        ------
        TypeError, ValueError
            If the duration is not a positive time, or if the run would take more than a year on one
            core or have more samples than a table can hold.
        """
        if duration is None:
            loading = self.loading_time(contact, threshold)
            reason, time = "loading time", max(loading, until, self.sample_interval)
        else:
            check_positive("duration", duration)
            reason, time = "duration", duration
        steps, samples = time / self.step, time / self.sample_interval
        if not steps * contact.size < _MOST_STEPS:
            years = steps * contact.size / _STEPS_PER_YEAR
            raise ValueError(
                f"step = {self.step!r} s is too short for a {reason} of {time:.4g} s: "
                f"{steps:.2g} steps of {contact.size} blocks would take {years:.2g} years"
            )
        if samples > _MOST_SAMPLES:
            raise ValueError(
                f"sample_interval = {self.sample_interval!r} s is too short for a {reason} of "
                f"{time:.4g} s: it gives {samples:.2g} samples, and a table holds {_MOST_SAMPLES}"
            )

    def _check_law(self) -> None:
        law = self.material.law
        if isinstance(law, LawFile):
            law.check(self.material.mu_static, self.material.mu_dynamic, self.step)
            if self.integrator != "leapfrog":
                raise ValueError(
                    f"integrator must be leapfrog with the law {law}, not {self.integrator!r}"
                )


#: Setup of the paper.
DEFAULT = Setup()
