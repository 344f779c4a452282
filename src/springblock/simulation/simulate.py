"""Simulation of one realisation from contact mask and friction coefficients."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from tqdm import tqdm

from springblock.model.direction import heading
from springblock.model.surface import Surface
from springblock.simulation.checkpoint import Checkpoint, belonging
from springblock.simulation.checks import check_type, count_samples, snapshot_samples
from springblock.simulation.energy import Energy, elastic_energy
from springblock.simulation.fields import Fields
from springblock.simulation.prelude import Prelude, conditions
from springblock.simulation.run import Realisation, first_minimum
from springblock.simulation.setup import DEFAULT, Setup
from springblock.solver.integrators import INTEGRATORS, on_cores
from springblock.solver.lattice import (
    SQUARES,
    WORK,
    Advance,
    Constants,
    Samples,
    State,
    prepare,
    unpadded,
)
from springblock.solver.law_file import FromFile
from springblock.solver.shear import shear_forces

Array = NDArray[np.float64]

#: Sample intervals between two tests whether a run is complete.
_SAMPLES_PER_CALL = 10
#: A run whose force does not drop (mu_d = mu_s, or strong damping) ends at this multiple of the
#: time of the last first detachment.
_WITHOUT_DROP = 1.5
#: A run fails at this multiple of the loading time of its strongest block, mu_s F_n/(K_s v).
_LATEST = 3.0


class SimulationError(RuntimeError):
    """A run cannot be continued."""


def simulate(
    surface: Surface,
    setup: Setup = DEFAULT,
    direction: str | float = "x",
    duration: float | None = None,
    snapshot_times: Sequence[float] = (),
    prelude: Prelude | None = None,
    cores: int = 1,
    progress: bool = False,
    checkpoint: str | Path | None = None,
    checkpoint_interval: float = 300.0,
) -> Realisation:
    """Pull one surface from rest and record force and detachments.

    The model is that of section 2 of Costagliola, Bosia & Pugno 2022,
    doi:10.1016/j.ijsolstr.2022.111525.

    Parameters
    ----------
    surface : Surface
        Blocks in contact, and their friction coefficients.
    setup : Setup
        Material, integrator, step and sample interval; the paper's by default.
    direction : "x", "y" or an angle from x in degrees
        Sliding direction.
    duration : s, or None
        None: until every contact block has detached and the force has passed its peak and the
        first minimum after it. If the force does not drop, until 1.5 times the time of the last
        first detachment.
    snapshot_times : s
        Times at which `Realisation.fields` are stored, in ascending order; multiples of the
        sample interval. A run without duration lasts at least until the last of them.
    prelude : Prelude
        States of the same scene before its first detachment, see `compute_prelude`. They save
        time; results are the same.
    cores : int
        Number of cores for the leapfrog on one large surface; results are the same to the bit.
    progress : bool
        Whether to show a progress bar on stderr.
    checkpoint : Path
        File for the state of the unfinished run. If it exists, the run continues from it, to the
        same bits; it is removed at the end.
    checkpoint_interval : s
        Wall-clock seconds between two checkpoints.

    Raises
    ------
    TypeError, ValueError
        If an argument is not valid, or prelude or checkpoint belong to another run.
    SimulationError
        If a spring leaves 1/2 to 2 times its rest length or becomes NaN, with time and block; or
        if blocks do not detach in a run without duration.
    """
    check_type("surface", surface, Surface)
    check_type("setup", setup, Setup)
    contact, strongest, interval = surface.contact, surface.strongest, setup.sample_interval
    advance, towards = on_cores(setup.integrator, cores), heading(direction)
    stops = snapshot_samples(snapshot_times, interval, contact.size, duration)
    setup.check_length(contact, strongest, duration, until=max(snapshot_times, default=0.0))
    end = None if duration is None else count_samples(duration, interval)
    limit = _LATEST * setup.loading_time(contact, strongest)

    method = INTEGRATORS[setup.integrator]
    motion = _Motion(setup, advance, *prepare(surface, setup.material, towards, method, setup.step))
    here = conditions(contact, setup, towards, surface.periodic)
    kept, snapshots = None, list[Array]()
    if checkpoint is not None:
        friction = surface.mu_static, surface.mu_dynamic
        belongs = belonging(here, friction, duration=end, snapshot_times=stops)
        kept = Checkpoint(Path(checkpoint), checkpoint_interval, belongs)
        snapshots = motion.resume(kept)
    if prelude is not None:
        motion.skip(prelude, here, min([*stops, math.inf if end is None else end]) - 1)
    with tqdm(total=end, initial=motion.samples, unit=" samples", disable=not progress) as bar:
        while len(snapshots) < len(stops) or not motion.is_over(end, limit):
            pause = (motion.samples // _SAMPLES_PER_CALL + 1) * _SAMPLES_PER_CALL
            pause = pause if end is None else min(pause, end)
            for stop in [stop for stop in stops if motion.samples < stop <= pause]:
                motion.proceed(stop)
                snapshots.append(motion.snapshot())
            motion.proceed(pause)
            bar.update(motion.samples - bar.n)
            if kept is not None and kept.is_due:
                kept.save(motion.state, motion.recorded(), snapshots)
    run = motion.result(snapshots, stops)
    if kept is not None:
        kept.path.unlink(missing_ok=True)
    return run


@dataclass
class _Motion:
    """State of a run between two calls of the compiled time loop."""

    setup: Setup
    advance: Advance
    state: State
    constants: Constants
    samples: int = 0  #: recorded so far, without the initial one
    record: list[Samples] = field(default_factory=lambda: [Samples.empty(1)])

    @property
    def steps(self) -> int:
        """Number of steps so far."""
        return self.samples * self.setup.every

    def skip(self, prelude: Prelude, expected: str, latest: float) -> None:
        """Start from the latest valid state of a prelude instead of from zero."""
        if prelude.conditions != expected:
            raise ValueError(
                "this prelude belongs to another scene, material, integrator, step or "
                "sample_interval"
            )
        if not self.samples:
            self.samples, taken = prelude.start(self.state, self.constants, latest)
            self.record.append(taken)

    def resume(self, kept: Checkpoint) -> list[Array]:
        """Continue from a checkpoint, if there is one; return the snapshots up to then."""
        if not kept.path.exists():
            return []
        taken, snapshots = kept.restore(self.state)
        self.samples, self.record = len(taken.force_x) - 1, [taken]
        return snapshots

    def proceed(self, until: int) -> None:
        """Advance to sample `until`."""
        if until == self.samples:
            return
        every, more, first = self.setup.every, until - self.samples, self.steps
        taken = Samples.empty(more)
        done, row, column = self.advance(
            self.state, self.constants, first, more * every, every, taken
        )
        now, law = (first + done) * self.setup.step, self.state.law
        if isinstance(law, FromFile) and law.failed[0] >= 0:
            raise SimulationError(
                f"before t = {now:.4g} s the law {self.setup.material.law} returned a friction "
                "coefficient that is negative or not finite"
            )
        if row >= 0:
            raise SimulationError(
                f"at t = {now:.4g} s a spring at block "
                f"(y, x) = ({row}, {column}) has collapsed to less than half its length, grown "
                "to more than twice, or become NaN"
            )
        self.samples = until
        self.record.append(taken)

    def is_over(self, end: int | None, limit: float) -> bool:
        """Return whether the run is complete, see `simulate`."""
        if end is not None:
            return self.samples >= end
        blocks, step = self.state.blocks, self.setup.step
        t_det = blocks.t_det[blocks.static > 0.0] * step
        last = float(t_det.max())
        now = self.steps * step
        if math.isfinite(last):
            force = np.hypot(*self.recorded()[:2])
            return now > _WITHOUT_DROP * last or first_minimum(force) is not None
        if now > limit:
            stuck = int(np.isinf(t_det).sum())
            raise SimulationError(
                f"at t = {now:.4g} s {stuck} contact blocks have not detached; "
                "if this is intended, set a duration"
            )
        return False

    def recorded(self) -> Samples:
        """Samples so far, in the kernels' units."""
        return Samples(*map(np.concatenate, zip(*self.record, strict=True)))

    def displacement(self) -> Array:
        """(2, N_y, N_x) m."""
        blocks = self.state.blocks
        return self.setup.material.spacing * self._vectors(blocks.ux, blocks.uy)

    def snapshot(self) -> Array:
        """Displacement, velocity and stress of `Fields`, (3, 2, N_y, N_x)."""
        state, constants, material = self.state, self.constants, self.setup.material
        own, _ = INTEGRATORS[self.setup.integrator].at_step(state, constants, self.steps)
        force = self._newton() * self._vectors(*shear_forces(state, constants, self.steps, own))
        velocity = self._vectors(*own) * material.spacing / self.setup.step
        return np.stack([self.displacement(), velocity, force / material.spacing**2])

    def _vectors(self, x: Array, y: Array) -> Array:
        """Two components without their border, (2, N_y, N_x)."""
        return np.stack([unpadded(field, self.constants.grid) for field in (x, y)])

    def result(self, snapshots: list[Array], stops: list[int]) -> Realisation:
        """Return the results in SI units."""
        grid, material, step = self.constants.grid, self.setup.material, self.setup.step
        n_y, n_x = grid.shape
        t_det = step * unpadded(self.state.blocks.t_det, grid)
        t_det = np.where(np.isfinite(t_det), t_det, np.nan)
        time = self.setup.every * step * np.arange(self.samples + 1.0)
        velocity, heat = INTEGRATORS[self.setup.integrator].at_step(
            self.state, self.constants, self.steps
        )
        velocity = self._vectors(*velocity) * material.spacing / step
        force_x, force_y, switches = self.recorded()
        energy = self._energy(velocity, heat)
        if not math.isfinite(energy.relative_residual):
            raise SimulationError(f"at t = {time[-1]:.4g} s the energy is {energy}")
        fields = self._fields(snapshots, stops)
        return Realisation(
            time=time,
            force=self._newton() * np.hypot(force_x, force_y),
            detachments=self._first_detachments(),
            switches=switches,
            t_det=t_det,
            normal_force=material.block_load * n_y * n_x,
            energy=energy,
            steps=self.steps,
            displacement=self.displacement(),
            velocity=velocity,
            snapshots=fields.displacement,
            snapshot_times=fields.time,
            fields=fields,
            contact=fields.contact,
        )

    def _fields(self, snapshots: list[Array], stops: list[int]) -> Fields:
        grid, setup = self.constants.grid, self.setup
        kept = np.array(snapshots).reshape(-1, 3, 2, *grid.shape)
        return Fields(
            time=setup.sample_interval * np.array(stops, float),
            displacement=kept[:, 0],
            velocity=kept[:, 1],
            stress=kept[:, 2],
            contact=unpadded(self.state.blocks.static, grid) > 0.0,
            spacing=setup.material.spacing,
        )

    def _newton(self) -> float:
        """Force in N that adds a velocity of one l per step in one step."""
        material, step = self.setup.material, self.setup.step
        force_time = INTEGRATORS[self.setup.integrator].force_time(step, material.gamma)
        return material.mass * material.spacing / (step * force_time)

    def _first_detachments(self) -> NDArray[np.int64]:
        """Number of first detachments in each sample interval, with 0 for the initial sample."""
        t_det = self.state.blocks.t_det
        steps = np.ceil(t_det[np.isfinite(t_det)]).astype(np.int64)
        return np.bincount(steps // self.setup.every + 1, minlength=self.samples + 1)

    def _energy(self, velocity: Array, heat: float) -> Energy:
        material, ledger = self.setup.material, self.state.ledger
        joule = self._newton() * material.spacing
        slide = np.array([self.constants.slider_x, self.constants.slider_y])
        slider = self.steps * slide * material.spacing
        displacement = self.displacement()
        last_pull = material.k_s * np.sum(slider[:, None, None] - displacement, axis=(1, 2))
        # trapezoidal rule: the ledger contains the full last force instead of half of it
        work_in = joule * ledger[WORK] - 0.5 * float(last_pull @ slide) * material.spacing
        return Energy(
            work_in=float(work_in),
            elastic=elastic_energy(
                displacement, slider, material, bool(self.constants.grid.periodic)
            ),
            kinetic=0.5 * material.mass * float(np.sum(velocity**2)),
            friction=joule * heat,
            viscous=float(material.gamma * material.mass * material.spacing**2 / self.setup.step)
            * float(ledger[SQUARES]),
        )
