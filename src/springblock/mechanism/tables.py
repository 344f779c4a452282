"""Tables of the page: their columns, and their rows for each surface.

The elastic forces on edges, on the core and on blocks without contact add up to the friction force,
since the forces of the springs between blocks add up to zero. On blocks without contact the
elastic force equals inertia and damping, on sliding blocks also friction.
"""

from collections.abc import Iterator
from itertools import chain
from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray
from scipy.ndimage import binary_erosion
from tqdm import tqdm

from springblock.analysis.statistics import events, prominence
from springblock.io.rows import Row
from springblock.io.schemas import SCENE, SETUP, column, numbers, texts
from springblock.mechanism import models, pawls
from springblock.mechanism.elasticity import Layer, lattice_stiffness
from springblock.mechanism.surfaces import TABLES, TRAINING
from springblock.model.material import Material
from springblock.model.numbers import Array
from springblock.model.scene import Scene
from springblock.model.surface import Surface
from springblock.simulation.prelude import compute_prelude
from springblock.simulation.run import Run, friction
from springblock.simulation.setup import Setup
from springblock.simulation.simulate import simulate

SEEDS = 10  #: of pillars and flat surfaces
SEEDS_OF_GROOVES = 5
_TIMES = 1e-6 * np.arange(240.0, 541.0, 6.0)  #: s, of the forces on edges and core

_SAME = [*SCENE, *SETUP, column("seed", pa.int64(), "1", "seed of the friction coefficients")]
FRICTION = pa.schema(
    [
        *_SAME,
        *numbers(
            "1",
            stress_variation="standard deviation over mean of the stress on blocks in contact, "
            "before any slip",
            independent="static friction without load transfer",
            quasi_static="static friction with load transfer, without inertia",
            overshooting="static friction with load transfer, overshoot and sticking",
            simulation="static friction in the simulation",
        ),
    ]
)
PEAKS = pa.schema(
    [
        *_SAME,
        column(
            "trained",
            pa.bool_(),
            "1",
            "whether the prediction's assumption and limit were chosen with this surface",
        ),
        *numbers(
            "%",
            predicted="predicted prominence of the lesser load peak",
            measured="prominence of the lesser load peak in the simulation",
        ),
    ]
)
BUDGET = pa.schema(
    [
        *SCENE,
        *SETUP,
        *texts(model="simulation or overshooting"),
        *_SAME[-1:],
        *numbers("1", edge_share="share of edge blocks in the blocks in contact"),
        *numbers(
            "blocks",
            edge_event="mean number of blocks in an event on edges: neighbours that detach within "
            "0.5 % of t_max of each other; NaN in overshooting",
        ),
        *numbers("s", time="time; overshooting: displacement of the slider over its velocity"),
        *numbers(
            "1",
            edge="total force on edges over the normal force; NaN after the end of the run",
            core="the same for the core",
            free="the same for blocks without contact; overshooting: 0",
        ),
    ]
)


def measure(part: str) -> tuple[pa.Schema, Iterator[Row]]:
    """Return the columns of a part of `surfaces.TABLES`, and its rows as they are computed."""
    kinds = {
        "mechanism": (FRICTION, friction_rows),
        "mechanism_variants": (FRICTION, friction_rows),
        "mechanism_peaks": (PEAKS, peaks_rows),
        "mechanism_budget": (BUDGET, budget_rows),
    }
    table = next(name for name, parts in TABLES.items() if part in parts)
    schema, rows_on = kinds[table]
    return schema, chain.from_iterable(map(rows_on, TABLES[table][part]))


def friction_rows(surface: Scene) -> Iterator[Row]:
    """Yield one row per seed, with all models on the same coefficients."""
    contact, material = surface.contact, _material(surface)
    layer, normal_force = Layer(contact, material), material.block_load * contact.size
    load = normal_force / np.count_nonzero(contact)
    stress_variation = models.stress_variation(layer)
    for same, drawn, run in _runs(surface, SEEDS):
        forces = [load * mu[contact] for mu in drawn]
        yield same | {
            "stress_variation": stress_variation,
            "simulation": run.static_friction,
            **{
                model.__name__: model(layer, *forces).force.max() / normal_force
                for model in (models.independent, models.quasi_static, models.overshooting)
            },
        }


