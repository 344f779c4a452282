"""Random friction coefficients: their distributions, correlations and seeds."""

from dataclasses import replace
from math import gamma

import numpy as np
import pytest
import scipy.stats

from springblock import Material, Surface, draw_friction
from springblock.model.asperities import check_draws, distribution, log_share_above

PAPER = Material()
N = 120
BLOCKS = N * N


def correlation(a, b):
    return np.corrcoef(a.ravel(), b.ravel())[0, 1]


def test_a_seed_gives_the_same_surface_everywhere():
    """Values of seed 0 and N = 2, printed once."""
    mu_static, mu_dynamic = draw_friction(2, 0)
    assert mu_static.tolist() == [
        [1.0743586844777047, 1.141798828331121],
        [0.876966684077843, 1.2806813447333592],
    ]
    assert mu_dynamic.tolist() == [
        [0.5475586892041802, 0.6199535567828082],
        [0.6629553553521763, 0.6227272135763453],
    ]


def test_neither_coefficient_depends_on_the_statistics_of_the_other():
    rough = replace(PAPER, mu_dynamic=0.3, mu_dynamic_std=0.2)
    np.testing.assert_array_equal(draw_friction(8, 5, rough)[0], draw_friction(8, 5)[0])


def test_blocks_coefficients_and_seeds_are_independent():
    """Correlations are zero within four standard errors, 4/√n."""
    mu_static, mu_dynamic = draw_friction(N, 0)
    pairs = [
        (mu_static, mu_dynamic),
        *((mu_static, other) for other in draw_friction(N, 1)),
        (mu_static[1:], mu_static[:-1]),
        (mu_static[:, 1:], mu_static[:, :-1]),
        (mu_static, mu_static.T),
    ]
    assert max(abs(correlation(*pair)) for pair in pairs) < 4 / np.sqrt(BLOCKS)


def test_coefficients_are_never_negative():
    """A standard deviation of half the mean sends 2.3 % of the draws below zero, and to it."""
    mu_static, _ = draw_friction(N, 0, replace(PAPER, mu_static_std=0.5))
    share = 0.02275  # of a normal distribution, beyond two standard deviations
    assert mu_static.min() == 0.0
    assert np.mean(mu_static == 0.0) == pytest.approx(
        share, abs=4 * np.sqrt(share * (1 - share) / BLOCKS)
    )


@pytest.mark.parametrize("kind", ["normal", "lognormal", "weibull", "uniform"])
@pytest.mark.parametrize("length", [0.0, 3e-5])
def test_both_coefficients_have_their_distribution_correlated_or_not(kind, length):
    """Mean, standard deviation and quantiles of 40 surfaces against distributions of scipy.

    Within four standard errors, with as many independent draws n as areas of correlation, π ℓ²:
    std/√n of the mean, at most √(1/4)/√n of the share below a quantile.
    """
    stds = {"mu_static_std": 0.3, "mu_dynamic_std": 0.18}
    material = replace(PAPER, **stds, distribution=kind, correlation_length=length)
    law = {
        "normal": scipy.stats.norm(1.0, 0.3),
        "lognormal": scipy.stats.lognorm(np.sqrt(np.log(1.09)), scale=1 / np.sqrt(1.09)),
        "weibull": scipy.stats.weibull_min(3.7138, scale=1 / gamma(1 + 1 / 3.7138)),
        "uniform": scipy.stats.uniform(1 - 0.3 * np.sqrt(3), 0.6 * np.sqrt(3)),
    }[kind]
    assert (law.mean(), law.std()) == pytest.approx((1.0, 0.3), rel=1e-4)
    draws = np.array([draw_friction(60, seed, material) for seed in range(40)])
    error = 1 / np.sqrt(40 * 60**2 / max(1.0, np.pi * 3.0**2 * (length > 0.0)))
    for mu in (draws[:, 0], draws[:, 1] / 0.6):
        assert mu.mean() == pytest.approx(1.0, abs=4 * 0.3 * error)
        assert mu.std() == pytest.approx(0.3, abs=4 * 0.3 * error)
        for share in (0.05, 0.25, 0.5, 0.75, 0.95):
            assert np.mean(mu < law.ppf(share)) == pytest.approx(share, abs=4 * 0.5 * error)


