"""Correlation along the edges of stripes without end."""

import math
from functools import cached_property

import numpy as np

from springblock.analysis.correlation import Correlation
from springblock.analysis.statistics import Interval, bootstrap_interval
from springblock.model.numbers import Array


class EdgeCorrelation(Correlation):
    """Correlation along closed edges, on which all blocks are alike: one mean serves for all.

    `times` are (k, edges, 1, n), of k realisations; any unit.
    """

    @cached_property
    def _moments(self) -> tuple[Array, Array]:
        """Means of τ, (k,), and of τ(x) τ(x + r), (k, r), over all x; τ less its mean."""
        n, about = self.times.shape[-1], self.times - self.times.mean()
        power = np.abs(np.fft.rfft(about, axis=-1)) ** 2 / n
        products = np.fft.irfft(power.mean(axis=(1, 2)), n)[:, : n // 2]
        return about.mean(axis=(1, 2, 3)), products

    def _covariance(self, weights: Array) -> Array:
        mean, products = self._moments
        return weights @ products - (weights @ mean)[:, None] ** 2

    def weighted(self, weights: Array) -> Array:
        """Return c(r), (b, r), for b sets of weights of the realisations, (b, k), of sum 1."""
        covariance = self._covariance(weights)
        return covariance / covariance[:, :1]

    @property
    def scatter(self) -> Interval:
        """Standard deviation of τ over its mean."""

        def estimate(weights: Array) -> Array:
            mean = weights @ self.times.mean(axis=(1, 2, 3))
            return np.sqrt(self._covariance(weights)[:, 0]) / mean

        return bootstrap_interval(estimate, len(self.times))


def reach(r: Array, c: Array) -> float:
    """Return the distance at which c(r) first falls to 1/e, in the unit of r; NaN if it never does.

    Between points c is linear; c(0) = 1 comes first.
    """
    level = math.exp(-1.0)
    first = int(np.argmax(c < level))
    if first == 0:
        return math.nan
    near = slice(first - 1, first + 1)
    return float(np.interp(-level, -c[near], r[near]))
