"""Simulation of one realisation: `simulate`, and its results from the final state."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from tqdm import tqdm

from springblock.model.direction import heading
from springblock.model.numbers import Array
from springblock.model.surface import Surface
from springblock.simulation import resolution
from springblock.simulation.energy import Energy, elastic_energy
from springblock.simulation.fields import Fields
from springblock.simulation.motion import Motion, SimulationError
from springblock.simulation.prelude import Prelude, conditions
from springblock.simulation.run import Realisation, first_minimum
from springblock.simulation.setup import DEFAULT, Setup, check_type
from springblock.solver.lattice import SQUARES, WORK, unpadded
from springblock.solver.shear import shear_forces

#: Sample intervals between two tests of whether a run is complete.
_SAMPLES_PER_CALL = 10
#: A run whose force does not drop (mu_d = mu_s, or strong damping) ends at this multiple of its
#: largest t_det.
_WITHOUT_DROP = 1.5
#: A run with stuck blocks fails at this multiple of its longest loading time, F_c/(K_s v).
_LATEST = 3.0
_SOON = 10.0  #: s after which a run shows its progress on a terminal


def simulate(
    surface: Surface,
    setup: Setup = DEFAULT,
    direction: str | float = "x",
    duration: float | None = None,
    snapshot_times: Sequence[float] = (),
    prelude: Prelude | None = None,
    progress: bool | None = None,
) -> Realisation:
    """Pull one surface from rest and record force and detachments.

    The model is that of section 2 of Costagliola, Bosia & Pugno 2022,
    doi:10.1016/j.ijsolstr.2022.111525.

    Parameters
    ----------
    surface : Surface
        Blocks in contact, and their friction coefficients.
    setup : Setup
        Material, integrator, step and sample interval; by default the paper's material and
        `leapfrog` with 2e-8 s.
    direction : "x", "y" or an angle from x in degrees
        Sliding direction.
    duration : s, or None
        None: until every contact block has detached and the force has risen from its first
        minimum after the peak by a tenth of its drop; at the latest until 1.5 times the largest
        t_det.
    snapshot_times : s
        Times at which `Realisation.fields` are stored, in ascending order; multiples of the
        sample interval. A run without duration lasts at least until the last of them.
    prelude : Prelude
        States of the same scene before its first detachment, see `compute_prelude`. They save
        time; results are the same, but for the rounding of forces under a law from a file.
    progress : bool, or None
        Whether to show a progress bar on stderr. None: on a terminal, in runs of more than 10 s.

    Raises
    ------
    TypeError, ValueError
        If an argument is not valid, the surface was drawn with other constants than those of the
        setup, or the prelude belongs to another run.
    SimulationError
        If the length of a spring is below 1/2 or above 2 times its rest length, or NaN (the message
        gives time and block), if a law from a file raises, or returns a negative or non-finite
        coefficient, if the energy is not finite, or if blocks do not detach in a run without
        duration.
    """
    check_type("surface", surface, Surface)
    check_type("setup", setup, Setup)
    surface.check_material(setup.material)
    contact, strongest = surface.contact, surface.strongest
    last_sample, at_samples = setup.plan(contact, strongest, duration, snapshot_times)
    latest = _LATEST * setup.loading_time(contact, strongest)

    motion, snapshots = Motion(surface, setup, direction), list[Array]()
    if prelude is not None:
        if prelude.conditions != conditions(contact, setup, heading(direction), surface.periodic):
            raise ValueError(
                "this prelude belongs to another scene, material, integrator, step or "
                "sample_interval"
            )
        prelude.start(motion, min([*at_samples, last_sample or math.inf]) - 1)
    hidden = None if progress is None else not progress  # None: unless stderr is a terminal
    shown: dict[str, Any] = {"disable": hidden, "delay": 0.0 if progress else _SOON}
    until = last_sample or max(at_samples, default=None)
    with tqdm(total=until, initial=motion.samples, unit=" samples", **shown) as bar:
        while len(snapshots) < len(at_samples) or not _is_over(motion, last_sample, latest):
            pause = (motion.samples // _SAMPLES_PER_CALL + 1) * _SAMPLES_PER_CALL
            pause = min(pause, last_sample or pause)
            for sample in [each for each in at_samples if motion.samples < each <= pause]:
                motion.proceed(sample)
                snapshots.append(_snapshot(motion))
            motion.proceed(pause)
            bar.update(motion.samples - bar.n)
    run = _result(motion, snapshots, at_samples)
    resolution.warn(surface, setup.material, direction, run)
    return run


def _is_over(motion: Motion, last_sample: int | None, latest: float) -> bool:
    """Return whether a run is complete, see `simulate`; raise if blocks are stuck at `latest` s."""
    if last_sample is not None:
        return motion.samples >= last_sample
    blocks, now = motion.state.blocks, motion.steps * motion.setup.step
    t_det = blocks.t_det[blocks.static > 0.0] * motion.setup.step
    last = float(t_det.max())
    if math.isfinite(last):
        force = np.hypot(*motion.recorded()[:2])
        return now > _WITHOUT_DROP * last or first_minimum(force) is not None
    if now > latest:
        stuck = int(np.isinf(t_det).sum())
        raise SimulationError(
            f"at t = {now:.4g} s {stuck} contact blocks have not detached; "
            "if this is intended, set a duration"
        )
    return False


def _snapshot(motion: Motion) -> Array:
    """Displacement, velocity and stress of `Fields`, (3, 2, N_y, N_x)."""
    state, constants, setup = motion.state, motion.constants, motion.setup
    own, _ = motion.at_step()
    force = motion.newton * motion.vectors(*shear_forces(state, constants, motion.steps, own))
    velocity = motion.vectors(*own) * setup.material.spacing / setup.step
    return np.stack([motion.displacement(), velocity, force / setup.material.spacing**2])


def _result(motion: Motion, snapshots: list[Array], at_samples: list[int]) -> Realisation:
    """Return the results in SI units."""
    grid, setup, blocks = motion.constants.grid, motion.setup, motion.state.blocks
    material, step = setup.material, setup.step
    n_y, n_x = grid.shape
    t_det = unpadded(blocks.t_det, grid)  # in steps
    detached_in = np.ceil(t_det[np.isfinite(t_det)]).astype(np.int64) // setup.every + 1
    time = setup.every * step * np.arange(motion.samples + 1.0)
    velocity, heat = motion.at_step()
    velocity = motion.vectors(*velocity) * material.spacing / step
    force_x, force_y, switches = motion.recorded()
    energy = _energy(motion, velocity, heat)
    if not math.isfinite(energy.relative_residual):
        raise SimulationError(f"at t = {time[-1]:.4g} s the energy is {energy}")
    kept = np.array(snapshots).reshape(-1, 3, 2, n_y, n_x)
    fields = Fields(
        time=setup.interval * np.array(at_samples, float),
        displacement=kept[:, 0],
        velocity=kept[:, 1],
        stress=kept[:, 2],
        contact=unpadded(blocks.static, grid) > 0.0,
        spacing=material.spacing,
    )
    return Realisation(
        time=time,
        force=motion.newton * np.hypot(force_x, force_y),
        detachments=np.bincount(detached_in, minlength=motion.samples + 1),
        switches=switches,
        t_det=np.where(np.isfinite(t_det), step * t_det, np.nan),
        normal_force=material.block_load * n_y * n_x,
        energy=energy,
        steps=motion.steps,
        displacement=motion.displacement(),
        velocity=velocity,
        snapshots=fields.displacement,
        snapshot_times=fields.time,
        fields=fields,
        contact=fields.contact,
    )


def _energy(motion: Motion, velocity: Array, heat: float) -> Energy:
    material, ledger, constants = motion.setup.material, motion.state.ledger, motion.constants
    joule = motion.newton * material.spacing
    slide = np.array([constants.slider_x, constants.slider_y])
    slider = motion.steps * slide * material.spacing
    displacement = motion.displacement()
    last_pull = material.k_s * np.sum(slider[:, None, None] - displacement, axis=(1, 2))
    # trapezoidal rule: the ledger contains the full last force instead of half of it
    work_in = joule * ledger[WORK] - 0.5 * float(last_pull @ slide) * material.spacing
    viscous = material.gamma * material.mass * material.spacing**2 / motion.setup.step
    return Energy(
        work_in=float(work_in),
        elastic=elastic_energy(displacement, slider, material, bool(constants.grid.periodic)),
        kinetic=0.5 * material.mass * float(np.sum(velocity**2)),
        friction=joule * heat,
        viscous=float(viscous) * float(ledger[SQUARES]),
    )