@pytest.mark.parametrize("kind", ["lognormal", "weibull", "uniform"])
@pytest.mark.parametrize("scatter", [1e-4, 0.05, 0.5])
def test_a_distribution_has_the_mean_and_scatter_that_are_asked_for(kind, scatter):
    material = replace(PAPER, mu_dynamic_std=0.6 * scatter, distribution=kind)
    law = distribution("mu_dynamic", material)
    assert (law.mean(), law.std()) == pytest.approx((0.6, 0.6 * scatter), rel=1e-6)


@pytest.mark.parametrize("periodic", [False, True])
def test_the_autocorrelation_is_gaussian_and_crosses_periodic_edges_only(periodic):
    """exp(-r²/ℓ²), within four standard errors of 200 surfaces of about (30/ℓ)²/π areas each."""
    material = replace(PAPER, correlation_length=4e-5)
    flat = np.ones((30, 30), bool)
    surfaces = [Surface.draw(flat, seed, material, periodic) for seed in range(200)]
    draws = np.array([surface.mu_static for surface in surfaces])
    z = (draws - 1.0) / 0.1
    bound = 4 / np.sqrt(200 * 30**2 / (np.pi * 4.0**2))
    for r in (1, 2, 4, 6, 12):
        for found in (z[:, :, r:] * z[:, :, :-r], z[:, r:] * z[:, :-r]):
            assert found.mean() == pytest.approx(np.exp(-((r / 4.0) ** 2)), abs=bound)
    edge = 4 / np.sqrt(200 * 30 / (np.sqrt(np.pi) * 4.0))
    for across in (z[:, :, 0] * z[:, :, -1], z[:, 0] * z[:, -1]):  # neighbours, or far apart
        assert across.mean() == pytest.approx(np.exp(-1 / 16) if periodic else 0.0, abs=edge)


def test_coefficients_correlated_over_the_whole_surface_scatter_from_seed_to_seed():
    """By their standard deviation, within four standard errors of one independent area a seed."""
    material, flat = replace(PAPER, correlation_length=1.2e-4), np.ones((12, 12), bool)
    surfaces = [Surface.draw(flat, seed, material, periodic=True) for seed in range(400)]
    z = (np.array([surface.mu_static for surface in surfaces]) - 1.0) / 0.1
    assert np.mean(z**2) == pytest.approx(1.0, abs=4.0 * np.sqrt(2.0 / 400))


def test_a_rectangle_has_a_draw_for_each_block():
    mu_static, mu_dynamic = draw_friction((3, 5), 0)
    assert mu_static.shape == mu_dynamic.shape == (3, 5)
    np.testing.assert_array_equal(draw_friction((4, 4), 7), draw_friction(4, 7))


@pytest.mark.parametrize(
    ("constants", "sentence"),
    [
        ({"distribution": "uniform", "mu_static_std": 0.6}, "mu_static_std must be at most 0.5774"),
        ({"distribution": "weibull", "mu_dynamic": 0.0}, "mu_dynamic must be positive"),
        ({"distribution": "weibull", "mu_static_std": 20.0}, "1e-5 to 15 times mu_static = 1.0"),
        ({"correlation_length": 9e-5}, "at most the side of the surface, 8e-05 m, not 9e-05 m"),
    ],
)
def test_impossible_distributions_are_refused_without_drawing(constants, sentence):
    material = replace(PAPER, **constants)
    for refused in (lambda: draw_friction(8, 0, material), lambda: check_draws((8, 8), material)):
        with pytest.raises(ValueError, match=sentence):
            refused()


def test_thresholds_may_be_correlated_over_the_longer_side_of_a_rectangle():
    check_draws((8, 4), replace(PAPER, correlation_length=7.9e-5))


@pytest.mark.parametrize("kind", ["normal", "lognormal", "weibull", "uniform"])
def test_the_probability_of_a_threshold_is_the_share_of_draws(kind):
    """Within four standard errors; where nothing holds its logarithm is minus infinity."""
    material = replace(PAPER, mu_static_std=0.2, distribution=kind)
    check_draws((N, N), material)  # refuses nothing that can be drawn
    draws, _ = draw_friction(N, 0, material)
    needed = np.array([0.0, 0.7, 0.9, 1.0, 1.2])
    shares = np.exp(log_share_above(needed, material))
    measured = [np.mean(draws > each) for each in needed]
    assert measured == pytest.approx(shares, abs=4 * 0.5 / np.sqrt(BLOCKS))
    assert log_share_above(np.array([9.0]), material)[0] < -30
