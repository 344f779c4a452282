"""What an ensemble shows: means with their intervals, pillars, load peaks.

The intervals are bootstrap intervals over realisations (Efron & Tibshirani 1993,
doi:10.1201/9780429246593); the observables are those of Costagliola, Bosia & Pugno 2022,
doi:10.1016/j.ijsolstr.2022.111525.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from springblock.pattern import Pattern
from springblock.run import Array, Run, friction, percent

_INTERVAL = (2.5, 97.5)  #: percentiles
#: Force at a load peak over the largest, at least: after the peak it falls to two thirds or less.
_LOAD_PEAK = 0.9


class Interval(NamedTuple):
    """A mean and the limits of its 95 % interval, each of the same shape."""

    mean: Array
    low: Array
    high: Array


def bootstrap_weights(k: int, seed: int = 0, resamples: int = 1000) -> Array:
    """Weights of k realisations in bootstrap resamples, (resamples, k); each row sums to 1."""
    drawn = np.random.default_rng(seed).multinomial(k, np.full(k, 1.0 / k), size=resamples)
    return drawn / k


def limits(resampled: Array) -> tuple[Array, Array]:
    """Limits of the 95 % percentile interval, (...), of resampled values, (resamples, ...)."""
    low, high = np.percentile(resampled, _INTERVAL, axis=0)
    return low, high


def mean_interval(values: ArrayLike, seed: int = 0, resamples: int = 1000) -> Interval:
    """Mean over k realisations, (k, ...), with its 95 % bootstrap percentile interval, (...).

    Realisations are drawn as wholes, so what belongs to one of them stays together. A single
    one says nothing about its spread: its limits are NaN.
    """
    values = np.asarray(values, dtype=float)
    k, shape = len(values), values.shape[1:]
    mean = values.mean(axis=0)
    if k == 1:
        return Interval(mean, np.full(shape, np.nan), np.full(shape, np.nan))
    means = bootstrap_weights(k, seed, resamples) @ values.reshape(k, -1)
    low, high = limits(means)
    return Interval(mean, low.reshape(shape), high.reshape(shape))


def half_widths(
    values: Array, sizes: Iterable[int], subsets: int = 30, seed: int = 0
) -> dict[int, float]:
    """Half the width of the interval of a mean over fewer of the k realisations, (k,), by number.

    Means over random subsets; numbers beyond k are left out.
    """
    rng = np.random.default_rng(seed)
    widths: dict[int, float] = {}
    for size in sizes:
        if size > len(values):
            break
        drawn = [rng.permutation(values)[:size] for _ in range(subsets)]
        _, low, high = mean_interval(np.stack(drawn, axis=1), seed=int(rng.integers(2**32)))
        widths[size] = float(np.mean(high - low)) / 2.0
    return widths


def standard_error(values: Array) -> Array:
    """Standard error of the mean over k realisations, (k, ...); infinite for a single one."""
    k = len(values)
    if k == 1:
        return np.full(values.shape[1:], np.inf)
    return values.std(axis=0, ddof=1) / np.sqrt(k)


def ratio_interval(numerator: ArrayLike, denominator: ArrayLike, seed: int = 0) -> Interval:
    """Ratio of two means over the same k realisations, (k,) each, with its 95 % interval.

    Bootstrap as in `mean_interval`; a realisation brings its share of both means.
    """
    pairs = np.stack([numerator, denominator]).astype(float)
    k = pairs.shape[1]
    top, bottom = pairs.mean(axis=1)
    if k == 1:
        return Interval(top / bottom, np.array(np.nan), np.array(np.nan))
    weights = bootstrap_weights(k, seed)
    tops, bottoms = (weights @ values for values in pairs)
    return Interval(top / bottom, *limits(tops / bottoms))


def repeatability(fields: Array) -> Interval:
    """Share of the variance over places that is the same in all k fields, (k, places).

    It is the mean covariance of two fields over their mean variance, the means of both taken
    out: zero, but for scatter, where no place differs from another on average, and one where all
    fields are alike (the intraclass correlation, Shrout & Fleiss 1979,
    doi:10.1037/0033-2909.86.2.420). The 95 % interval is Student's, with the jackknife's error:
    a bootstrap would compare fields with themselves. NaN below three fields.
    """
    from scipy.stats import t  # slow to load, and most jobs do without

    k = len(fields)
    if k < 3:
        return Interval(*np.full(3, np.nan))
    centred = fields - fields.mean(axis=1, keepdims=True)
    products = centred @ centred.T
    variances = np.diag(products)
    crossed = products.sum(axis=1) - variances

    def share(covariance: Array, variance: Array, n: int) -> Array:
        return covariance / (n - 1) / variance

    whole = share(crossed.sum(), variances.sum(), k)
    without = share(crossed.sum() - 2.0 * crossed, variances.sum() - variances, k - 1)
    half = t.ppf(0.975, k - 1) * np.sqrt(k - 1) * without.std()
    return Interval(whole, whole - half, whole + half)


def cut(runs: Sequence[Run], curves: Sequence[Array]) -> tuple[Array, Array]:
    """Time in s, (n,), and curves, (runs, n), of the samples that all runs have.

    Raises
    ------
    ValueError
        Where the runs do not share one sample interval.
    """
    n = min(len(curve) for curve in curves)
    time = runs[0].time[:n]
    if not all(np.allclose(run.time[:n], time) for run in runs):
        raise ValueError("the runs of an ensemble must share one sample interval")
    return time, np.stack([curve[:n] for curve in curves])


@dataclass(frozen=True, eq=False)
class Curve:
    """Force and detachments of k realisations, as long as the shortest of them."""

    time: Array  #: (n,) s
    friction: Array  #: (k, n) force over P l² N²
    detachments: Array  #: (k, n) first detachments since the sample before, % of all of the run

    def binned(self, width: float) -> tuple[Array, Array]:
        """Edges of bins of about `width` s, (bins + 1,), and detachments in each, (k, bins), %.

        A bin holds whole sample intervals, at least one; what does not fill a bin is left out.
        """
        interval = self.time[1] - self.time[0]
        size = max(1, round(width / interval))
        bins = (len(self.time) - 1) // size
        counts = self.detachments[:, 1 : bins * size + 1]
        return self.time[: bins * size + 1 : size], counts.reshape(-1, bins, size).sum(axis=2)


def common_curve(runs: Sequence[Run]) -> Curve:
    """Cut the force and detachment curves of an ensemble to its shortest run."""
    time, forces = cut(runs, [friction(run) for run in runs])
    _, shares = cut(runs, [percent(run, run.detachments) for run in runs])
    return Curve(time, forces, shares)


def pillar_map(runs: Sequence[Run], pattern: Pattern) -> Array:
    """Return t_det/t_max by place on a pillar, [y_p, x_p], mean over pillars; (k, n_p, n_p).

    NaN where a block of some pillar is not in contact or never detached. Section 3.2, figure 5.

    Raises
    ------
    ValueError
        Where the surface is flat.
    """
    if not pattern.levels:
        raise ValueError("a flat surface has no pillar to average over")
    size = pattern.levels[0].size
    rows, columns = (pattern.origins[:, axis, None] + np.arange(size) for axis in (0, 1))
    pillars = rows[:, :, None], columns[:, None, :]
    return np.stack([(run.t_det[pillars] / run.t_max).mean(axis=0) for run in runs])


def pillar_ring(size: int, depth: int) -> dict[str, NDArray[np.bool_]]:
    """Masks, [y_p, x_p], of the blocks that are `depth` blocks from the edge of a pillar.

    They are told apart as the "corners" of this ring, and its sides along "x" and along "y"
    without the corners. In the middle of a pillar only corners are left.
    """
    from_edge = np.minimum(np.arange(size), np.arange(size)[::-1])
    y, x = np.meshgrid(from_edge, from_edge, indexing="ij")
    return {
        "corners": (x == depth) & (y == depth),
        "y": (x == depth) & (y > depth),
        "x": (y == depth) & (x > depth),
    }


def load_peaks(curve: Array, scatter: ArrayLike, share: float = 0.01) -> NDArray[np.intp]:
    """Find the peaks of a force curve, (n,), under load; their indices.

    A peak must stand out of its surroundings by two standard errors of the mean, `scatter`, and
    by `share` of the largest force, which keeps out the small waves of loading; and it must reach
    `_LOAD_PEAK` of the largest force, which keeps out those of sliding. Section 3.3.
    """
    from scipy.signal import find_peaks  # slow to load, and few figures look for peaks

    needed = np.maximum(2.0 * np.broadcast_to(scatter, curve.shape), share * curve.max())
    return find_peaks(curve, prominence=needed, height=_LOAD_PEAK * curve.max())[0]


def load_peak_number(curves: Array, seed: int = 0, resamples: int = 1000) -> Interval:
    """Count the load peaks of the mean of k force curves, (k, n), with a bootstrap interval."""
    k = len(curves)
    number = len(load_peaks(curves.mean(axis=0), standard_error(curves)))
    if k == 1:
        return Interval(np.array(number), np.array(np.nan), np.array(np.nan))
    weights = bootstrap_weights(k, seed, resamples)
    means = weights @ curves
    variances = np.maximum(weights @ curves**2 - means**2, 0.0)
    scatters = np.sqrt(variances / (k - 1))
    counts = [len(load_peaks(m, scatter)) for m, scatter in zip(means, scatters, strict=True)]
    return Interval(np.array(number), *limits(np.array(counts)))


def lesser_prominence(curve: Array) -> float:
    """Prominence of the second most prominent peak under load, (n,), over the largest force.

    How far the force falls between two load peaks, from the lower of them; 0 with one alone.
    """
    from scipy.signal import find_peaks  # slow to load, and few figures look for peaks

    highest = float(curve.max())
    _, found = find_peaks(curve, prominence=0.0, height=_LOAD_PEAK * highest)
    prominences = np.sort(found["prominences"])
    return float(prominences[-2]) / highest if len(prominences) > 1 else 0.0
