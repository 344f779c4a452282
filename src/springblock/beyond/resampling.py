"""Intervals of statistics of several ensembles, each resampled independently.

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
    of_indices,
    samples_interval,
)
from springblock.io.records import Record
from springblock.model.numbers import Array

_RESAMPLES = 1000
#: Least number of realisations for a correlation: no resample consists of a single one.
FEWEST = 10
_DISTANCES = 3  #: least number for a fit of two unknowns


def interval(samples: Sequence[NDArray[Any]], statistic: Callable[..., Any]) -> Interval:
    """A statistic of independent samples, (k,) each, with its 95 % BCa interval.

    `statistic` takes the samples, (..., k) each, and their `axis`. Limits are NaN where a sample
    has fewer than three realisations.
    """
    if min(map(len, samples)) < 3:
        value = np.asarray(statistic(*samples, axis=-1))
        return Interval(value, *np.full((2, *value.shape), np.nan))
    return samples_interval(samples, statistic, _RESAMPLES, batch=100)


def side_length(runs: Sequence[Record], most: int | None = None) -> Interval | None:
    """Decay length along the sides of pillars, blocks: of A exp(-r/l) from r = 1 to n_p/3.

    On larger pillars up to `most` blocks; None with too few realisations or on too short sides. All
    resamples are fitted with the errors of the whole ensemble.
    """
    scene, k = runs[0].scene, len(runs)
    last = min(scene.n_p // 3, most or scene.n_p)
    if k < FEWEST or last < _DISTANCES:
        return None
    found = Correlation(side_times(runs, scene.pattern, "x"))

    def curve(weights: Array) -> Array:
        return found.weighted(weights)[:, 1 : last + 1]

    error = curve(bootstrap_weights(k)).std(axis=0)
    length = of_indices(lambda weights: fit_tail(curve(weights), error), k)
    return interval([np.arange(k)], length)
