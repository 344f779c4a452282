"""Columns and rows of the tables of the page."""

from collections.abc import Iterator
from functools import partial

import numpy as np
import pyarrow as pa
from tqdm import tqdm

from springblock.analysis.statistics import bootstrap_interval, mean_interval
from springblock.io.identity import identity
from springblock.io.rows import Row, limits
from springblock.io.schemas import SCENE, column, numbers, texts
from springblock.model.numbers import Array
from springblock.model.scene import Scene
from springblock.simulation.peaks import prominence
from springblock.simulation.run import Realisation
from springblock.simulation.scenes import prelude_of, realise, surface_of
from springblock.study.mechanism import models
from springblock.study.mechanism.surfaces import PARTS
from springblock.theory.elasticity import Layer

SEEDS = 10

FRICTION = pa.schema(
    [
        *SCENE,
        column("seed", pa.int64(), "1", "seed of the friction coefficients"),
        *numbers(
            "1",
            stress_variation="standard deviation over mean of the stress on blocks in contact, "
            "before any slip",
            independent="static friction without load transfer",
            quasi_static="static friction with load transfer, without inertia",
            sticking="static friction with load transfer, if blocks stick again and heal",
            overshooting="static friction with load transfer, sticking and overshoot",
            simulation="static friction in the simulation",
        ),
    ]
)


#: Models that are compared on grooves, where load transfer without inertia takes minutes.
ON_GROOVES = ("sticking", "overshooting", "collective", "simulation")
#: Share of the largest force below which the main drop has come, and points of a force curve.
_DROPPED, _POINTS = 0.92, 1000

GROOVES = pa.schema(
    [
        *texts(model=f"one of {', '.join(ON_GROOVES)}"),
        *numbers(
            "1",
            static_friction="mean static friction",
            static_friction_low="lower limit of its 95 % interval",
            static_friction_high="upper limit",
            prominence="prominence of the second load peak up to the main drop, over the largest "
            "force, of the mean force at equal displacements of the slider",
            prominence_low="lower limit of its 95 % interval",
            prominence_high="upper limit",
        ),
    ]
)


def measure_grooves(part: str) -> Iterator[Row]:
    """Yield one row per model for sliding along grooves."""
    (scene,) = PARTS[part]
    layer = Layer(scene.contact, scene.material)
    normal_force = scene.material.block_load * scene.contact.size
    curves: dict[str, list[models.Curve]] = {name: [] for name in ON_GROOVES}
    for run, forces in _realisations(scene):
        curves["simulation"].append(models.Curve(scene.slider_velocity * run.time, run.force))
        for name in ON_GROOVES[:-1]:
            curves[name].append(getattr(models, name)(layer, *forces))
    for name, found in curves.items():
        friction = mean_interval([curve.force.max() / normal_force for curve in found])
        peaks = bootstrap_interval(partial(_dips, _on_a_grid(found)), SEEDS)
        yield {"model": name} | limits("static_friction", friction) | limits("prominence", peaks)


def _realisations(scene: Scene) -> Iterator[tuple[Realisation, list[Array]]]:
    """Yield the simulation with each seed, and mu_s F_n and mu_d F_n of its blocks, (k,) N."""
    contact, prelude = scene.contact, prelude_of(scene)
    load = scene.material.block_load * contact.size / np.count_nonzero(contact)
    for seed in tqdm(range(SEEDS), desc=str(scene), unit="seed"):
        run, drawn = realise(scene, seed, prelude=prelude), surface_of(scene, seed)
        yield run, [load * mu[contact] for mu in (drawn.mu_static, drawn.mu_dynamic)]


def _on_a_grid(curves: list[models.Curve]) -> Array:
    """Return forces at equal displacements of the slider, as far as all curves go, (k, n)."""
    grid = np.linspace(0.0, min(curve.slider[-1] for curve in curves), _POINTS)
    return np.array([np.interp(grid, *curve) for curve in curves])


def _dips(forces: Array, weights: Array) -> Array:
    """Return the prominence in weighted means of forces up to the main drop, (b,)."""
    found = []
    for curve in weights @ forces:
        peak = int(np.argmax(curve))
        end = peak + int(np.argmax(np.append(curve[peak:], 0.0) < _DROPPED * curve[peak]))
        found.append(prominence(curve[: end + 1]))
    return np.array(found)


def measure(part: str) -> Iterator[Row]:
    """Yield one row per surface of a part and seed, with all models on the same coefficients."""
    for scene in PARTS[part]:
        layer = Layer(scene.contact, scene.material)
        normal_force = scene.material.block_load * scene.contact.size
        constants = identity(scene) | {"stress_variation": models.stress_variation(layer)}
        for seed, (run, forces) in enumerate(_realisations(scene)):
            friction = {
                name: model(layer, *forces).force.max() / normal_force
                for name, model in models.MODELS.items()
            }
            friction["simulation"] = run.static_friction
            yield constants | {"seed": seed} | friction
