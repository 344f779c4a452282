"""Evidence made up so that all that the paper says is true, and ways to change it."""

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from springblock import draw_friction
from springblock.analysis.statistics import pillar_ring
from springblock.claims.rule import Evidence
from springblock.claims.surfaces import edge, grooved_parts, pillars_of
from springblock.io.identity import identity
from springblock.io.records import Record
from springblock.io.rows import Row
from springblock.model.scene import Scene

N, SEEDS = 48, range(40)
#: Scenes with the study's material: damped, so that motion has ended far below the load peaks.
surface = partial(Scene, gamma=1e5, mu_dynamic=0.05)
NAMES = ("slider_velocity", "pressure", "mu_static_std")
FLAT = surface(N)
ALONG, ACROSS, ANGLED = (
    surface(N, 23, 25, 5, 1, direction=direction) for direction in ("x", "y", "45")
)
BARE_ALONG, BARE_ACROSS = (surface(N, n_p2=5, n_s2=1, direction=direction) for direction in "xy")
DEEP_ALONG, DEEP_ACROSS = (surface(N, 23, 25, 5, 1, 11, 1, direction) for direction in "xy")
SQUARE, PLAIN = surface(N, 23, 25, 5, 1, 5, 1), surface(N, 23, 25)
STIFF = surface(N, youngs_modulus=4e7, pressure=2e5, step=1e-8)
#: The same motion as with a modulus and a pressure 1e4 times larger.
STIFFER = surface(N, slider_velocity=5e-6, gamma=1e3)
#: The lowest and the highest value of each constant that decides how many fronts there are.
FEW, MANY = (
    [surface(N, **{name: value}) for name, value in zip(NAMES, values, strict=True)]
    for values in ((5e-5, 1e4, 0.02), (5e-3, 2e5, 0.3))
)
#: Shorter pillars than those of `ALONG`, and some with wider pawls.
SHORTER = [surface(N, 17, 7, 5, 1), surface(N, 11, 13, 5, 1)]
WIDER = [surface(N, 23, 25, 11, 1), surface(N, 17, 7, 8, 1), surface(N, 23, 25, 7, 1)]
PILLARS = [surface(N, n_p, n_p) for n_p in (2, 6, 24)]

DECAY = np.exp(-1.0 / 4.0)  #: of the correlation along long sides, from block to block
#: t_max in µs, static friction, width of the force peak in µs; other load peaks as (µs, height).
CURVES: dict[Scene, tuple[float, float, float, list[tuple[float, float]]]] = {
    FLAT: (100.0, 0.80, 3.0, []),
    PILLARS[0]: (200.0, 0.78, 7.0, []),
    PILLARS[1]: (300.0, 0.60, 60.0, []),
    PILLARS[2]: (300.0, 0.70, 20.0, []),
    ALONG: (300.0, 0.64, 48.0, [(220.0, 0.62)]),
    PLAIN: (300.0, 0.65, 15.0, []),
    SQUARE: (300.0, 0.65, 15.0, []),
    ACROSS: (300.0, 0.70, 20.0, []),
    ANGLED: (300.0, 0.70, 20.0, []),
    **dict.fromkeys([STIFF, STIFFER, *FEW, *MANY], (100.0, 0.80, 3.0, [])),
    BARE_ALONG: (300.0, 0.70, 20.0, []),
    BARE_ACROSS: (300.0, 0.75, 20.0, []),
    DEEP_ALONG: (300.0, 0.65, 15.0, [(140.0, 0.60), (220.0, 0.61)]),
    DEEP_ACROSS: (300.0, 0.70, 20.0, []),
    SHORTER[0]: (300.0, 0.63, 6.0, [(247.0, 0.60)]),
    SHORTER[1]: (300.0, 0.61, 6.0, [(273.0, 0.59)]),
    WIDER[0]: (300.0, 0.64, 6.0, [(265.0, 0.62)]),
    WIDER[1]: (300.0, 0.63, 6.0, [(268.0, 0.60)]),
    WIDER[2]: (300.0, 0.64, 6.0, [(243.0, 0.62)]),
}


