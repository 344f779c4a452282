"""Evidence made up so that all that the paper says is true, and ways to change it."""

from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Any

import numpy as np

from springblock.claims.grooves import edge, grooved_parts
from springblock.claims.rule import Evidence, Row
from springblock.scene import Scene
from springblock.statistics import pillar_ring
from springblock.tables import Record

N, SEEDS = 48, range(24)
FLAT = Scene(N)
ALONG, ACROSS = (Scene(N, 23, 25, 5, 1, direction=direction) for direction in "xy")
DEEP_ALONG, DEEP_ACROSS = (Scene(N, 23, 25, 5, 1, 11, 1, direction) for direction in "xy")
PILLARS = [Scene(N, n_p, n_p) for n_p in (2, 6, 24)]

#: t_max in µs, static friction, width of the force peak in µs; other load peaks as (µs, height).
CURVES: dict[Scene, tuple[float, float, float, list[tuple[float, float]]]] = {
    FLAT: (100.0, 0.80, 3.0, []),
    PILLARS[0]: (200.0, 0.78, 7.0, []),
    PILLARS[1]: (300.0, 0.60, 60.0, []),
    PILLARS[2]: (300.0, 0.70, 20.0, []),
    ALONG: (300.0, 0.65, 15.0, [(220.0, 0.60)]),
    ACROSS: (300.0, 0.70, 20.0, []),
    DEEP_ALONG: (300.0, 0.65, 15.0, [(220.0, 0.60)]),
    DEEP_ACROSS: (300.0, 0.70, 20.0, []),
}


def times(scene: Scene, rng: np.random.Generator) -> np.ndarray:
    """t_det over t_max, (N, N), as the paper has it."""
    if scene == FLAT:
        return flat_times(rng)
    field, size = np.full((N, N), np.nan), scene.n_p
    like_flat = scene.level == 1 and size < 4
    pillar = 1.04 if like_flat else ringed(size) if scene.level == 1 else grooved(scene)
    for y, x in scene.pattern.origins:
        field[y : y + size, x : x + size] = pillar + 0.001 * rng.standard_normal()
    return field + 0.001 * rng.standard_normal(field.shape)


def flat_times(rng: np.random.Generator) -> np.ndarray:
    """A few lonely precursors and a pair of them, anywhere; the front comes late."""
    field = 1.02 + 0.002 * rng.standard_normal((N, N))
    blocks = 4 * rng.choice((N // 4) ** 2, 8, replace=False)
    rows, columns = 4 * (blocks // N) + 1, blocks % N + 1
    field[rows, columns] = 0.85
    field[rows[0], columns[0] + 1] = 0.86
    return field


def ringed(size: int) -> np.ndarray:
    pillar = np.zeros((size, size))
    for depth in range(size // 2):
        for late, mask in enumerate(pillar_ring(size, depth).values()):
            pillar[mask] = min(0.70 + 0.08 * depth, 0.93) + 0.02 * late
    return pillar


def grooved(scene: Scene) -> np.ndarray:
    (y, x), size = scene.pattern.origins[0], scene.n_p
    contact = scene.pattern.contact[y : y + size, x : x + size]
    if scene.direction == "y":
        return np.where(edge(contact), 0.70, np.where(contact, 0.98, np.nan))
    pillar = np.full((size, size), np.nan)
    for late, mask in zip((0.55, 0.65, 0.70, 0.98), grooved_parts(scene).values(), strict=True):
        pillar[mask] = late
    return pillar


def record(scene: Scene, seed: int) -> Record:
    """A realisation whose force has Gaussian peaks."""
    rng = np.random.default_rng([seed, scene.n_p, scene.level])
    t_max, friction, width, others = CURVES[scene]
    time = np.arange(0.0, 500e-6, 1e-6)
    friction += 0.002 * rng.standard_normal()
    force = sum(
        height * np.exp(-(((1e6 * time - place) / width) ** 2))
        for place, height in [(t_max, friction), *others]
    )
    t_det = 1e-6 * t_max * times(scene, rng)
    nothing = np.zeros(len(time), np.int32)
    return Record(
        scene=scene,
        seed=seed,
        time=time,
        force=force,
        normal_force=1.0,
        detachments=nothing,
        switches=nothing,
        t_det=t_det,
        t_max=1e-6 * t_max,
        t_avg=float(np.nanmean(t_det)),
        static_friction=friction,
    )


def evidence(records: Iterable[Record]) -> Evidence:
    """Evidence of these records, with tables that say what the paper says."""
    by_scene: dict[Scene, list[Record]] = {}
    for made in records:
        by_scene.setdefault(made.scene, []).append(made)
    names = ("seed", "t_max", "t_avg", "static_friction")
    return Evidence(
        summaries={
            scene: [{name: getattr(run, name) for name in names} for run in runs]
            for scene, runs in by_scene.items()
        },
        records=by_scene,
        correlation=correlation(),
        correlation_length=lengths(),
        precision=precision(),
    )


def as_in_the_paper() -> list[Record]:
    return [record(scene, seed) for scene in CURVES for seed in SEEDS]


#: Scenes of the tables of correlations, and l_c.
LENGTHS = {Scene(120, 20, 20): 3.4, Scene(120, 60, 60): 4.4, Scene(120, 58, 62, 8, 2): 4.3}


def around(name: str, value: float, half: float, prefix: str = "ci") -> Row:
    """A value and an interval around it."""
    return {name: value, f"{prefix}_low": value - half, f"{prefix}_high": value + half}


def correlation() -> dict[Scene, list[Row]]:
    return {
        scene: [
            {**scene.row, "side": side, "r": r, **around("correlation", np.exp(-r / decay), 0.03)}
            for side, decay in (("x", l_c), ("y", 0.5))
            for r in range(9)
        ]
        for scene, l_c in LENGTHS.items()
    }


def lengths() -> dict[Scene, list[Row]]:
    return {
        scene: [
            {**scene.row, "side": side, "r_last": 8}
            | around("l_c", value, 0.2)
            | around("tail", value, 0.3, prefix="tail")
            for side, value in (("x", l_c), ("y", 0.5))
        ]
        for scene, l_c in LENGTHS.items()
    }


def precision(bias: float = 1e-4) -> list[Row]:
    common = {"step": 1e-8, "scene": "flat", "quantity": "static_friction", "realisations": 100}
    found = [("paired", "leapfrog", bias, 1e-4), ("paired", "rk4", bias, 1e-4)]
    found.append(("scatter", "leapfrog", 0.0, 0.002))
    return [
        {**common, "comparison": comparison, "integrator": integrator}
        | around("error", error, half)
        for comparison, integrator, error, half in found
    ]


def changed(
    records: Iterable[Record], scenes: Iterable[Scene], change: Callable[[Record], dict[str, Any]]
) -> list[Record]:
    """Replace fields of the realisations of some scenes."""
    chosen = set(scenes)
    return [replace(r, **change(r)) if r.scene in chosen else r for r in records]
