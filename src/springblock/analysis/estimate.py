"""Statistics with their confidence intervals, at 95 % and at other levels."""

import math
from dataclasses import dataclass

import numpy as np

from springblock.analysis.statistics import Interval, independent_difference, students_t

_MISS = 0.05  #: probability that any of several intervals misses its true value


@dataclass(frozen=True)
class Estimate:
    """A statistic with the limits of its 95 % interval."""

    value: float
    ci_low: float
    ci_high: float
    n: int = 0  #: realisations of the smallest sample; 0 for a quantity without scatter
    bounds: tuple[float, float] = (-math.inf, math.inf)  #: range of possible values

    @classmethod
    def of(cls, interval: Interval, n: int) -> "Estimate":
        """Return the estimate of an interval from n realisations."""
        mean, low, high = interval
        return cls(float(mean), float(low), float(high), n)

    def limits(self, together: int) -> tuple[float, float]:
        """Limits for `together` simultaneous intervals (Bonferroni), at a joint level of 95 %.

        Both sides of the interval are scaled like those of Student's t, from 95 % to
        1 - 0.05/together.
        """
        if not self.n:
            return self.ci_low, self.ci_high
        now, then = students_t(self.n - 1), students_t(self.n - 1, 1.0 - _MISS / together)
        wider = float(then / now)
        below, above = self.value - self.ci_low, self.ci_high - self.value
        lowest, highest = self.bounds
        return max(lowest, self.value - wider * below), min(highest, self.value + wider * above)

    def __truediv__(self, scale: float) -> "Estimate":
        """Divide by a positive number without error."""
        value, low, high = (each / scale for each in (self.value, self.ci_low, self.ci_high))
        return Estimate(value, low, high, self.n)

    def __abs__(self) -> "Estimate":
        """Return the absolute value; its upper limit is that of the end further from zero."""
        nearer = -self.ci_high if self.value < 0.0 else self.ci_low
        return Estimate(abs(self.value), nearer, max(abs(self.ci_low), abs(self.ci_high)), self.n)

    def __sub__(self, other: "Estimate") -> "Estimate":
        """Subtract an estimate from other realisations; independent errors add in quadrature."""
        ends = (Interval(*map(np.array, (e.value, e.ci_low, e.ci_high))) for e in (self, other))
        return Estimate.of(independent_difference(*ends), min(self.n, other.n))

    def minus_paired(self, other: "Estimate") -> "Estimate":
        """Subtract an estimate from the same realisations; errors of unknown correlation add up."""
        low, high = self.ci_low - other.ci_high, self.ci_high - other.ci_low
        return Estimate(self.value - other.value, low, high, min(self.n, other.n))


@dataclass(frozen=True)
class AnyOf(Estimate):
    """One of several estimates, it is not known which: limits enclose those of each."""

    each: tuple[Estimate, ...] = ()

    @classmethod
    def these(cls, *each: Estimate) -> "AnyOf":
        """Return the first value, with limits that enclose those of all."""
        low, high = min(one.ci_low for one in each), max(one.ci_high for one in each)
        return cls(each[0].value, low, high, min(one.n for one in each), each=each)

    def limits(self, together: int) -> tuple[float, float]:
        """Limits as in `Estimate.limits`; the distances between estimates are not scaled."""
        limits = [one.limits(together) for one in self.each]
        return min(low for low, _ in limits), max(high for _, high in limits)


UNKNOWN = Estimate(math.nan, math.nan, math.nan)
