"""Grooved pillars: two length scales, two load peaks (section 3.3 of the paper).

Times are taken over t_avg: where two load peaks are about as high, t_max is that of the one or of
the other, and a share of it would mix two populations.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from operator import attrgetter

import numpy as np

from springblock.analysis.statistics import (
    bootstrap_interval,
    common_curve,
    lesser_prominence,
    load_peaks,
    pillar_map,
)
from springblock.claims.rule import Case, Claim, Estimate, Evidence, Finding, Range
from springblock.claims.samples import (
    ALONG,
    INF,
    MOST,
    NEARLY_ALL,
    POSITIVE,
    SMALLEST,
    Mask,
    difference,
    in_files,
    in_order,
    mean,
    over_runs,
    place,
    rates,
    scenes_along_x,
    share,
)
from springblock.io.records import Record
from springblock.model.scene import Scene
from springblock.simulation.run import Array, Run

_STANDS_OUT = 0.01  #: prominence of a load peak over the largest force, as in figure 9
_BURST = 0.02  #: of t_avg, over which detachments are counted
_EQUAL = (0.4, 0.6)  #: share of either of two parts of about equal size
_WAYS_OF_SLIDING = ("along", "across")
_GROOVES = "realisations of a grooved surface"
_WAYS = "realisations of a grooved surface that slides along and across its grooves"


def both_peaks(run: Run) -> tuple[int, int] | None:
    """Samples of the two most prominent load peaks, the earlier first; None with less than two."""
    from scipy.signal import peak_prominences  # slow to load

    peaks = load_peaks(run.force, 0.0)
    if len(peaks) < 2:
        return None
    prominences, *_ = peak_prominences(run.force, peaks)
    first, second = sorted(peaks[np.argsort(prominences)[-2:]])
    return int(first), int(second)


def valley(run: Run) -> int | None:
    """Sample of the lowest force between the load peaks; None without two of them."""
    peaks = both_peaks(run)
    return peaks and peaks[0] + int(np.argmin(run.force[peaks[0] : peaks[1]]))


def second_peak(run: Run) -> float:
    """Force at the second load peak minus that at the first, over P l² N²; NaN without."""
    peaks = both_peaks(run)
    if peaks is None:
        return float("nan")
    return float(run.force[peaks[1]] - run.force[peaks[0]]) / run.normal_force


def detached_between(run: Run, blocks: Mask) -> float:
    """Share of some blocks that have detached at the lowest force between load peaks."""
    lowest = valley(run)
    if lowest is None:
        return float("nan")
    return float(np.mean(run.t_det[blocks] <= run.time[lowest]))  # NaN: never


def resting_core(run: Record) -> float:
    """Share of the blocks off the edges yet to detach at the lowest force between load peaks."""
    contact = run.scene.contact
    return 1.0 - detached_between(run, contact & ~edge(contact))


def quiet_rate(run: Run) -> float:
    """Least rate of detachments between the load peaks over their mean rate in the run."""
    peaks = both_peaks(run)
    if peaks is None:
        return float("nan")
    width = _BURST * run.t_avg
    lasting = np.nanmax(run.t_det) - np.nanmin(run.t_det)
    mean_rate = np.count_nonzero(np.isfinite(run.t_det)) * width / lasting
    return float(rates(run, width)[peaks[0] : peaks[1]].min() / mean_rate)


def slips_again(run: Run) -> float:
    """Slips after the first, between the load peaks, of each block detached before their end."""
    peaks, lowest = both_peaks(run), valley(run)
    if peaks is None or lowest is None:
        return float("nan")
    repeated = run.switches[peaks[0] : peaks[1]] - run.detachments[peaks[0] : peaks[1]]
    return float(repeated.sum() / np.count_nonzero(run.t_det <= run.time[lowest]))


def edge(contact: Mask) -> Mask:
    """Contact blocks beside a block, in one of the four directions, that is not in contact."""
    padded = np.pad(contact, 1)
    inside = padded[2:, 1:-1] & padded[:-2, 1:-1] & padded[1:-1, 2:] & padded[1:-1, :-2]
    return contact & ~inside


def grooved_parts(scene: Scene) -> dict[str, Mask]:
    """Masks over a grooved pillar, [y_p, x_p], of its parts in the order of the paper."""
    (y, x), size = scene.pattern.origins[0], scene.n_p
    contact = scene.contact[y : y + size, x : x + size]
    edges, (rows, columns) = edge(contact), np.indices(contact.shape)
    transverse = contact & ((columns == 0) | (columns == size - 1))
    external = contact & ~transverse & ((rows == 0) | (rows == size - 1))
    internal = edges & ~transverse & ~external
    return {
        "transverse sides": transverse,
        "external longitudinal sides": external,
        "sides along the grooves": internal,
        "inside of the pawls": contact & ~edges,
    }


def slid_both_ways(
    evidence: Evidence, scenes: Iterable[Scene] | None = None
) -> list[tuple[dict[str, int | str], Scene, Scene]]:
    """Grooved surfaces that were slid both along and across: lengths and both scenes.

    Those that look the same from both sides are left out: they have no along and across.
    """
    pairs = []
    for along in scenes_along_x(evidence.records, 2) if scenes is None else scenes:
        across, contact = replace(along, direction="y"), along.pattern.contact
        if across in evidence.records and not np.array_equal(contact, contact.T):
            pairs.append((place(along), along, across))
    return pairs


def prominence_of_mean(curves: Array) -> Estimate:
    """Prominence of the lesser load peak of the mean of k force curves, (k, n); BCa."""

    def lesser(weights: Array) -> Array:
        return np.array([lesser_prominence(curve) for curve in weights @ curves])

    return Estimate.of(bootstrap_interval(lesser, len(curves)), len(curves))


def _prominences(evidence: Evidence, scene: Scene, case: Case, claimed: Range) -> Iterator[Finding]:
    """Prominence of the lesser load peak: mean over realisations, and of their mean force."""
    runs, source = evidence.records[scene], in_files(scene)
    single = over_runs(lambda run: lesser_prominence(run.force), runs)
    name = "prominence of the lesser load peak over the largest force"
    yield Finding(case, f"{name}, mean over realisations", mean(single), claimed, source)
    estimate = prominence_of_mean(common_curve(runs).friction)
    yield Finding(case, f"{name}, of the mean force", estimate, claimed, source)


_TWO, _ONE = (_STANDS_OUT, INF), (-INF, _STANDS_OUT)


def _degrees(direction: str) -> float:
    return {"x": 0.0, "y": 90.0}[direction] if direction in "xy" else float(direction)


def two_peaks(evidence: Evidence) -> Iterator[Finding]:
    """Two load peaks along the grooves, one at any angle to them."""
    for lengths, along, _ in slid_both_ways(evidence):
        ways = [s for s in evidence.records if replace(s, direction="x") == along]
        for scene in sorted(ways, key=lambda s: _degrees(s.direction)):
            claimed = _TWO if scene == along else _ONE
            case: Case = {**lengths, "degrees from the grooves": _degrees(scene.direction)}
            yield from _prominences(evidence, scene, case, claimed)


def further_levels(evidence: Evidence) -> Iterator[Finding]:
    """Two load peaks along the grooves and one across, with a third level."""
    for lengths, *scenes in slid_both_ways(evidence, scenes_along_x(evidence.records, 3)):
        for scene, way, claimed in zip(scenes, _WAYS_OF_SLIDING, (_TWO, _ONE), strict=True):
            case: Case = {**lengths, "sliding": f"{way} the grooves"}
            yield from _prominences(evidence, scene, case, claimed)


def hierarchy_needed(evidence: Evidence) -> Iterator[Finding]:
    """One load peak on pillars without grooves, and on grooves without pillars."""
    for scene in (*scenes_along_x(evidence.records, 1, SMALLEST), *bare_grooves(evidence)):
        yield from _prominences(evidence, scene, place(scene), _ONE)


def bare_grooves(evidence: Evidence) -> list[Scene]:
    """Surfaces grooved from edge to edge, without pillars, that slide along the grooves."""
    found = [s for s in evidence.records if s.n_p2 and not s.n_p and s.direction == ALONG]
    return sorted(found, key=lambda s: (s.n_blocks, s.n_p2, s.n_s2))


def _with_both_peaks(
    evidence: Evidence, name: str, quantity: Callable[[Record], float], claimed: Range
) -> Iterator[Finding]:
    """A quantity of the runs along grooves that have two load peaks, where most runs have."""
    for scene in scenes_along_x(evidence.records, 2):
        sample = over_runs(quantity, evidence.records[scene])
        if len(sample) > MOST * len(evidence.records[scene]):
            statistic = f"{name}, in the {len(sample)} runs that have both"
            yield Finding(place(scene), statistic, mean(sample), claimed, in_files(scene))


def second_peak_decides(evidence: Evidence) -> Iterator[Finding]:
    """The second load peak is the higher one along the grooves: on average, and in most runs."""
    name = "force at the second load peak minus that at the first, over the normal force"
    yield from _with_both_peaks(evidence, name, second_peak, POSITIVE)
    for scene in scenes_along_x(evidence.records, 2):
        sample = over_runs(second_peak, evidence.records[scene])
        if len(sample) > MOST * len(evidence.records[scene]):
            higher = {seed: value > 0.0 for seed, value in sample.items()}
            statistic = f"share of the {len(sample)} runs in which the second load peak is higher"
            yield Finding(place(scene), statistic, share(higher), (MOST, INF), in_files(scene))


def rest_between_peaks(evidence: Evidence) -> Iterator[Finding]:
    """Between the load peaks nearly all of the core has yet to let go."""
    name = (
        "share of the blocks off the edges yet to detach at the lowest force between the load peaks"
    )
    return _with_both_peaks(evidence, name, resting_core, (NEARLY_ALL, INF))


def edges_make_first_peak(evidence: Evidence) -> Iterator[Finding]:
    """Between the load peaks nearly all edges have let go."""

    def detached(run: Record) -> float:
        return detached_between(run, edge(run.scene.contact))

    name = "share of the edges detached at the lowest force between the load peaks"
    return _with_both_peaks(evidence, name, detached, (NEARLY_ALL, INF))


def equal_parts(evidence: Evidence) -> Iterator[Finding]:
    """What detaches before the lowest force between the load peaks is half of the surface."""

    def detached(run: Record) -> float:
        return detached_between(run, run.scene.contact)

    name = "share of the contact blocks detached at the lowest force between the load peaks"
    return _with_both_peaks(evidence, name, detached, _EQUAL)


def quiet_between_peaks(evidence: Evidence) -> Iterator[Finding]:
    """Between the load peaks detachments become rare for a while."""
    name = "least rate of detachments between the load peaks, within 2 % of t_avg, over the mean"
    return _with_both_peaks(evidence, name, quiet_rate, (-INF, MOST))


def stick_slip(evidence: Evidence) -> Iterator[Finding]:
    """Between the load peaks what has detached slips again."""
    name = "further slips between the load peaks per block detached at the lowest force"
    return _with_both_peaks(evidence, name, slips_again, (MOST, INF))


def edges_before_core(evidence: Evidence) -> Iterator[Finding]:
    """The edges let go before the rest, sliding along or across the grooves."""
    for lengths, *scenes in slid_both_ways(evidence):
        for scene, name in zip(scenes, _WAYS_OF_SLIDING, strict=True):
            contact = scene.contact
            edges = edge(contact)
            later = [
                (run.t_det[contact & ~edges].mean() - run.t_det[edges].mean()) / run.t_avg
                for run in evidence.records[scene]
            ]
            yield Finding(
                lengths | {"sliding": f"{name} the grooves"},
                "t_det/t_avg of the core minus that of the edges",
                mean(np.array(later)),
                POSITIVE,
                in_files(scene),
            )


def grooved_order(evidence: Evidence) -> Iterator[Finding]:
    """Transverse sides, external longitudinal ones, those along the grooves, the inside."""
    for scene in scenes_along_x(evidence.records, 2):
        runs = evidence.records[scene]
        scale = np.array([run.t_max / run.t_avg for run in runs])
        times = pillar_map(runs, scene.pattern) * scale[:, None, None]
        parts = {name: times[:, mask].mean(axis=1) for name, mask in grooved_parts(scene).items()}
        yield from in_order(place(scene), parts, in_files(scene), "t_avg")


def across_sticks_better(evidence: Evidence) -> Iterator[Finding]:
    """Static friction across the grooves exceeds that along them, with pillars and without."""
    scenes = *bare_grooves(evidence), *scenes_along_x(evidence.records, 2)
    for lengths, along, across in slid_both_ways(evidence, scenes):
        friction = attrgetter("static_friction")
        samples = [over_runs(friction, evidence.records[s]) for s in (across, along)]
        yield Finding(
            lengths,
            "static friction across the grooves minus that along them",
            difference(*samples),
            POSITIVE,
            in_files(across, along),
        )


CLAIMS = (
    Claim(
        "Two load peaks only along grooves",
        "3.3",
        "The two load peaks appear only if the second level grooves are aligned with the sliding "
        "direction. Tested: the lesser peak stands out by more than 1 % of the largest force along "
        "the grooves, and by less at any angle to them.",
        _WAYS,
        two_peaks,
    ),
    Claim(
        "The second load peak sets static friction",
        "3.3",
        "The global static friction is determined by the force reached at the second load peak. "
        "Tested: it is the higher one on average, and in most realisations.",
        f"{_GROOVES} with two load peaks",
        second_peak_decides,
    ),
    Claim(
        "A quiet phase between the load peaks",
        "3.3",
        "The transition is characterized by two load peaks separated by an intermediate "
        "quasi-static phase. Tested: detachments fall below half of their mean rate.",
        f"{_GROOVES} with two load peaks",
        quiet_between_peaks,
    ),
    Claim(
        "The edges make the first load peak",
        "3.3",
        "Slip precursors lead to a faster detachment of the boundary regions and, consequently, to "
        "the first load peak. Tested: more than nine tenths of the edges have detached between "
        "the peaks.",
        f"{_GROOVES} with two load peaks",
        edges_make_first_peak,
    ),
    Claim(
        "Edges and core are of equal size",
        "3.3",
        "The geometry divides the contact surface into two parts of equal size with distinct "
        "dynamics. Tested: four to six tenths have detached between the load peaks.",
        f"{_GROOVES} with two load peaks",
        equal_parts,
    ),
    Claim(
        "The core rests between the load peaks",
        "4",
        "In the phase between load peaks the internal regions are still at rest. Tested: more than "
        "nine tenths of the blocks off the edges.",
        f"{_GROOVES} with two load peaks",
        rest_between_peaks,
    ),
    Claim(
        "What has detached slips again between the load peaks",
        "4",
        "The regions involved by precursor events undergo a stick-slip motion after the first "
        "detachment. Tested: a further slip for every second of their blocks, or more.",
        f"{_GROOVES} with two load peaks",
        stick_slip,
    ),
    Claim(
        "Without hierarchy one load peak",
        "3.3",
        "Two load peaks need the concurrent presence of multiple length scales: hierarchy is "
        "necessary. Tested: on pillars without grooves, and on grooves without pillars, a lesser "
        "peak stands out by less than 1 % of the largest force.",
        "realisations of pillars with n_p of 4 or more, or of grooves without pillars",
        hierarchy_needed,
    ),
    Claim(
        "Edges detach before the core of grooved pillars",
        "3.3",
        "Edge regions and internal core have distinct dynamics; the boundary regions detach first.",
        _WAYS,
        edges_before_core,
    ),
    Claim(
        "Order of detachment on a grooved pillar",
        "3.3",
        "Transversal sides detach first, then the external longitudinal ones, then the internal "
        "ones along the grooves, then the internal regions of the pawls.",
        _GROOVES,
        grooved_order,
    ),
    Claim(
        "The effects remain with a further level",
        "3.3",
        "We expect that these effects remain present when adding further hierarchical levels. "
        "Tested: the lesser of two load peaks stands out by more than 1 % along grooves, and by "
        "less across.",
        f"{_WAYS}, with a third level",
        further_levels,
    ),
    Claim(
        "Static friction is greater across grooves than along",
        "1",
        "Static friction is greater when the grooves are perpendicular to the sliding direction. "
        "A result of the authors' paper of 2018, J. Mech. Phys. Solids 112, 50 (arXiv:1706.08055), "
        "for grooves that cross the whole surface, n_p2 and n_s2 alone here.",
        _WAYS,
        across_sticks_better,
    ),
)
