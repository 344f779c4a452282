"""Grooved pillars: two length scales, two load peaks (section 3.3 of the paper).

Times are taken over t_avg: where two load peaks are about as high, t_max is that of the one or of
the other, and a share of it would mix two populations.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import partial
from itertools import groupby
from operator import attrgetter

import numpy as np

from springblock.analysis.estimate import UNKNOWN, Estimate
from springblock.analysis.statistics import (
    bootstrap_interval,
    cut,
    lesser_prominence,
    load_peaks,
    pillar_map,
    samples_interval,
)
from springblock.claims import ranges
from springblock.claims.rule import Case, Evidence, Finding, Range, claim
from springblock.claims.samples import (
    ALONG,
    SMALLEST,
    Mask,
    along_x,
    compared,
    found_on,
    in_files,
    in_order,
    magnitude,
    mean,
    over_runs,
    pillars_of,
    place,
    proportion,
    rates,
    relative,
    static_friction,
)
from springblock.io.records import Record
from springblock.model.direction import degrees
from springblock.model.scene import Scene
from springblock.simulation.run import Array, Run, friction

_STANDS_OUT = 0.01  #: prominence of a load peak over the largest force, as in figure 9
_TWO_PEAKS, _ONE_PEAK = (_STANDS_OUT, ranges.INF), (-ranges.INF, _STANDS_OUT)
_AT_VALLEY = "at the lowest force between the load peaks"
_BURST = 0.02  #: of t_avg, over which detachments are counted
_EQUAL = (0.4, 0.6)  #: share of either of two parts of about equal size
_FEWEST = 3  #: surfaces that a trend needs
_MANIPULATED = (0.01, ranges.INF)  #: change over static friction
_ALONG_X = "surfaces with grooves of several lengths along the sliding direction"
_WAYS_OF_SLIDING = ("along", "across")
_GROOVES = "realisations of a grooved surface"
_NO_HIERARCHY = "realisations of pillars with n_p of 4 or more, or of grooves without pillars"
_PEAKS = f"{_GROOVES} with two load peaks"
_WAYS = "realisations of a grooved surface that slides along and across its grooves"


def edge(contact: Mask) -> Mask:
    """Contact blocks beside a block, in one of the four directions, that is not in contact."""
    padded = np.pad(contact, 1)
    inside = padded[2:, 1:-1] & padded[:-2, 1:-1] & padded[1:-1, 2:] & padded[1:-1, :-2]
    return contact & ~inside


def core(contact: Mask) -> Mask:
    """Contact blocks that are not of the edge."""
    return contact & ~edge(contact)


def slid_both_ways(evidence: Evidence, scenes: Iterable[Scene]) -> list[tuple[Scene, Scene]]:
    """Grooved surfaces that were slid both along the grooves and across, both scenes of each.

    Those that look the same from both sides are left out: they have no along and across.
    """
    pairs = []
    for along in scenes:
        across, contact = replace(along, direction="y"), along.pattern.contact
        if across in evidence.records and not np.array_equal(contact, contact.T):
            pairs.append((along, across))
    return pairs


def bare_grooves(evidence: Evidence) -> list[Scene]:
    """Surfaces grooved from edge to edge, without pillars, that slide along the grooves."""
    found = [s for s in evidence.records if s.n_p2 and not s.n_p and s.direction == ALONG]
    return sorted(found, key=lambda s: (s.n_blocks, s.n_p2, s.n_s2))


def prominence_of_mean(curves: Array) -> Estimate:
    """Prominence of the lesser load peak of the mean of k force curves, (k, n); BCa."""

    def lesser(weights: Array) -> Array:
        return np.array([lesser_prominence(curve) for curve in weights @ curves])

    return Estimate.of(bootstrap_interval(lesser, len(curves)), len(curves))


def _prominences(
    evidence: Evidence, scene: Scene, claimed: Range, **more: str | float
) -> Iterator[Finding]:
    """Prominence of the lesser load peak: mean over realisations, and of their mean force."""
    runs = evidence.records[scene]
    name = "prominence of the lesser load peak over the largest force"
    single = mean(over_runs(lambda run: lesser_prominence(run.force), runs))
    yield found_on(scene, f"{name}, mean over realisations", single, claimed, **more)
    _, curves = cut(runs, [friction(run) for run in runs])
    common = prominence_of_mean(curves)
    yield found_on(scene, f"{name}, of the mean force", common, claimed, **more)


@claim("Two load peaks only along grooves", "3.3", 9, _WAYS)
def two_peaks(evidence: Evidence) -> Iterator[Finding]:
    """The two load peaks appear only if the second level grooves are aligned with the sliding
    direction.

    Tested: the lesser peak stands out by more than 1 % of the largest force along the grooves, and
    by less at any angle to them.
    """
    for along, _ in slid_both_ways(evidence, along_x(evidence.records, 2)):
        ways = [s for s in evidence.records if replace(s, direction="x") == along]
        for scene in sorted(ways, key=lambda s: degrees(s.direction)):
            claimed = _TWO_PEAKS if scene == along else _ONE_PEAK
            case = {"degrees from the grooves": degrees(scene.direction)}
            yield from _prominences(evidence, scene, claimed, **case)


def both_peaks(run: Run) -> tuple[int, int] | None:
    """Samples of the two most prominent load peaks, the earlier first; None with less than two."""
    from scipy.signal import peak_prominences  # slow to load

    peaks = load_peaks(run.force, 0.0)
    if len(peaks) < 2:
        return None
    prominences, *_ = peak_prominences(run.force, peaks)
    first, second = sorted(peaks[np.argsort(prominences)[-2:]])
    return int(first), int(second)


def valley(run: Run, first: int, second: int) -> int:
    """Sample of the lowest force between two load peaks."""
    return first + int(np.argmin(run.force[first:second]))


QuantityOfPeaks = Callable[[Record, int, int], float]  #: of a run and the samples of its load peaks


def with_both_peaks(evidence: Evidence, quantity: QuantityOfPeaks) -> Iterator[tuple[Scene, Array]]:
    """A quantity of the runs along grooves that have two load peaks, (k,), where most runs have."""
    for scene, runs in along_x(evidence.records, 2).items():
        found = [(run, peaks) for run in runs if (peaks := both_peaks(run))]
        sample = np.array([quantity(run, *peaks) for run, peaks in found])
        sample = sample[np.isfinite(sample)]
        if len(sample) > 0.5 * len(runs):
            yield scene, sample


def _means(
    evidence: Evidence, name: str, quantity: QuantityOfPeaks, claimed: Range
) -> Iterator[Finding]:
    for scene, sample in with_both_peaks(evidence, quantity):
        statistic = f"{name}, in the {len(sample)} runs that have both"
        yield found_on(scene, statistic, mean(sample), claimed)


def second_peak(run: Run, first: int, second: int) -> float:
    """Force at the second load peak minus that at the first, over P l² N²."""
    return float(run.force[second] - run.force[first]) / run.normal_force


@claim("The second load peak sets static friction", "3.3", 9, _PEAKS)
def second_peak_decides(evidence: Evidence) -> Iterator[Finding]:
    """The global static friction is determined by the force reached at the second load peak.

    Tested: it is the higher one on average, and in most realisations.
    """
    name = "force at the second load peak minus that at the first, over the normal force"
    yield from _means(evidence, name, second_peak, ranges.POSITIVE)
    for scene, sample in with_both_peaks(evidence, second_peak):
        statistic = f"share of the {len(sample)} runs in which the second load peak is higher"
        yield found_on(scene, statistic, proportion(sample > 0.0), ranges.MOST)


def quiet_rate(run: Run, first: int, second: int) -> float:
    """Least rate of detachments between the load peaks over their mean rate in the run."""
    width = _BURST * run.t_avg
    lasting = np.nanmax(run.t_det) - np.nanmin(run.t_det)
    mean_rate = np.count_nonzero(np.isfinite(run.t_det)) * width / lasting
    return float(rates(run, width)[first:second].min() / mean_rate)


@claim("A quiet phase between the load peaks", "3.3", 9, _PEAKS)
def quiet_between_peaks(evidence: Evidence) -> Iterator[Finding]:
    """The transition is characterized by two load peaks separated by an intermediate quasi-static
    phase.

    Tested: detachments fall below half of their mean rate.
    """
    name = "least rate of detachments between the load peaks, within 2 % of t_avg, over the mean"
    return _means(evidence, name, quiet_rate, ranges.FEWER_THAN_HALF)


def share_detached(run: Record, first: int, second: int, blocks: Callable[[Mask], Mask]) -> float:
    """Share of some contact blocks that have detached at the lowest force between load peaks."""
    lowest = run.time[valley(run, first, second)]
    return float(np.mean(run.t_det[blocks(run.scene.contact)] <= lowest))  # NaN: never


@claim("The edges make the first load peak", "3.3", 9, _PEAKS)
def edges_make_first_peak(evidence: Evidence) -> Iterator[Finding]:
    """Slip precursors lead to a faster detachment of the boundary regions and, consequently, to the
    first load peak.

    Tested: more than nine tenths of the edges have detached between the peaks.
    """
    name = f"share of the edges detached {_AT_VALLEY}"
    return _means(evidence, name, partial(share_detached, blocks=edge), ranges.NEARLY_ALL)


@claim("Edges and core are of equal size", "3.3", 9, _PEAKS)
def equal_parts(evidence: Evidence) -> Iterator[Finding]:
    """The geometry divides the contact surface into two parts of equal size with distinct dynamics.

    Tested: four to six tenths have detached between the load peaks.
    """
    name = f"share of the contact blocks detached {_AT_VALLEY}"
    return _means(evidence, name, partial(share_detached, blocks=lambda contact: contact), _EQUAL)


@claim("The core rests between the load peaks", "4", 9, _PEAKS)
def rest_between_peaks(evidence: Evidence) -> Iterator[Finding]:
    """In the phase between load peaks the internal regions are still at rest.

    Tested: more than nine tenths of the blocks off the edges.
    """
    name = f"share of the blocks off the edges yet to detach {_AT_VALLEY}"

    def at_rest(run: Record, first: int, second: int) -> float:
        return 1.0 - share_detached(run, first, second, core)

    return _means(evidence, name, at_rest, ranges.NEARLY_ALL)


def slips_again(run: Run, first: int, second: int) -> float:
    """Slips after the first, between the load peaks, of each block detached before their end."""
    repeated = run.switches[first:second] - run.detachments[first:second]
    lowest = run.time[valley(run, first, second)]
    return float(repeated.sum() / np.count_nonzero(run.t_det <= lowest))


@claim("What has detached slips again between the load peaks", "4", 9, _PEAKS)
def stick_slip(evidence: Evidence) -> Iterator[Finding]:
    """The regions involved by precursor events undergo a stick-slip motion after the first
    detachment.

    Tested: a further slip for every second of their blocks, or more.
    """
    name = "further slips between the load peaks per block detached at the lowest force"
    return _means(evidence, name, slips_again, ranges.MOST)


@claim("Without hierarchy one load peak", "3.3", 9, _NO_HIERARCHY)
def hierarchy_needed(evidence: Evidence) -> Iterator[Finding]:
    """Two load peaks need the concurrent presence of multiple length scales: hierarchy is
    necessary.

    Tested: on pillars without grooves, and on grooves without pillars, a lesser peak stands out by
    less than 1 % of the largest force.
    """
    for scene in (*along_x(evidence.records, 1, SMALLEST), *bare_grooves(evidence)):
        yield from _prominences(evidence, scene, _ONE_PEAK)


@claim("Edges detach before the core of grooved pillars", "3.3", 9, _WAYS)
def edges_before_core(evidence: Evidence) -> Iterator[Finding]:
    """Edge regions and internal core have distinct dynamics; the boundary regions detach first."""
    name = "t_det/t_avg of the core minus that of the edges"
    for scenes in slid_both_ways(evidence, along_x(evidence.records, 2)):
        for scene, way in zip(scenes, _WAYS_OF_SLIDING, strict=True):
            inside, edges = core(scene.contact), edge(scene.contact)
            later = [
                (run.t_det[inside].mean() - run.t_det[edges].mean()) / run.t_avg
                for run in evidence.records[scene]
            ]
            yield found_on(scene, name, mean(later), ranges.POSITIVE, sliding=f"{way} the grooves")


def grooved_parts(scene: Scene) -> dict[str, Mask]:
    """Masks over a grooved pillar, [y_p, x_p], of its parts in the order of the paper."""
    contact, size = pillars_of(scene.contact, scene)[0], scene.n_p
    rows, columns = np.indices(contact.shape)
    transverse = contact & ((columns == 0) | (columns == size - 1))
    external = contact & ~transverse & ((rows == 0) | (rows == size - 1))
    internal = edge(contact) & ~transverse & ~external
    return {
        "transverse sides": transverse,
        "external longitudinal sides": external,
        "sides along the grooves": internal,
        "inside of the pawls": core(contact),
    }


@claim("Order of detachment on a grooved pillar", "3.3", 8, _GROOVES)
def grooved_order(evidence: Evidence) -> Iterator[Finding]:
    """Transversal sides detach first, then the external longitudinal ones, then the internal ones
    along the grooves, then the internal regions of the pawls.
    """
    for scene, runs in along_x(evidence.records, 2).items():
        scale = np.array([run.t_max / run.t_avg for run in runs])
        times = pillar_map(runs, scene.pattern) * scale[:, None, None]
        parts = {name: times[:, mask].mean(axis=1) for name, mask in grooved_parts(scene).items()}
        yield from in_order(scene, parts, "t_avg")


@claim("The effects remain with a further level", "3.3", 9, f"{_WAYS}, with a third level")
def further_levels(evidence: Evidence) -> Iterator[Finding]:
    """We expect that these effects remain present when adding further hierarchical levels.

    Tested: the lesser of two load peaks stands out by more than 1 % along grooves, and by less
    across.
    """
    for scenes in slid_both_ways(evidence, along_x(evidence.records, 3)):
        claims = zip(scenes, _WAYS_OF_SLIDING, (_TWO_PEAKS, _ONE_PEAK), strict=True)
        for scene, way, claimed in claims:
            yield from _prominences(evidence, scene, claimed, sliding=f"{way} the grooves")


@claim("Static friction is greater across grooves than along", "1", 9, _WAYS)
def across_sticks_better(evidence: Evidence) -> Iterator[Finding]:
    """Static friction is greater when the grooves are perpendicular to the sliding direction. A
    result of the authors' paper of 2018, J. Mech. Phys. Solids 112, 50 (arXiv:1706.08055), for
    grooves that cross the whole surface, n_p2 and n_s2 alone here.
    """
    name = "static friction across the grooves minus that along them"
    scenes = *bare_grooves(evidence), *along_x(evidence.records, 2)
    for along, across in slid_both_ways(evidence, scenes):
        yield compared(evidence, place(along), name, static_friction, across, along)


def peak_interval(run: Run, first: int, second: int) -> float:
    """Time from the first load peak to the second over t_avg."""
    return float(run.time[second] - run.time[first]) / run.t_avg


def trend(x: Array, samples: list[Array], statistic: str) -> Estimate:
    """The "slope" of a line through means of samples, or the share of variance it explains; BCa.

    Samples are drawn from anew, each for itself. NaN where one of them is a single number.
    """

    def of_means(*parts: Array, axis: int = -1) -> Array:
        means = np.stack([part.mean(axis=axis) for part in parts], axis=-1)
        places, values = x - x.mean(), means - means.mean(axis=-1, keepdims=True)
        slope = values @ places / (places @ places)
        if statistic == "slope":
            return slope
        return slope**2 * (places @ places) / (values**2).sum(axis=-1)

    fewest = min(map(len, samples))
    return Estimate.of(samples_interval(samples, of_means), fewest) if fewest >= 2 else UNKNOWN


@claim("The lengths control the interval between the load peaks", "3.3", 9, f"three {_ALONG_X}")
def interval_follows_lengths(evidence: Evidence) -> Iterator[Finding]:
    """The time interval between the first and the second peak is controlled by the difference
    between the length scales.

    Tested: it grows with n_p - n_p2, which explains most of its variance, on surfaces where most
    runs have two peaks.
    """
    found = dict(with_both_peaks(evidence, peak_interval))
    x = np.array([float(scene.n_p - scene.n_p2) for scene in found])
    if len(set(x)) < _FEWEST:
        return
    time, samples = "time between the load peaks", list(found.values())
    slope = f"change of the {time} over t_avg with n_p - n_p2"
    control = (
        f"share of the variance of the {time}, of surface means, that a line in n_p - n_p2 explains"
    )
    for statistic, name, claimed, unit in (
        ("slope", slope, ranges.POSITIVE, "1/block"),
        ("control", control, ranges.MOST, "1"),
    ):
        case: Case = {"surfaces": len(found), "looked at": statistic}
        found_trend = trend(x, samples, statistic)
        yield Finding(case, name, found_trend, claimed, in_files(*found), unit)


@claim("The length of pillars changes static friction", "3.3", 9, f"two {_ALONG_X}")
def pillar_length_matters(evidence: Evidence) -> Iterator[Finding]:
    """The global static friction can be manipulated by modifying the pillar length.

    Tested: it changes by more than 1 % from the shortest to the longest pillars.
    """
    scenes = sorted(along_x(evidence.records, 2), key=lambda s: (s.n_p2, s.n_s2, s.n_p))
    for (n_p2, n_s2), group in groupby(scenes, key=attrgetter("n_p2", "n_s2")):
        alike = list({scene.n_p: scene for scene in group}.values())
        if len(alike) < 2:
            continue
        shortest, longest = alike[0], alike[-1]
        last, first = (over_runs(static_friction, evidence.records[s]) for s in (longest, shortest))
        yield Finding(
            {"n_p2": n_p2, "n_s2": n_s2},
            f"change of static friction from n_p = {shortest.n_p} to {longest.n_p}, over the first",
            magnitude(relative(last, first, first)),
            _MANIPULATED,
            in_files(shortest, longest),
        )
