"""Realisations of scenes, and the columns of a table that they fill."""

from typing import Any

from springblock.model.asperities import draw_friction
from springblock.model.scene import Scene
from springblock.model.surface import Surface
from springblock.simulation.motion import SimulationError
from springblock.simulation.prelude import Prelude, compute_prelude
from springblock.simulation.run import Realisation
from springblock.simulation.setup import Setup
from springblock.simulation.simulate import simulate

#: Columns of a table that are properties of a run.
_OF_RUN = ["static_friction", "dynamic_friction", "t_max", "t_avg", "t_first", "steps", "force"]
_OF_RUN += ["prominence", "t_quiet", "t_width"]
_OF_RUN += ["detachments", "switches", "normal_force", "onset_end"]


def setup_of(scene: Scene) -> Setup:
    """Return material and numerical parameters of a scene."""
    return Setup(scene.material, scene.integrator, scene.step, scene.sample_interval)


def surface_of(scene: Scene, seed: int) -> Surface:
    """Return the surface of a scene, its coefficients random or from the files of the scene."""
    drawn = draw_friction(scene.shape, seed, scene.material, scene.is_periodic)
    files = scene.mu_static_field, scene.mu_dynamic_field
    pairs = zip(drawn, files, strict=True)
    mu: Any = [random if file is None else file.values for random, file in pairs]
    return Surface(scene.contact, mu[0], mu[1], scene.is_periodic)


def prelude_of(scene: Scene) -> Prelude:
    """Compute the prelude of a scene."""
    known: Any = scene.mu_static_field and scene.mu_static_field.values
    how = setup_of(scene), scene.direction, scene.is_periodic
    return compute_prelude(scene.contact, *how, mu_static=known)


def realise(scene: Scene, seed: int, **options: Any) -> Realisation:
    """Simulate one realisation of a scene; `options` are further ones of `simulate`."""
    times = scene.duration or None, scene.snapshot_times
    try:
        surface = surface_of(scene, seed)
        return simulate(surface, setup_of(scene), scene.direction, *times, **options)
    except SimulationError as error:
        raise SimulationError(f"{scene}, seed {seed}: {error}") from error


def columns_of(run: Realisation, scene: Scene, seed: int) -> dict[str, Any]:
    """Return the columns of a run in a table, besides those of its scene."""
    return {
        "seed": seed,
        "contact_fraction": float(scene.contact.mean()),
        **{name: getattr(run, name) for name in _OF_RUN},
        "energy_error": run.energy.relative_residual,
        "t_det": run.t_det.ravel(),
        "snapshots": run.snapshots.ravel(),
        "contact": scene.contact.ravel(),
    }
