"""How a surface is computed: the layer, the integrator and its times."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields, replace
from typing import Any

import numpy as np

from springblock.model.defaults import INTEGRATOR, SAMPLE_INTERVAL, STEP
from springblock.model.material import Material
from springblock.simulation.checks import check_positive, whole_multiple
from springblock.solver import INTEGRATORS
from springblock.solver.lattice import Integrator

PAPER = Material()


@dataclass(frozen=True)
class Setup:
    """What a run depends on besides its surface and its direction, by the keywords of `simulate`.

    Raises
    ------
    TypeError, ValueError
        Where a run could not be made, an unstable step among the reasons.
    """

    material: Material = PAPER
    integrator: str = INTEGRATOR
    step: float = STEP  #: s
    sample_interval: float = SAMPLE_INTERVAL  #: s, a multiple of the step

    def __post_init__(self) -> None:
        if not isinstance(self.material, Material):
            raise TypeError(f"material must be a Material, not {self.material!r}")
        if self.integrator not in INTEGRATORS:
            known = ", ".join(INTEGRATORS)
            raise ValueError(f"integrator must be one of {known}, not {self.integrator!r}")
        check_positive("step", self.step)
        self._check_stability()
        _ = self.every

    def vary(self, constants: Mapping[str, Any]) -> "Setup":
        """Return a setup with other constants of the material, another integrator or step."""
        own = {key: constants[key] for key in ("integrator", "step") if key in constants}
        material = {name: value for name, value in constants.items() if name not in own}
        return replace(self, material=replace(self.material, **material), **own)

    @property
    def constants(self) -> dict[str, Any]:
        """Constants of the material, integrator, step and sample interval, by name."""
        own = {field.name: getattr(self, field.name) for field in fields(self)}
        return {**dict(own.pop("material").items()), **own}

    def conditions(self, duration: float | None) -> dict[str, Any]:
        """All that a realisation depends on besides its scene and its seed; None: till its peak."""
        times = {"step": float(self.step), "sample_interval": float(self.sample_interval)}
        return {**asdict(self), **times, "duration": None if duration is None else float(duration)}

    @property
    def method(self) -> Integrator:
        """The integrator itself."""
        return INTEGRATORS[self.integrator]

    @property
    def every(self) -> int:
        """Steps per sample."""
        return whole_multiple("sample_interval", self.sample_interval, "step", self.step)

    def _check_stability(self) -> None:
        omega = np.linspace(self.material.omega_min, self.material.omega_max, 33)
        if self.method.is_stable(self.step, omega, self.material.gamma):
            return
        stable, unstable = 0.0, float(self.step)
        while unstable - stable > 1e-4 * unstable:
            middle = 0.5 * (stable + unstable)
            if self.method.is_stable(middle, omega, self.material.gamma):
                stable = middle
            else:
                unstable = middle
        raise ValueError(
            f"step = {self.step:.4g} s is unstable: "
            f"{self.integrator} needs less than {stable:.4g} s here"
        )
