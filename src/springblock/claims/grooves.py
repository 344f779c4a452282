"""Grooved pillars: stress, friction and conditions for two load peaks (sections 1, 3.3 and 5)."""

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from itertools import chain, product

import numpy as np

from springblock.analysis.estimate import Estimate
from springblock.analysis.statistics import PROMINENT, bootstrap_interval, prominence
from springblock.claims import ranges, samples
from springblock.claims.rule import Case, Evidence, Finding, Range, tests_statement
from springblock.claims.samples import found_on
from springblock.claims.surfaces import (
    ALONG,
    across,
    case_of,
    grooved,
    in_files,
    pillars,
    slid_both_ways,
    with_and_without_grooves,
)
from springblock.model.direction import degrees
from springblock.model.numbers import Array
from springblock.model.scene import Scene

_TWO_PEAKS, _ONE_PEAK = (PROMINENT, ranges.INF), (-ranges.INF, PROMINENT)
_LESSER = "the prominence of the lesser peak of the mean force over its largest value"
_LASTING = "the duration of the transition"
_NARROW = 2  #: largest width of grooves that count as narrow, blocks


def prominent(
    evidence: Evidence,
    scene: Scene,
    claimed: Range,
    statistic: str = _LESSER,
    case: Case | None = None,
    rank: int = 2,
) -> Finding:
    """Return the prominence of the load peak of a rank in the mean force of all realisations.

    A run that has ended counts with its last force, which lies below its peaks.
    """
    runs = evidence.records[scene]
    longest = max(len(run.force) for run in runs)
    forces = np.stack([np.pad(r.force, (0, longest - len(r.force)), mode="edge") for r in runs])

    def of_mean(weights: Array) -> Array:
        return np.array([prominence(curve, rank) for curve in weights @ forces])

    value, low, high = map(float, bootstrap_interval(of_mean, len(runs)))
    ends = min(low, value), max(high, value)  # fluctuations make the prominence of resamples larger
    found = Estimate(value, *ends, len(runs), bounds=(0.0, 1.0))
    return found_on(scene, statistic, found, claimed, case=case)


@tests_statement
def two_peaks(evidence: Evidence) -> Iterator[Finding]:
    for scene in slid_both_ways(evidence.records):
        yield prominent(evidence, scene, _TWO_PEAKS)


@tests_statement
def only_along(evidence: Evidence) -> Iterator[Finding]:
    along = slid_both_ways(evidence.records)
    scenes = [scene for scene in evidence.records if replace(scene, direction=ALONG) in along]
    for scene in sorted(scenes, key=lambda s: (degrees(s.direction), s.n_p2)):
        if scene.direction != ALONG:
            case = replace(case_of(scene), degrees=degrees(scene.direction))
            yield prominent(evidence, scene, _ONE_PEAK, case=case)


@tests_statement
def hierarchy_needed(evidence: Evidence) -> Iterator[Finding]:
    for scene in chain(pillars(evidence.records), grooved(evidence.records, 1)):
        yield prominent(evidence, scene, _ONE_PEAK)


@tests_statement
def anisotropy_needed(evidence: Evidence) -> Iterator[Finding]:
    for scene in grooved(evidence.records, 3):
        if (scene.n_p2, scene.n_s2) == (scene.n_p3, scene.n_s3):
            yield prominent(evidence, scene, _ONE_PEAK)


@tests_statement
def further_levels(evidence: Evidence) -> Iterator[Finding]:
    third = _LESSER.replace("lesser", "third most prominent")
    for along in slid_both_ways(evidence.records, 3):
        case = replace(case_of(along), part="two load peaks, only along")
        for way, scene, claimed in (
            ("along", along, _TWO_PEAKS),
            ("across", across(along), _ONE_PEAK),
        ):
            statistic = f"{_LESSER}, when sliding {way} grooves of the second level"
            yield prominent(evidence, scene, claimed, statistic, case)
        case = replace(case, part="a load peak for every level")
        yield prominent(evidence, along, _TWO_PEAKS, third, case, rank=3)


@tests_statement
def more_uniform(evidence: Evidence) -> Iterator[Finding]:
    name = "the standard deviation of the stress over its mean, with grooves minus without"
    for pair in with_and_without_grooves(evidence.stress):
        ours, theirs = (float(np.nanstd(np.hypot(*evidence.stress[scene]))) for scene in pair)
        exact, source = ours - theirs, in_files(*pair, folder="surface of")
        found = Estimate(exact, exact, exact)
        yield Finding(case_of(pair[0]), name, found, ranges.NEGATIVE, source)


@tests_statement
def across_sticks_better(evidence: Evidence) -> Iterator[Finding]:
    name = "static friction across the grooves minus that along them (same seeds)"
    for along in slid_both_ways(evidence.records, 1):
        if along.n_s2 <= _NARROW:
            yield samples.compared(evidence, name, samples.static_friction, across(along), along)


@tests_statement
def faster_along(evidence: Evidence) -> Iterator[Finding]:
    name = f"{_LASTING}, over t_max, along minus across (same seeds)"
    spans = {"a tenth to nine tenths": 0.1, "a quarter to three quarters": 0.25}
    for (span, first), along in product(spans.items(), slid_both_ways(evidence.records, 1)):
        case, duration = replace(case_of(along), part=span), partial(samples.lasting, first=first)
        scenes = along, across(along)
        yield samples.compared(evidence, name, duration, *scenes, ranges.NEGATIVE, case)
