"""The random surface: one static and one dynamic friction coefficient per block."""

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from springblock.model.material import Material

if TYPE_CHECKING:
    from scipy.stats.distributions import rv_frozen

Array = NDArray[np.float64]

#: Correlated normals are drawn on a surface that is larger by so many correlation lengths, where
#: exp(-r²/ℓ²) is 1e-7: what crosses its edge does not reach the other one.
_MARGIN = 4.0
#: Exponents of Weibull distributions that scatter by 16 times their mean, and by 1e-6 of it.
_EXPONENTS = (0.2, 1e6)


def _standard_normal(name: str, seed: int, shape: tuple[int, int]) -> Array:
    """Draw (N_y, N_x) standard normals from the stream `name` of this seed."""
    sequence = np.random.SeedSequence(seed, spawn_key=tuple(name.encode()))
    return np.random.Generator(np.random.PCG64(sequence)).standard_normal(shape)


def draw_friction(
    n_blocks: int | tuple[int, int],
    seed: int,
    material: Material | None = None,
    periodic: bool = False,
) -> tuple[Array, Array]:
    """Draw the microscopic coefficients mu_static and mu_dynamic, (N_y, N_x) each, [y, x].

    For N x N blocks, or for (N_y, N_x). In the paper both are Gaussian (section 2), from two
    independent streams that depend on the seed and their own name alone. Every block gets its
    draw, in contact or not: all patterns of one shape see the same asperities.

    A negative draw would make friction push and becomes zero. With the paper's standard
    deviations that needs ten of them; with a standard deviation of half the mean it happens to
    2.3 % of the blocks and raises the mean by 0.4 %. A draw with mu_static < mu_dynamic is kept
    as drawn: a block that lets go under less than its dynamic friction comes to rest in the
    same instant, so that it detaches for good at mu_dynamic (see `springblock.solver.friction`).

    Other distributions have the same mean and standard deviation. With a correlation length ℓ,
    the normals z that the draws are made from have the autocorrelation exp(-r²/ℓ²), around the
    edges if the surface is `periodic`; a draw is F⁻¹(Φ(z)), where F is its distribution and Φ
    that of z (a Gaussian copula), which leaves F as it is.

    Raises
    ------
    TypeError, ValueError
        Where the seed is not a whole number from zero up, the distribution cannot have this mean
        and standard deviation, or the correlation length exceeds the surface.
    """
    if isinstance(seed, bool) or not isinstance(seed, int | np.integer):
        raise TypeError(f"a seed must be a whole number, not {seed!r}")
    if seed < 0:
        raise ValueError(f"a seed must be zero or positive, not {seed}")
    shape = n_blocks if isinstance(n_blocks, tuple) else (n_blocks, n_blocks)
    return (
        _draw("mu_static", seed, shape, material or Material(), periodic),
        _draw("mu_dynamic", seed, shape, material or Material(), periodic),
    )


def _draw(
    name: str, seed: int, shape: tuple[int, int], material: Material, periodic: bool
) -> Array:
    rows, columns = shape
    width = _width(shape, material)
    margin = 0 if periodic else math.ceil(_MARGIN * width)
    normal = _standard_normal(name, seed, (rows + margin, columns + margin))
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
            f"correlation_length = {material.correlation_length!r} m must not exceed the surface, "
            f"{max(shape) * material.spacing:.4g} m"
        )
    return width


def _correlated(normal: Array, width: float) -> Array:
    """Smooth independent normals, around the edges, to exp(-r²/width²); their variance stays 1."""
    from scipy.fft import fft2, ifft2
    from scipy.ndimage import fourier_gaussian

    response = fourier_gaussian(np.ones(normal.shape), 0.5 * width)
    smooth = ifft2(response * fft2(normal)).real
    return smooth / np.sqrt(np.mean(response**2))


def check_draws(shape: tuple[int, int], material: Material) -> None:
    """Refuse what `draw_friction` would, without drawing."""
    _width(shape, material)
    for name in ("mu_static", "mu_dynamic"):
        distribution(name, material)


def distribution(name: str, material: Material) -> "rv_frozen | None":
    """Distribution of "mu_static" or "mu_dynamic"; None where it is normal, or one value.

    Raises
    ------
    ValueError
        Where it cannot have the mean and the standard deviation that the material says.
    """
    mean, std = getattr(material, name), getattr(material, f"{name}_std")
    kind = material.distribution
    if kind == "normal" or std == 0.0:
        return None
    import scipy.stats  # takes half a second, which jobs with normal draws do not spend

    refusal = f"no {kind} distribution has {name} = {mean!r} and {name}_std = {std!r}"
    if mean == 0.0:
        raise ValueError(f"{refusal}; its mean must be positive")
    if kind == "lognormal":
        width = math.sqrt(math.log1p((std / mean) ** 2))
        return scipy.stats.lognorm(width, scale=mean * math.exp(-0.5 * width**2))
    if kind == "weibull":
        exponent = _weibull_exponent(std / mean, refusal)
        return scipy.stats.weibull_min(exponent, scale=mean / math.gamma(1.0 + 1.0 / exponent))
    reach = math.sqrt(3.0) * std
    if reach > mean:
        limit = f"{name}_std may be up to {mean / math.sqrt(3.0):.4g}"
        raise ValueError(f"{refusal} without going below zero; {limit}")
    return scipy.stats.uniform(mean - reach, 2.0 * reach)


def _weibull_exponent(scatter: float, refusal: str) -> float:
    """Exponent of the Weibull distribution with this standard deviation over its mean."""
    from scipy.optimize import brentq

    def excess(exponent: float) -> float:
        first, second = (math.lgamma(1.0 + moment / exponent) for moment in (1, 2))
        return math.expm1(second - 2.0 * first) - scatter**2

    if excess(_EXPONENTS[0]) < 0.0 or excess(_EXPONENTS[1]) > 0.0:
        raise ValueError(f"{refusal}; it must scatter by 1e-5 to 15 times its mean")
    return float(brentq(excess, *_EXPONENTS, xtol=1e-13, rtol=1e-14))


def log_share_above(needed: Array, material: Material) -> Any:
    """Logarithm of the probability that mu_static of a block exceeds what is `needed`."""
    law = distribution("mu_static", material)
    if law is not None:
        return law.logsf(needed)
    from scipy.special import log_ndtr  # takes a third of a second, for a prelude only

    spread = max(material.mu_static_std, 1e-9)
    return log_ndtr((material.mu_static - needed) / spread)
