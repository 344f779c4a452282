"""Intervals of statistics of several ensembles, each resampled by itself.

Bias-corrected and accelerated bootstrap over realisations (BCa; Efron & Tibshirani 1993,
doi:10.1201/9780429246593, chapter 14). Ensembles are independent of each other.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from springblock.analysis.correlation import Correlation, fit_tail
from springblock.analysis.statistics import (
    Interval,
    bootstrap_weights,
    difference_interval,
    samples_interval,
    weights_of,
)
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


class Lowest(NamedTuple):
    """The place of the lowest mean, and all places whose means cannot be told from it."""

    place: float
    alike: list[float]

    def __str__(self) -> str:
        """Write the place, and the others in brackets."""
        others = ", ".join(f"{place:g}" for place in self.alike if place != self.place)
        return f"{self.place:g} (or {others})" if others else f"{self.place:g}"


def lowest(samples: Mapping[Any, Array]) -> Lowest:
    """Where the means of samples, by their places, are lowest.

    Nothing is interpolated between places. A mean is told from the lowest where the 95 % interval
    of their difference, each by itself, leaves out zero.
    """
    best = min(samples, key=lambda place: float(samples[place].mean()))
    apart = {place: difference_interval(each, samples[best]) for place, each in samples.items()}
    alike = [place for place, found in apart.items() if place == best or not found.low > 0.0]
    return Lowest(best, alike)


def means(samples: Sequence[Array], axis: int) -> Array:
    """Means of several samples, (..., samples)."""
    return np.stack([sample.mean(axis=axis) for sample in samples], axis=-1)


class SideLength:
    """Decay length along sides in one ensemble: of A exp(-r/l) from r = 1 to `last`, in blocks.

    Called with numbers of realisations, as a bootstrap draws them, (..., k), it returns lengths,
    (...). The errors that the fit takes stay those of all realisations. `times` are those of
    `springblock.analysis.correlation.side_times`.
    """

    def __init__(self, times: Array, last: int) -> None:
        self.realisations = np.arange(len(times))
        self._found, self._last = Correlation(times), last
        self._error = self._curve(bootstrap_weights(len(times))).std(axis=0)

    def _curve(self, weights: Array) -> Array:
        return self._found.weighted(weights)[:, 1 : self._last + 1]

    def __call__(self, drawn: NDArray[np.intp]) -> Array:
        draws, which = np.unique(drawn.reshape(-1, drawn.shape[-1]), axis=0, return_inverse=True)
        weights = weights_of(draws, len(self.realisations))
        return fit_tail(self._curve(weights), self._error)[which].reshape(drawn.shape[:-1])

    @property
    def interval(self) -> Interval:
        """The length with its 95 % interval, blocks."""
        return interval([self.realisations], lambda drawn, axis: self(drawn))
