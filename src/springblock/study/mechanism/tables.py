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
from springblock.model.surface import Surface
from springblock.simulation.peaks import prominence
from springblock.simulation.prelude import compute_prelude
from springblock.simulation.scenes import setup_of
from springblock.simulation.simulate import simulate
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
    (surface,) = PARTS[part]
    setup, contact = setup_of(surface), surface.contact
    layer, normal_force = Layer(contact, setup.material), setup.material.block_load * contact.size
    load = normal_force / np.count_nonzero(contact)
    curves: dict[str, list[models.Curve]] = {name: [] for name in ON_GROOVES}
    for seed in tqdm(range(SEEDS), desc=str(surface), unit="seed"):
        drawn = Surface.draw(contact, seed, setup.material)
        forces = [load * mu[contact] for mu in (drawn.mu_static, drawn.mu_dynamic)]
        run = simulate(drawn, setup, surface.direction)
        slider = setup.material.slider_velocity * run.time
        curves["simulation"].append(models.Curve(slider, run.force))
        for name in ON_GROOVES[:-1]:
            curves[name].append(getattr(models, name)(layer, *forces))
    for name, found in curves.items():
        friction = mean_interval([curve.force.max() / normal_force for curve in found])
        peaks = bootstrap_interval(partial(_dips, _on_a_grid(found)), SEEDS)
        yield {"model": name} | limits("static_friction", friction) | limits("prominence", peaks)


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
    """Yield the rows of a part as they are computed."""
    for surface in PARTS[part]:
        yield from friction_rows(surface)


def friction_rows(surface: Scene) -> Iterator[Row]:
    """Yield one row per seed, with all models on the same coefficients."""
    setup, contact = setup_of(surface), surface.contact
    layer, normal_force = Layer(contact, setup.material), setup.material.block_load * contact.size
    load = normal_force / np.count_nonzero(contact)
    constants = identity(surface)
    constants["stress_variation"] = models.stress_variation(layer)
    prelude = compute_prelude(contact, setup, surface.direction)
    for seed in tqdm(range(SEEDS), desc=str(surface), unit="seed"):
        drawn = Surface.draw(contact, seed, setup.material)
        run = simulate(drawn, setup, surface.direction, prelude=prelude)
        forces = [load * mu[contact] for mu in (drawn.mu_static, drawn.mu_dynamic)]
        yield constants | {
            "seed": seed,
            "simulation": run.static_friction,
            **{
                name: model(layer, *forces).force.max() / normal_force
                for name, model in models.MODELS.items()
            },
        }
