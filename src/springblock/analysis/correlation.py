"""Correlation of detachment times along the sides of pillars, and its length.

Section 3.2 of Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525: with τ the
first detachment times of the blocks of a side and ⟨...⟩ the mean over realisations,

    C(x₁, x₂) = ⟨τ₁τ₂⟩ - ⟨τ₁⟩⟨τ₂⟩,    c(r) = C(x₀, x₀ + r) / C(x₀, x₀),

x₀ at the side's middle, and c(r) ~ exp(-r/l_c). Since "~" leaves the amplitude open, A exp(-r/l) is
fitted, too; its l is the decay length of the tail. Numerator and denominator are sums over all
pillars, both sides of each, both directions along it and a few x₀ (`references`). Means ⟨τ⟩ are
taken for each block of the surface by itself, as the paper's are.

Intervals are BCa intervals over whole realisations, since the pillars of one realisation share one
surface (`design_effect` says how much that matters). They and the bias are those of Efron &
Tibshirani 1993, doi:10.1201/9780429246593.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from springblock.analysis.statistics import Interval, bootstrap_interval, bootstrap_weights
from springblock.model.pattern import Pattern
from springblock.simulation.run import Array, Run

#: Fits begin at r = 1 and end here, blocks, on every side that is long enough: a third of 20, the
#: shortest side on which enough distances can be fitted. Lengths from other ranges do not compare.
LAST = 6
#: Correlation lengths among which the fit looks for the best, blocks: 1 % apart. A parabola does
#: the rest: what the jackknife multiplies by k must be smooth.
_LENGTHS = np.geomspace(0.1, 1000.0, 922)


def side_times(runs: Sequence[Run], pattern: Pattern, side: str) -> Array:
    """First detachment times along the sides of pillars that run along `side`, "x" or "y".

    Returns
    -------
    (k, pillars, 2, n_p) s: for k runs, the rows y_p = 0 and n_p - 1 (columns x_p of a side "y").

    Raises
    ------
    ValueError
        Where blocks of a side are not in contact, or one never detached.
    """
    edges = np.array([0, pattern.levels[0].size - 1])
    along = np.arange(pattern.levels[0].size)
    y, x = pattern.origins.T[:, :, None, None]
    place = (y + edges[:, None], x + along) if side == "x" else (y + along, x + edges[:, None])
    if not pattern.contact[place].all():
        raise ValueError(f"the pillars have no whole sides along {side}")
    return _times_of(runs, place, f"of a side along {side}")


def groove_times(runs: Sequence[Run], pattern: Pattern) -> Array:
    """First detachment times along the edges of the grooves that run along x within pillars.

    Returns
    -------
    (k, pillars, edges, n_p) s: for k runs, the rows on both sides of every groove.

    Raises
    ------
    ValueError
        Where no such groove divides the pillars, or a block of an edge never detached.
    """
    if len(pattern.levels) != 2 or pattern.levels[1].along != "x":
        raise ValueError("the pillars have no grooves along x that nothing cuts")
    size, first = pattern.levels[0].size, pattern.origins[0, 0]
    pawls = [(start - first, n) for start, n in pattern.profile("y") if start < first + size]
    beside = [edge for start, n in pawls for edge in (start, start + n - 1)][1:-1]
    y, x = pattern.origins.T[:, :, None, None]
    place = (y + np.array(beside)[:, None], x + np.arange(size))
    return _times_of(runs, place, "beside a groove")


def _times_of(runs: Sequence[Run], place: tuple[Any, Any], where: str) -> Array:
    """First detachment times of some blocks, by run; all of them must have detached."""
    times = np.stack([run.t_det[place] for run in runs])
    if not np.isfinite(times).all():
        raise ValueError(f"some block {where} never detached; run for longer")
    return times


def references(size: int) -> NDArray[np.intp]:
    """Blocks x₀ of a side that count as its middle: those within n_p/10 of it.

    One or two blocks alone, as in the paper, would need about four times as many realisations
    for the same interval where the surface holds a single pillar (n_p = 60). Both agree within
    their intervals on pillars of 20 and 60 blocks.
    """
    from_middle = np.abs(np.arange(size) - (size - 1) / 2.0)
    return np.flatnonzero(from_middle <= max(0.1 * size, 0.5))


def lagged_products(values: Array) -> Array:
    """Sum v(x₀) v(x₀ ± r) over sides, (..., sides, n_p), references and directions; (..., r).

    From r = 0 on, as far as every reference has a partner on both sides.
    """
    size = values.shape[-1]
    middle = references(size)
    here = values[..., middle]
    return np.stack(
        [
            np.sum(here * (values[..., middle - r] + values[..., middle + r]), axis=(-2, -1))
            for r in range(size - middle[-1])
        ],
        axis=-1,
    )


class Length(NamedTuple):
    """Correlation length in blocks; 0.1 stands for none."""

    fitted: Interval  #: exp(-r/l_c) by weighted least squares
    integral: Interval  #: the exponential that has the same sum over r
    tail: Interval  #: l of A exp(-r/l) with A free; NaN where it has less than three r to fit
    amplitude: Interval  #: A of that
    bias: float  #: of the one through c(0) = 1, by jackknife
    last: int  #: all look at r = 1 ... last
    deviation: float  #: largest distance of c(r) from the fit, in its standard errors
    residual: Interval  #: c(r) - A exp(-r/l), (last,)


@dataclass(frozen=True, eq=False)
class Correlation:
    """Correlation along the sides of pillars in k realisations.

    Parameters
    ----------
    times
        (k, pillars, 2, n_p) s, from `side_times`.

    Raises
    ------
    ValueError
        Where there are fewer than three realisations, or they do not differ.
    """

    times: Array

    def __post_init__(self) -> None:
        if len(self.times) < 3:
            raise ValueError(f"a correlation needs 3 realisations or more, not {len(self.times)}")
        if not self._fluctuations[..., references(self.times.shape[-1])].any():
            raise ValueError("all realisations detach at the same times: nothing can correlate")

    @cached_property
    def _fluctuations(self) -> Array:
        """τ - ⟨τ⟩, (k, sides, n_p) s."""
        k, _, _, size = self.times.shape
        return (self.times - self.times.mean(axis=0)).reshape(k, -1, size)

    def weighted(self, weights: Array) -> Array:
        """c(r), (b, r), with b sets of weights of the realisations, (b, k), each of sum 1.

        A resample is a product of matrices, since ⟨τ₁τ₂⟩ and ⟨τ₁⟩ are linear in the weights. The
        factor k/(k-1) that frees C of bias is common to numerator and denominator.
        """
        k, sides, size = self._fluctuations.shape
        means = (weights @ self._fluctuations.reshape(k, -1)).reshape(-1, sides, size)
        covariance = weights @ lagged_products(self._fluctuations) - lagged_products(means)
        return covariance / covariance[:, :1]

    @cached_property
    def mean(self) -> Array:
        """c(r), (r,), from r = 0 on."""
        k = len(self.times)
        return self.weighted(np.full((1, k), 1.0 / k))[0]

    @cached_property
    def resampled(self) -> Array:
        """c(r) of bootstrap resamples, (b, r)."""
        return self.weighted(bootstrap_weights(len(self.times)))

    @cached_property
    def _left_out(self) -> Array:
        """c(r) without each realisation in turn, (k, r)."""
        k = len(self.times)
        return self.weighted((1.0 - np.eye(k)) / (k - 1.0))

    @cached_property
    def interval(self) -> Interval:
        """c(r) with its 95 % interval, (r,) each; that of c(0) = 1 has no width."""
        return bootstrap_interval(self.weighted, len(self.times))

    @property
    def bias(self) -> Array:
        """Bias of c(r), (r,), by jackknife: that of a ratio of means, of order 1/k."""
        return _jackknife_bias(self.mean, self._left_out)

    @property
    def last(self) -> int:
        """Distance up to which l_c is fitted: `LAST`, or n_p/3 on shorter sides."""
        return min(LAST, self.times.shape[-1] // 3, len(self.mean) - 1)

    def length(self) -> Length:
        """Correlation length; its weights stay those of all realisations."""
        span = slice(1, self.last + 1)
        error = self.resampled[:, span].std(axis=0)

        def estimates(weights: Array) -> Array:
            c = self.weighted(weights)[:, span]
            tail = fit_tail(c, error)
            gain = amplitude(c, error, tail)
            residual = c - gain[:, None] * np.exp(-_distances(self.last) / tail[:, None])
            return np.column_stack([fit_length(c, error), integral_length(c), tail, gain, residual])

        found = bootstrap_interval(estimates, len(self.times))
        fitted, integral, tail, gain = (Interval(*(limit[i] for limit in found)) for i in range(4))
        bias = _jackknife_bias(fitted.mean, fit_length(self._left_out[:, span], error))
        distance = np.abs(self.mean[span] - np.exp(-_distances(self.last) / fitted.mean))
        return Length(
            fitted=fitted,
            integral=integral,
            tail=tail,
            amplitude=gain,
            bias=float(bias),
            last=self.last,
            deviation=float((distance / error).max()),
            residual=Interval(*(limit[4:] for limit in found)),
        )


def _jackknife_bias(mean: Array, left_out: Array) -> Array:
    return (len(left_out) - 1.0) * (left_out.mean(axis=0) - mean)


def _decays(last: int) -> Array:
    """exp(-r/l) for r = 1 ... last and the lengths to choose from, (r, lengths)."""
    return np.exp(-_distances(last)[:, None] / _LENGTHS)


def fit_length(correlation: Array, error: Array) -> Array:
    """Fit exp(-r/l_c) to c(r) from r = 1 on, (b, r), by least squares with weights 1/error²; (b,).

    One unknown and many resamples: the best of a fine grid is the global minimum of them all.
    Errors at neighbouring r are correlated, but their covariance is known too badly to be used.
    """
    decays, weight = _decays(correlation.shape[-1]), error**-2.0
    return _lowest(weight @ decays**2 - 2.0 * (correlation * weight) @ decays)


def _lowest(misfit: Array) -> Array:
    """Length of the lowest misfit, (b, lengths): of the parabola through it and its neighbours."""
    best = np.clip(misfit.argmin(axis=-1), 1, len(_LENGTHS) - 2)
    before, at, after = (
        np.take_along_axis(misfit, (best + step)[:, None], axis=-1)[:, 0] for step in (-1, 0, 1)
    )
    bend = before - 2.0 * at + after
    shift = np.divide(0.5 * (before - after), bend, out=np.zeros_like(bend), where=bend > 0.0)
    ratio = _LENGTHS[1] / _LENGTHS[0]
    return _LENGTHS[best] * ratio ** np.clip(shift, -1.0, 1.0)


def fit_tail(correlation: Array, error: Array) -> Array:
    """Fit A exp(-r/l) as `fit_length` does, with any A > 0; (b,). Given l, the best A is linear."""
    if correlation.shape[-1] < 3:
        return np.full(len(correlation), np.nan)
    decays, weight = _decays(correlation.shape[-1]), error**-2.0
    gain = np.maximum((correlation * weight) @ decays, 0.0) ** 2 / (weight @ decays**2)
    return _lowest(-gain)


def amplitude(correlation: Array, error: Array, lengths: Array) -> Array:
    """Best A of A exp(-r/l), (b,), given the length of each c(r)."""
    decay, weight = np.exp(-_distances(correlation.shape[-1]) / lengths[:, None]), error**-2.0
    return np.maximum((correlation * weight * decay).sum(axis=-1), 0.0) / (decay**2 @ weight)


def _distances(last: int) -> Array:
    return np.arange(1.0, last + 1.0)


def integral_length(correlation: Array) -> Array:
    """Length of the exponential with the same sum as c(r) from r = 1 on, (b, r); (b,)."""
    sums = _decays(correlation.shape[-1]).sum(axis=0)  # 1/(exp(1/l) - 1) for a long range
    return np.interp(correlation.sum(axis=-1), sums, _LENGTHS)


def design_effect(times: Array) -> float:
    """How many times larger the variance of c(r) is than if pillars were independent.

    `times` as of `side_times`; the ratio of bootstrap variances, summed over r. The root of it is
    how much too narrow an interval over pillars would be. On pillars of 6 and 20 blocks it is
    0.9 to 1.1: their sides detach almost independently of those of other pillars.
    """
    places = (times - times.mean(axis=0)).reshape(-1, 1, *times.shape[2:])
    whole, apart = (Correlation(part).resampled.var(axis=0).sum() for part in (times, places))
    return float(whole / apart)
