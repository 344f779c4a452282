"""Static friction of the models and of the simulation, seed by seed, on pillars of each size."""

from collections.abc import Iterator

import numpy as np
import pyarrow as pa
from tqdm import tqdm

from springblock.io.rows import Row
from springblock.io.schemas import SCENE, SETUP, column
from springblock.mechanism import models
from springblock.mechanism.elasticity import layer
from springblock.model.asperities import draw_friction
from springblock.model.scene import Scene
from springblock.simulation.prelude import compute_prelude
from springblock.simulation.setup import Setup
from springblock.simulation.simulate import simulate

SEEDS = 10
_LEAST = 40  #: blocks along a side, at least: the models take the cube of their number

SCHEMA = pa.schema(
    [
        *SCENE,
        *SETUP,
        column("seed", pa.int64(), "1", "seed of the friction coefficients"),
        column(
            "stress_variation",
            pa.float64(),
            "1",
            "standard deviation over mean of the stress on blocks in contact, before any slip",
        ),
        column("independent", pa.float64(), "1", "static friction without load transfer"),
        column("quasi_static", pa.float64(), "1", "static friction with it, without inertia"),
        column("overshooting", pa.float64(), "1", "static friction with overshoot and sticking"),
        column("simulation", pa.float64(), "1", "static friction of the full model"),
    ]
)


def scene(n_p: int) -> Scene:
    """Return the smallest surface of whole pillars with the gaps of their size."""
    period = 2 * n_p
    return Scene(period * -(-_LEAST // period), n_p=n_p, n_s=n_p)


def mechanism_rows(n_p: int) -> Iterator[Row]:
    """Yield one row per seed: all models on the same coefficients."""
    surface, setup = scene(n_p), Setup()
    contact, material = surface.contact, setup.material
    reduced, prelude = layer(contact, material), compute_prelude(contact)
    normal_force = material.block_load * contact.size
    load = normal_force / np.count_nonzero(contact)
    same = surface.row | setup.constants | {"stress_variation": models.stress_variation(reduced)}
    for seed in tqdm(range(SEEDS), desc=f"n_p = {n_p}", unit="seed"):
        drawn = draw_friction(surface.shape, seed, material)
        forces = [load * mu[contact] for mu in drawn]
        yield same | {
            "seed": seed,
            "simulation": simulate(contact, *drawn, prelude=prelude).static_friction,
            **{
                model.__name__: model(reduced, *forces).force.max() / normal_force
                for model in (models.independent, models.quasi_static, models.overshooting)
            },
        }
