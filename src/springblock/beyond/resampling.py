"""Intervals of statistics of several ensembles, each resampled by itself.

Bias-corrected and accelerated bootstrap over realisations (BCa; Efron & Tibshirani 1993,
doi:10.1201/9780429246593, chapter 14). Ensembles are independent of each other.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from springblock.analysis.correlation import Correlation, fit_tail
from springblock.analysis.statistics import (
    Interval,
    bootstrap_weights,
    samples_interval,
    weights_of,
)
from springblock.simulation.run import Array

Sample = NDArray[Any]  #: numbers, one for each realisation, (k,)
Statistic = Callable[..., Array]  #: of samples, (..., k) each, and their axis: (...)
LengthFit = Callable[[Array, Array], Array]  #: from c(r), (b, r), and its errors, (r,), to (b,)
_RESAMPLES = 1000
#: Realisations that a correlation needs here: no resample of so many is one of them alone.
FEWEST = 10
_NONE = 0.1  #: blocks, stands for no correlation


def interval(samples: Sequence[Sample], statistic: Statistic) -> Interval:
    """A statistic of independent samples, (k,) each, with its 95 % BCa interval.

    Limits are NaN where a sample has fewer than three realisations.
    """
    if min(len(sample) for sample in samples) < 3:
        return Interval(np.asarray(statistic(*samples, axis=-1)), *np.full(2, np.nan))
    return samples_interval(samples, statistic, _RESAMPLES, batch=100)


def difference(first: Array, second: Array) -> Interval:
    """Mean of one sample minus that of another, with its 95 % interval."""
    return interval((first, second), lambda a, b, axis: a.mean(axis=axis) - b.mean(axis=axis))


def exponents(rates: Array, samples: Sequence[Sample], values: Statistic) -> list[Interval]:
    """Exponents of values that go with powers of what varies, of which `rates` are logarithms.

    `rates` are (places, exponents). `values` takes all samples and returns (..., places). The
    exponents are slopes by least squares, with a constant beside them.
    """
    design = np.column_stack([np.ones(len(rates)), rates])
    slopes = np.linalg.pinv(design)[1:]

    def exponent(*drawn: Sample, axis: int, slope: Array) -> Array:
        return np.log(values(*drawn, axis=axis)) @ slope

    return [interval(samples, partial(exponent, slope=slope)) for slope in slopes]


def lowest(places: Array, heights: Array) -> Array:
    """Where a curve through heights, (..., places), is lowest, on a logarithmic axis; (...).

    The vertex of the parabola through the lowest place and its neighbours, or the place itself
    at an end.
    """
    log = np.log(places)
    at = heights.argmin(axis=-1)
    inside = (at > 0) & (at < len(places) - 1)
    middle = np.clip(at, 1, len(places) - 2)
    x, y = (
        [np.take_along_axis(part, (middle + step)[..., None], -1)[..., 0] for step in (-1, 0, 1)]
        for part in (np.broadcast_to(log, heights.shape), heights)
    )
    before, after = (y[1] - y[0]) / (x[1] - x[0]), (y[2] - y[1]) / (x[2] - x[1])
    bend = after - before
    safe = np.where(bend > 0.0, bend, 1.0)
    vertex = 0.5 * (x[0] + x[1]) - before * 0.5 * (x[2] - x[0]) / safe
    vertex = np.where(inside & (bend > 0.0), np.clip(vertex, x[0], x[2]), log[at])
    return np.exp(vertex)


def means(samples: Sequence[Array], axis: int) -> Array:
    """Means of several samples, (..., samples)."""
    return np.stack([sample.mean(axis=axis) for sample in samples], axis=-1)


def lowest_place(samples: Mapping[Any, Array]) -> Interval:
    """Where the means of samples, by their places, are lowest, with its 95 % interval."""
    places = np.array(list(samples))
    return interval([*samples.values()], lambda *each, axis: lowest(places, means(each, axis)))


def area(curve: Array, error: Array) -> Array:
    """Area below c(r), (b, r) from r = 1 on, and c(0) = 1, by the trapezoidal rule, blocks; (b,).

    The length of an exponential that is resolved and at its end within the range; it needs no fit.
    """
    return np.maximum(0.5 + curve.sum(axis=-1) - 0.5 * curve[:, -1], _NONE)


class SideLength:
    """Correlation length along sides in one ensemble, from r = 1 to `last`, in blocks.

    Called with numbers of realisations, as a bootstrap draws them, (..., k), it returns lengths,
    (...). The errors that `fit` takes stay those of all realisations. `times` are those of
    `springblock.analysis.correlation.side_times`.
    """

    def __init__(self, times: Array, last: int, fit: LengthFit = fit_tail) -> None:
        self.realisations = np.arange(len(times))
        self._found, self._last, self._fit = Correlation(times), last, fit
        self._error = self._curve(bootstrap_weights(len(times))).std(axis=0)

    def _curve(self, weights: Array) -> Array:
        return self._found.weighted(weights)[:, 1 : self._last + 1]

    def __call__(self, drawn: NDArray[np.intp]) -> Array:
        draws, which = np.unique(drawn.reshape(-1, drawn.shape[-1]), axis=0, return_inverse=True)
        weights = weights_of(draws, len(self.realisations))
        return self._fit(self._curve(weights), self._error)[which].reshape(drawn.shape[:-1])

    @property
    def interval(self) -> Interval:
        """The length with its 95 % interval, blocks."""
        return interval([self.realisations], lambda drawn, axis: self(drawn))


def length_exponents(
    fits: Iterable[SideLength], rates: Array, units: Sequence[float]
) -> list[Interval]:
    """Exponents of correlation lengths in units, each of another ensemble."""
    found = list(fits)

    def lengths(*drawn: Sample, axis: int) -> Array:
        each = [fit(numbers) for fit, numbers in zip(found, drawn, strict=True)]
        return np.stack(each, axis=-1) * np.array(units)

    return exponents(rates, [fit.realisations for fit in found], lengths)