def times(scene: Scene, seed: int, rng: np.random.Generator) -> np.ndarray:
    """t_det over t_max, (N, N), as the paper has it."""
    if not scene.level:
        return flat_times(seed, rng, fronts=3 if scene in MANY else 1)
    if not scene.n_p:
        field = np.where(scene.pattern.contact, 1.03, np.nan)
        return field + (0.001 if scene == BARE_ALONG else 0.002) * rng.standard_normal(field.shape)
    field, size = np.full((N, N), np.nan), scene.n_p
    like_flat = scene.level == 1 and size < 4
    pillar = 1.03 if like_flat else ringed(size) if scene.level == 1 else grooved(scene)
    if scene == PLAIN:
        pillar = np.linspace(0.1, 1.0, size * size).reshape(size, size)
    for y, x in scene.pattern.origins:
        field[y : y + size, x : x + size] = pillar + 0.001 * rng.standard_normal()
        if scene.level == 1 and size > 4:
            field[y : y + size, x : x + size] += by_side(size, rng)
    return field + 0.001 * rng.standard_normal(field.shape)


def flat_times(seed: int, rng: np.random.Generator, fronts: int) -> np.ndarray:
    """Lonely precursors where thresholds are low, a few that share a neighbour; late fronts.

    The first half of the late blocks are in so many stripes of columns.
    """
    late = np.sort(1.05 + 0.015 * rng.standard_normal(N * N))
    stripes = np.roll(np.arange(N) * 2 * fronts // N % 2 == 0, rng.integers(N))
    field = np.empty((N, N))
    for columns, half in ((stripes, late[: N * N // 2]), (~stripes, late[N * N // 2 :])):
        field[:, columns] = rng.permutation(half).reshape(N, -1)
    for column in rng.permutation(N // 8)[:fronts]:
        y, x = rng.integers(N - 5), 8 * column
        field[y : y + 5, x : x + 5] = 1.005
    taken = np.zeros((N, N), bool)
    weakest = np.argsort(draw_friction(N, seed)[0], axis=None)
    singles, groups = 40, 4
    for block in weakest:
        y, x = divmod(int(block), N)
        room = np.s_[max(y - 2, 0) : y + 5, max(x - 2, 0) : x + 5]
        if taken[room].any() or not (singles or groups):
            continue
        if groups and y + 2 < N and x + 2 < N:
            groups -= 1
            early = rng.uniform(0.86, 0.89, (2, 2))
            field[y : y + 3 : 2, x : x + 3 : 2], field[y + 1, x + 1] = early, 0.95
            taken[y : y + 3, x : x + 3] = True
        elif singles:
            singles -= 1
            field[y, x], taken[y, x] = rng.uniform(0.86, 0.89), True
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
    if scene.direction != "x":
        field = np.where(edge(scene.contact), 0.70, np.where(scene.contact, 0.98, np.nan))
        return pillars_of(field, scene)[0]
    pillar = np.full((scene.n_p, scene.n_p), np.nan)
    for late, mask in zip((0.55, 0.65, 0.70, 1.03), grooved_parts(scene).values(), strict=True):
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
    if not scene.level:  # goes on to slide, more or less evenly
        force += 0.3 * (1.0 + 0.02 * np.sin(0.3e6 * time)) * (1e6 * time > t_max + 10.0)
    t_det = 1e-6 * t_max * times(scene, seed, rng)
    detachments = counted(t_det, len(time))
    again = 250 * (1e6 * time == 250.0) * (scene.level > 1)
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
        snapshots=strained(rng)[: len(watched)],
    )


def strained(rng: np.random.Generator) -> np.ndarray:
    """Displacements that are uneven, most at the second of four times, the force minimum."""
    share = np.array([0.1, 1.0, 0.2, 0.1]).reshape(4, 1, 1, 1)
    return 1e-8 * share * rng.standard_normal((4, 2, N, N))


def counted(t_det: np.ndarray, samples: int) -> np.ndarray:
    """First detachments in the microsecond before each sample."""
    microseconds = np.ceil(1e6 * t_det[np.isfinite(t_det)]).astype(int)
    return np.bincount(microseconds, minlength=samples)[:samples]


def evidence(records: Iterable[Record]) -> Evidence:
    """Evidence of these records, with tables that say what the paper says."""
    by_scene: dict[Scene, list[Record]] = {}
    for made in records:
        by_scene.setdefault(made.scene, []).append(made)
    return Evidence(
        records=by_scene,
        correlation=correlation(),
        correlation_length=lengths(),
        stress=stress(),
        precision=precision(),
    )


def realisations(scenes: Iterable[Scene]) -> list[Record]:
    return [record(scene, seed) for scene in scenes for seed in SEEDS]


def stress() -> dict[Scene, np.ndarray]:
    """Most at corners and edges across; on grooved pillars less uneven, and most outside."""
    fields = {}
    for scene in (*PILLARS, ALONG, ACROSS, PLAIN):
        size, field = scene.n_p, np.full((2, N, N), np.nan)
        if scene.n_p2:
            pillar, parts = np.full((size, size), np.nan), grooved_parts(scene)
            levels = (1.5, 1.4, 1.2, 0.9) if scene == ALONG else (1.6, 1.5, 1.3, 0.8)
        else:
            pillar, parts = np.full((size, size), 0.6), pillar_ring(size, 0)
            levels = (1.0, 1.0, 1.0) if size < 4 else (3.0, 2.5, 2.0)
        for level, mask in zip(levels, parts.values(), strict=True):
            pillar[mask] = level
        for y, x in scene.pattern.origins:
            field[:, y : y + size, x : x + size] = pillar, 0.0 * pillar
        fields[scene] = field
    return fields


#: Scenes of the tables of correlations, and l_c of their sides.
LENGTHS = {
    surface(120, 20, 20): {"x": 3.4, "y": 0.5},
    surface(120, 60, 60): {"x": 4.4, "y": 0.5},
    surface(120, 58, 62, 8, 2): {"x": 4.3, "grooves": 4.3},
    surface(120, 58, 62, 8, 2, direction="y"): {"x": 0.3, "grooves": 0.3},
}


def around(name: str, value: float, half: float, prefix: str = "ci") -> Row:
    """A value and an interval around it."""
    return {name: value, f"{prefix}_low": value - half, f"{prefix}_high": value + half}


def correlation() -> dict[Scene, list[Row]]:
    return {
        scene: [
            {**identity(scene), "side": side, "r": r, "realisations": 240}
            | around("correlation", np.exp(-r / decay), 0.005)
            for side, decay in sides.items()
            for r in range(9)
        ]
        for scene, sides in LENGTHS.items()
    }


def lengths() -> dict[Scene, list[Row]]:
    return {
        scene: [
            {**identity(scene), "side": side, "realisations": 240}
            | around("l_c", value, 0.2)
            | around("tail", value, 0.3, prefix="tail")
            for side, value in sides.items()
        ]
        for scene, sides in LENGTHS.items()
    }


def precision(bias: float = 1e-4) -> list[Row]:
    common = {"step": 1e-8, "scene": "flat", "quantity": "static_friction", "realisations": 100}
    scatter = {"comparison": "scatter", "integrator": "leapfrog"} | around("error", 0.0, 0.002)
    paired = {"comparison": "paired"} | around("error", bias, 1e-4)
    methods = "leapfrog", "rk4", "plain rk4"
    return [common | scatter, *(common | paired | {"integrator": name} for name in methods)]


Change = Callable[[Record], dict[str, Any]]  #: what to replace of a realisation


def peaks(*places: tuple[float, float], width: float = 15.0) -> Change:
    """Load peaks at these times in µs, of these heights."""

    def change(run: Record) -> dict[str, Any]:
        time = 1e6 * run.time
        hills = [height * np.exp(-(((time - place) / width) ** 2)) for place, height in places]
        return {"force": sum(hills)}

    return change


def changed(records: Iterable[Record], scenes: Iterable[Scene], change: Change) -> list[Record]:
    """Replace fields of the realisations of some scenes."""
    chosen = set(scenes)
    return [replace(r, **change(r)) if r.scene in chosen else r for r in records]
