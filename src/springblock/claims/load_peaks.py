"""Between two load peaks: grooved pillars that slide along their grooves (sections 3.3 and 4).

Times are taken over t_avg: where two load peaks are about as high, t_max is that of the one or of
the other, and a share of it would mix two populations.
"""

from collections.abc import Callable, Iterable, Iterator
from functools import partial

import numpy as np

from springblock.analysis.estimate import UNKNOWN, Estimate
from springblock.analysis.statistics import bootstrap_interval, load_peaks
from springblock.claims import ranges
from springblock.claims.grooves import core, edge
from springblock.claims.rule import Case, Evidence, Finding, Range, claim
from springblock.claims.samples import (
    Mask,
    found_on,
    grooved,
    in_files,
    mean,
    pawls,
    proportion,
    rates,
    slid_both_ways,
)
from springblock.io.records import Record
from springblock.model.scene import Scene
from springblock.simulation.run import Array, Run

_AT_VALLEY = "at the lowest force between the load peaks"
_IN_SUCH_RUNS = " (runs with two load peaks)"
_FEWEST = 3  #: surfaces that a trend needs
_PEAKS = "realisations of a grooved surface, slid along and across, with two load peaks"
_LENGTHS = "three surfaces with grooves of several lengths along the sliding direction"


def both_peaks(run: Run) -> tuple[int, int] | None:
    """Samples of the two most prominent load peaks, the earlier first; None with less than two.

    Both stand out by 1 % of the largest force or more.
    """
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


def with_both_peaks(
    evidence: Evidence, scenes: Iterable[Scene], quantity: QuantityOfPeaks
) -> Iterator[tuple[Scene, Array]]:
    """A quantity of the runs that have two load peaks, (k,), on scenes where most runs have."""
    for scene in scenes:
        runs = evidence.records[scene]
        found = [(run, peaks) for run in runs if (peaks := both_peaks(run))]
        sample = np.array([quantity(run, *peaks) for run, peaks in found])
        sample = sample[np.isfinite(sample)]
        if len(sample) > 0.5 * len(runs):
            yield scene, sample


def _means(
    evidence: Evidence,
    name: str,
    quantity: QuantityOfPeaks,
    claimed: Range,
    reading: Case | None = None,
) -> Iterator[Finding]:
    """Mean of a quantity over the runs with two load peaks, for one reading of the statement."""
    scenes = slid_both_ways(evidence.records)
    for scene, sample in with_both_peaks(evidence, scenes, quantity):
        case = {**(reading or {}), **pawls(scene)}
        yield found_on(scene, case, f"{name}{_IN_SUCH_RUNS}", mean(sample), claimed)


def second_peak(run: Run, first: int, second: int) -> float:
    """Force at the second load peak minus that at the first, over P l² N²."""
    return float(run.force[second] - run.force[first]) / run.normal_force


@claim("The second load peak sets static friction", "3.3", 9, _PEAKS)
def second_peak_decides(evidence: Evidence) -> Iterator[Finding]:
    """The global static friction is determined by the force reached at the second load peak.

    Tested: it is the higher one in most realisations.
    """
    scenes = slid_both_ways(evidence.records)
    for scene, sample in with_both_peaks(evidence, scenes, second_peak):
        statistic = f"share of runs in which the second load peak is higher{_IN_SUCH_RUNS}"
        yield found_on(scene, pawls(scene), statistic, proportion(sample > 0.0), ranges.MOST)


def mean_rate(run: Run) -> float:
    """Detachments per second from the first to the last."""
    lasting = np.nanmax(run.t_det) - np.nanmin(run.t_det)
    return float(np.count_nonzero(np.isfinite(run.t_det)) / lasting)


def quietest_rate(run: Run, first: int, second: int, share: float) -> float:
    """Least rate of detachments between the load peaks, in a share of t_avg, over the mean rate."""
    width = share * run.t_avg
    return float(rates(run, width)[first:second].min()) / (mean_rate(run) * width)


def rate_between(run: Run, first: int, second: int) -> float:
    """Rate of detachments between the load peaks over the mean rate."""
    detached = run.detachments[first:second].sum()
    return float(detached / (mean_rate(run) * (run.time[second] - run.time[first])))


@claim("A quiet phase between the load peaks", "3.3", 9, _PEAKS)
def quiet_between_peaks(evidence: Evidence) -> Iterator[Finding]:
    """The transition is characterized by two load peaks separated by an intermediate quasi-static
    phase.

    Tested: detachments fall below half of their mean rate; in the quietest time between the peaks,
    which takes 1 or 5 % of t_avg, or from one peak to the other.
    """
    for phase, quantity in (
        ("its quietest 1 % of t_avg", partial(quietest_rate, share=0.01)),
        ("its quietest 5 % of t_avg", partial(quietest_rate, share=0.05)),
        ("all of it", rate_between),
    ):
        name = "rate of detachments between the load peaks over the mean rate"
        yield from _means(
            evidence, name, quantity, ranges.FEWER_THAN_HALF, {"part of the phase": phase}
        )


def share_detached(run: Record, first: int, second: int, blocks: Callable[[Mask], Mask]) -> float:
    """Share of some contact blocks that have detached at the lowest force between load peaks."""
    lowest = run.time[valley(run, first, second)]
    return float(np.mean(run.t_det[blocks(run.scene.contact)] <= lowest))  # NaN: never


