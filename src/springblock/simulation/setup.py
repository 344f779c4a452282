"""Setup of a run: material, integrator, step and sample interval."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from springblock.model.defaults import INTEGRATOR, STEP
from springblock.model.law import LawFile
from springblock.model.material import Material
from springblock.model.numbers import check_real
from springblock.solver.integrators import INTEGRATORS, is_stable, limit

PAPER = Material()
#: Largest number of steps times blocks, and the number that takes one core a year (leapfrog).
_MOST_STEPS, _STEPS_PER_YEAR = 1e16, 7e15
#: Largest number of blocks times snapshots in a run: 6 GB of fields.
_MOST_IN_SNAPSHOTS = 2**27


def check_type(name: str, value: Any, kind: type) -> None:
    """Refuse a value of another type."""
    if not isinstance(value, kind):
        raise TypeError(f"{name} must be a {kind.__name__}, not {value!r}")


def _whole_multiple(name: str, value: float, unit_name: str, unit: float) -> int:
    """Return `value` divided by `unit`; raise ValueError unless it is a whole number."""
    check_real(name, value)
    ratio = value / unit
    count = round(ratio) if math.isfinite(ratio) else 0
    if count < 1 or abs(ratio - count) > 1e-6 * count:
        near = f", such as {unit * max(1, math.floor(ratio)):.10g} s" if ratio < 1e6 else ""
        raise ValueError(
            f"{name} must be a multiple of {unit_name} = {unit!r} s{near}, not {value!r} s"
        )
    return count


@dataclass(frozen=True)
class Setup:
    """Material and numerical parameters of a run.

    Parameters
    ----------
    material : Material
    integrator : "leapfrog" or "rk4"
    step : s
        Integration step h.
    sample_interval : s, or None
        Time between samples of the force; a multiple of the step. None: as many steps as fit into
        2e-7 s, and into a 60th of the loading time, but at least one.

    Raises
    ------
    TypeError, ValueError
        If a value is not valid, or the step is unstable.
    """

    material: Material = PAPER
    integrator: str = INTEGRATOR
    step: float = STEP
    sample_interval: float | None = None

    def __post_init__(self) -> None:
        check_type("material", self.material, Material)
        if self.integrator not in INTEGRATORS:
            known = ", ".join(INTEGRATORS)
            raise ValueError(f"integrator must be one of {known}, not {self.integrator!r}")
        check_real("step", self.step)
        law = self.material.law
        if isinstance(law, LawFile):
            law.check(self.material.mu_static, self.material.mu_dynamic, self.step)
        lasting = self.material.healing == "none"
        if (lasting or isinstance(law, LawFile)) and not INTEGRATORS[self.integrator].keeps_state:
            what = "healing none" if lasting else f"the law {law}"
            able = " or ".join(name for name, each in INTEGRATORS.items() if each.keeps_state)
            raise ValueError(f"integrator must be {able} with {what}, not {self.integrator!r}")
        if not is_stable(self.integrator, self.step, self.material):
            raise ValueError(
                f"step = {self.step:.4g} s is unstable: {self.integrator} needs less than "
                f"{limit(self.integrator, self.material):.4g} s here"
            )
        _ = self.every
        longest = max(self.material.longest_interval(), self.step)
        if self.interval > (1.0 + 1e-6) * longest:
            raise ValueError(
                f"sample_interval = {self.interval!r} s is too long for slider_velocity = "
                f"{self.material.slider_velocity!r} m/s, since static friction would be too low; "
                f"choose at most {self.material.usual_interval(self.step):.10g} s"
            )

    @property
    def constants(self) -> dict[str, Any]:
        """Constants of the material, integrator, step and sample interval, by name."""
        own = {field.name: getattr(self, field.name) for field in fields(self)}
        return {**dict(own.pop("material").items()), **own, "sample_interval": self.interval}

    @property
    def interval(self) -> float:
        """Time between samples of the force, s, given or chosen."""
        if self.sample_interval is not None:
            return self.sample_interval
        return self.material.usual_interval(self.step)

    @property
    def every(self) -> int:
        """Steps per sample."""
        return _whole_multiple("sample_interval", self.interval, "step", self.step)

    def loading_time(self, contact: NDArray[np.bool_], threshold: float) -> float:
        """Time t = mu F_n/(K_s v), s, at which a block without neighbours would detach.

        `threshold` is mu; the blocks in contact share the load on all blocks.
        """
        load = self.material.block_load * contact.size / np.count_nonzero(contact)
        with np.errstate(all="ignore"):  # infinite where the slider hardly moves
            rate = np.float64(self.material.k_s * self.material.slider_velocity)
            return float(threshold * load / rate)

    def plan(
        self,
        contact: NDArray[np.bool_],
        threshold: float,
        duration: float | None = None,
        snapshot_times: Sequence[float] = (),
    ) -> tuple[int | None, list[int]]:
        """Count the sample intervals of a run, if it has a duration, and those to each snapshot.

        Times are in s. Without a duration, a run is taken to last for the loading time of its
        strongest block, whose coefficient is `threshold`, and until its last snapshot.

        Raises
        ------
        TypeError, ValueError
            If a time is not valid, or the run would take 1.4 years or more on one core, or has
            more snapshots than fit in memory.
        """
        interval, intervals = self.interval, math.inf
        if duration is not None:
            check_real("duration", duration)
            intervals = duration / interval + 1e-6
            if intervals < 1.0:
                raise ValueError(
                    f"duration must be at least one sample_interval = {interval!r} s, "
                    f"not {duration!r} s"
                )
        at_samples = [
            _whole_multiple("snapshot_times", time, "sample_interval", interval)
            for time in snapshot_times
        ]
        if at_samples != sorted(set(at_samples)):
            raise ValueError("snapshot_times must be in ascending order, without repetition")
        if at_samples and at_samples[-1] > intervals:
            raise ValueError(f"snapshot_times must lie within the duration of {duration!r} s")
        if len(at_samples) * contact.size > _MOST_IN_SNAPSHOTS:
            raise ValueError(
                f"snapshot_times has {len(at_samples)} times; of {contact.size} blocks at most "
                f"{_MOST_IN_SNAPSHOTS // contact.size} snapshots can be kept"
            )
        if duration is None:
            loading = self.loading_time(contact, threshold)
            time = max(loading, interval, *snapshot_times)
            self._check_cost(contact.size, "loading time", time)
            return None, at_samples
        self._check_cost(contact.size, "duration", duration)
        return int(intervals), at_samples

    def _check_cost(self, blocks: int, reason: str, time: float) -> None:
        """Refuse a run over this time, s, that takes too many steps."""
        steps = time / self.step
        if not steps * blocks < _MOST_STEPS:
            raise ValueError(
                f"step = {self.step!r} s is too short for a {reason} of {time:.4g} s: "
                f"{steps:.2g} steps of {blocks} blocks would take "
                f"{steps * blocks / _STEPS_PER_YEAR:.2g} years or more"
            )


#: Default of all functions and commands.
DEFAULT = Setup()
