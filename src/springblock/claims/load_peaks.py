"""Between two load peaks: grooved pillars that slide along their grooves (sections 3.3 and 4).

Statistics are over the runs with two load peaks, on surfaces where most runs have two. Times are
divided by t_avg: where the peaks are about equally high, t_max belongs to either.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from itertools import product

import numpy as np

from springblock.analysis.statistics import load_peaks
from springblock.claims import ranges, samples, surfaces
from springblock.claims.rule import Evidence, Finding, Records
from springblock.claims.samples import mean_over
from springblock.claims.surfaces import Mask, core, edge, slid_both_ways
from springblock.io.records import Record
from springblock.model.scene import Scene
from springblock.simulation.run import Run

_BY_VALLEY = "by the time of the lowest force between the load peaks"


@dataclass(frozen=True)
class Peaks:
    """The two most prominent load peaks of a run, as indices of its force curve."""

    run: Record
    first: int
    valley: int  #: of the lowest force between them
    second: int

    @property
    def lowest(self) -> float:
        """Return the lowest force between the peaks, N."""
        return float(self.run.force[self.valley])

    @property
    def apart(self) -> float:
        """Return the time from the first peak to the second, s."""
        return float(self.run.time[self.second] - self.run.time[self.first])


def both_peaks(run: Record) -> Peaks | None:
    """Find the two most prominent load peaks; None with fewer than two.

    Both have a prominence of 1 % of the largest force or more.
    """
    from scipy.signal import peak_prominences  # slow to load

    peaks = load_peaks(run.force, 0.0)
    if len(peaks) < 2:
        return None
    prominences, *_ = peak_prominences(run.force, peaks)
    first, second = sorted(map(int, peaks[np.argsort(prominences)[-2:]]))
    return Peaks(run, first, first + int(np.argmin(run.force[first:second])), second)


def twice_peaked(records: Records) -> dict[Scene, list[Peaks]]:
    """Return the peaks of the runs with two load peaks, of scenes where most runs have two."""
    found = {
        scene: [peaks for run in runs if (peaks := both_peaks(run))]
        for scene, runs in records.items()
    }
    return {s: peaks for s, peaks in found.items() if len(peaks) > 0.5 * len(records[s])}


def _grooved(records: Records) -> dict[Scene, list[Peaks]]:
    """Return the peaks on grooved pillars along x that were also slid across their grooves."""
    return twice_peaked(slid_both_ways(records))


@mean_over(
    _grooved,
    "the share of runs with two load peaks in which the second is higher",
    ranges.MOST,
    estimate=samples.proportion,
)
def second_peak_decides(peaks: Peaks) -> float:
    """Test: the second peak is the higher one in most runs that have two. With the bound for “all”,
    pawls of 10 blocks would be an open case, and the statement would not be reproduced.
    """
    return float(peaks.run.force[peaks.second] > peaks.run.force[peaks.first])


def mean_rate(run: Run) -> float:
    """Return the mean detachment rate from the first detachment to the last, 1/s."""
    lasting = np.nanmax(run.t_det) - np.nanmin(run.t_det)
    return float(np.count_nonzero(np.isfinite(run.t_det)) / lasting)


def main_rate(run: Run) -> float:
    """Return the mean detachment rate over the transition, 1/s."""
    detached = 0.8 * np.count_nonzero(np.isfinite(run.t_det))
    return float(detached / (samples.lasting(run) * run.t_max))


def quietest_rate(peaks: Peaks, share: float) -> float:
    """Return the lowest detachment rate between the peaks, over `share` of t_avg, 1/s."""
    width = share * peaks.run.t_avg
    counts = samples.rates(peaks.run, width)[peaks.first : peaks.second]
    return float(counts.min() / width)


def rate_between(peaks: Peaks) -> float:
    """Return the mean detachment rate between the load peaks, 1/s."""
    return float(peaks.run.detachments[peaks.first : peaks.second].sum() / peaks.apart)


def quiet_between_peaks(evidence: Evidence) -> Iterator[Finding]:
    """Test: the detachment rate between the peaks is below half of a reference. The rate is either
    the lowest of those in windows of 0.05 t_avg, or the mean from one peak to the other; since the
    paper does not say what the phase is quieter than, the reference is the mean rate from the first
    to the last detachment (“all detachments”), or that from a tenth to nine tenths of them (“the
    transition”). All four combinations are tested, with pawls of 8 and of 10 blocks; with a bound
    of a tenth all would fail.
    """
    rates: dict[str, Callable[[Peaks], float]] = {
        "lowest": partial(quietest_rate, share=0.05),
        "mean": rate_between,
    }
    means = {"all detachments": mean_rate, "the transition": main_rate}
    for (what, rate), (span, mean), (scene, found) in product(
        rates.items(), means.items(), _grooved(evidence.records).items()
    ):
        relative = samples.mean([rate(peaks) / mean(peaks.run) for peaks in found])
        ratio = f"the {what} rate between the peaks over the mean rate of {span}"
        case = {"ratio": ratio, **surfaces.case_of(scene)}
        yield samples.found_on(scene, ratio, relative, ranges.FEWER_THAN_HALF, case=case)


def share_detached(peaks: Peaks, blocks: Callable[[Mask], Mask]) -> float:
    """Return the share of some contact blocks detached at the lowest force between the peaks."""
    times = peaks.run.t_det[blocks(peaks.run.scene.contact)]
    return float(np.mean(times <= peaks.run.time[peaks.valley]))  # NaN: never


@mean_over(_grooved, f"the share of edge blocks detached {_BY_VALLEY}", ranges.NEARLY_ALL)
def edges_make_first_peak(peaks: Peaks) -> float:
    """Test: more than nine tenths of the edge blocks have detached by the time of the lowest force
    between the peaks. A bound below 0.84 would be met with pawls of 8 and of 10 blocks, one above
    0.92 with neither; with the bound for “most” the statement would be reproduced.
    """
    return share_detached(peaks, edge)


@mean_over(_grooved, f"the share of core blocks not detached {_BY_VALLEY}", ranges.NEARLY_ALL)
def rest_between_peaks(peaks: Peaks) -> float:
    """Test: by the time of the lowest force between the peaks, more than nine tenths of the core
    blocks have not detached. The mean of this share over the time between the peaks is 0.93 with
    pawls of 8 and of 10; at the second peak it is 0.83 and 0.85, so that a test at this time would
    fail. On the 16 other surfaces with two load peaks, which are not cases here, the share at the
    lowest force is 0.87 to 0.98; it is below 0.9 on pillars of 25 blocks with pawls of 7 and on
    pillars of 30 blocks with pawls of 6, and with these as cases the statement would be reproduced
    in part.
    """
    return 1.0 - share_detached(peaks, core)


@mean_over(
    _grooved,
    "the number of further slips between the load peaks per block detached by the time of the "
    "lowest force",
    ranges.MOST,
)
def slips_again(peaks: Peaks) -> float:
    """Test: between the load peaks there is more than one further slip for every two blocks that
    have detached by the time of the lowest force; one block may slip several times, and turning
    back counts as a slip. With a bound of one for every ten blocks the statement would hold.
    """
    run, between = peaks.run, slice(peaks.first, peaks.second)
    repeated = run.switches[between] - run.detachments[between]
    return float(repeated.sum() / np.count_nonzero(run.t_det <= run.time[peaks.valley]))


@mean_over(
    _grooved,
    "the lowest force between the load peaks over the normal force, minus the mean mu_dynamic",
    ranges.POSITIVE,
)
def stressed_between_peaks(peaks: Peaks) -> float:
    """Test: between the load peaks the surface bears more than if all blocks slid. After the second
    peak the force falls below this value in every run. Only the force on the whole surface is
    tested, not that on its parts.
    """
    run = peaks.run
    return (peaks.lowest - run.material.mu_dynamic * run.normal_force) / run.normal_force


@mean_over(
    _grooved,
    "the relative growth of the force from its lowest between the peaks to its largest until "
    "90 % detachment",
    ranges.NEGLIGIBLE,
)
def small_force_suffices(peaks: Peaks) -> float:
    """Test: the force grows by less than a tenth from its lowest value between the load peaks to
    the largest that it then reaches before nine tenths of the blocks have detached. If the force
    fell between the peaks to that of a surface that slides as a whole, 0.6 of the normal force, the
    growth would exceed a tenth. If the growth were divided by the drop of the force from static to
    dynamic friction instead of by the lowest force, its mean would be 0.28 and 0.33 (pawls of 8 and
    10), and it would be a tenth or less in only one run of 987.
    """
    detached = np.searchsorted(peaks.run.time, np.nanquantile(peaks.run.t_det, 0.9))
    highest = float(peaks.run.force[peaks.valley : detached + 1].max())
    return highest / peaks.lowest - 1.0


def interval_follows_lengths(evidence: Evidence) -> Iterator[Finding]:
    """Test: on pillars of the same n_p, the time between the peaks is shorter with the widest pawls
    than with the narrowest, among the widths with which most runs have two peaks. Pillars of
    different n_p are not compared: a time that depends on n_p alone would not show that the
    difference n_p - n_p2 matters. At n_p = 58, where the test holds, the two times differ by a
    twentieth of their value. That the smaller n_p - n_p2, with the wider pawls, gives the shorter
    time is an assumption; the paper does not say so. If the test were only whether the two times
    differ, it would hold at n_p = 58 and 118 (with opposite signs) and be open at 115, and the
    statement would not be settled.
    """
    name = (
        "the time between the load peaks over t_avg, with pawls of {} minus that with pawls of {}"
    )
    found = twice_peaked(surfaces.grooved(evidence.records))
    by_length: dict[tuple[int, int, int], list[Scene]] = {}
    for scene in sorted(found, key=lambda scene: scene.n_p2):
        by_length.setdefault((scene.n_p, scene.n_blocks, scene.n_s2), []).append(scene)
    for narrow, *_, wide in (scenes for scenes in by_length.values() if len(scenes) > 1):
        times = [[peaks.apart / peaks.run.t_avg for peaks in found[s]] for s in (wide, narrow)]
        shorter = samples.difference(*map(np.array, times))
        statistic = name.format(wide.n_p2, narrow.n_p2)
        case = {"n_p": wide.n_p}
        yield samples.found_on(
            wide, statistic, shorter, ranges.NEGATIVE, case=case, beside=[narrow]
        )
