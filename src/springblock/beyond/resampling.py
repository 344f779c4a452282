"""Intervals of statistics of several ensembles, each resampled by itself.

Bias-corrected and accelerated bootstrap over realisations (BCa; Efron & Tibshirani 1993,
doi:10.1201/9780429246593, chapter 14). Ensembles are independent of each other.
"""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from springblock.analysis.correlation import Correlation, fit_tail, side_times
from springblock.analysis.statistics import (
    Interval,
    bootstrap_weights,
    samples_interval,
    weights_of,
)
from springblock.io.records import Record
from springblock.simulation.run import Array

Sample = NDArray[Any]  #: numbers, one for each realisation, (k,)
Statistic = Callable[..., Array]  #: of samples, (..., k) each, and their axis: (...)
_RESAMPLES = 1000
#: Realisations that a correlation needs here: no resample of so many is one of them alone.
FEWEST = 10


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


def means(samples: Sequence[Array], axis: int) -> Array:
    """Means of several samples, (..., samples)."""
    return np.stack([sample.mean(axis=axis) for sample in samples], axis=-1)


def side_length(runs: Sequence[Record], last: int) -> Interval:
    """Decay length along the sides of pillars that run along x, fitted as by `decay_length`."""
    return decay_length(side_times(runs, runs[0].scene.pattern, "x"), last)


def decay_length(times: Array, last: int) -> Interval:
    """Decay length in one ensemble: of A exp(-r/l) from r = 1 to `last`, in blocks.

    `times` are detachment times as those of `springblock.analysis.correlation.side_times`. The
    errors that the fit takes stay those of all realisations.
    """
    found, k = Correlation(times), len(times)

    def curve(weights: Array) -> Array:
        return found.weighted(weights)[:, 1 : last + 1]

    error = curve(bootstrap_weights(k)).std(axis=0)

    def length(drawn: NDArray[np.intp], axis: int) -> Array:
        weights = weights_of(drawn.reshape(-1, drawn.shape[axis]), k)
        return fit_tail(curve(weights), error).reshape(drawn.shape[:-1])

    return interval([np.arange(k)], length)
