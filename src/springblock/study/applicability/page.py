"""Values of the page on where the model applies: friction of strips as wide as their grooves."""

import math
from collections.abc import Iterable
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from springblock.analysis.statistics import Interval, mean_interval
from springblock.io.rows import Row, scene_of
from springblock.model.material import Material
from springblock.model.scene import Scene
from springblock.simulation.resolution import DECAY, STIFFNESS


class Strips(NamedTuple):
    """Static friction of strips between grooves of the same width."""

    width: int  #: blocks
    number: int  #: of strips
    across: Interval
    along: Interval
    difference: Interval  #: across minus along


def values(realisations: Iterable[Row], *_: Iterable[Row]) -> dict[str, Any]:
    """Return what the template names, from rows of the table `realisations`.

    Runs of the same seed have the same friction coefficients, so that differences are paired.
    """
    friction: dict[Scene, dict[int, float]] = {}
    for row in realisations:
        scene = replace(scene_of(row), duration=0.0, snapshot_times=())
        friction.setdefault(scene, {})[row["seed"]] = row["static_friction"]
    strips, numbers = [], []
    for scene, along in friction.items():
        width, n = scene.n_p2, scene.n_blocks
        if width and scene == Scene(n, n_p2=width, n_s2=width):
            across = friction.get(replace(scene, direction="y"), {})
            seeds = sorted(along.keys() & across.keys())
            pairs = np.array([(across[seed], along[seed]) for seed in seeds])
            if len(pairs) > 1:
                numbers.append(len(pairs))
                means = map(mean_interval, (pairs[:, 0], pairs[:, 1], pairs[:, 0] - pairs[:, 1]))
                strips.append(Strips(width, n // (2 * width), *means))
    flat = friction[Scene(strips[0].width * strips[0].number * 2)]
    strips.sort(key=lambda each: each.number)
    by_difference = sorted(strips, key=lambda each: each.difference.mean)
    return {
        "strips": strips,
        "coarsest": {axis: math.sqrt(ratio) / DECAY for axis, ratio in STIFFNESS.items()},
        "widest": max(m.high - m.mean for each in strips for m in (each.across, each.along)),
        "lowest": min(strips, key=lambda each: each.across.mean),
        "deepest": by_difference[0],
        "highest": by_difference[-1],
        "seeds": min(numbers),
        "flat": mean_interval(list(flat.values())),
        "mu_dynamic": Material().mu_dynamic,
    }
