"""Maps of load peaks and of static friction."""

import re
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from beyond.made_up import grooves, lean, sizes_and_distances
from springblock.beyond import friction, peaks
from springblock.beyond.peaks import Grooves
from springblock.model.scene import Scene


def test_prominence_is_the_depth_between_two_hills():
    """Hills of widths of 5 µs, 40 µs apart, have nothing between them; 95 % is the lesser."""
    found = peaks.by_grooves(grooves({"x": 0.95, "30": 0.92, "y": 0.0}))
    assert list(found) == [Grooves(0, 2, 4)]
    angles = found[Grooves(0, 2, 4)]
    assert list(angles) == [0.0, 30.0, 90.0]
    for angle, expected in ((0.0, 95.0), (30.0, 92.0), (90.0, 0.0)):
        np.testing.assert_allclose(angles[angle], expected, atol=0.1)


def test_of_equal_grooves_the_ensemble_with_the_most_realisations_counts():
    many, few = grooves({"x": 0.95}, runs=6), grooves({"x": 0.92}, runs=3)
    larger = {replace(scene, n_blocks=72): runs for scene, runs in few.items()}
    for both in (many | larger, larger | many):
        assert len(peaks.by_grooves(both)[Grooves(0, 2, 4)][0.0]) == 6


def test_the_page_counts_surfaces_with_more_along_than_across():
    made = grooves({"x": 0.95, "y": 0.0}) | grooves({"x": 0.0, "y": 0.95}, n_p=22)
    conclusion, hierarchy, table = peaks.answers(made)
    assert "across them** on 1 of 2 surfaces, and less prominent on 1" in conclusion
    assert "pawls of 4 and grooves of 2 blocks over the whole surface, 94.99" in conclusion
    assert "in 0 of 1 cases, and less prominent in 1. In the 0 cases in which its" in hierarchy
    assert "the differences are significant in none." in hierarchy
    assert len(table.splitlines()) == 4


def test_peaks_along_and_across_are_compared_seed_by_seed():
    """Their heights scatter by some percent, and their difference does not."""
    _, table = peaks.answers(grooves({"x": 0.95, "y": 0.94}, scatter=0.03))
    difference = table.splitlines()[-1].split("|")[-2].strip()
    assert difference == "1.00000 [1.00000, 1.00000]"


def added(n_p, ratio):
    return 0.6 + 0.05 * np.log(n_p / 6.0) ** 2 - 0.02 * ratio


def together(n_p, ratio):
    return 0.6 + 0.05 * np.log(n_p / (6.0 * ratio)) ** 2


def test_size_and_contact_that_add_up_leave_nothing():
    found = friction.friction_map(sizes_and_distances(added))
    shares = friction.explained(found)
    assert shares["interaction"].mean == pytest.approx(0.0, abs=1e-4)
    assert shares["size"].low > shares["contact"].high > 0.001


def test_the_share_of_size_is_the_variance_within_contact_fractions():
    """Friction that depends on size alone."""
    found = friction.friction_map(sizes_and_distances(lambda n_p, ratio: added(n_p, 0.0)))
    kinds = pd.Series([friction.distance(at) for at in found])
    means = pd.Series([values.mean() for values in found.values()])
    within = ((means - means.groupby(kinds).transform("mean")) ** 2).mean() / means.var(ddof=0)
    assert friction.explained(found)["size"].mean == pytest.approx(within, abs=1e-3)


def test_what_size_and_contact_do_only_together_is_left():
    found = friction.friction_map(sizes_and_distances(together))
    assert friction.explained(found)["interaction"].low > 0.01


def test_two_realisations_leave_shares_without_intervals():
    made = {scene: runs[:2] for scene, runs in sizes_and_distances(added).items()}
    assert re.search(
        r"explains a further [\d.]+ \[no interval\] % of", next(friction.answers(made))
    )


def test_the_page_has_the_lowest_friction_of_each_contact_fraction():
    """3, 6 and 12, or the nearest of the sizes that there are, over their logarithm."""
    conclusion, table = friction.answers(sizes_and_distances(together))
    assert "more on the size of pillars than on contact fraction" in conclusion
    places = [line.split("|")[4].strip() for line in table.splitlines()[2:]]
    assert places == ["4", "6", "16"]


def test_sizes_that_do_not_divide_the_side_come_from_larger_surfaces():
    made = sizes_and_distances(together)
    odd, far = Scene(252, 7, 7), Scene(280, 14, 14)
    found = friction.friction_map(made | {each: lean(each, 0.5) for each in (odd, far)})
    assert (7, 7) in found
    assert (14, 14) not in found


def test_friction_is_that_on_the_common_side_where_there_is_one():
    made = sizes_and_distances(together)
    usual = next(scene for scene in made if scene.n_p == 4)
    larger = replace(usual, n_blocks=usual.n_blocks + usual.n_p + usual.n_s)
    found = friction.friction_map(made | {larger: lean(larger, 0.5)})
    at = usual.n_p, usual.n_s
    np.testing.assert_array_equal(found[at], friction.friction_map(made)[at])
