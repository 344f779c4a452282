"""Between two load peaks: grooved pillars that slide along their grooves (sections 3.3 and 4).

Times are taken over t_avg: where two load peaks are about as high, t_max is that of the one or of
the other, and a share of it would mix two populations.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial, wraps

import numpy as np

from springblock.analysis.estimate import UNKNOWN, Estimate
from springblock.analysis.statistics import bootstrap_interval, load_peaks
from springblock.claims import ranges, samples, surfaces
from springblock.claims.rule import Case, Evidence, Finding, Range, Records, Test, claim
from springblock.claims.surfaces import Mask, core, edge, slid_both_ways
from springblock.io.records import Record
from springblock.model.scene import Scene
from springblock.simulation.run import Array, Run

_AT_VALLEY = "at the lowest force between the load peaks"
_IN_SUCH_RUNS = " (runs with two load peaks)"
_FEWEST = 4  #: surfaces that a trend with two lengths needs
_PEAKS = "realisations of a grooved surface, slid along and across, with two load peaks"
_LENGTHS = "four surfaces with pawls and pillars of several lengths along the sliding direction"


@dataclass(frozen=True)
class Peaks:
    """A run with two load peaks, the most prominent ones, by samples of its force."""

    run: Record
    first: int
    valley: int  #: where the force between them is lowest
    second: int

    @property
    def lowest(self) -> float:
        """Lowest force between the peaks, N."""
        return float(self.run.force[self.valley])

    @property
    def sliding(self) -> float:
        """Force under which all blocks slide: the mean of mu_dynamic times the normal force, N."""
        return self.run.material.mu_dynamic * self.run.normal_force

    @property
    def additional(self) -> float:
        """Growth of the force from the lowest until nine tenths of the blocks have detached, N."""
        detached = np.searchsorted(self.run.time, np.nanquantile(self.run.t_det, 0.9))
        return float(self.run.force[self.valley : detached + 1].max()) - self.lowest


def both_peaks(run: Record) -> Peaks | None:
    """Find the two most prominent load peaks; None with less than two.

    Both stand out by 1 % of the largest force or more.
    """
    from scipy.signal import peak_prominences  # slow to load

    peaks = load_peaks(run.force, 0.0)
    if len(peaks) < 2:
        return None
    prominences, *_ = peak_prominences(run.force, peaks)
    first, second = sorted(map(int, peaks[np.argsort(prominences)[-2:]]))
    return Peaks(run, first, first + int(np.argmin(run.force[first:second])), second)


Quantity = Callable[[Peaks], float]


def with_both_peaks(records: Records, quantity: Quantity) -> Iterator[tuple[Scene, Array]]:
    """A quantity of the runs that have two load peaks, (k,), on scenes where most runs have."""
    for scene, runs in records.items():
        found = [peaks for run in runs if (peaks := both_peaks(run))]
        sample = np.array([quantity(peaks) for peaks in found])
        sample = sample[np.isfinite(sample)]
        if len(sample) > 0.5 * len(runs):
            yield scene, sample


def _means(
    evidence: Evidence,
    statistic: str,
    quantity: Quantity,
    claimed: Range,
    reading: Case | None = None,
) -> Iterator[Finding]:
    """Mean of a quantity over the runs with two load peaks, for one reading of the statement."""
    for scene, sample in with_both_peaks(slid_both_ways(evidence.records), quantity):
        case, name = {**(reading or {}), **surfaces.case_of(scene)}, f"{statistic}{_IN_SUCH_RUNS}"
        yield samples.found_on(scene, name, samples.mean(sample), claimed, case=case)


def mean_between(statistic: str, claimed: Range) -> Callable[[Quantity], Test]:
    """Make a test of a quantity: its mean over the runs with two load peaks."""

    def made(quantity: Quantity) -> Test:
        return wraps(quantity)(lambda evidence: _means(evidence, statistic, quantity, claimed))

    return made


@claim("The second load peak sets static friction", "3.3", 9, _PEAKS)
def second_peak_decides(evidence: Evidence) -> Iterator[Finding]:
    """The global static friction is determined by the force reached at the second load peak.

    Tested: it is the higher one in most realisations.
    """

    def higher(peaks: Peaks) -> float:
        return float(peaks.run.force[peaks.second] > peaks.run.force[peaks.first])

    for scene, sample in with_both_peaks(slid_both_ways(evidence.records), higher):
        statistic = f"share of runs in which the second load peak is higher{_IN_SUCH_RUNS}"
        yield samples.found_on(scene, statistic, samples.proportion(sample > 0.0), ranges.MOST)


def mean_rate(run: Run) -> float:
    """Detachments per second from the first to the last."""
    lasting = np.nanmax(run.t_det) - np.nanmin(run.t_det)
    return float(np.count_nonzero(np.isfinite(run.t_det)) / lasting)


def quietest_rate(peaks: Peaks, share: float) -> float:
    """Least rate of detachments between the load peaks, in a share of t_avg, over the mean rate."""
    width = share * peaks.run.t_avg
    counts = samples.rates(peaks.run, width)[peaks.first : peaks.second]
    return float(counts.min()) / (mean_rate(peaks.run) * width)


def rate_between(peaks: Peaks) -> float:
    """Rate of detachments between the load peaks over the mean rate."""
    run, first, second = peaks.run, peaks.first, peaks.second
    detached = run.detachments[first:second].sum()
    return float(detached / (mean_rate(run) * (run.time[second] - run.time[first])))


@claim("A quiet phase between the load peaks", "3.3", 9, _PEAKS)
def quiet_between_peaks(evidence: Evidence) -> Iterator[Finding]:
    """The transition is characterized by two load peaks separated by an intermediate quasi-static
    phase.

    Tested: detachments fall below half of their mean rate: in the quietest 5 % of t_avg between
    the peaks, or from one peak to the other. In the quietest 1 % they also do so on surfaces
    without two load peaks.
    """
    name = "rate of detachments between the load peaks over the mean rate"
    for part, quantity in (
        ("its quietest 5 % of t_avg", partial(quietest_rate, share=0.05)),
        ("all of it", rate_between),
    ):
        reading = {"part of the phase": part}
        yield from _means(evidence, name, quantity, ranges.FEWER_THAN_HALF, reading)


def share_detached(peaks: Peaks, blocks: Callable[[Mask], Mask]) -> float:
    """Share of some contact blocks that have detached at the lowest force between load peaks."""
    times = peaks.run.t_det[blocks(peaks.run.scene.contact)]
    return float(np.mean(times <= peaks.run.time[peaks.valley]))  # NaN: never


@claim("The edges make the first load peak", "3.3", 9, _PEAKS)
@mean_between(f"share of the edges detached {_AT_VALLEY}", ranges.NEARLY_ALL)
def edges_make_first_peak(peaks: Peaks) -> float:
    """Slip precursors lead to a faster detachment of the boundary regions and, consequently, to the
    first load peak.

    Tested: more than nine tenths of the edges have detached between the peaks. With a bound below
    0.84 it would hold with pawls of 8 and of 10 blocks, with one above 0.92 with neither.
    """
    return share_detached(peaks, edge)


@claim("The core rests between the load peaks", "4", 9, _PEAKS)
@mean_between(f"share of the blocks off the edges yet to detach {_AT_VALLEY}", ranges.NEARLY_ALL)
def rest_between_peaks(peaks: Peaks) -> float:
    """In the phase between load peaks the internal regions are still at rest.

    Tested: more than nine tenths of the blocks off the edges.
    """
    return 1.0 - share_detached(peaks, core)


def slips_again(peaks: Peaks) -> float:
    """Slips after the first, between the load peaks, of each block detached before their end."""
    run, between = peaks.run, slice(peaks.first, peaks.second)
    repeated = run.switches[between] - run.detachments[between]
    return float(repeated.sum() / np.count_nonzero(run.t_det <= run.time[peaks.valley]))


@claim("What has detached slips again between the load peaks", "4", 9, _PEAKS)
def stick_slip(evidence: Evidence) -> Iterator[Finding]:
    """The regions involved by precursor events undergo a stick-slip motion after the first
    detachment.

    Tested: more than one further slip for every ten of their blocks, or for every two. Slips are
    counted, not blocks, of which one may slip again several times.
    """
    name = "further slips between the load peaks per block detached at the lowest force"
    for number, claimed in (("ten", ranges.MORE_THAN_NEGLIGIBLE), ("two", ranges.MOST)):
        reading = {"further slips": f"more than one slip for every {number} blocks"}
        yield from _means(evidence, name, slips_again, claimed, reading)


@claim("The surface stays stressed between the load peaks", "4", 9, _PEAKS)
@mean_between(
    "lowest force between the load peaks minus the mean mu_dynamic, over the normal force",
    ranges.POSITIVE,
)
def stressed_between_peaks(peaks: Peaks) -> float:
    """Between the load peaks the whole contact surface is in a stressed state.

    Tested: it bears more than if all blocks slid; after the second peak it bears less.
    """
    return (peaks.lowest - peaks.sliding) / peaks.run.normal_force


@claim("A small additional force detaches the surface", "4", 9, _PEAKS)
def small_force_suffices(evidence: Evidence) -> Iterator[Finding]:
    """The stressed state can lead to full detachment in the presence of a small additional force.

    Tested: from the lowest force between the load peaks until nine tenths of the blocks have
    detached, it grows by less than a tenth of itself, or of the excess of static friction over the
    mean mu_dynamic.
    """

    def over_lowest(peaks: Peaks) -> float:
        return peaks.additional / peaks.lowest

    def over_excess(peaks: Peaks) -> float:
        return peaks.additional / (float(peaks.run.force.max()) - peaks.sliding)

    name = "growth of the force from the lowest between the load peaks until 90 % have detached"
    for against, quantity in (
        ("the force itself", over_lowest),
        ("static minus dynamic friction", over_excess),
    ):
        reading = {"small against": against}
        yield from _means(evidence, f"{name}, over {against}", quantity, ranges.NEGLIGIBLE, reading)


def partial_slope(beside: Array, x: Array, y: Array) -> Estimate:
    """Slope of y with x beside that with another quantity; points, (k,), are drawn anew; BCa."""
    columns = np.stack([np.ones(len(x)), beside, x], axis=1)

    def of_points(weights: Array) -> Array:
        scale = np.sqrt(weights)[..., None]
        solved: Array = np.linalg.pinv(scale * columns) @ (scale * y[:, None])
        return solved[:, -1, 0]

    return Estimate.of(bootstrap_interval(of_points, len(x)), len(x))


@claim("The lengths control the interval between the load peaks", "3.3", 9, _LENGTHS)
def interval_follows_lengths(evidence: Evidence) -> Iterator[Finding]:
    """The time interval between the first and the second peak is controlled by the difference
    between the length scales.

    Tested: among pillars as long it is shorter with wider pawls, on surfaces where most runs have
    two peaks. That it is longer on longer pillars does not need the difference.
    """

    def apart(peaks: Peaks) -> float:
        time = peaks.run.time
        return float(time[peaks.second] - time[peaks.first]) / peaks.run.t_avg

    found = dict(with_both_peaks(surfaces.grooved(evidence.records), apart))
    n_p, n_p2 = (np.array([float(getattr(s, name)) for s in found]) for name in ("n_p", "n_p2"))
    if len(found) < _FEWEST or len(set(n_p)) < 2 or len(set(n_p2)) < 2:
        return
    y = np.array([sample.mean() for sample in found.values()])
    statistic = (
        "change of the time between the load peaks over t_avg, mean of each surface, with n_p2 "
        f"beside that with n_p; the interval is that over {len(found)} surfaces, which count as "
        "realisations"
    )
    change = partial_slope(n_p, n_p2, y) if min(map(len, found.values())) > 1 else UNKNOWN
    yield Finding({}, statistic, change, ranges.NEGATIVE, surfaces.in_files(*found), "1/block")
