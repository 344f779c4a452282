"""Correlation of detachment times along the sides of pillars, and the correlation length.

Section 3.2 of Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525: for the first
detachment times τ of the blocks of a side and the mean ⟨...⟩ over realisations,

    C(x₁, x₂) = ⟨τ₁τ₂⟩ - ⟨τ₁⟩⟨τ₂⟩,    c(r) = C(x₀, x₀ + r) / C(x₀, x₀),

with x₀ at the middle of the side, and c(r) ~ exp(-r/l_c); (6) of docs/model.md. Since "~" leaves
the amplitude open, A exp(-r/l) is also fitted; its l is the decay length of the tail. Numerator and
denominator are sums over all pillars, both sides of each, both directions along it and a few x₀
(`references`). The means ⟨τ⟩ are those of each block, as in the paper.

Intervals are BCa intervals (Efron & Tibshirani 1993, doi:10.1201/9780429246593) over whole
realisations, since all pillars of a realisation belong to one surface.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from springblock.analysis.statistics import Interval, bootstrap_interval, bootstrap_weights
from springblock.model.numbers import Array
from springblock.model.pattern import Pattern
from springblock.simulation.run import Run

#: Last r of the fits from r = 1 on, blocks: a third of 20; shorter sides are fitted up to n_p/3.
#: Lengths from different ranges cannot be compared.
LAST = 6
#: Grid of correlation lengths for the fit, blocks, in steps of 1 %. A parabola interpolates, since
#: the jackknife needs a smooth estimate.
_LENGTHS = np.geomspace(0.1, 1000.0, 922)


def side_times(runs: Sequence[Run], pattern: Pattern, side: str) -> Array:
    """First detachment times along the sides of pillars that run along `side`, "x" or "y".

    (k, pillars, 2, n_p) s: for k runs, the rows y_p = 0 and n_p - 1 (columns x_p for "y"). Blocks
    of a side that are not in contact, or never detached, are a ValueError.
    """
    edges = np.array([0, pattern.levels[0].size - 1])
    along = np.arange(pattern.levels[0].size)
    y, x = pattern.origins.T[:, :, None, None]
    place = (y + edges[:, None], x + along) if side == "x" else (y + along, x + edges[:, None])
    if not pattern.contact[place].all():
        raise ValueError(f"the sides of the pillars along {side} are not all in contact")
    return _times_of(runs, place, f"of a side along {side}")


def groove_times(runs: Sequence[Run], pattern: Pattern) -> Array:
    """First detachment times along the edges of the grooves along x within pillars.

    (k, pillars, edges, n_p) s: for k runs, the rows on both sides of every groove. Pillars without
    such grooves, and blocks of an edge that never detached, are a ValueError.
    """
    if len(pattern.levels) != 2 or pattern.levels[1].along != "x":
        raise ValueError("the pillars have no uncut pawls along x")
    size, first = pattern.levels[0].size, pattern.origins[0, 0]
    pawls = [(start - first, n) for start, n in pattern.profile("y") if start < first + size]
    beside = [edge for start, n in pawls for edge in (start, start + n - 1)][1:-1]
    y, x = pattern.origins.T[:, :, None, None]
    place = (y + np.array(beside)[:, None], x + np.arange(size))
    return _times_of(runs, place, "beside a groove")


def _times_of(runs: Sequence[Run], place: tuple[Any, Any], where: str) -> Array:
    """First detachment times of the given blocks, by run; all of them must have detached."""
    times = np.stack([run.t_det[place] for run in runs])
    if not np.isfinite(times).all():
        raise ValueError(f"a block {where} never detached; simulate for longer")
    return times


def references(size: int) -> NDArray[np.intp]:
    """Blocks x₀ at the middle of a side: those within n_p/10 of it.

    With the one or two middle blocks only, as in the paper, a surface with a single pillar
    (n_p = 60) would need about four times as many realisations for the same interval. On pillars of
    20 and 60 blocks both choices agree within their intervals; with a wider range, the decay length
    would change (docs/model.md).
    """
    from_middle = np.abs(np.arange(size) - (size - 1) / 2.0)
    return np.flatnonzero(from_middle <= max(0.1 * size, 0.5))


def lagged_products(values: Array) -> Array:
    """Sum v(x₀) v(x₀ ± r) over sides, references and directions: (..., sides, n_p) -> (..., r).

    From r = 0 to the largest r for which all x₀ ± r belong to the side.
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
    """Correlation length in blocks.

    0.1 means no correlation, and infinity that all blocks of a side detach together, c(r) = 1.
    """

    fitted: Interval  #: l_c of exp(-r/l_c), by weighted least squares
    tail: Interval  #: l of A exp(-r/l) with A free; NaN for fewer than three r
    amplitude: Interval  #: A of that fit
    last: int  #: all fits use r = 1 ... last


