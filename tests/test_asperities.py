"""The random surface: a draw that belongs to its seed, and to nothing else."""

from dataclasses import replace

import numpy as np
import pytest

from springblock import Material, draw_friction

PAPER = Material()
N = 120
BLOCKS = N * N


def correlation(a, b):
    return np.corrcoef(a.ravel(), b.ravel())[0, 1]


def test_a_seed_stands_for_the_same_surface_everywhere():
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


def test_a_draw_knows_nothing_of_other_draws():
    before = draw_friction(8, 5)
    draw_friction(8, 6)
    np.random.default_rng(5).normal(size=99)
    np.testing.assert_array_equal(draw_friction(8, np.int64(5)), before)


def test_neither_coefficient_depends_on_the_statistics_of_the_other():
    rough = replace(PAPER, mu_dynamic=0.3, mu_dynamic_std=0.2)
    np.testing.assert_array_equal(draw_friction(8, 5, rough)[0], draw_friction(8, 5)[0])


@pytest.mark.parametrize("seed", range(3))
def test_draws_have_the_papers_mean_and_scatter(seed):
    """Within four standard errors: std/√n of the mean, std/√(2n) of the standard deviation."""
    means = PAPER.mu_static, PAPER.mu_dynamic
    stds = PAPER.mu_static_std, PAPER.mu_dynamic_std
    for mu, mean, std in zip(draw_friction(N, seed), means, stds, strict=True):
        error = std / np.sqrt(BLOCKS)
        assert mu.mean() == pytest.approx(mean, abs=4 * error)
        assert mu.std() == pytest.approx(std, abs=4 * error / np.sqrt(2))


def test_blocks_coefficients_and_seeds_are_independent():
    """Correlations vanish within four standard errors, 4/√n."""
    mu_static, mu_dynamic = draw_friction(N, 0)
    others = draw_friction(N, 1)
    pairs = [
        (mu_static, mu_dynamic),
        (mu_static, others[0]),
        (mu_static, others[1]),
        (mu_static[1:], mu_static[:-1]),
        (mu_static[:, 1:], mu_static[:, :-1]),
        (mu_static, mu_static.T),
    ]
    assert max(abs(correlation(*pair)) for pair in pairs) < 4 / np.sqrt(BLOCKS)


def test_friction_never_pushes():
    """A standard deviation of half the mean sends 2.3 % of the draws below zero, and to it."""
    mu_static, _ = draw_friction(N, 0, replace(PAPER, mu_static_std=0.5))
    share = 0.02275  # of a normal distribution, beyond two standard deviations
    assert mu_static.min() == 0.0
    assert np.mean(mu_static == 0.0) == pytest.approx(
        share, abs=4 * np.sqrt(share * (1 - share) / BLOCKS)
    )


def test_a_static_coefficient_below_the_dynamic_one_is_kept():
    """With equal means and independent draws it is so for half the blocks."""
    mu_static, mu_dynamic = draw_friction(N, 0, replace(PAPER, mu_static=0.6))
    assert np.mean(mu_static < mu_dynamic) == pytest.approx(0.5, abs=4 * 0.5 / np.sqrt(BLOCKS))


@pytest.mark.parametrize("seed", [1.0, "1", None, True])
def test_a_seed_is_a_whole_number(seed):
    with pytest.raises(TypeError, match="seed must be a whole number"):
        draw_friction(2, seed)


def test_a_seed_is_not_negative():
    with pytest.raises(ValueError, match="seed must be zero or positive, not -1"):
        draw_friction(2, -1)
