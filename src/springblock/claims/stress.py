"""Stress before the first detachment, when nothing random has happened (section 3 of the paper).

A prelude holds the largest tangential force that has pulled at each block so far. There is no
scatter: values are exact, and their intervals have no width.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from springblock.analysis.estimate import Estimate
from springblock.analysis.statistics import pillar_ring
from springblock.claims import ranges
from springblock.claims.grooves import edge, grooved_parts
from springblock.claims.rule import Evidence, Finding, Range, claim
from springblock.claims.samples import SMALLEST, along_x, in_files, pillars_of, place
from springblock.claims.sides import most_like
from springblock.model.scene import Scene
from springblock.simulation.run import Array

_GROOVED = "preludes of a grooved surface"
_BOTH_WAYS = f"{_GROOVED} that slides along and across its grooves"
_PILLARS = "preludes of pillars with n_p of 4 or more"
_SEVERAL = "preludes of several pillars with n_p of 4 or more"
_BOTH_KINDS = "preludes of pillars with grooves and without"
_OVER_MEAN = "over the mean of the surface"


def _exactly(statistic: str, value: float, claimed: Range, *scenes: Scene) -> Finding:
    """Finding without scatter from the preludes of some scenes, the first of which names it."""
    exact = Estimate(float(value), float(value), float(value))
    return Finding(
        place(scenes[0]), statistic, exact, claimed, in_files(*scenes, folder="preludes")
    )


def pillar_stress(evidence: Evidence, scene: Scene) -> Array:
    """Stress on each pillar over the mean of the surface, (pillars, n_p, n_p)."""
    return np.stack(pillars_of(evidence.stress[scene], scene))


@claim("Edges bear more before sliding across grooves", "1", 8, _BOTH_WAYS)
def edges_bear_more_across(evidence: Evidence) -> Iterator[Finding]:
    """The tangential stress on the edges before sliding is larger when the grooves are
    perpendicular to the sliding direction. A result of the authors' paper of 2018, for grooves that
    cross the whole surface; here they divide pillars.
    """
    name = f"stress on the edges when sliding across the grooves minus that along, {_OVER_MEAN}"
    for along in along_x(evidence.stress, 2):
        across = replace(along, direction="y")
        if across in evidence.stress:
            edges = edge(along.pattern.contact)
            more, less = (float(evidence.stress[s][edges].mean()) for s in (across, along))
            yield _exactly(name, more - less, ranges.POSITIVE, across, along)


@claim("All pillars bear the same stress", "3.2", 4, _SEVERAL)
def same_stress(evidence: Evidence) -> Iterator[Finding]:
    """All the pillars are subject to the same stress distributions for n_p >= 4.

    Tested: none differs from the mean pillar by more than a fifth of what places on a pillar differ
    by.
    """
    name = (
        "root mean square of the stress on the pillar most unlike the mean pillar minus that "
        "on the latter, over the standard deviation on it"
    )
    for scene in along_x(evidence.stress, 1, SMALLEST):
        pillars = pillar_stress(evidence, scene)
        if len(pillars) >= 2:
            usual = pillars.mean(axis=0)
            off = np.sqrt(((pillars - usual) ** 2).mean(axis=(1, 2))).max()
            yield _exactly(name, off / usual.std(), ranges.ALIKE, scene)


@claim("Edges across the sliding direction bear more", "3.2", 4, _PILLARS)
def larger_across(evidence: Evidence) -> Iterator[Finding]:
    """The longitudinal stress exerted on orthogonal edges is larger than in-plane shear stress
    along parallel ones.
    """
    name = f"stress on the edges across minus that on the edges along, {_OVER_MEAN}"
    for scene in along_x(evidence.stress, 1, SMALLEST):
        ring = pillar_ring(scene.n_p, 0)
        across, along = (pillar_stress(evidence, scene)[:, ring[side]].mean() for side in "yx")
        yield _exactly(name, across - along, ranges.POSITIVE, scene)


@claim("Grooves make stress more uniform", "3.3", 8, _BOTH_KINDS)
def more_uniform(evidence: Evidence) -> Iterator[Finding]:
    """A hierarchical configuration allows to distribute mechanical stresses more uniformly over the
    surface.
    """
    whole = along_x(evidence.stress, 1, SMALLEST)
    for scene in along_x(evidence.stress, 2) if whole else ():
        like = most_like(scene, whole)
        grooved, plain = (float(np.nanstd(evidence.stress[s])) for s in (scene, like))
        name = f"standard deviation of the stress over its mean, minus that on n_p = {like.n_p}"
        yield _exactly(f"{name} without grooves", grooved - plain, ranges.NEGATIVE, scene, like)


@claim("External edges bear more than those along grooves", "3.3", 8, _GROOVED)
def external_bear_more(evidence: Evidence) -> Iterator[Finding]:
    """The external edges of the pillars are subjected to larger longitudinal stresses than the
    internal ones along the second-level grooves.
    """
    for scene in along_x(evidence.stress, 2):
        pillars = pillar_stress(evidence, scene)
        parts = {n: float(pillars[:, mask].mean()) for n, mask in grooved_parts(scene).items()}
        internal = parts["sides along the grooves"]
        for part in ("transverse sides", "external longitudinal sides"):
            name = f"stress on the {part} minus that on the sides along the grooves, {_OVER_MEAN}"
            yield _exactly(name, parts[part] - internal, ranges.POSITIVE, scene)
