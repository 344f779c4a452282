"""Simulation of one realisation: `simulate`, and its results from the final state."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from tqdm import tqdm

from springblock.model.direction import heading
from springblock.model.numbers import Array
from springblock.model.surface import Surface
from springblock.simulation import onset, plausibility
from springblock.simulation.energy import Energy, elastic_energy
from springblock.simulation.fields import Fields
from springblock.simulation.motion import Motion, SimulationError
from springblock.simulation.prelude import Prelude, conditions
from springblock.simulation.run import Realisation
from springblock.simulation.setup import DEFAULT, Setup, check_type
from springblock.solver.lattice import SQUARES, WORK, unpadded
from springblock.solver.shear import shear_forces

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
        None: until the end of the onset, see `springblock.simulation.onset`; at the latest 1.5
        times the largest t_det.
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
    latest, between = _LATEST * setup.loading_time(contact, strongest), onset.between_looks(setup)
    plausibility.warn(plausibility.of_input(surface, setup))

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
            pause = (motion.samples // between + 1) * between
            pause = min(pause, last_sample or pause)
            for sample in [each for each in at_samples if motion.samples < each <= pause]:
                motion.proceed(sample)
                snapshots.append(_snapshot(motion))
            motion.proceed(pause)
            bar.update(motion.samples - bar.n)
    run = _result(motion, snapshots, at_samples)
    plausibility.warn(plausibility.of_run(surface, setup, direction, run))
    return run


def _is_over(motion: Motion, last_sample: int | None, latest: float) -> bool:
    """Return whether a run is complete, see `simulate`; raise if blocks are stuck at `latest` s."""
    if last_sample is not None:
        return motion.samples >= last_sample
    blocks, now = motion.state.blocks, motion.steps * motion.setup.step
    t_det = blocks.t_det[blocks.static > 0.0]
    if np.isfinite(t_det).all():
        return onset.end_of_onset(motion.force, t_det, motion.surface, motion.setup) is not None
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
    detached_in = onset.known_at(t_det[np.isfinite(t_det)], setup.every)
    time = setup.every * step * np.arange(motion.samples + 1.0)
    velocity, heat = motion.at_step()
    velocity = motion.vectors(*velocity) * material.spacing / step
    load = material.block_load * n_y * n_x
    energy = _energy(motion, velocity, heat)
    if not math.isfinite(energy.relative_residual):
        raise SimulationError(f"at t = {time[-1]:.4g} s the energy is {energy}")
    surface, force, in_contact = motion.surface, motion.force, t_det[motion.surface.contact]
    end = onset.end_of_onset(force, in_contact, surface, setup)
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
        force=force,
        detachments=np.bincount(detached_in, minlength=motion.samples + 1),
        switches=motion.recorded().switches,
        t_det=np.where(np.isfinite(t_det), step * t_det, np.nan),
        normal_force=load,
        onset_end=math.nan if end is None else float(time[end]),
        dynamic_friction=onset.friction_of_sliding(
            time, force / load, step * in_contact, surface, setup
        ),
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
