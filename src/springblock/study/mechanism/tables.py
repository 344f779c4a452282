"""Columns and rows of the tables of the page."""

from collections.abc import Iterator

import numpy as np
import pyarrow as pa
from tqdm import tqdm

from springblock.io.identity import identity
from springblock.io.rows import Row
from springblock.io.schemas import SCENE, column, numbers
from springblock.model.scene import Scene
from springblock.model.surface import Surface
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
