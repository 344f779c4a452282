"""Correlation of detachment times along the sides of pillars, section 3.2.

l_c is fitted over r = 1 to 6 blocks on sides of 20 blocks or more; on shorter ones the paper finds
it difficult to estimate. The paper's c_x(r) ~ exp(-r/l_c) leaves the amplitude open, so that
statements on l_c are tested with exp(-r/l_c) and with A exp(-r/l_c).
"""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import partial
from itertools import pairwise, product
from typing import Any

import numpy as np

from springblock.analysis.correlation import LAST, Correlation, side_times
from springblock.analysis.estimate import Estimate
from springblock.analysis.statistics import (
    Interval,
    bootstrap_interval,
    events,
    independent_difference,
)
from springblock.claims import ranges, samples
from springblock.claims.ranges import INF, PLAIN, SCALED
from springblock.claims.rule import Case, Evidence, Finding, tests_statement
from springblock.claims.samples import found_on, interval
from springblock.claims.surfaces import ALONG, case_of, in_rows, pillars
from springblock.io.rows import Row
from springblock.model.numbers import Array
from springblock.model.scene import Scene

_DECAYED = (-INF, float(np.exp(-1.0)))
_BROAD = 20  #: n_p from which on l_c is fitted over the same distances
#: Columns of the length and of its limits, by fit.
_FITS = {PLAIN: ("l_c", "ci"), SCALED: ("tail", "tail")}


def paired_difference(first: Estimate, second: Estimate) -> Estimate:
    """Return first - second of the same runs; errors add up, as their correlation is unknown."""
    low, high = first.ci_low - second.ci_high, first.ci_high - second.ci_low
    return Estimate(first.value - second.value, low, high, min(first.n, second.n))


def unpaired_difference(first: Estimate, second: Estimate) -> Estimate:
    """Return first - second of different surfaces, with errors taken as independent.

    Realisations of different surfaces with the same seeds are hardly correlated.
    """
    ends = (Interval(*map(np.array, (e.value, e.ci_low, e.ci_high))) for e in (first, second))
    return Estimate.of(independent_difference(*ends), min(first.n, second.n))


def _length(rows: Iterable[Row], name: str, limits: str) -> Estimate:
    """Return a length of c_x from its columns, blocks."""
    (row,) = (row for row in rows if row["side"] == "x")
    return interval(row, name, limits)


def _case(scene: Scene, **more: Any) -> Case:
    return replace(case_of(scene), **more)


def mixed(times: Array) -> Array:
    """Take each block of the sides from another realisation, which leaves only chance."""
    k, n = len(times), times.shape[-1]
    blocks = np.arange(n)
    taken = (np.arange(k)[:, None] + blocks) % k
    return np.moveaxis(times[taken, ..., blocks], 1, -1)


def _sides_of(evidence: Evidence, scene: Scene, side: str) -> tuple[Array, Array]:
    """Return t_det/t_max along the sides without their corners, which detach earlier.

    As simulated and with each block from another realisation, (k, pillars, 2, n_p - 2) each.
    """
    runs = evidence.records[scene]
    times = side_times(runs, scene.pattern, side)[..., 1:-1]
    relative = times / np.array([run.t_max for run in runs])[:, None, None, None]
    return relative, mixed(relative)


@tests_statement
def correlated_along(evidence: Evidence) -> Iterator[Finding]:
    name = "c_x(r = 3) - c_y(r = 3) (sum of both intervals)"
    for scene, rows in pillars(evidence.correlation, _BROAD).items():
        c = {(row["side"], row["r"]): interval(row, "correlation") for row in rows}
        apart, case = paired_difference(c["x", 3], c["y", 3]), _case(scene, part="correlation")
        yield Finding(case, name, apart, ranges.POSITIVE, in_rows("correlation", scene, r=3))
        source = in_rows("correlation", scene, side="y", r=1)
        yield Finding(case, "c_y(r = 1)", c["y", 1], _DECAYED, source)
    name = "the size of an event in excess of chance, on sides along x minus that on sides along y"
    for scene in pillars(evidence.records):
        excess = []
        for side in "xy":
            number = [events(times).mean(axis=(1, 2)) for times in _sides_of(evidence, scene, side)]
            excess.append((scene.n_p - 2) / number[0] - (scene.n_p - 2) / number[1])
        larger, case = samples.mean(excess[0] - excess[1]), _case(scene, part="events")
        yield found_on(scene, name, larger, ranges.POSITIVE, "blocks", case)


