"""Grooved pillars: conditions for two load peaks (section 3.3 of the paper).

t_det is divided by t_avg: where two load peaks are about equally high, t_max belongs to either, and
t_det/t_max would mix two populations.
"""

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from itertools import chain, groupby, product
from operator import attrgetter

import numpy as np

from springblock.analysis.statistics import PROMINENT, pillar_map, prominence
from springblock.claims import ranges, samples, surfaces
from springblock.claims.rule import Case, Evidence, Finding, Range
from springblock.claims.samples import found_on
from springblock.claims.surfaces import ALONG, across, case_of, grooved, pillars, slid_both_ways
from springblock.model.direction import degrees
from springblock.model.scene import Scene

_TWO_PEAKS, _ONE_PEAK = (PROMINENT, ranges.INF), (-ranges.INF, PROMINENT)
_LESSER = "the prominence of the lesser peak over the largest force"
_LASTING = "the duration of the transition"
_NARROW = 2  #: largest width of grooves that count as narrow, blocks


def prominent(
    evidence: Evidence,
    scene: Scene,
    claimed: Range,
    case: Case | None = None,
    statistic: str = _LESSER,
    rank: int = 2,
) -> Finding:
    """Return the mean prominence of the load peak of a rank over the largest force."""
    found = samples.share([prominence(run.force, rank) for run in evidence.records[scene]])
    return found_on(scene, statistic, found, claimed, case=case)


def two_peaks(evidence: Evidence) -> Iterator[Finding]:
    for scene in slid_both_ways(evidence.records):
        yield prominent(evidence, scene, _TWO_PEAKS)


def only_along(evidence: Evidence) -> Iterator[Finding]:
    along = slid_both_ways(evidence.records)
    scenes = [scene for scene in evidence.records if replace(scene, direction=ALONG) in along]
    for scene in sorted(scenes, key=lambda s: (degrees(s.direction), s.n_p2)):
        if scene.direction != ALONG:
            case = replace(case_of(scene), degrees=degrees(scene.direction))
            yield prominent(evidence, scene, _ONE_PEAK, case)


def hierarchy_needed(evidence: Evidence) -> Iterator[Finding]:
    for scene in chain(pillars(evidence.records), grooved(evidence.records, 1)):
        yield prominent(evidence, scene, _ONE_PEAK)


def anisotropy_needed(evidence: Evidence) -> Iterator[Finding]:
    for scene in grooved(evidence.records, 3):
        if (scene.n_p2, scene.n_s2) == (scene.n_p3, scene.n_s3):
            yield prominent(evidence, scene, _ONE_PEAK)


def edges_before_core(evidence: Evidence) -> Iterator[Finding]:
    name = "t_det/t_avg of the core minus that of the edges"
    for along in slid_both_ways(evidence.records):
        inside, edges = surfaces.core(along.contact), surfaces.edge(along.contact)
        for scene in (along, across(along)):
            later = [
                (run.t_det[inside].mean() - run.t_det[edges].mean()) / run.t_avg
                for run in evidence.records[scene]
            ]
            case = replace(case_of(scene), degrees=degrees(scene.direction))
            yield found_on(scene, name, samples.mean(later), ranges.POSITIVE, case=case)


def grooved_order(evidence: Evidence) -> Iterator[Finding]:
    for scene, runs in slid_both_ways(evidence.records).items():
        scale = np.array([run.t_max / run.t_avg for run in runs])
        times = pillar_map(runs, scene.pattern) * scale[:, None, None]
        masks = surfaces.grooved_parts(scene)
        parts = {name: times[:, mask].mean(axis=1) for name, mask in masks.items()}
        yield from samples.in_order(scene, parts, "t_avg")


def further_levels(evidence: Evidence) -> Iterator[Finding]:
    for along in slid_both_ways(evidence.records, 3):
        both = ("along", along, _TWO_PEAKS), ("across", across(along), _ONE_PEAK)
        for way, scene, claimed in both:
            statistic = f"{_LESSER}, when sliding {way} grooves of the second level"
            yield prominent(evidence, scene, claimed, statistic=statistic)


def peak_for_every_level(evidence: Evidence) -> Iterator[Finding]:
    name = "the prominence of the third most prominent peak over the largest force"
    for scene in slid_both_ways(evidence.records, 3):
        yield prominent(evidence, scene, _TWO_PEAKS, statistic=name, rank=3)


def rapid_but_smooth(evidence: Evidence) -> Iterator[Finding]:
    smooth = ("the width of the force peak", samples.width, ranges.POSITIVE)
    rapid = (_LASTING, samples.lasting, ranges.NEGATIVE)
    for scene in slid_both_ways(evidence.records):
        plain = replace(scene, n_p2=0, n_s2=0)
        for name, quantity, claimed in (smooth, rapid) if plain in evidence.records else ():
            statistic = f"{name}, over t_max, with grooves minus without"
            yield samples.compared(evidence, statistic, quantity, scene, plain, claimed)


def across_sticks_better(evidence: Evidence) -> Iterator[Finding]:
    name = "static friction across the grooves minus that along them (same seeds)"
    for along in slid_both_ways(evidence.records, 1):
        if along.n_s2 <= _NARROW:
            yield samples.compared(evidence, name, samples.static_friction, across(along), along)


def faster_along(evidence: Evidence) -> Iterator[Finding]:
    name = f"{_LASTING}, over t_max, along minus across (same seeds)"
    spans = {"a tenth to nine tenths": 0.1, "a quarter to three quarters": 0.25}
    for (span, first), along in product(spans.items(), slid_both_ways(evidence.records, 1)):
        case, duration = replace(case_of(along), part=span), partial(samples.lasting, first=first)
        scenes = along, across(along)
        yield samples.compared(evidence, name, duration, *scenes, ranges.NEGATIVE, case)


def pillar_length_matters(evidence: Evidence) -> Iterator[Finding]:
    scenes = sorted(grooved(evidence.records), key=lambda s: (s.n_p2, s.n_p))
    for _, group in groupby(scenes, key=attrgetter("n_p2")):
        shortest, *_, longest = [*group] * 2
        if shortest.n_p == longest.n_p:
            continue
        first, last = (samples.friction(evidence, scene) for scene in (shortest, longest))
        change = samples.magnitude(samples.relative(last, first, first))
        sizes = f"from n_p = {shortest.n_p} to {longest.n_p}"
        name = f"the magnitude of the relative change of static friction {sizes}"
        yield found_on(shortest, name, change, (0.01, ranges.INF), beside=[longest])
