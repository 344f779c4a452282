"""Samples of one number per realisation, estimates from them, and findings."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from operator import attrgetter
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from springblock.analysis.estimate import UNKNOWN, Estimate
from springblock.analysis.statistics import (
    difference_interval,
    mean_interval,
    samples_interval,
)
from springblock.claims import ranges, surfaces
from springblock.claims.rule import Case, Evidence, Finding, Range
from springblock.claims.surfaces import Mask
from springblock.io.records import Record
from springblock.io.rows import Row
from springblock.model.numbers import Array
from springblock.model.scene import Scene
from springblock.simulation.run import Run

T = TypeVar("T")
Quantity = Callable[[Record], float]  #: of a realisation

_HIGH = 0.95  #: of the largest force, at which the width of its peak is measured
static_friction: Quantity = attrgetter("static_friction")


def over_runs(quantity: Callable[[T], float], runs: Iterable[T]) -> Array:
    """Return a number per realisation, (k,), without those that are NaN."""
    values = np.array([quantity(run) for run in runs], dtype=float)
    return values[np.isfinite(values)]


def friction(evidence: Evidence, scene: Scene) -> Array:
    """Return the static friction of each realisation of a scene, (k,)."""
    return over_runs(static_friction, evidence.records[scene])


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


def relative(first: Array, second: Array, base: Array) -> Estimate:
    """Return the difference of two means over a third mean, whose error is neglected."""
    apart, scale = difference(first, second), mean(base).value
    if not scale:
        return UNKNOWN
    return Estimate(apart.value / scale, apart.ci_low / scale, apart.ci_high / scale, apart.n)


def magnitude(estimate: Estimate) -> Estimate:
    """Return the absolute value; its upper limit is that of the end further from zero."""
    value, ends = estimate.value, (estimate.ci_low, estimate.ci_high)
    nearer = -ends[1] if value < 0.0 else ends[0]
    return Estimate(abs(value), nearer, float(np.max(np.abs(ends))), estimate.n)


def position(sample: Array, zero: Array, one: Array) -> Estimate:
    """Return the position of the mean of `sample` between those of `zero`, 0, and `one`, 1; BCa.

    The interval is NaN where `zero` and `one` do not differ significantly.
    """
    samples = sample, zero, one
    scale, fewest = difference(one, zero), min(map(len, samples))
    if fewest < 2 or scale.ci_low <= 0.0 <= scale.ci_high:
        return UNKNOWN

    def relative_place(*parts: Array, axis: int) -> Array:
        middle, start, end = (part.mean(axis=axis) for part in parts)
        return (middle - start) / (end - start)

    return Estimate.of(samples_interval(samples, relative_place), fewest)


def found_on(
    scene: Scene,
    statistic: str,
    estimate: Estimate,
    claimed: Range,
    unit: str = "1",
    case: Case | None = None,
    beside: Iterable[Scene] = (),
) -> Finding:
    """Return a finding on a scene, by default with its lengths as the case."""
    case = case or surfaces.case_of(scene)
    return Finding(case, statistic, estimate, claimed, surfaces.in_files(scene, *beside), unit)


def on_each(
    scenes: Mapping[Scene, Sequence[T]],
    statistic: str,
    quantity: Callable[[T], float],
    claimed: Range,
    unit: str = "1",
    estimate: Callable[[ArrayLike], Estimate] = mean,
    part: str | None = None,
) -> Iterator[Finding]:
    """Yield the estimate of a quantity of the realisations of each scene."""
    for scene, runs in scenes.items():
        found, case = (
            estimate(over_runs(quantity, runs)),
            replace(surfaces.case_of(scene), part=part),
        )
        yield found_on(scene, statistic, found, claimed, unit, case)


share_on_each = partial(on_each, estimate=share)  #: its interval stays between 0 and 1


def compared(
    evidence: Evidence,
    statistic: str,
    quantity: Quantity,
    first: Scene,
    second: Scene,
    claimed: Range = ranges.POSITIVE,
    case: Case | None = None,
) -> Finding:
    """Return the mean of a quantity over the realisations of one scene minus that of another.

    One surface that slides in two directions is compared seed by seed: equal seeds have equal
    friction coefficients in both.
    """
    runs, others = evidence.records[first], evidence.records[second]
    if replace(first, direction=second.direction) == second:
        there = {run.seed: quantity(run) for run in others}
        apart = mean([quantity(run) - there[run.seed] for run in runs if run.seed in there])
    else:
        apart = difference(over_runs(quantity, runs), over_runs(quantity, others))
    return found_on(first, statistic, apart, claimed, case=case, beside=[second])


def before_peak(run: Run) -> float:
    """Return the share of all detaching blocks that detach before t_max."""
    times = run.t_det[np.isfinite(run.t_det)]
    return float(np.mean(times < run.t_max))


def lag(run: Run) -> float:
    """Return t_max - t_avg, s."""
    return run.t_max - run.t_avg


def relative_lag(run: Run) -> float:
    """Return (t_max - t_avg)/t_max."""
    return lag(run) / run.t_max


def neighbours(field: Array, outside: float) -> Array:
    """Return the values of the eight neighbours, (8, N, N), with `outside` beyond the edges."""
    padded, (rows, columns) = np.pad(field, 1, constant_values=outside), field.shape
    shifts = [(y, x) for y in range(3) for x in range(3) if (y, x) != (1, 1)]
    return np.stack([padded[y : y + rows, x : x + columns] for y, x in shifts])


def width(run: Run) -> float:
    """Return the time during which the force exceeds 95 % of its maximum, over t_max."""
    samples = np.count_nonzero(run.force > _HIGH * run.force.max())
    return float(samples * (run.time[1] - run.time[0]) / run.t_max)


def lasting(run: Run, first: float = 0.1) -> float:
    """Return the time from a share of the first detachments to all but this share, over t_max."""
    early, late = np.nanquantile(run.t_det, (first, 1.0 - first))
    return float(late - early) / run.t_max


def isolated(run: Run) -> float:
    """Return the share of the blocks detached before t_max that detach before all neighbours.

    Blocks that never detach, NaN, count as later.
    """
    alone = np.all(~(neighbours(run.t_det, np.inf) < run.t_det), axis=0)
    return share_of(alone, run.t_det < run.t_max)


def share_of(blocks: Mask, among: Mask) -> float:
    """Return the share of the blocks `among` that are also in `blocks`; NaN if there are none."""
    return float(blocks[among].mean()) if among.any() else float("nan")
