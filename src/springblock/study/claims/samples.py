"""Samples of one number per realisation, estimates from them, and findings."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from operator import attrgetter
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from springblock.analysis.estimate import UNKNOWN, Estimate
from springblock.analysis.statistics import difference_interval, interval_of_means, mean_interval
from springblock.io.records import Record
from springblock.io.rows import Row
from springblock.model.numbers import Array
from springblock.model.scene import Scene
from springblock.simulation.run import Run
from springblock.study.claims.rule import POSITIVE, Case, Evidence, Finding, Range
from springblock.study.claims.surfaces import Mask, case_of

T = TypeVar("T")
Quantity = Callable[[Record], float]  #: of a realisation

_HIGH = 0.95  #: of the largest force, at which the width of its peak is measured
static_friction: Quantity = attrgetter("static_friction")


def over_runs(quantity: Callable[[T], float], runs: Iterable[T]) -> Array:
    """Return a number per realisation, (k,), without those that are NaN."""
    values = np.array([quantity(run) for run in runs], dtype=float)
    return values[np.isfinite(values)]


def interval(row: Row, value: str, limits: str = "ci") -> Estimate:
    """Return a value of a row with its interval."""
    low, high = float(row[f"{limits}_low"]), float(row[f"{limits}_high"])
    return Estimate(float(row[value]), low, high, row["realisations"])


def mean(sample: ArrayLike) -> Estimate:
    """Return the mean of a sample, (k,), with its interval; NaN for an empty one."""
    values = np.asarray(sample)
    return Estimate.of(mean_interval(values), len(values)) if len(values) else UNKNOWN


def share(sample: ArrayLike) -> Estimate:
    """Return the mean of a sample of shares, (k,), with an interval between 0 and 1."""
    return replace(mean(sample), bounds=(0.0, 1.0))


def difference(first: Array, second: Array) -> Estimate:
    """Return the difference of the means of two independent samples (Welch)."""
    fewest = min(len(first), len(second))
    return Estimate.of(difference_interval(first, second), fewest) if fewest else UNKNOWN


def position(sample: Array, zero: Array, one: Array) -> Estimate:
    """Return the position of the mean of `sample` between those of `zero`, 0, and `one`, 1; BCa.

    The interval is NaN where `zero` and `one` do not differ significantly.
    """
    samples = sample, zero, one
    scale, fewest = difference(one, zero), min(map(len, samples))
    if fewest < 2 or scale.ci_low <= 0.0 <= scale.ci_high:
        return UNKNOWN

    def relative_place(middle: Array, start: Array, end: Array) -> Array:
        return (middle - start) / (end - start)

    return Estimate.of(interval_of_means(relative_place, samples), fewest)


def on_each(
    scenes: Mapping[Scene, Sequence[T]],
    statistic: str,
    quantity: Callable[[T], float],
    claimed: Range,
    unit: str = "1",
    estimate: Callable[[ArrayLike], Estimate] = mean,
    **case: Any,
) -> Iterator[Finding]:
    """Yield the estimate of a quantity of the realisations of each scene."""
    for scene, runs in scenes.items():
        found, where = estimate(over_runs(quantity, runs)), case_of(scene, **case)
        yield Finding(where, statistic, found, claimed, [scene], unit)


share_on_each = partial(on_each, estimate=share)  #: its interval stays between 0 and 1


def compared(
    evidence: Evidence,
    statistic: str,
    quantity: Quantity,
    pair: tuple[Scene, Scene],
    claimed: Range = POSITIVE,
    case: Case | None = None,
) -> Finding:
    """Return the mean of a quantity over the realisations of one scene minus that of another.

    One surface that slides in two directions is compared seed by seed: equal seeds have equal
    friction coefficients in both.
    """
    (first, second), (runs, others) = pair, (evidence.records[scene] for scene in pair)
    if replace(first, direction=second.direction) == second:
        there = {run.seed: quantity(run) for run in others}
        apart = mean([quantity(run) - there[run.seed] for run in runs if run.seed in there])
    else:
        apart = difference(over_runs(quantity, runs), over_runs(quantity, others))
    return Finding(case or case_of(first), statistic, apart, claimed, pair)


def before_peak(run: Run) -> float:
    """Return the share of all detaching blocks that detach before t_max."""
    return share_of(run.t_det < run.t_max, np.isfinite(run.t_det))


def lag(run: Run) -> float:
    """Return t_max - t_avg, s."""
    return run.t_max - run.t_avg


def relative_lag(run: Run) -> float:
    """Return (t_max - t_avg)/t_max."""
    return lag(run) / run.t_max


def width(run: Run) -> float:
    """Return the time during which the force exceeds 95 % of its maximum, over t_max."""
    force = run.force[run.onset]
    samples = np.count_nonzero(force > _HIGH * force.max())
    return float(samples * (run.time[1] - run.time[0]) / run.t_max)


def lasting(run: Run, first: float = 0.1) -> float:
    """Return the time from a share of the first detachments to all but this share, over t_max."""
    early, late = np.nanquantile(run.t_det, (first, 1.0 - first))
    return float(late - early) / run.t_max


def isolated(run: Run) -> float:
    """Return the share of the blocks detached before t_max that detach before all neighbours."""
    padded = np.pad(run.t_det, 1, constant_values=np.inf)
    around = np.lib.stride_tricks.sliding_window_view(padded, (3, 3))  # with the block itself
    alone = run.t_det <= np.fmin.reduce(np.fmin.reduce(around, axis=-1), axis=-1)
    return share_of(alone, run.t_det < run.t_max)


def share_of(blocks: Mask, among: Mask) -> float:
    """Return the share of the blocks `among` that are also in `blocks`; NaN if there are none."""
    return float(blocks[among].mean()) if among.any() else float("nan")