@dataclass(frozen=True, eq=False)
class Correlation:
    """Correlation along the sides of pillars in k realisations.

    Fewer than three realisations, or realisations that do not differ, are a ValueError.
    """

    times: Array  #: (k, pillars, 2, n_p) s, from `side_times`

    def __post_init__(self) -> None:
        if len(self.times) < 3:
            raise ValueError(f"a correlation needs at least 3 realisations, not {len(self.times)}")
        if not self._fluctuations[..., references(self.times.shape[-1])].any():
            raise ValueError("all realisations detach at the same times; c(r) is not defined")

    @cached_property
    def _fluctuations(self) -> Array:
        """τ - ⟨τ⟩, (k, sides, n_p) s."""
        k, _, _, size = self.times.shape
        return (self.times - self.times.mean(axis=0)).reshape(k, -1, size)

    def weighted(self, weights: Array) -> Array:
        """c(r), (b, r), for b sets of weights of the realisations, (b, k), each of sum 1.

        Resamples are matrix products, since ⟨τ₁τ₂⟩ and ⟨τ₁⟩ are linear in the weights. The factor
        k/(k-1), which would remove the bias of C, cancels in the ratio.
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
    def interval(self) -> Interval:
        """c(r) with its 95 % interval, (r,) each; c(0) = 1 exactly."""
        return bootstrap_interval(self.weighted, len(self.times))

    @property
    def last(self) -> int:
        """Last r of the fits: `LAST`, or n_p/3 on sides of less than 20 blocks."""
        return min(LAST, self.times.shape[-1] // 3, len(self.mean) - 1)

    def length(self, last: int | None = None) -> Length:
        """Correlation length, by default from fits to `self.last`.

        All resamples have the same weights in the fit.
        """
        last = last or self.last
        span = slice(1, last + 1)
        if np.allclose(self.mean[span], 1.0, rtol=0.0, atol=1e-9):
            endless = Interval(*np.full(3, np.inf))
            return Length(endless, endless, Interval(*np.ones(3)), last)
        error = self.resampled[:, span].std(axis=0)

        def estimates(weights: Array) -> Array:
            c = self.weighted(weights)[:, span]
            tail = fit_tail(c, error)
            return np.column_stack([fit_length(c, error), tail, amplitude(c, error, tail)])

        found = bootstrap_interval(estimates, len(self.times))
        fitted, tail, gain = (Interval(*each) for each in np.transpose(found))
        return Length(fitted, tail, gain, last)


def _decays(last: int) -> Array:
    """exp(-r/l) for r = 1 ... last and the grid of lengths, (r, lengths)."""
    return np.exp(-_distances(last)[:, None] / _LENGTHS)


def fit_length(correlation: Array, error: Array) -> Array:
    """Fit exp(-r/l_c) to c(r) from r = 1 on, (b, r), by least squares with weights 1/error²; (b,).

    With one unknown, a search on a fine grid finds the global minimum for every resample. Errors at
    neighbouring r are correlated, but their covariance is not known well enough to be used.
    """
    decays, weight = _decays(correlation.shape[-1]), error**-2.0
    return _lowest(weight @ decays**2 - 2.0 * (correlation * weight) @ decays)


def _lowest(misfit: Array) -> Array:
    """Length at the minimum of the misfit, (b, lengths), interpolated by a parabola; (b,)."""
    best = np.clip(misfit.argmin(axis=-1), 1, len(_LENGTHS) - 2)
    before, at, after = (
        np.take_along_axis(misfit, (best + step)[:, None], axis=-1)[:, 0] for step in (-1, 0, 1)
    )
    bend = before - 2.0 * at + after
    shift = np.divide(0.5 * (before - after), bend, out=np.zeros_like(bend), where=bend > 0.0)
    ratio = _LENGTHS[1] / _LENGTHS[0]
    return _LENGTHS[best] * ratio ** np.clip(shift, -1.0, 1.0)


def fit_tail(correlation: Array, error: Array) -> Array:
    """Fit A exp(-r/l), A >= 0, as `fit_length` does; (b,). For each l, A follows by regression."""
    if correlation.shape[-1] < 3:
        return np.full(len(correlation), np.nan)
    decays, weight = _decays(correlation.shape[-1]), error**-2.0
    gain = np.maximum((correlation * weight) @ decays, 0.0) ** 2 / (weight @ decays**2)
    return _lowest(-gain)


def amplitude(correlation: Array, error: Array, lengths: Array) -> Array:
    """Fit A of A exp(-r/l) to each c(r), (b,), for given lengths."""
    decay, weight = np.exp(-_distances(correlation.shape[-1]) / lengths[:, None]), error**-2.0
    return np.maximum((correlation * weight * decay).sum(axis=-1), 0.0) / (decay**2 @ weight)


def _distances(last: int) -> Array:
    return np.arange(1.0, last + 1.0)


def misfits(correlation: Array, is_free: bool = True) -> list[Array]:
    """Return the rms deviation of c(r), (b, r) from r = 1 on, from the best curve of each kind.

    Exponentials, power laws and straight lines, each with a length on a grid, and with an amplitude
    that is free or 1; (b,) each.
    """
    r = np.arange(1.0, correlation.shape[-1] + 1.0)
    lengths = np.geomspace(0.1, 100.0, 200)[:, None]
    power_law, line = (1.0 + r) ** (-1.0 / lengths), np.maximum(0.0, 1.0 - r / lengths)
    found = []
    for curves in (np.exp(-r / lengths), power_law, line):
        square = np.maximum((curves**2).sum(axis=-1), np.finfo(float).tiny)
        common = correlation @ curves.T
        explained = common**2 / square if is_free else 2.0 * common - square
        left = (correlation**2).sum(axis=-1) - explained.max(axis=-1)
        found.append(np.sqrt(np.maximum(left, 0.0) / len(r)))
    return found
