"""Clusters, the direction of sliding, scatter of thresholds, and variance."""

import numpy as np
import pytest

from beyond.made_up import T_MAX, ensemble, lean, record
from springblock.beyond import clusters, scatter, sliding, variance
from springblock.beyond.question import UNCHANGED
from springblock.model.scene import Scene

FLAT = Scene(40)


def before(mask, seed=0, scene=FLAT):
    """A run in which these blocks detach before the force maximum."""
    return record(scene, seed, np.where(mask, 0.9, 1.1) * T_MAX, 0.7)


def test_neighbours_along_the_axes_are_one_cluster():
    mask = np.zeros((40, 40), bool)
    mask[3, 3:7] = mask[4, 6] = True  # five, round a corner
    mask[10, 10] = mask[11, 11] = True  # two, which touch at a corner only
    assert clusters.mean_size(mask) == pytest.approx((25 + 1 + 1) / 7)
    assert np.isnan(clusters.mean_size(np.zeros_like(mask)))


def clumps(rng):
    """Squares of 2 x 2 blocks at random."""
    return np.kron(rng.random((20, 20)) < 0.1, np.ones((2, 2))).astype(bool)


def test_clumps_at_random_places_are_larger_than_by_chance_and_resting_ones_no_company(rng):
    """Clumps that never move cluster more than blocks anywhere, but no more than their places."""
    always = clumps(rng)
    moving = clusters.clusters([before(clumps(rng), seed) for seed in range(20)])
    resting = clusters.clusters([before(always, seed) for seed in range(20)])
    assert min(moving.ratio.low, moving.ratio_mixed.low, resting.ratio.low) > 1.5
    np.testing.assert_allclose(resting.ratio_mixed, 1.0)


def test_the_page_counts_surfaces_with_larger_clusters(rng):
    made = {FLAT: [before(clumps(rng), seed) for seed in range(10)]}
    conclusion, table = clusters.answers(made)
    assert "blocks in the same places on 1 of 1 surfaces; larger than with as " in conclusion
    assert conclusion.endswith("(surface: flat).")
    assert "| flat |" in table


def along_grooves(lengths):
    """Grooved pillars whose times are correlated as far as given, by sliding direction."""
    found = {}
    for direction, length in lengths.items():
        scene = Scene(60, 28, 32, 8, 2, direction=direction)
        found[scene] = ensemble(scene, length=length, runs=30)
    return found


def test_the_page_tells_along_from_across():
    made = along_grooves({"y": 0.3, "x": 5.0, "45": 2.0})
    found = sliding.by_angle(made)
    assert list(found) == [0.0, 45.0, 90.0]
    for angle, length in ((0.0, 5.0), (45.0, 2.0), (90.0, 0.3)):
        for times in sliding.edges(found[angle]).values():
            close, far = (sliding.at(times, r) for r in (1, 3))
            assert close.low < np.exp(-1.0 / length) < close.high
            assert far.low - 0.05 < np.exp(-3.0 / length) < far.high + 0.05
    conclusion, table = sliding.answers(made)
    assert conclusion.count("decreases from") == 2
    assert len(table.splitlines()) == 8


def scattered(length, best=lambda std: 10.0):
    """Pillars whose l_c and whose friction-minimising n_p follow the scatter."""
    found = {}
    for std in (0.05, 0.1, 0.2):
        varied = () if std == 0.1 else (("mu_static_std", std),)
        for n_p in (4, 10, 20):
            scene = Scene(80, n_p, n_p, varied=varied)
            height = 0.7 + 0.02 * np.log(n_p / best(std)) ** 2
            found[scene] = ensemble(scene, height, length(std), runs=25)
    return found


@pytest.mark.parametrize(
    ("exponent", "words", "best", "minimum"),
    [
        (-1.0, "decreases", lambda std: 100.0 * std, "changes from 4 to 20"),
        (0.0, UNCHANGED, lambda std: 10.0, f"{UNCHANGED}: 10"),
    ],
)
def test_the_page_says_what_scatter_changes(exponent, words, best, minimum):
    conclusion, table = scatter.answers(scattered(lambda std: 2.0 * (10.0 * std) ** exponent, best))
    assert "from 0.05 to 0.2**, the decay length" in conclusion
    assert f"length {words}" in conclusion or f"and {words}" in conclusion
    assert conclusion.endswith(f"the friction-minimising n_p {minimum}, among 4, 10 and 20.")
    assert len(table.splitlines()) == 5


def of_sizes(power, runs=200):
    """Flat surfaces whose variance goes with n^-power."""
    found = {}
    for n in (10, 20, 40):
        scatter = 0.1 * float(n**2) ** (-power / 2.0)
        found[Scene(n)] = lean(Scene(n), 0.7, runs, scatter)
    return found


def test_the_exponent_of_the_variance_is_found_again():
    """With 200 runs a variance has an error of a tenth, the exponent one of 0.05."""
    power = 0.5
    sizes = variance.by_pattern(of_sizes(power))[0, 0]
    found = variance.exponent(sizes)
    assert found.low <= power <= found.high
    assert found.high - found.low < 0.3


def test_the_page_says_whether_blocks_are_independent():
    law, steps, _ = variance.answers(of_sizes(1.0))
    assert "on flat surfaces (not significantly" in law
    assert "N = 20 and 40; x = 1 gives 0.25, within the interval" in steps
    assert "on flat surfaces (significantly" in next(variance.answers(of_sizes(0.4)))
    assert not list(variance.answers({Scene(10): lean(Scene(10), 0.7)}))


def test_a_variance_that_stays_at_last_goes_by_no_power():
    """It falls by 16 and then not at all: off the line by many standard errors."""
    made = of_sizes(1.0)
    made[Scene(40)] = lean(Scene(40), 0.7, 200, 0.1 / 10)
    made[Scene(20)] = lean(Scene(20), 0.7, 200, 0.1 / 40)
    assert "A law n^-x is rejected on flat surfaces (chi" in next(variance.answers(made))


def test_a_power_law_is_tested_by_all_variances():
    """Those of `docs/beyond.md`, section 7, / 1e-6: flat surfaces, then pillars of 10 blocks."""
    flat = {30: 100.0, 60: 14.0, 120: 9.9, 240: 1.1, 480: 1.0}
    assert variance.misfit(flat, [20, 20, 40, 20, 20]) == pytest.approx(11.23, abs=0.01)
    pillars = {40: 81.0, 60: 35.0, 80: 22.0, 120: 10.4, 160: 4.9, 240: 4.0}
    assert variance.misfit(pillars, [20, 60, 20, 60, 20, 20]) == pytest.approx(1.36, abs=0.01)
