"""What the lowest friction and the load peaks depend on, with one thing changed at a time.

A setting has pillars of several sizes on equally wide surfaces, for friction; pillars of `SIZE` on
larger surfaces, for times; and pawls between grooves, with pillars and without, for load peaks.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from operator import attrgetter
from typing import NamedTuple

import numpy as np
import pyarrow as pa

from springblock.analysis.lowest import lowest
from springblock.analysis.statistics import Interval, difference_interval, mean_interval
from springblock.io.records import Record
from springblock.io.rows import Row, limits
from springblock.io.schemas import column, numbers, texts
from springblock.model.material import Material
from springblock.model.scene import Scene, differing

SIZE = 6  #: n_p of the pillars whose times are compared, on which friction is lowest in the paper
_GROOVE = 2  #: n_s2 of the paper's grooves

SENSITIVITIES = pa.schema(
    [
        *texts(
            varied="what differs from the paper's surfaces; empty for these",
            value="its value, or ratio to the paper's value",
            edges="free or periodic",
        ),
        *numbers("1/s", gamma="damping frequency"),
        *texts(
            quantity="size: n_p of lowest static friction; friction: on pillars of this size; "
            "depth: of the largest size minus that; lag: t_max - t_avg on pillars of 6 blocks; "
            "prominence: of the second load peak over the largest force, on pawls of 8 blocks "
            "with pillars, and prominence_whole without"
        ),
        *numbers(
            "of its quantity: 1, blocks or s",
            mean="mean, or best size",
            mean_low="lower limit of its 95 % interval, or smallest size that may be the best",
            mean_high="upper limit, or largest size",
        ),
        column("seeds", pa.int64(), "1", "smallest number of realisations of a surface"),
    ]
)

#: Constants that are varied together: what they vary, and its value.
_RATIOS: dict[tuple[str, ...], tuple[str, Callable[[Material], float]]] = {
    ("thickness",): ("l_z", attrgetter("thickness")),
    ("mu_static_std",): ("scatter", attrgetter("mu_static_std")),
    ("mu_dynamic",): ("mu_s - mu_d", lambda material: material.mu_static - material.mu_dynamic),
    ("slider_velocity",): ("v", attrgetter("slider_velocity")),
    ("pressure",): ("P", attrgetter("pressure")),
    ("youngs_modulus", "density", "thickness"): ("K_s", attrgetter("k_s")),
}


class Setting(NamedTuple):
    """What differs from the paper's surfaces."""

    varied: str
    value: str
    edges: str
    gamma: float  #: 1/s


def setting(scene: Scene) -> Setting:
    """Return what differs from the paper's surfaces, apart from the pattern of pillars."""
    material, paper = scene.material, Material()
    names = tuple(differing(dict(each.items()) for each in (paper, material)))
    gaps = scene.n_s2 / _GROOVE if scene.n_p2 else scene.n_s / scene.n_p
    varied, value = "", ""
    if names in _RATIOS:
        varied, of = _RATIOS[names]
        value = f"× {of(material) / of(paper):.2g}"
    elif "law" in names:
        varied, value = "healing", material.healing
    elif material.gamma != paper.gamma:
        varied, value = "gamma", f"{material.gamma:.0e} 1/s"
    elif gaps != 1.0:
        varied, value = "gaps", f"× {gaps:g}"
    elif scene.is_periodic:
        varied, value = "edges", scene.edges
    return Setting(varied, value, scene.edges, material.gamma)


def sensitivities(records: Iterable[Record]) -> Iterator[Row]:
    """Yield a row for each setting and quantity."""
    by_setting: dict[Setting, dict[Scene, list[Record]]] = {}
    for record in records:
        ensembles = by_setting.setdefault(setting(record.scene), {})
        ensembles.setdefault(record.scene, []).append(record)
    for each, surfaces in by_setting.items():
        seeds = min(map(len, surfaces.values()))
        for quantity, interval in _quantities(surfaces):
            row = {"quantity": quantity, "seeds": seeds} | limits("mean", interval)
            yield each._asdict() | row


def _quantities(surfaces: Mapping[Scene, Sequence[Record]]) -> Iterator[tuple[str, Interval]]:
    """Yield each quantity that the surfaces of a setting allow."""
    pillars: dict[int, dict[int, Sequence[Record]]] = {}  # by N and n_p
    for scene, runs in surfaces.items():
        if scene.n_p2:
            name = "prominence" if scene.n_p else "prominence_whole"
            yield name, mean_interval([run.prominence for run in runs])
        else:
            pillars.setdefault(scene.n_blocks, {})[scene.n_p] = runs
    if not pillars:
        return
    yield "lag", mean_interval([run.t_max - run.t_avg for run in pillars[max(pillars)][SIZE]])
    sizes = max(pillars.values(), key=len)
    samples = {n_p: np.array([run.static_friction for run in sizes[n_p]]) for n_p in sorted(sizes)}
    least = lowest(samples)
    yield "size", Interval(*map(np.array, (least.place, min(least.alike), max(least.alike))))
    yield "friction", mean_interval(samples[least.place])
    yield "depth", difference_interval(samples[max(samples)], samples[least.place])
