"""Maps of load peaks and of static friction."""

from dataclasses import replace

import numpy as np
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


def test_surfaces_with_more_along_than_across_are_counted():
    made = grooves({"x": 0.95, "y": 0.0}) | grooves({"x": 0.0, "y": 0.95}, n_p=22)
    conclusion, _, table = peaks.answers(made)
    assert "1 of 2" in conclusion
    assert "94.99" in conclusion
    assert len(table.splitlines()) == 4


def test_peaks_along_and_across_are_compared_seed_by_seed():
    """Their heights scatter by some percent, and their difference does not."""
    _, table = peaks.answers(grooves({"x": 0.95, "y": 0.94}, scatter=0.03))
    difference = table.splitlines()[-1].split("|")[-2].strip()
    assert difference == "1.00000 [1.00000, 1.00000]"


def together(n_p, ratio):
    return 0.6 + 0.05 * np.log(n_p / (6.0 * ratio)) ** 2


def test_the_largest_difference_is_that_between_the_ends_of_one_group():
    families = [(0.7, 0.6, 0.8), (0.5, 0.65)]
    groups = [{i: np.full(2, mean) for i, mean in enumerate(means)} for means in families]
    assert friction.largest_difference(groups).mean == pytest.approx(0.2)


@pytest.mark.parametrize(("by_size", "by_contact"), [(0.03, 0.02), (0.02, 0.03), (0.03, 0.03)])
def test_friction_differs_between_sizes_by_what_they_add(by_size, by_contact):
    """Sizes from 2 to 20 at most, and n_s/n_p from 1/2 to 2."""

    def added(n_p, ratio):
        return 0.6 + by_size * np.log10(n_p / 2.0) + by_contact * np.log2(ratio) / 2.0

    said = next(friction.answers(sizes_and_distances(added)))
    assert f" {by_size:.5f} [" in said


def test_the_page_has_the_lowest_friction_of_each_contact_fraction():
    """3, 6 and 12, or the nearest of the sizes that there are, over their logarithm."""
    _, table = friction.answers(sizes_and_distances(together))
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
    stiff = replace(usual, varied={"youngs_modulus": 1e9})
    found = friction.friction_map(made | {larger: lean(larger, 0.5), stiff: lean(stiff, 0.5)})
    at = usual.n_p, usual.n_s
    np.testing.assert_array_equal(found[at], friction.friction_map(made)[at])
