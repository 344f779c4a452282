"""Realisations made up so that the answer to each question is known."""

from collections.abc import Callable

import numpy as np
from scipy.signal import lfilter

from springblock.io.records import Record
from springblock.model.material import Material
from springblock.model.scene import Scene

T_MAX = 100e-6  #: s


def record(scene: Scene, seed: int, t_det: np.ndarray, friction: float, hills=()) -> Record:
    """A realisation with a force peak at 100 µs, and other hills as (µs, height)."""
    time = np.arange(0.0, 200e-6, 1e-6)
    force = np.exp(-(((time - T_MAX) / 5e-6) ** 2))
    for at, height in hills:
        force = np.maximum(force, height * np.exp(-(((time - 1e-6 * at) / 5e-6) ** 2)))
    counts = np.zeros(time.size, np.int32)
    return Record(
        scene=scene,
        seed=seed,
        time=time,
        force=friction * force,
        normal_force=1.0,
        detachments=counts,
        switches=counts,
        t_det=np.where(scene.pattern.contact, t_det, np.nan),
        contact=np.isfinite(t_det),
        constants=dict(Material().items()) | dict(scene.varied),
    )


def correlated(n: int, length: float, rng: np.random.Generator) -> np.ndarray:
    """Times whose correlation along x is exp(-r/length), (n, n), and none along y."""
    decay = np.exp(-1.0 / length)
    noise = rng.standard_normal((n, 200 + n)) * np.sqrt(1.0 - decay**2)
    return T_MAX * (1.0 + 0.01 * lfilter([1.0], [1.0, -decay], noise)[:, 200:])


def ensemble(
    scene: Scene,
    friction: float = 0.7,
    length: float = 1.0,
    runs: int = 12,
    scatter: float = 1e-3,
    hills: Callable[[np.random.Generator], list[tuple[float, float]]] = lambda rng: [],
) -> list[Record]:
    """Runs with this static friction, give or take, and correlation length in blocks."""
    rng = np.random.default_rng([scene.n_blocks, scene.n_p, scene.n_s, scene.n_p2, runs])
    return [
        record(
            scene,
            seed,
            correlated(scene.n_blocks, length, rng),
            friction + scatter * rng.standard_normal(),
            hills(rng),
        )
        for seed in range(runs)
    ]


SIZES = (20.0, 40.0, 80.0, 120.0, 240.0)  #: of pillars, µm
SIDE = 480.0  #: of surfaces, µm
#: Spacing and thickness, µm, scatter, and the length over which it is alike, µm.
PLACES = (
    *((20, 10, 0.1, 0), (10, 10, 0.1, 0), (5, 10, 0.1, 0), (10, 5, 0.1, 0), (10, 20, 0.1, 0)),
    *((20, 10, 0.05, 0), (5, 10, 0.2, 0)),
    *((20, 10, 0.1, 20), (10, 10, 0.1, 20), (5, 10, 0.1, 20)),
    *((20, 10, 0, 0), (10, 10, 0, 0), (5, 10, 0, 0)),
)


def lattices(
    length: Callable[[float, float, float], float],
    best: Callable[[float, float, float], float],
    runs: int = 20,
) -> dict[Scene, list[Record]]:
    """Lattices and layers whose decay length and whose friction-minimising size, µm, are given.

    Both functions take the spacing and the thickness, µm, and the scatter. Without scatter there
    is one realisation.
    """
    found = {}
    for spacing, thickness, scatter, alike in PLACES:
        usual = {"spacing": 1e-5, "thickness": 1e-5, "mu_static_std": 0.1, "correlation_length": 0}
        given = {"spacing": 1e-6 * spacing, "thickness": 1e-6 * thickness, "mu_static_std": scatter}
        given["correlation_length"] = 1e-6 * alike
        varied = tuple((key, value) for key, value in given.items() if value != usual[key])
        for size in SIZES:
            n_p = int(size / spacing)
            scene = Scene(int(SIDE / spacing), n_p, n_p, varied=varied)
            place = spacing, thickness, scatter
            height = 0.7 + 0.02 * np.log(size / best(*place)) ** 2
            some = {"runs": runs} if scatter else {"runs": 1, "scatter": 0.0}
            found[scene] = ensemble(scene, height, length(*place) / spacing, **some)
    return found


def grooves(
    angles: dict[str, float], n_p: int = 0, runs: int = 6, scatter: float = 0.0
) -> dict[Scene, list[Record]]:
    """Grooves whose force has a lesser peak as high as given, by sliding direction.

    The height scatters from seed to seed, by the same in all directions.
    """
    lengths = {"n_p": n_p, "n_s": 36 - n_p if n_p else 0, "n_p2": 4, "n_s2": 2}
    return {
        (scene := Scene(36, **lengths, direction=direction)): ensemble(
            scene,
            runs=runs,
            hills=lambda rng, height=height: [(60.0, height + scatter * rng.uniform(-1.0, 1.0))],
        )
        for direction, height in angles.items()
    }


def sizes_and_distances(friction: Callable[[int, float], float]) -> dict[Scene, list[Record]]:
    """Pillars of many sizes, apart by parts and multiples of their size."""
    found = {}
    for ratio in (0.5, 1.0, 2.0):
        for n_p in (2, 4, 6, 8, 12, 16, 20):
            period = int(n_p * (1.0 + ratio))
            if 240 % period == 0:
                scene = Scene(240, n_p, int(n_p * ratio))
                found[scene] = lean(scene, friction(n_p, ratio))
    return found


def lean(scene: Scene, friction: float, runs: int = 5, scatter: float = 1e-4) -> list[Record]:
    """Runs whose times nobody looks at."""
    rng = np.random.default_rng([scene.n_blocks, scene.n_p, scene.n_s])
    values = friction + scatter * rng.standard_normal(runs)
    empty = np.zeros((scene.n_blocks, scene.n_blocks))
    return [record(scene, seed, empty, value) for seed, value in enumerate(values)]
