"""Grooved pillars: stress, friction, conditions for two load peaks, and the time between them.

Sections 1, 3.3, 4 and 5 of the paper.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from itertools import chain, product

import numpy as np

from springblock.analysis.estimate import Estimate
from springblock.analysis.statistics import prominence_of_mean
from springblock.io.records import Record
from springblock.model.direction import degrees
from springblock.model.scene import Scene
from springblock.simulation.peaks import PROMINENT, Peaks, both_peaks
from springblock.simulation.run import Run
from springblock.study.claims import rule, samples, surfaces
from springblock.study.claims.rule import Case, Evidence, Finding, tests_statement
from springblock.study.claims.surfaces import across, case_of, grooved, pillars, slid_both_ways
from springblock.theory.elasticity import Layer

_TWO_PEAKS, _ONE_PEAK = (PROMINENT, rule.INF), (-rule.INF, PROMINENT)
_LESSER = "the prominence of the lesser peak of the mean force over its largest value"
Twice = tuple[Record, Peaks]  #: a run with two load peaks
_NARROW = 2  #: largest width of grooves that count as narrow, blocks


@tests_statement
def across_sticks_better(evidence: Evidence) -> Iterator[Finding]:
    name = "static friction across the grooves minus that along them (same seeds)"
    for along in slid_both_ways(evidence.records, 1):
        if along.n_s2 <= _NARROW:
            pair = across(along), along
            yield samples.compared(evidence, name, samples.static_friction, pair)


@tests_statement
def faster_along(evidence: Evidence) -> Iterator[Finding]:
    name = "the duration of the transition, over t_max, along minus across (same seeds)"
    spans = {"a tenth to nine tenths": 0.1, "a quarter to three quarters": 0.25}
    for (span, first), along in product(spans.items(), slid_both_ways(evidence.records, 1)):
        pair, duration = (along, across(along)), partial(samples.lasting, first=first)
        case = case_of(along, part=span)
        yield samples.compared(evidence, name, duration, pair, rule.NEGATIVE, case)


def unevenness(scene: Scene) -> float:
    """Return the standard deviation of the stress before the first detachment over its mean.

    The layer is then in static equilibrium under the pull of the slider, along x; forces follow
    from its linear elasticity and do not depend on the thresholds.
    """
    forces = np.full((2, *scene.shape), np.nan)
    forces[:, scene.contact] = Layer(scene.contact, scene.material).pull.reshape(2, -1)
    forces /= np.nanmean(np.hypot(*forces))
    return float(np.nanstd(np.hypot(*forces)))


@tests_statement
def more_uniform(evidence: Evidence) -> Iterator[Finding]:
    name = "the standard deviation of the stress over its mean, with grooves minus without"
    for scene in grooved(evidence.records):
        plain = replace(scene, n_p2=0, n_s2=0)
        if plain in evidence.records:
            more = unevenness(scene) - unevenness(plain)
            exact = Estimate(more, more, more)
            yield Finding(case_of(scene), name, exact, rule.NEGATIVE, [scene, plain])


def prominent(
    evidence: Evidence,
    scene: Scene,
    claimed: rule.Range,
    statistic: str = _LESSER,
    case: Case | None = None,
    rank: int = 2,
) -> Finding:
    """Return the prominence of the load peak of a rank in the mean force of all realisations."""
    runs = evidence.records[scene]
    value, low, high = map(float, prominence_of_mean(runs, rank))
    found = Estimate(value, low, high, len(runs), bounds=(0.0, 1.0))
    return Finding(case or case_of(scene), statistic, found, claimed, [scene])


@tests_statement
def two_peaks(evidence: Evidence) -> Iterator[Finding]:
    for scene in slid_both_ways(evidence.records):
        yield prominent(evidence, scene, _TWO_PEAKS)


@tests_statement
def only_along(evidence: Evidence) -> Iterator[Finding]:
    along = slid_both_ways(evidence.records)
    turned = [s for s in evidence.records if s not in along and replace(s, direction="x") in along]
    angles = {scene: degrees(scene.direction) for scene in turned}
    for scene, angle in sorted(angles.items(), key=lambda each: (each[1], each[0].n_p2)):
        yield prominent(evidence, scene, _ONE_PEAK, case=case_of(scene, degrees=angle))


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
        case = case_of(along, part="two load peaks, only along")
        ways = ("along", along, _TWO_PEAKS), ("across", across(along), _ONE_PEAK)
        for way, scene, claimed in ways:
            statistic = f"{_LESSER}, when sliding {way} grooves of the second level"
            yield prominent(evidence, scene, claimed, statistic, case)
        case = case_of(along, part="a load peak for every level")
        yield prominent(evidence, along, _TWO_PEAKS, third, case, rank=3)


def twice_peaked(records: rule.Records) -> dict[Scene, list[Twice]]:
    """Return the runs with two load peaks, with these, of scenes where most runs have two.

    Scenes are grooved pillars that slide along their grooves, and were also slid across them.
    """
    found = {
        scene: [(run, peaks) for run in runs if (peaks := both_peaks(run.force[run.onset]))]
        for scene, runs in slid_both_ways(records).items()
    }
    return {s: twice for s, twice in found.items() if len(twice) > 0.5 * len(records[s])}


def rate_between(run: Run, peaks: Peaks) -> float:
    """Return the mean detachment rate from the first peak to the second, 1/s."""
    apart = float(run.time[peaks.second] - run.time[peaks.first])
    return float(run.detachments[peaks.first : peaks.second].sum() / apart)


def over_all(twice: Twice) -> float:
    """Return the rate between the peaks over that from the first detachment to the last."""
    times = twice[0].t_det
    lasting = np.nanmax(times) - np.nanmin(times)
    return rate_between(*twice) / float(np.count_nonzero(np.isfinite(times)) / lasting)


def over_most(twice: Twice) -> float:
    """Return the rate between the peaks over that from a tenth to nine tenths of detachments."""
    run, _ = twice
    detached = 0.8 * np.count_nonzero(np.isfinite(run.t_det))
    return rate_between(*twice) / float(detached / (samples.lasting(run) * run.t_max))


def core_at_rest(twice: Twice) -> float:
    """Return the share of the core not detached at the lowest force between the peaks."""
    run, peaks = twice
    return 1.0 - float(np.mean(run.t_det[surfaces.core(run.contact)] <= run.time[peaks.valley]))


def slips_again(twice: Twice) -> float:
    """Return the further slips between the peaks per block detached at the lowest force."""
    run, peaks = twice
    between = slice(peaks.first, peaks.second)
    repeated = run.switches[between] - run.detachments[between]
    return float(repeated.sum() / np.count_nonzero(run.t_det <= run.time[peaks.valley]))


def stressed(twice: Twice) -> float:
    """Return the lowest force between the peaks over the normal force, minus mean mu_dynamic."""
    run, peaks = twice
    sliding = run.material.mu_dynamic * run.normal_force
    return (float(run.force[peaks.valley]) - sliding) / run.normal_force


_RATE = "the mean rate between the peaks over the mean rate of"
_BY_VALLEY = "by the time of the lowest force between the load peaks"
_AT_REST = f"the share of core blocks not detached {_BY_VALLEY}"
_SLIPS = f"the number of further slips between the load peaks per block detached {_BY_VALLEY}"
_STRESS = "the lowest force between the load peaks over the normal force, minus the mean mu_dynamic"
#: Parts of the statement, each with its statistic, quantity and claimed range.
_PHASE: dict[str, tuple[str, Callable[[Twice], float], rule.Range]] = {
    "quiet beside all": (f"{_RATE} all detachments", over_all, rule.FEWER_THAN_HALF),
    "quiet beside most": (f"{_RATE} the transition", over_most, rule.FEWER_THAN_HALF),
    "the core at rest": (_AT_REST, core_at_rest, rule.NEARLY_ALL),
    "precursors slip again": (_SLIPS, slips_again, rule.MOST),
    "the surface stressed": (_STRESS, stressed, rule.POSITIVE),
}


@tests_statement
def quasi_static_phase(evidence: Evidence) -> Iterator[Finding]:
    scenes = twice_peaked(evidence.records)
    for part, (statistic, quantity, claimed) in _PHASE.items():
        yield from samples.on_each(scenes, statistic, quantity, claimed, part=part)
