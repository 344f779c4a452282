"""Stress before the first detachment (section 3 of the paper).

The layer is in static equilibrium under the pull of the slider. Forces follow from its linear
elasticity and do not depend on the thresholds, so that their intervals have no width.
"""

from collections.abc import Iterator
from dataclasses import replace
from itertools import chain

import numpy as np

from springblock.analysis.estimate import Estimate
from springblock.analysis.statistics import bootstrap_interval, pillar_map, pillar_ring
from springblock.claims import ranges, surfaces
from springblock.claims.rule import Evidence, Finding, Range
from springblock.claims.samples import found_on
from springblock.claims.surfaces import across, case_of, pillars, pillars_of, slid_both_ways
from springblock.mechanism.elasticity import Layer
from springblock.model.material import Material
from springblock.model.numbers import Array
from springblock.model.scene import Scene

_OVER_MEAN = "over the mean stress"
_DIGITS = 9  #: to which equal stresses agree


def elastic_forces(scene: Scene, material: Material) -> Array:
    """Return the tangential force on each block before the first detachment, (2, N_y, N_x).

    Components along the sliding direction, x or y, and across it, over the mean of the modulus;
    NaN off contact.
    """
    contact = scene.contact if scene.direction == "x" else scene.contact.T
    forces = np.full((2, *contact.shape), np.nan)
    forces[:, contact] = Layer(contact, material).pull.reshape(2, -1)
    forces /= np.nanmean(np.hypot(*forces))
    return forces if scene.direction == "x" else forces.transpose(0, 2, 1)


def _exactly(statistic: str, value: float, claimed: Range, *scenes: Scene) -> Finding:
    """Return a finding without scatter on some surfaces; the lengths of the first are its case."""
    exact, case = Estimate(float(value), float(value), float(value)), case_of(scenes[0])
    return Finding(case, statistic, exact, claimed, surfaces.in_files(*scenes, folder="surface of"))


def _modulus(evidence: Evidence, scene: Scene) -> Array:
    return np.hypot(*evidence.stress[scene])


def _pillar_stress(evidence: Evidence, scene: Scene) -> Array:
    """Return the modulus of the stress on each pillar over the mean, (pillars, n_p, n_p)."""
    return np.stack(pillars_of(_modulus(evidence, scene), scene))


def _along(evidence: Evidence, scene: Scene) -> Array:
    """Return the stress along the sliding direction on the mean pillar, (n_p, n_p)."""
    return np.mean(pillars_of(evidence.stress[scene][0], scene), axis=0)


def edges_bear_more_across(evidence: Evidence) -> Iterator[Finding]:
    name = f"the edge stress when sliding across the grooves minus that along them, {_OVER_MEAN}"
    for along in chain(*(slid_both_ways(evidence.stress, level) for level in (1, 2))):
        scenes, edges = (across(along), along), surfaces.edge(along.pattern.contact)
        more, less = (float(_modulus(evidence, s)[edges].mean()) for s in scenes)
        yield _exactly(name, more - less, ranges.POSITIVE, *scenes)


def trivial_stress(evidence: Evidence) -> Iterator[Finding]:
    name = "the standard deviation of the stress over its mean"
    for scene in (s for s in pillars(evidence.stress, 2) if s.n_p < surfaces.SMALLEST):
        deviation = float(np.nanstd(_modulus(evidence, scene)))
        yield _exactly(name, deviation, ranges.NEGLIGIBLE, scene)


def same_stress(evidence: Evidence) -> Iterator[Finding]:
    largest = "the largest rms deviation of a pillar's stress from the mean pillar's"
    name = f"{largest}, over the latter's standard deviation"
    for scene in pillars(evidence.stress):
        stresses = _pillar_stress(evidence, scene)
        if len(stresses) >= 2:
            usual = stresses.mean(axis=0)
            off = np.sqrt(((stresses - usual) ** 2).mean(axis=(1, 2))).max()
            yield _exactly(name, off / usual.std(), ranges.ALIKE, scene)


def larger_across(evidence: Evidence) -> Iterator[Finding]:
    edges = "edges across the sliding direction minus that on edges along it"
    name = f"the stress on {edges}, {_OVER_MEAN}"
    for scene in pillars(evidence.stress):
        ring, forces = pillar_ring(scene.n_p, 0), _along(evidence, scene)
        more = forces[ring["y"]].mean() - forces[ring["x"]].mean()
        yield _exactly(name, more, ranges.POSITIVE, scene)


def rank_correlation(field: Array, maps: Array) -> Estimate:
    """Return Spearman's correlation of a field, (n,), with the mean of k maps, (k, n); BCa.

    It is divided by the largest value that ties in the field allow: blocks inside a pillar bear
    equal loads.
    """
    from scipy.stats import rankdata  # slow to load

    def of_mean(weights: Array) -> Array:
        ranks = rankdata(weights @ maps, axis=1)
        ranks -= ranks.mean(axis=1, keepdims=True)
        return ranks @ own / np.sqrt((ranks**2).sum(axis=1) * square)

    own = rankdata(np.round(field, _DIGITS))
    own -= own.mean()
    square, order = own @ own, np.arange(len(own)) - (len(own) - 1) / 2.0
    own *= np.sqrt(square * (order @ order)) / (np.sort(own) @ order)
    return Estimate.of(bootstrap_interval(of_mean, len(maps)), len(maps))


def order_of_stress(evidence: Evidence) -> Iterator[Finding]:
    name = (
        "the rank correlation of initial stress and mean t_det on a pillar, over its largest "
        "possible magnitude"
    )
    for scene, runs in pillars(evidence.records).items():
        if scene in evidence.stress:
            stress = _pillar_stress(evidence, scene).mean(axis=0).ravel()
            maps = pillar_map(runs, scene.pattern).reshape(len(runs), -1)
            found = rank_correlation(stress, maps)
            yield found_on(scene, name, found, (-ranges.INF, -0.5))


def more_uniform(evidence: Evidence) -> Iterator[Finding]:
    name = "the standard deviation of the stress over its mean, with grooves minus without"
    for scene in surfaces.grooved(evidence.stress):
        plain = replace(scene, n_p2=0, n_s2=0)
        if plain in evidence.stress:
            ours, theirs = (float(np.nanstd(_modulus(evidence, s))) for s in (scene, plain))
            yield _exactly(name, ours - theirs, ranges.NEGATIVE, scene, plain)


def external_bear_more(evidence: Evidence) -> Iterator[Finding]:
    for scene in slid_both_ways(evidence.stress):
        forces = _along(evidence, scene)
        parts = {n: float(forces[mask].mean()) for n, mask in surfaces.grooved_parts(scene).items()}
        internal = parts["sides along the grooves"]
        for part in ("transverse sides", "external longitudinal sides"):
            name = f"the stress on the {part} minus that on sides along grooves, {_OVER_MEAN}"
            yield _exactly(name, parts[part] - internal, ranges.POSITIVE, scene)


def equal_parts(evidence: Evidence) -> Iterator[Finding]:
    name = "the share of the contact blocks that belong to the edge"
    for scene in slid_both_ways(evidence.stress):
        share = surfaces.edge(scene.contact).sum() / scene.contact.sum()
        yield _exactly(name, share, (0.4, 0.6), scene)
