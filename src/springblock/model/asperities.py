"""Random friction coefficients: one static and one dynamic coefficient per block."""

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from springblock.model.material import Material
from springblock.model.numbers import Array, check_whole

if TYPE_CHECKING:
    from scipy.stats.distributions import rv_frozen

_COEFFICIENTS = ("mu_static", "mu_static_std", "mu_dynamic", "mu_dynamic_std")
#: Constants of the material on which a draw depends; with a correlation length also the spacing.
DRAWN = (*_COEFFICIENTS, "distribution", "correlation_length")
#: Margin, in correlation lengths, that is added to the surface before correlated normals are drawn
#: on it with periodic edges. There exp(-r²/ℓ²) is 1e-7, so that opposite edges are uncorrelated.
_MARGIN = 4.0
#: Exponents of Weibull distributions whose standard deviation is 16 and 1e-6 times the mean.
_EXPONENTS = (0.2, 1e6)


def draw_friction(
    n_blocks: int | tuple[int, int],
    seed: int,
    material: Material | None = None,
    periodic: bool = False,
) -> tuple[Array, Array]:
    """Draw the microscopic coefficients mu_static and mu_dynamic, (N_y, N_x) each, [y, x].

    `n_blocks` is N for N x N blocks, or (N_y, N_x). In the paper both coefficients are normal
    (section 2; (5) of docs/model.md). They come from two independent random streams, which depend
    only on the seed and the name of the coefficient. All blocks have coefficients, in contact or
    not: patterns of the same shape share them.

    A negative draw is set to zero. With the paper's standard deviations it would have to be ten of
    them below the mean; with a standard deviation of half the mean, 2.3 % of the blocks are set to
    zero, which raises the mean by 0.4 %. A draw with mu_static < mu_dynamic is kept: such a block
    detaches at mu_dynamic (see `springblock.solver.friction`).

    Other distributions have the same mean and standard deviation. With a correlation length ℓ, the
    coefficients are F⁻¹(Φ(z)) (a Gaussian copula), where F is their distribution, Φ that of z, and
    the normals z have the autocorrelation exp(-r²/ℓ²), across the edges if the surface is
    `periodic`.

    Raises
    ------
    TypeError, ValueError
        If the seed is not a whole number from zero up, the distribution cannot have this mean and
        standard deviation, or the correlation length exceeds the surface.
    """
    shape = n_blocks if isinstance(n_blocks, tuple) else (n_blocks, n_blocks)
    how = check_whole("seed", seed, least=0), shape, material or Material(), periodic
    return _draw("mu_static", *how), _draw("mu_dynamic", *how)


def _draw(
    name: str, seed: int, shape: tuple[int, int], material: Material, periodic: bool
) -> Array:
    rows, columns = shape
    width = _width(shape, material)
    margin = 0 if periodic else math.ceil(_MARGIN * width)
    stream = np.random.SeedSequence(seed, spawn_key=tuple(name.encode()))
    generator = np.random.Generator(np.random.PCG64(stream))
    normal = generator.standard_normal((rows + margin, columns + margin))
    if width > 0.0:
        normal = _correlated(normal, width)[:rows, :columns]
    law = distribution(name, material)
    if law is not None:
        from scipy.special import ndtr

        return np.asarray(law.ppf(ndtr(normal)))
    mean, std = getattr(material, name), getattr(material, f"{name}_std")
    return np.maximum(mean + std * normal, 0.0)


def _width(shape: tuple[int, int], material: Material) -> float:
    """Correlation length in blocks."""
    width = material.correlation_length / material.spacing
    if width > max(shape):
        raise ValueError(
            f"correlation_length must be at most the side of the surface, "
            f"{max(shape) * material.spacing:.4g} m, not {material.correlation_length!r} m"
        )
    return width


def _correlated(normal: Array, width: float) -> Array:
    """Filter independent normals, with periodic edges, to the autocorrelation exp(-r²/width²)."""
    from scipy.fft import fft2, ifft2
    from scipy.ndimage import fourier_gaussian

    response = fourier_gaussian(np.ones(normal.shape), 0.5 * width)
    smooth = ifft2(response * fft2(normal)).real
    return smooth / np.sqrt(np.mean(response**2))


def check_draws(shape: tuple[int, int], material: Material) -> None:
    """Raise the errors of `draw_friction`, without drawing."""
    _width(shape, material)
    for name in ("mu_static", "mu_dynamic"):
        distribution(name, material)


def distribution(name: str, material: Material) -> "rv_frozen | None":
    """Distribution of "mu_static" or "mu_dynamic"; None if it is normal or a single value.

    Means and standard deviations that it cannot have are refused with a ValueError.
    """
    mean, std = getattr(material, name), getattr(material, f"{name}_std")
    kind = material.distribution
    if kind == "normal" or std == 0.0:
        return None
    import scipy.stats  # takes half a second to import, and normal draws do not need it

    if mean == 0.0:
        raise ValueError(f"{name} must be positive with the distribution {kind}, not {mean!r}")
    if kind == "lognormal":
        width = math.sqrt(math.log1p((std / mean) ** 2))
        return scipy.stats.lognorm(width, scale=mean * math.exp(-0.5 * width**2))
    if kind == "weibull":
        if not 1e-5 <= std / mean <= 15.0:
            raise ValueError(
                f"{name}_std must be 1e-5 to 15 times {name} = {mean!r} with the distribution "
                f"weibull, not {std!r}"
            )
        exponent = _weibull_exponent(std / mean)
        return scipy.stats.weibull_min(exponent, scale=mean / math.gamma(1.0 + 1.0 / exponent))
    reach = math.sqrt(3.0) * std
    if reach > mean:
        raise ValueError(
            f"{name}_std must be at most {mean / math.sqrt(3.0):.4g}, not {std!r}, with {name} = "
            f"{mean!r} and the distribution uniform, which must have no negative values"
        )
    return scipy.stats.uniform(mean - reach, 2.0 * reach)


def _weibull_exponent(scatter: float) -> float:
    """Exponent of the Weibull distribution with this ratio of standard deviation to mean."""
    from scipy.optimize import brentq

    def excess(exponent: float) -> float:
        first, second = (math.lgamma(1.0 + moment / exponent) for moment in (1, 2))
        return math.expm1(second - 2.0 * first) - scatter**2

    return float(brentq(excess, *_EXPONENTS, xtol=1e-13, rtol=1e-14))


def log_share_above(needed: Array, material: Material) -> Any:
    """Logarithm of the probability that mu_static of a block exceeds `needed`."""
    law = distribution("mu_static", material)
    if law is not None:
        return law.logsf(needed)
    from scipy.special import log_ndtr  # takes a third of a second to import, for preludes only

    spread = max(material.mu_static_std, 1e-9)
    return log_ndtr((material.mu_static - needed) / spread)
