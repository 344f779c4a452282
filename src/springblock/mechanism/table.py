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
from springblock.model.scene import Scene, Varied
from springblock.simulation.prelude import compute_prelude
from springblock.simulation.setup import Setup
from springblock.simulation.simulate import simulate

SEEDS = 10
_LEAST = 40  #: blocks along a side, at least: the models take the cube of their number
_LEAST_VARIED = 30  #: the same of variants
#: n_p on layers of other thickness, by that in µm.
_SIZES_OF_LAYERS = {
    "5": (2, 3, 4, 5, 6, 8, 10, 15),
    "20": (4, 6, 8, 10, 15, 20),
    "40": (6, 10, 15, 20, 30),
}

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


def variant(name: str) -> list[Scene]:
    """Return the surfaces of one of `mechanism.VARIANTS`, on a coarser list of sizes."""
    kind, _, value = name.partition("-")
    if kind == "flat":
        return [Scene(20)]
    if kind == "half":
        return [_pillars(n_p, n_p // 2) for n_p in (2, 4, 6, 8, 10, 16)]
    if kind == "double":
        return [_pillars(n_p, 2 * n_p) for n_p in (2, 3, 4, 6, 8, 10)]
    if kind == "scatter":
        own = (("mu_static_std", float(value)),)
        return [_pillars(n_p, n_p, own) for n_p in (2, 4, 6, 8, 10, 15)]
    own = (("thickness", 1e-6 * float(value)),)
    return [_pillars(n_p, n_p, own) for n_p in _SIZES_OF_LAYERS[value]]


def _pillars(n_p: int, n_s: int, varied: Varied = ()) -> Scene:
    period = n_p + n_s
    return Scene(period * -(-_LEAST_VARIED // period), n_p=n_p, n_s=n_s, varied=varied)


def mechanism_rows(surface: Scene) -> Iterator[Row]:
    """Yield one row per seed: all models on the same coefficients."""
    setup = Setup().vary(dict(surface.varied))
    contact, material = surface.contact, setup.material
    reduced, prelude = layer(contact, material), compute_prelude(contact, material)
    normal_force = material.block_load * contact.size
    load = normal_force / np.count_nonzero(contact)
    same = surface.row | setup.constants | {"stress_variation": models.stress_variation(reduced)}
    for seed in tqdm(range(SEEDS), desc=str(surface), unit="seed"):
        drawn = draw_friction(surface.shape, seed, material)
        forces = [load * mu[contact] for mu in drawn]
        run = simulate(contact, *drawn, material, prelude=prelude)
        yield same | {
            "seed": seed,
            "simulation": run.static_friction,
            **{
                model.__name__: model(reduced, *forces).force.max() / normal_force
                for model in (models.independent, models.quasi_static, models.overshooting)
            },
        }
