"""What an ensemble shows: means with their intervals, pillars, load peaks.

Intervals are 95 % intervals over realisations. Those of means are Student's; other statistics have
bias-corrected and accelerated bootstrap intervals (BCa; Efron & Tibshirani 1993,
doi:10.1201/9780429246593, chapter 14). Of 10 or 20 realisations both cover the truth more nearly
as often as they say than bootstrap percentiles. The observables are those of Costagliola, Bosia &
Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525.
"""

import warnings
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from springblock.model.pattern import Pattern
from springblock.simulation.run import Array, Run, friction, percent

_LEVEL = 0.95  #: of all intervals
_RESAMPLES = 2000
_SUBSETS = 30  #: over which the width of an interval is averaged
#: Force at a load peak over the largest, at least: after the peak it falls to two thirds or less.
_LOAD_PEAK = 0.9
_PROMINENT = 0.01  #: prominence of a load peak over the largest force, at least


class Interval(NamedTuple):
    """A mean and the limits of its 95 % interval, each of the same shape."""

    mean: Array
    low: Array
    high: Array


def students_t(freedom: ArrayLike, level: float = _LEVEL) -> Array:
    """Half an interval of this level in standard errors, by degrees of freedom."""
    from scipy.special import stdtrit  # slow to load, and most jobs do without

    return stdtrit(freedom, 0.5 + level / 2.0)


def mean_interval(values: ArrayLike) -> Interval:
    """Mean over k realisations, (k, ...), with its 95 % interval of Student's t, (...).

    A single realisation says nothing about its spread: its limits are NaN, as Student's t is
    without a degree of freedom.
    """
    values = np.asarray(values, dtype=float)
    mean = values.mean(axis=0)
    half = students_t(len(values) - 1) * standard_error(values)
    return Interval(mean, mean - half, mean + half)


def difference_interval(first: ArrayLike, second: ArrayLike) -> Interval:
    """Mean of the first sample minus that of the second, (k,) and (l,), with its 95 % interval.

    The samples are independent and may differ in their variances (Welch 1947,
    doi:10.1093/biomet/34.1-2.28). NaN limits where one of them is a single realisation.
    """
    samples = [np.asarray(sample, dtype=float) for sample in (first, second)]
    mean = samples[0].mean() - samples[1].mean()
    sizes = np.array([len(sample) for sample in samples])
    if sizes.min() < 2:
        return Interval(mean, *np.full(2, np.nan))
    squares = np.array([standard_error(sample) for sample in samples]) ** 2
    error = squares.sum()
    freedom = error**2 / (squares**2 / (sizes - 1)).sum() if error > 0.0 else 1.0
    half = students_t(freedom) * np.sqrt(error)
    return Interval(mean, mean - half, mean + half)


def samples_interval(
    samples: Sequence[ArrayLike],
    statistic: Callable[..., Array],
    resamples: int = _RESAMPLES,
    batch: int | None = None,
) -> Interval:
    """A statistic of independent samples, (k,) each, with its 95 % BCa interval.

    `statistic` takes samples, (..., k), and their `axis`, and returns values, (...). Every sample,
    of two realisations or more, is resampled by itself, in batches that decide what is drawn.
    Limits are percentiles where no realisation alone changes anything.
    """
    samples = tuple(np.asarray(part) for part in samples)
    options = {"random_state": np.random.default_rng(0), "n_resamples": resamples, "batch": batch}
    return _bca(np.asarray(statistic(*samples, axis=-1)), samples, statistic, **options)


def _bca(
    value: Array, samples: Sequence[Any], statistic: Callable[..., Array], **options: Any
) -> Interval:
    """A value with its BCa limits, or percentiles where these do not exist."""
    from scipy.stats import DegenerateDataWarning, bootstrap  # slow to load

    options |= {"method": "BCa", "vectorized": True, "confidence_level": _LEVEL}
    with warnings.catch_warnings(), np.errstate(invalid="ignore", divide="ignore"):
        warnings.simplefilter("ignore", DegenerateDataWarning)
        found = bootstrap(samples, statistic, **options)
    tail = 50.0 * (1.0 - _LEVEL)
    plain = np.percentile(found.bootstrap_distribution, (tail, 100.0 - tail), axis=-1)
    limits = np.asarray(found.confidence_interval)
    return Interval(value, *np.where(np.isnan(limits), plain, limits))


