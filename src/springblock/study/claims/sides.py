"""Correlation of detachment times along the sides of pillars, section 3.2.

l_c is fitted over r = 1 to 6 blocks on sides of 20 blocks or more; on shorter ones the paper finds
it difficult to estimate. The paper's c_x(r) ~ exp(-r/l_c) leaves the amplitude open, so that
statements on l_c are tested with exp(-r/l_c) and with A exp(-r/l_c).
"""

from collections.abc import Iterable, Iterator
from functools import partial
from itertools import pairwise, product

import numpy as np

from springblock.analysis.correlation import LAST, Correlation, misfits, side_times
from springblock.analysis.estimate import Estimate
from springblock.analysis.statistics import Interval, bootstrap_interval, events
from springblock.io.rows import Row, select
from springblock.model.numbers import Array
from springblock.model.scene import Scene
from springblock.study.claims import rule, samples
from springblock.study.claims.rule import INF, Evidence, Finding, tests_statement
from springblock.study.claims.surfaces import ALONG, PLAIN, SCALED, case_of, pillars

_DECAYED = (-INF, float(np.exp(-1.0)))
_BROAD = 20  #: n_p from which on l_c is fitted over the same distances
#: Columns of the length and of its limits, by fit.
_FITS = {PLAIN: ("l_c", "ci"), SCALED: ("tail", "tail")}


def _length(rows: Iterable[Row], name: str, limits: str) -> Estimate:
    """Return a length of c_x from its columns, blocks."""
    (row,) = select(rows, side="x")
    return samples.interval(row, name, limits)


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
        c = {(row["side"], row["r"]): samples.interval(row, "correlation") for row in rows}
        apart, case = c["x", 3].minus_paired(c["y", 3]), case_of(scene, part="correlation")
        yield Finding(case, name, apart, rule.POSITIVE, [scene])
        yield Finding(case, "c_y(r = 1)", c["y", 1], _DECAYED, [scene])
    name = "the size of an event in excess of chance, on sides along x minus that on sides along y"
    for scene in pillars(evidence.records):
        excess = []
        for side in "xy":
            number = [events(times).mean(axis=(1, 2)) for times in _sides_of(evidence, scene, side)]
            excess.append((scene.n_p - 2) / number[0] - (scene.n_p - 2) / number[1])
        larger, case = samples.mean(excess[0] - excess[1]), case_of(scene, part="events")
        yield Finding(case, name, larger, rule.POSITIVE, [scene], "blocks")


@tests_statement
def exponential(evidence: Evidence) -> Iterator[Finding]:
    for (scene, runs), (curve, is_free) in product(
        pillars(evidence.records, _BROAD).items(), {PLAIN: False, SCALED: True}.items()
    ):
        found = Correlation(side_times(runs, scene.pattern, ALONG))
        deviations = partial(_deviations, found, is_free)
        intervals = np.transpose(bootstrap_interval(deviations, len(runs)))
        names = ("", " minus that from the best power law", " minus that from the best line")
        claims = ((-INF, 0.05), rule.NEGATIVE, rule.NEGATIVE)
        for more, claimed, each in zip(names, claims, intervals, strict=True):
            apart = Estimate.of(Interval(*each), len(runs))
            statistic = f"the rms deviation of c_x from the best exponential{more}"
            case = case_of(scene, fit=curve)
            yield Finding(case, statistic, apart, claimed, [scene])


def _deviations(found: Correlation, is_free: bool, weights: Array) -> Array:
    """Return the deviation from the exponential, and that minus those from the other curves."""
    exponential, *others = misfits(found.weighted(weights)[:, 1 : LAST + 1], is_free)
    return np.column_stack([exponential, *(exponential - other for other in others)])


@tests_statement
def three_blocks(evidence: Evidence) -> Iterator[Finding]:
    for scene, rows in pillars(evidence.correlation_length, _BROAD).items():
        for curve, columns in _FITS.items():
            case, length = case_of(scene, fit=curve), _length(rows, *columns)
            yield Finding(case, "l_c of c_x", length, (3.0, INF), [scene], "blocks")


@tests_statement
def growing_length(evidence: Evidence) -> Iterator[Finding]:
    name = "l_c minus that on the next smaller pillars (from both intervals)"
    found = pillars(evidence.correlation_length, _BROAD).items()
    for ((small, few), (large, many)), (curve, columns) in product(pairwise(found), _FITS.items()):
        growth = _length(many, *columns) - _length(few, *columns)
        case = case_of(large, against_n_p=small.n_p, fit=curve)
        yield Finding(case, name, growth, rule.POSITIVE, [small, large], "blocks")
