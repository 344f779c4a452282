"""Evidence made up so that all that the paper says is true, and ways to change it."""

from collections.abc import Callable, Collection, Iterable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from springblock.analysis.statistics import pillar_ring
from springblock.io.identity import identity
from springblock.io.records import Record, by_scene
from springblock.io.rows import Row
from springblock.model.scene import Scene
from springblock.study.claims.rule import Evidence
from springblock.study.claims.surfaces import core, pillars_of

N, SEEDS = 48, range(40)
#: Scenes with the study's material: damped, so that motion has ended far below the load peaks.
surface = partial(Scene, gamma=1e5, mu_dynamic=0.05)
FLAT = surface(N)
ALONG, ACROSS, ANGLED = (surface(N, 23, 25, 5, 1, direction=way) for way in ("x", "y", "45"))
BARE_ALONG, BARE_ACROSS = (surface(N, n_p2=5, n_s2=1, direction=direction) for direction in "xy")
DEEP_ALONG, DEEP_ACROSS = (surface(N, 23, 25, 5, 1, 11, 1, direction) for direction in "xy")
SQUARE, PLAIN = surface(N, 23, 25, 5, 1, 5, 1), surface(N, 23, 25)
STIFF = surface(N, youngs_modulus=4e7, pressure=2e5, step=1e-8)
PILLARS = [surface(N, n_p, n_p) for n_p in (2, 6, 24)]

DECAY = np.exp(-1.0 / 4.0)  #: of the correlation along long sides, from block to block
#: t_max in µs, static friction, width of the force peak in µs; other load peaks as (µs, height).
CURVES: dict[Scene, tuple[float, float, float, list[tuple[float, float]]]] = {
    FLAT: (100.0, 0.80, 3.0, []),
    PILLARS[0]: (200.0, 0.78, 7.0, []),
    PILLARS[1]: (300.0, 0.60, 60.0, []),
    **dict.fromkeys([PLAIN, SQUARE], (300.0, 0.65, 15.0, [])),
    **dict.fromkeys([PILLARS[2], ACROSS, ANGLED], (300.0, 0.70, 20.0, [])),
    **dict.fromkeys([BARE_ALONG, DEEP_ACROSS], (300.0, 0.70, 20.0, [])),
    BARE_ACROSS: (300.0, 0.75, 20.0, []),
    ALONG: (300.0, 0.64, 48.0, [(220.0, 0.62)]),
    DEEP_ALONG: (300.0, 0.65, 15.0, [(140.0, 0.60), (220.0, 0.61)]),
}
SCENES = [*CURVES, STIFF]


def times(scene: Scene, rng: np.random.Generator) -> np.ndarray:
    """t_det over t_max, (N, N), as the paper has it."""
    if not scene.level:
        return flat_times(rng)
    if not scene.n_p:
        field = np.where(scene.pattern.contact, 1.03, np.nan)
        return field + (0.001 if scene == BARE_ALONG else 0.002) * rng.standard_normal(field.shape)
    field, size = np.full((N, N), np.nan), scene.n_p
    like_flat = scene.level == 1 and size < 4
    pillar = 1.03 if like_flat else ringed(size) if scene.level == 1 else grooved(scene)
    for y, x in scene.pattern.origins:
        field[y : y + size, x : x + size] = pillar + 0.001 * rng.standard_normal()
        if scene.level == 1 and size > 4:
            field[y : y + size, x : x + size] += by_side(size, rng)
    return field + 0.001 * rng.standard_normal(field.shape)


