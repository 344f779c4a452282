"""Flat surfaces: isolated precursors anywhere, then the front (section 3.1 of the paper)."""

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from springblock.analysis.estimate import Estimate
from springblock.analysis.statistics import bootstrap_interval, repeatability
from springblock.claims import ranges
from springblock.claims.ranges import INF, within
from springblock.claims.rule import Evidence, Finding, Range, claim
from springblock.claims.samples import (
    Quantity,
    before_peak,
    first_patch,
    found_on,
    in_table,
    isolated,
    mean,
    means_of_runs,
    neighbours,
    over_rows,
    over_runs,
    place,
    rates,
    scenes_along_x,
    share_of,
)
from springblock.io.records import Record
from springblock.model.asperities import draw_friction
from springblock.simulation.run import Array, Run

_EARLY = 0.9  #: of t_max
_CORE = 10  #: blocks from the edges of the surface to its core
_SMALL = 0.2  #: difference in standard deviations that is called small (Cohen 1988)
_SHUFFLES = 5  #: of the detachment times of a realisation
_PATCH = 5  #: blocks, side of the patch that counts as a nucleation point
_BURST = 0.02  #: of t_max, over which detachments are counted
_FLAT = "realisations of the flat surface"


def _means(
    evidence: Evidence, statistic: str, quantity: Quantity, claimed: Range, unit: str = "1"
) -> Iterator[Finding]:
    """Mean of a quantity over the realisations of each flat surface."""
    flat = scenes_along_x(evidence.records, 0)
    return means_of_runs(evidence, flat, statistic, quantity, claimed, unit)


def shuffled(run: Record, until: float) -> float:
    """The share of `isolated` if the same detachment times had fallen anywhere, on average."""
    rng, n = np.random.default_rng(run.seed), len(run.t_det)
    anywhere = (rng.permutation(run.t_det.ravel()).reshape(n, n) for _ in range(_SHUFFLES))
    return float(np.mean([isolated(replace(run, t_det=times), until) for times in anywhere]))


def clustering(observed: Array, chance: Array) -> Estimate:
    """Ratio of the mean shares, (k,) each, of precursors that are not isolated."""
    near, by_chance = 1.0 - observed, 1.0 - chance
    with np.errstate(invalid="ignore", divide="ignore"):  # NaN: by chance there are none
        found = bootstrap_interval(lambda w: (w @ near) / (w @ by_chance), len(near))
    return Estimate.of(found, len(near))


@claim("Isolated precursors on flat surfaces", "3.1", 3, _FLAT)
def isolated_precursors(evidence: Evidence) -> Iterator[Finding]:
    """Slip precursors occur as single detachment events before the macroscopic sliding phase.

    Tested: most are isolated, and those that are not are less than twice as many as by chance.
    """
    for scene in scenes_along_x(evidence.records, 0):
        for until in (_EARLY, 1.0):
            case, runs = {"t/t_max below": until}, evidence.records[scene]
            observed = over_runs(partial(isolated, until=until), runs)
            chance = over_runs(partial(shuffled, until=until), runs)
            name = (
                "share of the blocks detached by then that let go while all eight neighbours were "
                "at rest since the start"
            )
            yield found_on(scene, name, mean(observed), ranges.MOST, **case, measure="share")
            if not len(observed):
                continue
            name = "share of the others, over that of the same detachment times shuffled"
            claimed, ratio = (-INF, ranges.COMPARABLE[1]), clustering(observed, chance)
            yield found_on(scene, name, ratio, claimed, **case, measure="chance")


def weakest(run: Record) -> float:
    """Share of the m blocks detached before t_max that are among the m weakest of the surface."""
    early = run.t_det < run.t_max
    thresholds, _ = draw_friction(run.t_det.shape, run.seed, run.material)
    bound = np.sort(thresholds, axis=None)[np.count_nonzero(early) - 1]
    return share_of(thresholds <= bound, early)


@claim("Precursors are the weakest blocks", "3.1", 3, _FLAT)
def weakest_first(evidence: Evidence) -> Iterator[Finding]:
    """Slip precursors occur corresponding to the weakest microscopic static friction thresholds.

    Tested: most of them.
    """
    name = "share of the m blocks detached before t_max that have one of the m lowest mu_static"
    return _means(evidence, name, weakest, ranges.MOST)


def lonely(run: Run) -> float:
    """Share of the blocks detaching before 0.9 t_max around which no other has by t_max.

    None of these has started a front by itself in a tenth of t_max.
    """
    alone = np.all(~(neighbours(run.t_det, np.inf) < run.t_max), axis=0)
    return share_of(alone, run.t_det < _EARLY * run.t_max)


