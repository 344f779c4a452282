"""Between two load peaks: grooved pillars that slide along their grooves (sections 3.3 and 4).

Statistics are over the runs with two load peaks, on surfaces where most runs have two.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from springblock.analysis.statistics import load_peaks
from springblock.claims import ranges, samples
from springblock.claims.rule import Evidence, Finding, Range, Records, tests_statement
from springblock.claims.samples import on_each
from springblock.claims.surfaces import core, slid_both_ways
from springblock.io.records import Record
from springblock.model.scene import Scene
from springblock.simulation.run import Run


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
    """Return the peaks of the runs with two load peaks, of scenes where most runs have two.

    Scenes are grooved pillars that slide along their grooves, and were also slid across them.
    """
    found = {
        scene: [peaks for run in runs if (peaks := both_peaks(run))]
        for scene, runs in slid_both_ways(records).items()
    }
    return {s: peaks for s, peaks in found.items() if len(peaks) > 0.5 * len(records[s])}


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


def core_at_rest(peaks: Peaks) -> float:
    """Return the share of the core not detached at the lowest force between the peaks."""
    times = peaks.run.t_det[core(peaks.run.scene.contact)]
    return 1.0 - float(np.mean(times <= peaks.run.time[peaks.valley]))  # NaN: never


def slips_again(peaks: Peaks) -> float:
    """Return the further slips between the peaks per block detached at the lowest force."""
    run, between = peaks.run, slice(peaks.first, peaks.second)
    repeated = run.switches[between] - run.detachments[between]
    return float(repeated.sum() / np.count_nonzero(run.t_det <= run.time[peaks.valley]))


def stressed(peaks: Peaks) -> float:
    """Return the lowest force between the peaks over the normal force, minus mean mu_dynamic."""
    run = peaks.run
    return (peaks.lowest - run.material.mu_dynamic * run.normal_force) / run.normal_force


_RATE = "the mean rate between the peaks over the mean rate of {}"
_BY_VALLEY = "by the time of the lowest force between the load peaks"
#: Parts of the statement, each with its statistic, quantity and claimed range.
_PHASE: tuple[tuple[str, str, Callable[[Peaks], float], Range], ...] = (
    (
        "quiet beside all detachments",
        _RATE.format("all detachments"),
        lambda peaks: rate_between(peaks) / mean_rate(peaks.run),
        ranges.FEWER_THAN_HALF,
    ),
    (
        "quiet beside the transition",
        _RATE.format("the transition"),
        lambda peaks: rate_between(peaks) / main_rate(peaks.run),
        ranges.FEWER_THAN_HALF,
    ),
    (
        "the core at rest",
        f"the share of core blocks not detached {_BY_VALLEY}",
        core_at_rest,
        ranges.NEARLY_ALL,
    ),
    (
        "precursors slip again",
        "the number of further slips between the load peaks per block detached by the time of the "
        "lowest force",
        slips_again,
        ranges.MOST,
    ),
    (
        "the surface stressed",
        "the lowest force between the load peaks over the normal force, minus the mean mu_dynamic",
        stressed,
        ranges.POSITIVE,
    ),
)


@tests_statement
def quasi_static_phase(evidence: Evidence) -> Iterator[Finding]:
    scenes = twice_peaked(evidence.records)
    for part, statistic, quantity, claimed in _PHASE:
        yield from on_each(scenes, statistic, quantity, claimed, part=part)
