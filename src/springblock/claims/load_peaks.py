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
from springblock.claims.rule import Evidence, Finding, Range, claim
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
_BURST = 0.02  #: of t_avg, over which detachments are counted
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
    evidence: Evidence, name: str, quantity: QuantityOfPeaks, claimed: Range
) -> Iterator[Finding]:
    scenes = slid_both_ways(evidence.records)
    for scene, sample in with_both_peaks(evidence, scenes, quantity):
        yield found_on(scene, pawls(scene), f"{name}{_IN_SUCH_RUNS}", mean(sample), claimed)


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


def force_at_valley(run: Run, first: int, second: int) -> float:
    """Lowest force between the load peaks over the largest force."""
    return float(run.force[valley(run, first, second)] / run.force.max())


@claim("The surface stays stressed between the load peaks", "4", 9, _PEAKS)
def stressed_between_peaks(evidence: Evidence) -> Iterator[Finding]:
    """Between the load peaks the whole contact surface is in a stressed state.

    Tested: it bears more than nine tenths of the largest force.
    """
    name = "lowest force between the load peaks over the largest"
    return _means(evidence, name, force_at_valley, ranges.NEARLY_ALL)


def additional_force(run: Run, first: int, second: int) -> float:
    """Force from the lowest between the load peaks to the second peak, over the lowest."""
    lowest = run.force[valley(run, first, second)]
    return float(run.force[second] / lowest - 1.0)


@claim("A small additional force detaches the surface", "4", 9, _PEAKS)
def small_force_suffices(evidence: Evidence) -> Iterator[Finding]:
    """The stressed state can lead to full detachment in the presence of a small additional force.

    Tested: from the lowest force between the load peaks to the second peak, after which everything
    slides, it grows by less than a tenth.
    """
    name = "growth of the force from the lowest between the load peaks to the second"
    return _means(evidence, name, additional_force, ranges.NEGLIGIBLE)


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
