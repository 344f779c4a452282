"""Motion of a surface: the state of a run between two calls of the compiled time loop."""

from typing import Any

import numpy as np

from springblock.model.direction import heading
from springblock.model.numbers import Array
from springblock.model.surface import Surface
from springblock.simulation.setup import Setup
from springblock.solver.integrators import INTEGRATORS
from springblock.solver.lattice import Samples, prepare, unpadded
from springblock.solver.law_file import FromFile
from springblock.solver.loop import advance, at_step


class SimulationError(RuntimeError):
    """A run cannot be continued."""


class Motion:
    """State of a run between two calls of the compiled time loop, and its samples so far.

    It starts from rest; arguments are those of `simulate` and `prepare`.
    """

    def __init__(
        self,
        surface: Surface,
        setup: Setup,
        direction: str | float,
        keep_peak: bool = False,
    ) -> None:
        self.surface, self.setup = surface, setup
        self.method = INTEGRATORS[setup.integrator]
        how = setup.material, heading(direction), self.method, setup.step, keep_peak
        self.state, self.constants = prepare(surface, *how)
        self.samples = 0  #: recorded so far, without the initial one
        self.record = [Samples.empty(1)]

    @property
    def steps(self) -> int:
        """Number of steps so far."""
        return self.samples * self.setup.every

    @property
    def newton(self) -> float:
        """Force in N that adds a velocity of one l per step in one step."""
        material, step = self.setup.material, self.setup.step
        force_time = self.method.force_time(step, material.gamma)
        return material.mass * material.spacing / (step * force_time)

    def proceed(self, until: int) -> None:
        """Advance to sample `until`; raise SimulationError if a spring breaks or the law fails."""
        if until == self.samples:
            return
        every, more, first = self.setup.every, until - self.samples, self.steps
        taken = Samples.empty(more)
        how = self.method, self.state, self.constants
        done, row, column = advance(*how, first, more * every, every, taken)
        now, law = (first + done) * self.setup.step, self.state.law
        if isinstance(law, FromFile) and law.failed[0] >= 0:
            raise SimulationError(f"before t = {now:.4g} s: {self._failure(law)}")
        if row >= 0:
            raise SimulationError(
                f"at t = {now:.4g} s a spring at block "
                f"(y, x) = ({row}, {column}) has collapsed to less than half its length, grown "
                "to more than twice, or become NaN"
            )
        self.append(taken)

    def _failure(self, law: FromFile) -> str:
        """Return why a law from a file failed, as Python reports it."""
        given: Any = self.setup.material.law
        b, *where = law.failed.tolist()
        blocks = self.state.blocks
        mu = (float(field.flat[int(b)]) / law.load for field in (blocks.static, blocks.dynamic))
        try:
            given.check(*mu, self.setup.step, *where)
        except ValueError as error:
            return str(error)
        return f"{given.file} fails at {where[0]} m/s, but not in Python"

    def append(self, taken: Samples) -> None:
        """Append samples that lead to the current state."""
        self.samples += len(taken.force_x)
        self.record.append(taken)

    def recorded(self) -> Samples:
        """Samples so far, in the kernels' units."""
        return Samples(*map(np.concatenate, zip(*self.record, strict=True)))

    @property
    def force(self) -> Array:
        """Friction force so far, (n,) N."""
        force_x, force_y, _ = self.recorded()
        return self.newton * np.hypot(force_x, force_y)

    def at_step(self) -> tuple[Array, float]:
        """Velocity (2, lattice) in l per step at this time, and the frictional heat so far."""
        return at_step(self.method, self.state, self.constants, self.steps)

    def displacement(self) -> Array:
        """(2, N_y, N_x) m."""
        blocks = self.state.blocks
        return self.setup.material.spacing * self.vectors(blocks.ux, blocks.uy)

    def vectors(self, x: Array, y: Array) -> Array:
        """Two components without their border, (2, N_y, N_x)."""
        return np.stack([unpadded(field, self.constants.grid) for field in (x, y)])