def peaks_rows(surface: Scene) -> Iterator[Row]:
    """Yield one row per seed, with the load peak predicted by `pawls` and the simulated one."""
    own = {"trained": surface in TRAINING, "predicted": predicted(surface)}
    for same, _, run in _runs(surface, SEEDS_OF_GROOVES):
        yield same | own | {"measured": 100.0 * prominence(friction(run))}


def predicted(surface: Scene) -> float:
    """Return the prominence of the lesser load peak that elasticity predicts, %."""
    across = surface.direction == "y"
    return pawls.prominence(surface.n_p2, surface.n_s2, across, _material(surface))


def budget_rows(surface: Scene) -> Iterator[Row]:
    """Yield one row per seed, model and time: forces on edges, core and blocks without contact."""
    contact, material = surface.contact, _material(surface)
    axis, way = "xy".index(surface.direction), _TIMES * material.slider_velocity
    edges, normal_force = edge_blocks(contact), material.block_load * contact.size
    groups = {"edge": edges, "core": contact & ~edges, "free": ~contact}
    stiffness = lattice_stiffness(surface.shape, material)
    turn = np.transpose if axis else np.asarray  # the models slide along x
    held = turn(contact)
    layer, load = Layer(held, material), normal_force / np.count_nonzero(contact)
    edge_share = np.count_nonzero(edges) / np.count_nonzero(contact)
    for same, drawn, run in _runs(surface, SEEDS_OF_GROOVES, snapshot_times=list(_TIMES)):
        forces = [  # of all springs on each block, along `direction`: s K_s - K u, (N_y, N_x) N
            material.k_s * slider - (stiffness @ moved.ravel()).reshape(moved.shape)[axis]
            for moved, slider in zip(run.snapshots, way, strict=True)
        ]
        simulated = {
            name: [force[of].sum() / normal_force for force in forces]
            for name, of in groups.items()
        }
        static, dynamic = (load * turn(mu)[held] for mu in drawn)
        sizes = {"simulation": event_size(run, contact), "overshooting": np.nan}
        modelled = {"free": np.zeros(_TIMES.size)}
        for name in ("edge", "core"):
            curve = models.overshooting(layer, static, dynamic, turn(groups[name])[held])
            slider, force = np.pad(curve, ((0, 0), (1, 0)))  # from rest on
            modelled[name] = np.interp(way, slider, force, right=np.nan) / normal_force
        for model, parts in (("simulation", simulated), ("overshooting", modelled)):
            own = {"model": model, "edge_share": edge_share, "edge_event": sizes[model]}
            for i, time in enumerate(_TIMES):
                at_time = {name: values[i] for name, values in parts.items()}
                yield same | own | {"time": time, **at_time}


def edge_blocks(contact: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return the blocks in contact beside one without, along x or y, (N_y, N_x)."""
    return contact & ~binary_erosion(contact, border_value=1)


def event_size(run: Run, contact: NDArray[np.bool_]) -> float:
    """Return the mean number of blocks that detach in one event, on edges along x."""
    edges = np.any(contact, axis=1) & ~np.any(contact & ~edge_blocks(contact), axis=1)
    times = run.t_det[np.ix_(edges, contact.any(axis=0))] / run.t_max
    return float(times.size / events(times).sum())


def _runs(
    surface: Scene, seeds: int, **options: Any
) -> Iterator[tuple[Row, tuple[Array, Array], Run]]:
    """Yield the first columns of a row, the coefficients of friction and the run of each seed."""
    setup, contact = Setup().vary(dict(surface.varied)), surface.contact
    prelude = compute_prelude(contact, setup, surface.direction)
    constants = surface.row | setup.constants
    for seed in tqdm(range(seeds), desc=str(surface), unit="seed"):
        drawn = Surface.draw(contact, seed, setup.material)
        run = simulate(drawn, setup, surface.direction, prelude=prelude, **options)
        yield constants | {"seed": seed}, (drawn.mu_static, drawn.mu_dynamic), run


def _material(surface: Scene) -> Material:
    return Setup().vary(dict(surface.varied)).material