@claim("The edges make the first load peak", "3.3", 9, _PEAKS)
def edges_make_first_peak(evidence: Evidence) -> Iterator[Finding]:
    """Slip precursors lead to a faster detachment of the boundary regions and, consequently, to the
    first load peak.

    Tested: more than nine tenths of the edges have detached between the peaks. A bound below 0.84
    would hold with pawls of 8 and of 10 blocks, one above 0.92 with neither.
    """
    name = f"share of the edges detached {_AT_VALLEY}"
    return _means(evidence, name, partial(share_detached, blocks=edge), ranges.NEARLY_ALL)


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

    Tested: a further slip for more than a tenth of their blocks, or for more than half.
    """
    name = "further slips between the load peaks per block detached at the lowest force"
    for share, claimed in (("a tenth", ranges.MORE_THAN_NEGLIGIBLE), ("half", ranges.MOST)):
        reading = {"blocks that slip again": f"more than {share} of the blocks"}
        yield from _means(evidence, name, slips_again, claimed, reading)


def sliding_force(run: Record) -> float:
    """Force under which all blocks slide: the mean of mu_dynamic times the normal force, N."""
    return run.material.mu_dynamic * run.normal_force


def stress_at_valley(run: Record, first: int, second: int) -> float:
    """Lowest force between the load peaks minus that of sliding, over the normal force."""
    lowest = run.force[valley(run, first, second)]
    return float(lowest - sliding_force(run)) / run.normal_force


@claim("The surface stays stressed between the load peaks", "4", 9, _PEAKS)
def stressed_between_peaks(evidence: Evidence) -> Iterator[Finding]:
    """Between the load peaks the whole contact surface is in a stressed state.

    Tested: it bears more than if all blocks slid, which after the second peak it does not.
    """
    name = "lowest force between the load peaks minus the mean mu_dynamic, over the normal force"
    return _means(evidence, name, stress_at_valley, ranges.POSITIVE)


def additional_force(run: Run, first: int, second: int) -> float:
    """Growth of the force from the lowest between the peaks until nine tenths have detached, N."""
    lowest = valley(run, first, second)
    detached = np.searchsorted(run.time, np.nanquantile(run.t_det, 0.9))
    return float(run.force[lowest : detached + 1].max() - run.force[lowest])


def over_lowest(run: Run, first: int, second: int) -> float:
    """Additional force over the lowest between the load peaks."""
    return additional_force(run, first, second) / float(run.force[valley(run, first, second)])


def over_excess(run: Record, first: int, second: int) -> float:
    """Additional force over what the largest force exceeds that of sliding by."""
    excess = float(run.force.max()) - sliding_force(run)
    return additional_force(run, first, second) / excess


@claim("A small additional force detaches the surface", "4", 9, _PEAKS)
def small_force_suffices(evidence: Evidence) -> Iterator[Finding]:
    """The stressed state can lead to full detachment in the presence of a small additional force.

    Tested: from the lowest force between the load peaks until nine tenths of the blocks have
    detached, it grows by less than a tenth; of itself, or of what static friction exceeds the mean
    mu_dynamic by.
    """
    name = "growth of the force from the lowest between the load peaks until 90 % have detached"
    for against, quantity in (
        ("the force itself", over_lowest),
        ("static minus dynamic friction", over_excess),
    ):
        reading = {"small against": against}
        yield from _means(evidence, f"{name}, over {against}", quantity, ranges.NEGLIGIBLE, reading)


def peak_interval(run: Run, first: int, second: int) -> float:
    """Time from the first load peak to the second over t_avg."""
    return float(run.time[second] - run.time[first]) / run.t_avg


def slope(x: Array, y: Array) -> Estimate:
    """Slope of a line through points, (k,) each, which are drawn from anew; BCa."""

    def of_points(weights: Array) -> Array:
        away = x - (weights @ x)[:, None]
        return (weights * away * y).sum(axis=1) / (weights * away**2).sum(axis=1)

    return Estimate.of(bootstrap_interval(of_points, len(x)), len(x))


@claim("The lengths control the interval between the load peaks", "3.3", 9, _LENGTHS)
def interval_follows_lengths(evidence: Evidence) -> Iterator[Finding]:
    """The time interval between the first and the second peak is controlled by the difference
    between the length scales.

    Tested: it grows with n_p - n_p2, on surfaces where most runs have two peaks. On these
    n_p - n_p2 goes along with n_p, which may as well be what counts.
    """
    scenes = grooved(evidence.records)
    found = dict(with_both_peaks(evidence, scenes, peak_interval))
    x = np.array([float(scene.n_p - scene.n_p2) for scene in found])
    if len(set(x)) < _FEWEST:
        return
    y = np.array([sample.mean() for sample in found.values()])
    statistic = (
        "change of the time between the load peaks over t_avg, mean of each surface, with n_p - "
        f"n_p2; the interval is that over {len(found)} surfaces"
    )
    growth = slope(x, y) if min(map(len, found.values())) > 1 else UNKNOWN
    yield Finding({}, statistic, growth, ranges.POSITIVE, in_files(*found), "1/block")
