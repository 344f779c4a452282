"""Stress before the first detachment, when nothing random has happened (section 3 of the paper).

A prelude holds the largest tangential force that has pulled at each block so far. There is no
scatter: values are exact, and their intervals have no width.
"""

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from springblock.analysis.statistics import pillar_ring
from springblock.claims.correlation import most_like
from springblock.claims.grooves import edge, grooved_parts
from springblock.claims.rule import Claim, Estimate, Evidence, Finding
from springblock.claims.samples import (
    ALIKE,
    INF,
    NEGATIVE,
    POSITIVE,
    SMALLEST,
    place,
    scenes_along_x,
)
from springblock.model.scene import Scene
from springblock.simulation.run import Array

_NEEDS = "preludes of"
_OVER_MEAN = "over the mean of the surface"


def exact(value: float) -> Estimate:
    """A value without scatter."""
    return Estimate(value, value, value)


def _in_prelude(*scenes: Scene) -> str:
    return "; ".join(f"preludes/{scene.folder}" for scene in scenes)


def pillar_stress(evidence: Evidence, scene: Scene) -> Array:
    """Stress on each pillar over the mean of the surface, (pillars, n_p, n_p)."""
    size, field = scene.n_p, evidence.stress[scene]
    return np.stack([field[y : y + size, x : x + size] for y, x in scene.pattern.origins])


def larger_across(evidence: Evidence) -> Iterator[Finding]:
    """The edges across the sliding direction bear more than those along it."""
    for scene in scenes_along_x(evidence.stress, 1, SMALLEST):
        ring = pillar_ring(scene.n_p, 0)
        across, along = (pillar_stress(evidence, scene)[:, ring[side]].mean() for side in "yx")
        yield Finding(
            place(scene),
            f"stress on the edges across minus that on the edges along, {_OVER_MEAN}",
            exact(float(across - along)),
            POSITIVE,
            _in_prelude(scene),
        )


def same_stress(evidence: Evidence) -> Iterator[Finding]:
    """No pillar differs much from the mean pillar, against how places on a pillar differ."""
    for scene in scenes_along_x(evidence.stress, 1, SMALLEST):
        pillars = pillar_stress(evidence, scene)
        if len(pillars) < 2:
            continue
        usual = pillars.mean(axis=0)
        off = np.sqrt(((pillars - usual) ** 2).mean(axis=(1, 2))).max()
        yield Finding(
            place(scene),
            "root mean square of the stress on the pillar most unlike the mean pillar minus that "
            "on the latter, over the standard deviation on it",
            exact(float(off / usual.std())),
            (-INF, ALIKE),
            _in_prelude(scene),
        )


def more_uniform(evidence: Evidence) -> Iterator[Finding]:
    """Stress on grooved pillars varies less, over its mean, than on whole ones of their size."""
    whole = scenes_along_x(evidence.stress, 1, SMALLEST)
    for scene in scenes_along_x(evidence.stress, 2):
        if not whole:
            continue
        like = most_like(scene, whole)
        spread = [float(np.nanstd(evidence.stress[s])) for s in (scene, like)]
        yield Finding(
            place(scene),
            "standard deviation of the stress over its mean, minus that on "
            f"n_p = {like.n_p} without grooves",
            exact(spread[0] - spread[1]),
            NEGATIVE,
            _in_prelude(scene, like),
        )


def _parts(evidence: Evidence, scene: Scene) -> Mapping[str, float]:
    """Mean stress on the parts of grooved pillars, over the mean of the surface."""
    pillars = pillar_stress(evidence, scene)
    return {name: float(pillars[:, mask].mean()) for name, mask in grooved_parts(scene).items()}


def external_bear_more(evidence: Evidence) -> Iterator[Finding]:
    """External sides, transverse and longitudinal, bear more than those along the grooves."""
    for scene in scenes_along_x(evidence.stress, 2):
        found = _parts(evidence, scene)
        for name in ("transverse sides", "external longitudinal sides"):
            yield Finding(
                place(scene),
                f"stress on the {name} minus that on the sides along the grooves, {_OVER_MEAN}",
                exact(found[name] - found["sides along the grooves"]),
                POSITIVE,
                _in_prelude(scene),
            )


def edges_bear_more_across(evidence: Evidence) -> Iterator[Finding]:
    """The edges bear more before sliding across the grooves than before sliding along them."""
    for along in scenes_along_x(evidence.stress, 2):
        across = replace(along, direction="y")
        if across not in evidence.stress:
            continue
        edges = edge(along.pattern.contact)
        stress = [float(evidence.stress[scene][edges].mean()) for scene in (across, along)]
        yield Finding(
            place(along),
            f"stress on the edges when sliding across the grooves minus that along, {_OVER_MEAN}",
            exact(stress[0] - stress[1]),
            POSITIVE,
            _in_prelude(across, along),
        )


CLAIMS = (
    Claim(
        "Edges bear more before sliding across grooves",
        "1",
        "The tangential stress on the edges before sliding is larger when the grooves are "
        "perpendicular to the sliding direction. A result of the authors' paper of 2018, for "
        "grooves that cross the whole surface; here they divide pillars.",
        f"{_NEEDS} a grooved surface that slides along and across its grooves",
        edges_bear_more_across,
    ),
    Claim(
        "All pillars bear the same stress",
        "3.2",
        "All the pillars are subject to the same stress distributions for n_p >= 4. Tested: none "
        "differs from the mean pillar by more than a fifth of what places on a pillar differ by.",
        f"{_NEEDS} several pillars with n_p of 4 or more",
        same_stress,
    ),
    Claim(
        "Edges across the sliding direction bear more",
        "3.2",
        "The longitudinal stress exerted on orthogonal edges is larger than in-plane shear stress "
        "along parallel ones.",
        f"{_NEEDS} pillars with n_p of 4 or more",
        larger_across,
    ),
    Claim(
        "Grooves make stress more uniform",
        "3.3",
        "A hierarchical configuration allows to distribute mechanical stresses more uniformly over "
        "the surface.",
        f"{_NEEDS} pillars with grooves and without",
        more_uniform,
    ),
    Claim(
        "External edges bear more than those along grooves",
        "3.3",
        "The external edges of the pillars are subjected to larger longitudinal stresses than the "
        "internal ones along the second-level grooves.",
        f"{_NEEDS} a grooved surface",
        external_bear_more,
    ),
)
