"""Between two load peaks: grooved pillars that slide along their grooves (sections 3.3 and 4).

Statistics are over the runs with two load peaks, on surfaces where most runs have two. Times are
divided by t_avg: where the peaks are about equally high, t_max belongs to either.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from springblock.analysis.statistics import load_peaks
from springblock.claims import ranges, samples, surfaces
from springblock.claims.rule import Case, Evidence, Finding, Records
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
    return float(peaks.run.force[peaks.second] > peaks.run.force[peaks.first])


def mean_rate(run: Run) -> float:
    """Return the mean detachment rate from the first detachment to the last, 1/s."""
    lasting = np.nanmax(run.t_det) - np.nanmin(run.t_det)
    return float(np.count_nonzero(np.isfinite(run.t_det)) / lasting)


def main_rate(run: Run) -> float:
    """Return the mean detachment rate over the transition, 1/s."""
    detached = 0.8 * np.count_nonzero(np.isfinite(run.t_det))
    return float(detached / (samples.lasting(run) * run.t_max))


def rate_between(peaks: Peaks) -> float:
    """Return the mean detachment rate between the load peaks, 1/s."""
    return float(peaks.run.detachments[peaks.first : peaks.second].sum() / peaks.apart)


def quiet_between_peaks(evidence: Evidence) -> Iterator[Finding]:
    references = {"all detachments": mean_rate, "the transition": main_rate}
    for (span, mean), (scene, found) in product(
        references.items(), _grooved(evidence.records).items()
    ):
        relative = samples.mean([rate_between(peaks) / mean(peaks.run) for peaks in found])
        ratio = f"the mean rate between the peaks over the mean rate of {span}"
        case = replace(surfaces.case_of(scene), part=span)
        yield samples.found_on(scene, ratio, relative, ranges.FEWER_THAN_HALF, case=case)


def share_detached(peaks: Peaks, blocks: Callable[[Mask], Mask]) -> float:
    """Return the share of some contact blocks detached at the lowest force between the peaks."""
    times = peaks.run.t_det[blocks(peaks.run.scene.contact)]
    return float(np.mean(times <= peaks.run.time[peaks.valley]))  # NaN: never


@mean_over(_grooved, f"the share of edge blocks detached {_BY_VALLEY}", ranges.NEARLY_ALL)
def edges_make_first_peak(peaks: Peaks) -> float:
    return share_detached(peaks, edge)


@mean_over(_grooved, f"the share of core blocks not detached {_BY_VALLEY}", ranges.NEARLY_ALL)
def rest_between_peaks(peaks: Peaks) -> float:
    return 1.0 - share_detached(peaks, core)


@mean_over(
    _grooved,
    "the number of further slips between the load peaks per block detached by the time of the "
    "lowest force",
    ranges.MOST,
)
def slips_again(peaks: Peaks) -> float:
    run, between = peaks.run, slice(peaks.first, peaks.second)
    repeated = run.switches[between] - run.detachments[between]
    return float(repeated.sum() / np.count_nonzero(run.t_det <= run.time[peaks.valley]))


@mean_over(
    _grooved,
    "the lowest force between the load peaks over the normal force, minus the mean mu_dynamic",
    ranges.POSITIVE,
)
def stressed_between_peaks(peaks: Peaks) -> float:
    run = peaks.run
    return (peaks.lowest - run.material.mu_dynamic * run.normal_force) / run.normal_force


@mean_over(
    _grooved,
    "the growth of the force from its lowest between the peaks to its largest until 90 % "
    "detachment, over the drop from static to dynamic friction",
    ranges.NEGLIGIBLE,
)
def small_force_suffices(peaks: Peaks) -> float:
    run = peaks.run
    detached = np.searchsorted(run.time, np.nanquantile(run.t_det, 0.9))
    highest = float(run.force[peaks.valley : detached + 1].max())
    drop = float(run.force.max()) - run.material.mu_dynamic * run.normal_force
    return (highest - peaks.lowest) / drop


def interval_follows_lengths(evidence: Evidence) -> Iterator[Finding]:
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
        case, claimed = Case(n_p=wide.n_p), ranges.NEGATIVE
        yield samples.found_on(wide, statistic, shorter, claimed, case=case, beside=[narrow])