def proportion_interval(hits: int, k: int, level: float = _LEVEL) -> Interval:
    """Proportion of k realisations, with the exact interval of Clopper and Pearson 1934."""
    from scipy.stats import binomtest  # slow to load, and most jobs do without

    low, high = binomtest(hits, k).proportion_ci(level)
    return Interval(np.array(hits / k), np.array(low), np.array(high))


def bootstrap_weights(k: int) -> Array:
    """Weights of k realisations in bootstrap resamples, (resamples, k); each row sums to 1.

    Resamples of one realisation alone are left out: they have no variance.
    """
    drawn = np.random.default_rng(0).multinomial(k, np.full(k, 1.0 / k), size=_RESAMPLES)
    return drawn[drawn.max(axis=1) < k] / k


def bootstrap_interval(statistic: Callable[[Array], Array], k: int) -> Interval:
    """Any statistic of k realisations with its 95 % BCa interval, (...).

    `statistic` turns sets of weights of the realisations, (b, k), each of sum 1, into values,
    (b, ...). Realisations are drawn as wholes, so what belongs to one of them stays together.
    Limits are percentiles where leaving out any one realisation changes nothing, and NaN below
    three realisations.
    """

    def of_drawn(drawn: NDArray[np.intp], axis: int) -> Array:
        flat = drawn.reshape(-1, drawn.shape[axis])
        values = np.moveaxis(statistic(weights_of(flat, k)), 0, -1)
        return values.reshape((*values.shape[:-1], *drawn.shape[:-1]))

    value = statistic(np.full((1, k), 1.0 / k))[0]
    if k < 3:
        return Interval(value, *np.full((2, *value.shape), np.nan))
    resampled = statistic(bootstrap_weights(k))
    given = SimpleNamespace(bootstrap_distribution=np.moveaxis(resampled, 0, -1))
    return _bca(value, (np.arange(k),), of_drawn, n_resamples=0, bootstrap_result=given)


def weights_of(drawn: NDArray[np.intp], k: int) -> Array:
    """Weights, (b, k), of the realisations in each of b draws of their numbers, (b, n)."""
    return np.stack([np.bincount(numbers, minlength=k) for numbers in drawn]) / drawn.shape[1]


def half_widths(values: Array, sizes: Iterable[int]) -> dict[int, float]:
    """Half the width of the interval of a mean over fewer of the k realisations, (k,), by number.

    Means over random subsets; numbers beyond k are left out.
    """
    rng = np.random.default_rng(0)
    widths: dict[int, float] = {}
    for size in sizes:
        if size > len(values):
            break
        drawn = [rng.permutation(values)[:size] for _ in range(_SUBSETS)]
        _, low, high = mean_interval(np.stack(drawn, axis=1))
        widths[size] = float(np.mean(high - low)) / 2.0
    return widths


def standard_error(values: Array) -> Array:
    """Standard error of the mean over k realisations, (k, ...); infinite for a single one."""
    k = len(values)
    if k == 1:
        return np.full(values.shape[1:], np.inf)
    return values.std(axis=0, ddof=1) / np.sqrt(k)


