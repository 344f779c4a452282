"""One realisation: from a contact mask and its friction coefficients to the observables."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from types import ModuleType

import numpy as np
from numpy.typing import ArrayLike, NDArray

from springblock.direction import heading
from springblock.energy import Energy, elastic_energy
from springblock.material import Material
from springblock.prelude import Prelude, compute, conditions
from springblock.solver import INTEGRATORS
from springblock.solver.lattice import Constants, Samples, State, prepare, unpadded
from springblock.solver.springs import MAX_BLOCKS

Array = NDArray[np.float64]

PAPER = Material()

_REAL = int | float | np.integer | np.floating

#: Default integration step of the leapfrog, s; results/tables/work_precision.parquet says why.
STEP = 1e-8

#: A run pauses this often, in sample intervals, to see whether it may stop.
_SAMPLES_PER_CALL = 10
#: Share of the drop after the peak by which the force must have risen again: then it has passed
#: its first minimum.
_REBOUND = 0.1
#: A force that does not drop (mu_d = mu_s, or strong damping) is followed for this multiple of
#: the time at which the last block has detached.
_PATIENCE = 1.5
#: The strongest block alone would let go at mu_s F_n/(K_s v); a run gives up at this multiple.
_LAST_RESORT = 3.0


class SimulationError(RuntimeError):
    """The equations of motion could not be followed any further."""


@dataclass(frozen=True, eq=False)
class Realisation:
    """What one run yields, in SI units. Fields over blocks are indexed [y, x]."""

    time: Array  #: (n,) s, multiples of the sample interval, from zero
    force: Array  #: (n,) N, |ΣF_s|
    detachments: NDArray[np.int64]  #: (n,) blocks that detached for the first time in the interval
    switches: NDArray[np.int64]  #: (n,) blocks that went from rest to sliding, again or not
    t_det: Array  #: (N, N) s, first detachment; NaN where never or not in contact
    normal_force: float  #: P l² N², N
    energy: Energy  #: at the end, J
    steps: int  #: of the integrator
    displacement: Array  #: (2, N, N) m, components x and y, at the end
    velocity: Array  #: (2, N, N) m/s, at the end
    snapshots: Array = field(repr=False)  #: (k, 2, N, N) m, displacement at the times asked for

    @property
    def t_max(self) -> float:
        """Time of the force maximum, s."""
        return float(self.time[np.argmax(self.force)])

    @property
    def static_friction(self) -> float:
        """Global static friction coefficient: the maximum of the force over P l² N²."""
        return float(self.force.max()) / self.normal_force

    @property
    def dynamic_friction(self) -> float:
        """Mean of force over P l² N² after the first minimum that follows the peak.

        Over the samples that the run holds; the force still oscillates there. NaN where the run
        ends before, or the force does not fall.
        """
        minimum = first_minimum(self.force)
        return (
            math.nan if minimum is None else float(self.force[minimum:].mean()) / self.normal_force
        )

    @property
    def t_avg(self) -> float:
        """Mean of t_det over the contact blocks that have detached, s; NaN where none has."""
        detached = self.t_det[np.isfinite(self.t_det)]
        return float(detached.mean()) if detached.size else math.nan

    @property
    def t_first(self) -> float:
        """Time of the first detachment, s; NaN where there is none."""
        detached = self.t_det[np.isfinite(self.t_det)]
        return float(detached.min()) if detached.size else math.nan


def first_minimum(force: Array) -> int | None:
    """Index of the first minimum after the peak of `force`; None if it is not passed yet.

    A minimum counts once the force has risen again by a tenth of its drop from the peak.
    """
    peak = int(np.argmax(force))
    after = force[peak:]
    lowest = np.minimum.accumulate(after)
    rebound = after - lowest > _REBOUND * (after[0] - lowest)
    if not rebound.any():
        return None
    return peak + int(np.argmin(after[: int(np.argmax(rebound)) + 1]))


def simulate(
    contact: ArrayLike,
    mu_static: ArrayLike,
    mu_dynamic: ArrayLike,
    material: Material = PAPER,
    direction: str | float = "x",
    integrator: str = "leapfrog",
    step: float = STEP,
    duration: float | None = None,
    sample_interval: float = 2e-7,
    snapshot_times: Sequence[float] = (),
    prelude: Prelude | None = None,
) -> Realisation:
    """Pull one surface from rest and record how it lets go.

    The model of Costagliola, Bosia & Pugno 2022 (doi:10.1016/j.ijsolstr.2022.111525), section 2.

    Parameters
    ----------
    contact : (N, N) bool, [y, x]
        Blocks in contact with the substrate, as `Pattern.contact`.
    mu_static, mu_dynamic : (N, N) float
        Microscopic friction coefficients; not read outside the contact.
    material : Material
    direction : "x", "y" or an angle from x in degrees
        Where the slider goes.
    integrator : "leapfrog" or "rk4"
    step : s
        Integration step h.
    duration : s, or None
        None: until every contact block has detached and the force has passed its peak and the
        first minimum after it. Where the force does not drop, until 1.5 times the last first
        detachment.
    sample_interval : s
        Between entries of the force curve; a multiple of the step.
    snapshot_times : s
        Multiples of the sample interval at which the displacements are kept, in rising order.
    prelude : Prelude
        States of this very scene before its first detachment, see `load`. They save time and
        change nothing.

    Raises
    ------
    TypeError, ValueError
        For arguments that make no sense, an unstable step among them.
    SimulationError
        Where a spring collapses, bursts or becomes NaN, with time and block; or where a run
        without duration does not come to its end.
    """
    contact, mu_static, mu_dynamic = _checked_surface(contact, mu_static, mu_dynamic)
    if not isinstance(material, Material):
        raise TypeError(f"material must be a Material, not {material!r}")
    towards = heading(direction)
    every = check_times(material, integrator, step, sample_interval)
    method = INTEGRATORS[integrator]
    stops = [
        _whole_multiple("snapshot_times", time, "sample_interval", sample_interval)
        for time in snapshot_times
    ]
    if stops != sorted(set(stops)):
        raise ValueError("snapshot_times must rise from one to the next")
    end = None if duration is None else _count_samples(duration, sample_interval)
    if end is not None and stops and stops[-1] > end:
        raise ValueError(f"snapshot_times must lie within the duration of {duration!r} s")
    limit = _LAST_RESORT * _lone_release_time(contact, mu_static, mu_dynamic, material)

    scale = method.force_time(step, material.gamma)
    state, constants = prepare(
        contact, mu_static, mu_dynamic, material, towards, step, scale, method.WORK_FIELDS
    )
    run = _Run(method, state, constants, material, step, every)
    if prelude is not None:
        here = conditions(contact, material, towards, integrator, step, every)
        run.skip(prelude, here, min([*stops, math.inf if end is None else end]) - 1)
    snapshots = []
    while not run.is_over(end, limit):
        pause = (run.samples // _SAMPLES_PER_CALL + 1) * _SAMPLES_PER_CALL
        pause = pause if end is None else min(pause, end)
        for stop in [stop for stop in stops if run.samples < stop <= pause]:
            run.proceed(stop)
            snapshots.append(run.displacement())
        run.proceed(pause)
    if len(snapshots) < len(stops):
        raise ValueError(
            f"the run ended by itself at t = {run.samples * sample_interval:.4g} s, before the "
            f"last of snapshot_times; give it a duration"
        )
    return run.result(snapshots)


def load(
    contact: ArrayLike,
    material: Material = PAPER,
    direction: str | float = "x",
    integrator: str = "leapfrog",
    step: float = STEP,
    sample_interval: float = 2e-7,
) -> Prelude:
    """Compute the prelude of a scene, to be shared by `simulate` among all seeds.

    Arguments and errors are those of `simulate`.
    """
    mask, _, _ = _checked_surface(contact, np.ones(np.shape(contact)), np.ones(np.shape(contact)))
    every = check_times(material, integrator, step, sample_interval)
    return compute(mask, material, heading(direction), integrator, step, every)


@dataclass
class _Run:
    """A run in progress, between two calls of the compiled loop."""

    method: ModuleType
    state: State
    constants: Constants
    material: Material
    step: float
    every: int  #: steps per sample
    samples: int = 0  #: taken so far, not counting the one at rest
    record: list[Samples] = field(default_factory=lambda: [Samples.empty(1)])

    def skip(self, prelude: Prelude, expected: str, latest: float) -> None:
        """Start from the latest state of a prelude that will do, instead of from zero."""
        if prelude.conditions != expected:
            raise ValueError(
                "this prelude belongs to another scene, material, integrator, step or "
                "sample_interval"
            )
        self.samples, taken = prelude.start(self.state, latest)
        self.record.append(taken)

    def proceed(self, until: int) -> None:
        """Go on to sample `until`."""
        if until == self.samples:
            return
        more, first = until - self.samples, self.samples * self.every
        taken = Samples.empty(more)
        done, row, column = self.method.advance(
            self.state, self.constants, first, more * self.every, self.every, taken
        )
        if row >= 0:
            raise SimulationError(
                f"at t = {(first + done) * self.step:.4g} s a spring at block "
                f"(y, x) = ({row}, {column}) has collapsed to less than half its length, grown "
                "to more than twice, or become NaN"
            )
        self.samples = until
        self.record.append(taken)

    def is_over(self, end: int | None, limit: float) -> bool:
        """Whether the scene has shown what it must: see `simulate`."""
        if end is not None:
            return self.samples >= end
        in_contact = self.state.static > 0.0
        last = float(self.state.t_det[in_contact].max()) * self.step
        now = self.samples * self.every * self.step
        if math.isfinite(last):
            return now > _PATIENCE * last or first_minimum(self.force()) is not None
        if now > limit:
            waiting = int(np.isinf(self.state.t_det[in_contact]).sum())
            raise SimulationError(
                f"at t = {now:.4g} s {waiting} contact blocks have not detached; "
                "give the run a duration if that is meant to be"
            )
        return False

    def force(self) -> Array:
        """|ΣF_s| so far, in the kernel's unit."""
        x = np.concatenate([samples.force_x for samples in self.record])
        y = np.concatenate([samples.force_y for samples in self.record])
        return np.hypot(x, y)

    def displacement(self) -> Array:
        """(2, N, N) m."""
        n, length = int(self.constants.n), self.material.spacing
        return length * np.stack([unpadded(u, n) for u in (self.state.ux, self.state.uy)])

    def result(self, snapshots: list[Array]) -> Realisation:
        """Turn what has been recorded into SI units."""
        n, material, steps = int(self.constants.n), self.material, self.samples * self.every
        # A threshold is passed within the step before it is noticed: in its middle, on average.
        t_det = np.maximum(unpadded(self.state.t_det, n) - 0.5, 0.0) * self.step
        t_det = np.where(np.isfinite(t_det), t_det, np.nan)
        time = self.every * self.step * np.arange(self.samples + 1.0)
        velocity, heat = self.method.at_step(self.state, self.constants, steps)
        velocity = np.stack([unpadded(w, n) for w in velocity]) * material.spacing / self.step
        force = self._newton() * self.force()
        energy = self._energy(velocity, heat)
        if not math.isfinite(energy.relative_residual):
            raise SimulationError(f"at t = {time[-1]:.4g} s the energy is {energy}")
        return Realisation(
            time=time,
            force=force,
            detachments=self._first_detachments(),
            switches=np.concatenate([samples.switches for samples in self.record]),
            t_det=t_det,
            normal_force=material.block_load * n * n,
            energy=energy,
            steps=steps,
            displacement=self.displacement(),
            velocity=velocity,
            snapshots=np.array(snapshots).reshape(-1, 2, n, n),
        )

    def _newton(self) -> float:
        """Force in N that changes a block's velocity by one l per step in one step."""
        force_time = self.method.force_time(self.step, self.material.gamma)
        return self.material.mass * self.material.spacing / (self.step * force_time)

    def _first_detachments(self) -> NDArray[np.int64]:
        """Blocks that detached for the first time in each interval; none before the first."""
        steps = self.state.t_det[np.isfinite(self.state.t_det)].astype(np.int64)
        return np.bincount(steps // self.every + 1, minlength=self.samples + 1)

    def _energy(self, velocity: Array, heat: float) -> Energy:
        material, ledger = self.material, self.state.ledger
        joule = self._newton() * material.spacing
        slide = np.array([self.constants.slider_x, self.constants.slider_y])
        slider = self.samples * self.every * slide * material.spacing
        displacement = self.displacement()
        last_pull = material.k_s * np.sum(slider[:, None, None] - displacement, axis=(1, 2))
        # trapezoidal rule: the loop has counted the last force in full
        work_in = joule * ledger[0] - 0.5 * float(last_pull @ slide) * material.spacing
        return Energy(
            work_in=float(work_in),
            elastic=elastic_energy(displacement, slider, material),
            kinetic=0.5 * material.mass * float(np.sum(velocity**2)),
            friction=joule * heat,
            viscous=float(material.gamma * material.mass * material.spacing**2 / self.step)
            * float(ledger[2]),
        )


def _checked_surface(
    contact: ArrayLike, mu_static: ArrayLike, mu_dynamic: ArrayLike
) -> tuple[NDArray[np.bool_], Array, Array]:
    mask = np.asarray(contact)
    if mask.dtype != np.bool_:
        raise TypeError(f"contact must be an array of bool, not of {mask.dtype}")
    if mask.ndim != 2 or mask.shape[0] != mask.shape[1]:
        raise ValueError(f"contact must have the shape (N, N), not {mask.shape}")
    if mask.shape[0] > MAX_BLOCKS:
        raise ValueError(f"contact has N = {mask.shape[0]}; this solver goes up to {MAX_BLOCKS}")
    if not mask.any():
        raise ValueError("contact is False everywhere: at least one block must bear the load")
    fields = []
    for name, values in (("mu_static", mu_static), ("mu_dynamic", mu_dynamic)):
        mu = np.asarray(values)
        if mu.dtype.kind not in "iuf":
            raise TypeError(f"{name} must be an array of real numbers, not of {mu.dtype}")
        if mu.shape != mask.shape:
            raise ValueError(f"{name} must have the shape {mask.shape} of contact, not {mu.shape}")
        in_contact = mu[mask]
        if not (np.isfinite(in_contact) & (in_contact >= 0.0)).all():
            raise ValueError(f"{name} must be finite and not negative wherever there is contact")
        fields.append(np.where(mask, mu, 0.0).astype(float))
    return mask, fields[0], fields[1]


def check_times(material: Material, integrator: str, step: float, sample_interval: float) -> int:
    """Return the steps per sample; raise ValueError or TypeError where a run could not be made."""
    if integrator not in INTEGRATORS:
        raise ValueError(f"integrator must be one of {', '.join(INTEGRATORS)}, not {integrator!r}")
    _check_positive("step", step)
    _check_stability(INTEGRATORS[integrator], step, material)
    return _whole_multiple("sample_interval", sample_interval, "step", step)


def _check_stability(method: ModuleType, step: float, material: Material) -> None:
    omega = np.linspace(material.omega_min, material.omega_max, 33)
    if method.is_stable(step, omega, material.gamma):
        return
    stable, unstable = 0.0, float(step)
    while unstable - stable > 1e-4 * unstable:
        middle = 0.5 * (stable + unstable)
        if method.is_stable(middle, omega, material.gamma):
            stable = middle
        else:
            unstable = middle
    name = method.__name__.rpartition(".")[2]
    raise ValueError(f"step = {step:.4g} s is unstable: {name} needs less than {stable:.4g} s here")


def _check_positive(name: str, value: float) -> None:
    if isinstance(value, bool) or not isinstance(value, _REAL):
        raise TypeError(f"{name} must be a number of seconds, not {value!r}")
    if not (math.isfinite(value) and value > 0.0):
        raise ValueError(f"{name} must be finite and positive, not {value!r}")


def _whole_multiple(name: str, value: float, unit_name: str, unit: float) -> int:
    _check_positive(name, value)
    count = round(value / unit)
    if count < 1 or abs(value / unit - count) > 1e-6 * count:
        raise ValueError(f"{name} must be a multiple of {unit_name} = {unit!r} s, not {value!r} s")
    return count


def _count_samples(duration: float, sample_interval: float) -> int:
    """Whole sample intervals within the duration; at least one."""
    _check_positive("duration", duration)
    if duration < sample_interval * (1.0 - 1e-9):
        raise ValueError(
            f"duration must be at least one sample_interval = {sample_interval!r} s, "
            f"not {duration!r} s"
        )
    return int(duration / sample_interval + 1e-6)


def _lone_release_time(
    contact: NDArray[np.bool_], mu_static: Array, mu_dynamic: Array, material: Material
) -> float:
    """Time in s at which the strongest block would let go if its neighbours did not pull."""
    load = material.block_load * contact.size / np.count_nonzero(contact)
    strongest = float(np.maximum(mu_static, mu_dynamic)[contact].max())
    return strongest * load / (material.k_s * material.slider_velocity)