def flat_times(rng: np.random.Generator) -> np.ndarray:
    """Lonely precursors, a few that share a neighbour; late fronts.

    The first half of the late blocks are in twelve stripes of columns.
    """
    late = np.sort(1.05 + 0.015 * rng.standard_normal(N * N))
    stripes = np.roll(np.arange(N) * 24 // N % 2 == 0, rng.integers(N))
    field = np.empty((N, N))
    for columns, half in ((stripes, late[: N * N // 2]), (~stripes, late[N * N // 2 :])):
        field[:, columns] = rng.permutation(half).reshape(N, -1)
    for i, cell in enumerate(rng.permutation((N // 6) ** 2)[:44]):  # one in each cell of 6 x 6
        y, x = 6 * np.array(divmod(int(cell), N // 6)) + 1
        if i < 4:
            field[y : y + 3 : 2, x : x + 3 : 2] = rng.uniform(0.86, 0.89, (2, 2))
            field[y + 1, x + 1] = 0.95
        else:
            field[y, x] = rng.uniform(0.86, 0.89)
    return field


def ringed(size: int) -> np.ndarray:
    """The border in the paper's order before t_max; the inside of large pillars late."""
    start, step, apart = (0.50, 0.22, 0.06) if size < 20 else (0.84, 0.06, 0.02)
    pillar = np.zeros((size, size))
    for depth in range(size // 2):
        for late, mask in enumerate(pillar_ring(size, depth).values()):
            inside = (0.90 if size < 20 else 0.96) + 0.012 * min(depth, 4) + 0.001 * depth
            pillar[mask] = start + step * depth + apart * late if depth < 2 else inside
    return pillar


def by_side(size: int, rng: np.random.Generator) -> np.ndarray:
    """Sides along x detach as wholes if short, or in parts of 4 blocks; along y block by block."""
    field, along = np.zeros((size, size)), rng.standard_normal((2, size - 2))
    for i in range(1, size - 2):
        along[:, i] = DECAY * along[:, i - 1] + np.sqrt(1.0 - DECAY**2) * along[:, i]
    field[[0, -1], 1:-1] = 0.005 * (along if size >= 20 else along[:, :1])
    field[1:-1, [0, -1]] = 0.010 * rng.standard_normal((size - 2, 2))
    return field


def grooved(scene: Scene) -> np.ndarray:
    """Edges before the core."""
    early, late = (0.70, 0.98) if scene.direction != "x" else (0.65, 1.03)
    field = np.where(scene.contact, np.where(core(scene.contact), late, early), np.nan)
    return pillars_of(field, scene)[0]


def record(scene: Scene, seed: int) -> Record:
    """A realisation whose force has Gaussian peaks."""
    rng = np.random.default_rng([seed, scene.n_p, scene.level])
    t_max, friction, width, others = CURVES[replace(scene, **FLAT.constants)]
    time = np.arange(0.0, 500e-6, 1e-6)
    friction += 0.002 * rng.standard_normal()
    hills = [(t_max, friction), *others]
    force = sum(h * np.exp(-(((1e6 * time - at) / width) ** 2)) for at, h in hills)
    if not scene.level:  # goes on to slide, more or less evenly
        force += 0.3 * (1.0 + 0.02 * np.sin(0.3e6 * time)) * (1e6 * time > t_max + 10.0)
    t_det = 1e-6 * t_max * times(scene, rng)
    detachments = counted(t_det, len(time))
    again = 250 * (1e6 * time == 250.0) * (scene.level > 1)
    uneven = np.array([0.1, 1.0, 0.2, 0.1]).reshape(4, 1, 1, 1)  # most at the force minimum
    watched = 1e-6 * np.array([80.0, 110.0, 160.0, 290.0] if scene == FLAT else [])
    return Record(
        scene=scene,
        seed=seed,
        time=time,
        force=force,
        normal_force=1.0,
        detachments=detachments,
        switches=detachments + again,
        t_det=t_det,
        contact=np.isfinite(t_det),
        snapshot_times=watched,
        snapshots=(1e-8 * uneven * rng.standard_normal((4, 2, N, N)))[: len(watched)],
    )


def counted(t_det: np.ndarray, samples: int) -> np.ndarray:
    """First detachments in the microsecond before each sample."""
    microseconds = np.ceil(1e6 * t_det[np.isfinite(t_det)]).astype(int)
    return np.bincount(microseconds, minlength=samples)[:samples]


def evidence(records: Iterable[Record]) -> Evidence:
    """Evidence of these records, with tables that say what the paper says."""
    return Evidence(by_scene(records), *tables(), precision=precision())


def realisations() -> list[Record]:
    return [record(scene, seed) for scene in SCENES for seed in SEEDS]


#: Scenes of the tables of correlations, and l_c of their sides.
LENGTHS = {surface(120, n_p, n_p): {"x": l_c, "y": 0.5} for n_p, l_c in ((20, 3.4), (60, 4.4))}


def around(name: str, value: float, half: float, prefix: str = "ci") -> Row:
    """A value and an interval around it."""
    return {name: value, f"{prefix}_low": value - half, f"{prefix}_high": value + half}


def tables() -> tuple[dict[Scene, list[Row]], ...]:
    """The tables of c(r) and of its lengths."""
    correlations: dict[Scene, list[Row]] = {}
    lengths: dict[Scene, list[Row]] = {}
    for scene, sides in LENGTHS.items():
        for side, value in sides.items():
            row = {**identity(scene), "side": side, "realisations": 240}
            c = [around("correlation", np.exp(-r / value), 0.005) | {"r": r} for r in range(9)]
            correlations.setdefault(scene, []).extend(row | each for each in c)
            row |= around("l_c", value, 0.2) | around("tail", value, 0.3, prefix="tail")
            lengths.setdefault(scene, []).append(row)
    return correlations, lengths


def precision(bias: float = 1e-4) -> list[Row]:
    common = {"step": 1e-8, "scene": "flat", "quantity": "static_friction", "realisations": 100}
    scatter = {"comparison": "scatter", "integrator": "leapfrog"} | around("error", 0.0, 0.002)
    paired = {"comparison": "paired"} | around("error", bias, 1e-4)
    methods = "leapfrog", "rk4", "plain rk4"
    return [common | scatter, *(common | paired | {"integrator": name} for name in methods)]


Change = Callable[[Record], dict[str, Any]]  #: what to replace of a realisation


def peaks(*places: tuple[float, float], width: float = 15.0) -> Change:
    """Load peaks at these times in µs, of these heights."""
    return lambda run: {
        "force": sum(h * np.exp(-(((1e6 * run.time - at) / width) ** 2)) for at, h in places)
    }


def changed(records: Iterable[Record], scenes: Collection[Scene], change: Change) -> list[Record]:
    """Replace fields of the realisations of some scenes."""
    return [replace(r, **change(r)) if r.scene in scenes else r for r in records]
