"""Changes with the lattice are distinguished from changes with the layer or the disorder."""

import numpy as np
import pytest

from beyond.made_up import PLACES, SIZES, lattices
from springblock.analysis.statistics import Interval
from springblock.beyond.lattice import (
    Comparison,
    Lattice,
    answers,
    by_lattice,
    changes,
    comparisons,
    measures,
    minimum,
    stress_ratio,
)
from springblock.beyond.question import UNCHANGED, side_length
from springblock.model.scene import Scene


def eighty(spacing, l_z, scatter):
    return 80.0


def surfaces(length=eighty, best=eighty, runs=3):
    return by_lattice(lattices(length, best, runs))


def test_surfaces_are_of_one_size_in_metres_and_of_one_distance():
    made = lattices(eighty, eighty, runs=3)
    other = Scene(18, 3, 3), Scene(48, 8, 16), Scene(48, 8, 8, direction="y")
    found = by_lattice(made | {scene: next(iter(made.values())) for scene in other})
    assert set(found) == {Lattice(*map(float, at)) for at in PLACES}
    assert all(tuple(sizes) == SIZES for sizes in found.values())


def test_surfaces_of_a_comparison_differ_in_one_length():
    """From coarse to fine and from thin to thick; no scatter is no disorder of any length."""
    made = surfaces()
    found = comparisons(made)
    assert {name: [at[:3] for at in each.surfaces] for name, each in found.items()} == {
        "block": [(20, 10, 0.1), (10, 10, 0.1), (5, 10, 0.1)],
        "area": [(20, 10, 0.05), (10, 10, 0.1), (5, 10, 0.2)],
        "length": [(20, 10, 0.1), (10, 10, 0.1), (5, 10, 0.1)],
        "none": [(20, 10, 0), (10, 10, 0), (5, 10, 0)],
        "layer": [(10, 5, 0.1), (10, 10, 0.1), (10, 20, 0.1)],
    }
    lengths = {name: {at.length for at in each.surfaces} for name, each in found.items()}
    assert lengths.pop("length") == {20.0}
    assert set.union(*lengths.values()) == {0.0}
    two = {at: sizes for at, sizes in made.items() if at.spacing > 5.0}  # lattices are too few
    assert set(comparisons(two)) == {"layer"}


def test_a_decay_length_is_found_again_in_blocks():
    """Of 30 µm: three blocks of 10 µm, on pillars of 24."""
    sizes = surfaces(lambda *_: 30.0, runs=40)[Lattice(10.0, 10.0, 0.1, 0.0)]
    found = side_length(sizes[240.0])
    assert found.low < 3.0 < found.high
    assert found.high - found.low < 3.0
    assert side_length(sizes[20.0]) is None  # two blocks
    assert side_length(sizes[240.0][:10]) is not None
    assert side_length(sizes[240.0][:9]) is None  # too few realisations


def test_stress_on_the_outermost_blocks_goes_with_one_over_the_spacing():
    """A force per length on the edges; at its corners more."""
    found = surfaces()
    coarse, fine = (
        stress_ratio(found[Lattice(spacing, 10.0, 0.1, 0.0)][120.0]) for spacing in (10.0, 5.0)
    )
    assert 1.6 < fine / coarse < 2.4


def test_the_page_has_the_sizes_of_each_lattice_and_layer():
    """A minimum at twice the layer's thickness, but at ten blocks without disorder."""
    made = lattices(eighty, lambda x, l_z, s: 8.0 * l_z if s else 8.0 * x, runs=9)  # none of c(r)
    *_, size, table = answers(made)
    assert "80 µm at l_z = 10" in size
    assert "80 µm at l = 10 µm and 40" in size
    assert len(table.splitlines()) == 2 + len(PLACES)
    realisations = {row.split(" | ")[-1].rstrip(" |") for row in table.splitlines()[2:]}
    assert realisations == {"9", "1"}  # one where nothing is random


def test_changes_are_those_from_the_first_lattice_finer_than_the_layer_to_the_last():
    """Ways of 2.0 and 1.0 on lattices of 10 and 5 µm; without scatter they have no interval."""
    made = surfaces()
    values = {20: (0.1, 0.0, 0.2), 10: (2.0, 1.5, 2.5), 5: (1.0, 0.5, 1.5)}
    way = {
        at: Interval(*np.array(values[at.spacing] if at.scatter else [values[at.spacing][0]] * 3))
        for at in made
    }
    found = changes(comparisons(made), way)
    assert found["block"] == found["area"] == ("decreases", "-1.0 [-1.7, -0.3]")
    assert found["none"] == ("decreases", "decreases")
    assert found["layer"][0] == UNCHANGED


def test_a_change_that_is_not_monotonic_is_named():
    layers = [Lattice(10.0, l_z, 0.1, 0.0) for l_z in (10.0, 20.0, 40.0)]
    compared = {"layer": Comparison("", "thickness", {at: {} for at in layers})}
    for between, said in ((1.6, ""), (2.1, ", not monotonic"), (0.9, ", not monotonic")):
        way = {
            at: Interval(*np.array([value, value - 0.1, value + 0.1]))
            for at, value in zip(layers, (2.0, between, 1.0), strict=True)
        }
        assert changes(compared, way)["layer"] == ("decreases", f"-1.00 [-1.14, -0.86]{said}")


def test_values_without_scatter_are_exact():
    """One realisation is all there are: sizes differ if their values do."""
    sizes = surfaces(best=lambda *_: 40.0)[Lattice(10.0, 10.0, 0.0, 0.0)]
    assert minimum(sizes).alike == [40.0]
    for value in measures(sizes, 80.0, 120.0, 240.0).values():
        assert value.low == value.mean == value.high


@pytest.mark.parametrize(("smallest", "is_compared"), [(40.0, True), (80.0, False)])
def test_sizes_are_compared_if_there_are_four(smallest, is_compared):
    pillars = lattices(eighty, eighty, runs=3).items()
    some = {s: runs for s, runs in pillars if s.n_p * 480.0 / s.n_blocks >= smallest}
    said = "40, 80, 120 and 240 µm" in "".join(answers(some))
    assert said == is_compared


def test_the_best_sizes_are_compared_among_those_on_all_lattices():
    """80 µm, the best, is missing on the finest lattice; of the others 120 µm is best on both."""
    made = lattices(eighty, eighty, runs=9)
    some = {
        s: runs for s, runs in made.items() if s.n_p * 480.0 / s.n_blocks != 80.0 or s.n_blocks < 96
    }
    *_, size, _ = answers(some)
    assert "120 µm at l = 10 µm and 120 µm at" in size


def test_decay_lengths_are_those_on_the_largest_pillars():
    conclusion = next(answers(lattices(eighty, lambda *_: 40.0, runs=10)))
    assert "240 µm" in conclusion