def repeatability(fields: Array) -> Interval:
    """Fraction of the variance over places that is the same in all k fields, (k, places).

    It is the mean covariance of two fields over their mean variance, the means of both taken
    out: zero, but for scatter, where no place differs from another on average, and one where all
    fields are alike (the intraclass correlation, Shrout & Fleiss 1979,
    doi:10.1037/0033-2909.86.2.420). The 95 % interval is Student's, with the jackknife's error:
    a bootstrap would compare fields with themselves. NaN below three fields.
    """
    k = len(fields)
    if k < 3:
        return Interval(*np.full(3, np.nan))
    centred = fields - fields.mean(axis=1, keepdims=True)
    products = centred @ centred.T
    variances = np.diag(products)
    crossed = products.sum(axis=1) - variances

    def ratio(covariance: Array, variance: Array, n: int) -> Array:
        return covariance / (n - 1) / variance

    whole = ratio(crossed.sum(), variances.sum(), k)
    without = ratio(crossed.sum() - 2.0 * crossed, variances.sum() - variances, k - 1)
    half = students_t(k - 1) * np.sqrt(k - 1) * without.std()
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
    """Force and detachments of k realisations."""

    time: Array  #: (n,) s
    friction: Array  #: (k, n) force over P l² N², NaN after the end of a run
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


def whole_curve(runs: Sequence[Run]) -> Curve:
    """Force and detachments of an ensemble up to the end of its longest run.

    After its end a run has no force, but it has first detachments: none, since `percent` counts
    shares of those that the run has seen, which are all there are once everything slides.
    """
    cut(runs, [run.time for run in runs])  # refuses runs that are sampled differently
    time = max((run.time for run in runs), key=len)

    def continued(curve: Array, value: float) -> Array:
        return np.pad(curve, (0, len(time) - len(curve)), constant_values=value)

    forces = np.stack([continued(friction(run), np.nan) for run in runs])
    counts = np.stack([continued(percent(run, run.detachments), 0.0) for run in runs])
    return Curve(time, forces, counts)


def mean_of_rest(values: Array) -> Interval:
    """Mean and interval over those of k runs, (k, n), that go on; (n,). NaN follows their ends.

    NaN, too, where fewer than half of the runs go on: what is left are the slowest.
    """
    goes_on = np.isfinite(values)
    left = goes_on.sum(axis=0)
    result = np.full((3, values.shape[1]), np.nan)
    for number in np.unique(left[2 * left >= len(values)]):
        here = left == number
        result[:, here] = mean_interval(values[goes_on[:, here].all(axis=1)][:, here])
    return Interval(*result)


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
    along = np.arange(pattern.levels[0].size)
    y, x = pattern.origins.T[:, :, None, None]
    pillars = y + along[:, None], x + along
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


def cluster_sizes(blocks: NDArray[np.bool_], by_corners: bool = False) -> NDArray[np.intp]:
    """Sizes of the clusters of a mask, (N, N), in blocks: those side by side belong together.

    Those that touch `by_corners` do as well, if asked.
    """
    from scipy.ndimage import label  # slow to load, and most jobs do without

    places, _ = label(blocks, structure=np.ones((3, 3)) if by_corners else None)
    return np.bincount(places.ravel())[1:]


def load_peaks(curve: Array, scatter: ArrayLike) -> NDArray[np.intp]:
    """Find the peaks of a force curve, (n,), under load; their indices.

    A peak must stand out of its surroundings by two standard errors of the mean, `scatter`, and
    by `_PROMINENT` of the largest force, which keeps out the small waves of loading; and it must
    reach `_LOAD_PEAK` of the largest force, which keeps out those of sliding. Section 3.3.
    """
    from scipy.signal import find_peaks  # slow to load, and few figures look for peaks

    needed = np.maximum(2.0 * np.broadcast_to(scatter, curve.shape), _PROMINENT * curve.max())
    return find_peaks(curve, prominence=needed, height=_LOAD_PEAK * curve.max())[0]


def prominence(curve: Array, rank: int = 2) -> float:
    """Prominence of the second most prominent peak under load, (n,), over the largest force.

    How far the force falls between two load peaks, from the lower of them; 0 with one alone. With
    another `rank` that of the most prominent, third most prominent, ... peak.
    """
    from scipy.signal import find_peaks  # slow to load, and few figures look for peaks

    highest = float(curve.max())
    _, found = find_peaks(curve, prominence=0.0, height=_LOAD_PEAK * highest)
    prominences = np.sort(found["prominences"])
    return float(prominences[-rank]) / highest if len(prominences) >= rank else 0.0