@claim("Not every precursor starts a front", "3.1", 3, _FLAT)
def not_all_nucleate(evidence: Evidence) -> Iterator[Finding]:
    """From these events rupture waves may nucleate; not all the precursors trigger a rupture wave
    front.

    Tested: more than a tenth of them stay alone, and less than nine tenths.
    """
    name = "share of the blocks detached before 0.9 t_max around which no other has by t_max"
    return _means(evidence, name, lonely, (1.0 - 0.9, 0.9))


@claim("t_max is the onset of propagation on flat surfaces", "3.1", 2, _FLAT)
def onset(evidence: Evidence) -> Iterator[Finding]:
    """The time instant t_max corresponds to the onset of propagation.

    Tested: less than a tenth of the surface has detached before.
    """
    name = "share of the blocks detached before t_max"
    return _means(evidence, name, before_peak, ranges.NEGLIGIBLE)


def avalanche_lag(run: Run) -> float:
    """Time of the most detachments minus t_max, s."""
    return float(run.time[np.argmax(rates(run, _BURST * run.t_max))]) - run.t_max


@claim("The main avalanche follows t_max on flat surfaces", "3.1", 2, _FLAT)
def avalanche_follows(evidence: Evidence) -> Iterator[Finding]:
    """After t_max there is the main sliding avalanche, highlighted by the peak of the number of
    detachments.
    """
    name = "time of the most detachments, within 2 % of t_max, minus t_max"
    return _means(evidence, name, avalanche_lag, ranges.POSITIVE, "s")


def rate_at_peak(run: Run) -> float:
    """Detachments around t_max over those around the time of the most."""
    counts = rates(run, _BURST * run.t_max)
    return float(counts[np.argmin(np.abs(run.time - run.t_max))] / counts.max())


@claim("Force and detachments peak apart on flat surfaces", "3.1", 2, _FLAT)
def peaks_apart(evidence: Evidence) -> Iterator[Finding]:
    """The two peaks, of force and of detachments, are clearly separated.

    Tested: at the one, detachments are below half of the other.
    """
    name = "detachments within 2 % of t_max around it, over the most in such a time"
    return _means(evidence, name, rate_at_peak, ranges.FEWER_THAN_HALF)


@claim("t_max < t_avg on flat surfaces", "3.1", 2, _FLAT)
def peak_before_average(evidence: Evidence) -> Iterator[Finding]:
    """The force maximum occurs before the average detachment time."""
    for scene in scenes_along_x(evidence.summaries, 0):
        lag = mean(over_rows(lambda row: row["t_max"] - row["t_avg"], evidence.summaries[scene]))
        source = in_table(scene)
        yield Finding(place(scene), "t_max - t_avg", lag, ranges.NEGATIVE, source, "s")


@claim("Detachment times are uniform on flat surfaces", "3.2", 3, f"three {_FLAT} or more")
def uniform(evidence: Evidence) -> Iterator[Finding]:
    """In repeated simulations the spatial distribution of the initial detachment time is
    uniform.
    """
    for scene in scenes_along_x(evidence.records, 0):
        n = scene.n_blocks
        from_edge = np.minimum(np.arange(n), np.arange(n)[::-1])
        depth = np.minimum.outer(from_edge, from_edge)
        core = depth >= min(_CORE, n // 4)
        times = np.stack([run.t_det for run in evidence.records[scene]])
        by_place = Estimate.of(repeatability(times[:, core]), len(times))
        name = "share of the variance of t_det that place explains (jackknife)"
        yield found_on(scene, name, by_place, ranges.ALIKE, part="core")
        late = mean([(t[depth == 0].mean() - t[core].mean()) / t.std() for t in times])
        name, unit = "mean t_det minus that of the core", "standard deviations of t_det"
        yield found_on(scene, name, late, within(_SMALL), unit, part="outermost blocks")


@claim("Nucleation anywhere on flat surfaces", "3.2", 3, _FLAT)
def nucleation_anywhere(evidence: Evidence) -> Iterator[Finding]:
    """On average, each point of the surface has the same probability of being a nucleation point.

    Tested: how far from the edge the first patch of 5 x 5 blocks detaches.
    """
    name = f"share of places nearer to the edge than the {_PATCH} x {_PATCH} blocks detaching first"
    return _means(evidence, name, lambda run: first_patch(run.t_det, _PATCH), within(_SMALL, 0.5))
