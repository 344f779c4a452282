"""The force on edges and core of the paper's pawls over time, in the full model and in the last.

A block without contact bears its inertia alone, as one that slides does beside its friction: the
elastic force on it. The springs between blocks add up to nothing, so that the forces on edges, on
the core and on blocks without contact add up to the friction force.
"""

from collections.abc import Iterator

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray
from scipy.sparse import csc_array
from tqdm import tqdm

from springblock.io.rows import Row
from springblock.io.schemas import SCENE, SETUP, column, numbers, texts
from springblock.mechanism.elasticity import Array, lattice_stiffness, layer
from springblock.mechanism.models import overshooting
from springblock.model.asperities import draw_friction
from springblock.model.scene import Scene
from springblock.simulation.setup import Setup
from springblock.simulation.simulate import simulate

SEEDS = 5
#: The paper's pawls and grooves, along the grooves and across them.
SCENES = [Scene(120, n_p=58, n_s=62, n_p2=8, n_s2=2, direction=way) for way in "xy"]
_TIMES = 1e-6 * np.arange(240.0, 541.0, 6.0)  #: s

SCHEMA = pa.schema(
    [
        *SCENE,
        *SETUP,
        *texts(model="simulation, the full model, or overshooting"),
        column("seed", pa.int64(), "1", "seed of the friction coefficients"),
        column("edge_share", pa.float64(), "1", "share of edge blocks in those in contact"),
        *numbers("s", time="time; in the model without time the slider's way over its velocity"),
        *numbers(
            "1",
            edge="force on blocks in contact beside one without, over the normal force; NaN "
            "once the model has come to its end",
            core="the same of other blocks in contact",
            free="the same of blocks without contact; 0 in the model without inertia",
        ),
    ]
)


def edge_blocks(contact: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return the blocks in contact with a neighbour along x or y that is not, (N_y, N_x)."""
    around = np.pad(contact, 1, constant_values=True)
    held = around[:-2, 1:-1] & around[2:, 1:-1] & around[1:-1, :-2] & around[1:-1, 2:]
    return contact & ~held


def elastic_force(stiffness: csc_array, displacement: Array, pull: float, axis: int) -> Array:
    """Return the force of all springs along `axis`, 0 for x, on each block, (N_y, N_x) N.

    Displacements are (2, N_y, N_x) m; the slider has moved along the axis and pulls with `pull`,
    N, on a block that has not.
    """
    force = -stiffness @ displacement.ravel()
    return np.asarray(force.reshape(displacement.shape)[axis] + pull)


def budget_rows() -> Iterator[Row]:
    """Yield one row per scene, model, seed and time."""
    setup = Setup()
    material, way = setup.material, _TIMES * setup.material.slider_velocity
    stiffness = lattice_stiffness(SCENES[0].shape, material)
    for scene in SCENES:
        contact, axis = scene.contact, "xy".index(scene.direction)
        edges, normal_force = edge_blocks(contact), material.block_load * contact.size
        groups = {"edge": edges, "core": contact & ~edges, "free": ~contact}
        same = scene.row | setup.constants
        same |= {"edge_share": np.count_nonzero(edges) / np.count_nonzero(contact)}
        turned = contact.T if axis else contact  # the models slide along x
        reduced = layer(turned, material)
        for seed in tqdm(range(SEEDS), desc=str(scene), unit="seed"):
            drawn = draw_friction(scene.shape, seed, material)
            run = simulate(contact, *drawn, material, scene.direction, snapshot_times=list(_TIMES))
            forces = [
                elastic_force(stiffness, each, material.k_s * slider, axis)
                for each, slider in zip(run.snapshots, way, strict=True)
            ]
            for time, force in zip(_TIMES, forces, strict=True):
                parts = {name: force[of].sum() / normal_force for name, of in groups.items()}
                yield same | {"model": "simulation", "seed": seed, "time": time, **parts}
            load = normal_force / np.count_nonzero(contact)
            static, dynamic = (load * (mu.T if axis else mu)[turned] for mu in drawn)
            curves = []
            for name in ("edge", "core"):
                of = groups[name].T if axis else groups[name]
                curve = overshooting(reduced, static, dynamic, of[turned])
                slider, force = np.pad(curve, ((0, 0), (1, 0)))  # from rest on
                curves.append(np.interp(way, slider, force, right=np.nan) / normal_force)
            for time, edge, core in zip(_TIMES, *curves, strict=True):
                parts = {"edge": edge, "core": core, "free": 0.0}
                yield same | {"model": "overshooting", "seed": seed, "time": time, **parts}