def misfits(correlation: Array, is_free: bool = True) -> list[Array]:
    """Return the rms deviation of c(r), (b, r) from r = 1 on, from the best curve of each kind.

    Exponentials, power laws and straight lines, each with a length on a grid, and with an amplitude
    that is free or 1; (b,) each.
    """
    r = np.arange(1.0, correlation.shape[-1] + 1.0)
    lengths = np.geomspace(0.1, 100.0, 200)[:, None]
    power_law, line = (1.0 + r) ** (-1.0 / lengths), np.maximum(0.0, 1.0 - r / lengths)
    found = []
    for curves in (np.exp(-r / lengths), power_law, line):
        square = np.maximum((curves**2).sum(axis=-1), np.finfo(float).tiny)
        common = correlation @ curves.T
        explained = common**2 / square if is_free else 2.0 * common - square
        left = (correlation**2).sum(axis=-1) - explained.max(axis=-1)
        found.append(np.sqrt(np.maximum(left, 0.0) / len(r)))
    return found


@tests_statement
def exponential(evidence: Evidence) -> Iterator[Finding]:
    for (scene, runs), (curve, is_free) in product(
        pillars(evidence.records, _BROAD).items(), {PLAIN: False, SCALED: True}.items()
    ):
        found = Correlation(side_times(runs, scene.pattern, ALONG))
        deviations = partial(_deviations, found, is_free)
        intervals = np.transpose(bootstrap_interval(deviations, len(runs)))
        names = ("", " minus that from the best power law", " minus that from the best line")
        claims = ((-INF, 0.05), ranges.NEGATIVE, ranges.NEGATIVE)
        for more, claimed, each in zip(names, claims, intervals, strict=True):
            apart = Estimate.of(Interval(*each), len(runs))
            statistic = f"the rms deviation of c_x from the best exponential{more}"
            yield found_on(scene, statistic, apart, claimed, case=_case(scene, fit=curve))


def _deviations(found: Correlation, is_free: bool, weights: Array) -> Array:
    """Return the deviation from the exponential, and that minus those from the other curves."""
    exponential, *others = misfits(found.weighted(weights)[:, 1 : LAST + 1], is_free)
    return np.column_stack([exponential, *(exponential - other for other in others)])


@tests_statement
def three_blocks(evidence: Evidence) -> Iterator[Finding]:
    for scene, rows in pillars(evidence.correlation_length, _BROAD).items():
        source = in_rows("correlation_length", scene, side="x")
        for curve, columns in _FITS.items():
            case, length = _case(scene, fit=curve), _length(rows, *columns)
            yield Finding(case, "l_c of c_x", length, (3.0, INF), source, "blocks")


@tests_statement
def growing_length(evidence: Evidence) -> Iterator[Finding]:
    name = "l_c minus that on the next smaller pillars (from both intervals)"
    for (small, few), (large, many) in pairwise(
        pillars(evidence.correlation_length, _BROAD).items()
    ):
        source = f"tables/correlation_length: n_p = {small.n_p} and {large.n_p}, side = x"
        for curve, columns in _FITS.items():
            growth = unpaired_difference(_length(many, *columns), _length(few, *columns))
            case = _case(large, against_n_p=small.n_p, fit=curve)
            yield Finding(case, name, growth, ranges.POSITIVE, source, "blocks")
