"""Lengths that follow the lattice are told from those that follow the layer or the disorder."""

import numpy as np
import pytest

from beyond.made_up import PLACES, SIZES, lattices
from springblock.analysis.correlation import fit_tail
from springblock.beyond.lattice import (
    Layer,
    answers,
    evenly_disordered,
    fits,
    layers,
    minimum_exponents,
    refined,
)
from springblock.beyond.resampling import area, exponents, length_exponents, means
from springblock.model.scene import Scene

LAWS = {
    "lattice": (lambda spacing, l_z, scatter: 3.0 * spacing, (1.0, 0.0)),
    "layer": (lambda spacing, l_z, scatter: 3.0 * l_z, (0.0, 1.0)),
    "both": (lambda spacing, l_z, scatter: 3.0 * np.sqrt(spacing * l_z), (0.5, 0.5)),
}


def sixty(spacing, l_z, scatter):
    return 60.0


def surfaces(length=sixty, best=sixty, runs=3):
    return layers(lattices(length, best, runs))


def rates(found):
    return np.log([(at.spacing, at.thickness) for at in found])


def close(interval, expected, within):
    assert interval.low <= expected <= interval.high
    assert abs(interval.mean - expected) < within


@pytest.mark.parametrize("name", LAWS)
def test_lengths_without_scatter_have_exact_exponents(name):
    length, expected = LAWS[name]
    places = [Layer(*map(float, at)) for at in PLACES]
    samples = [np.full(3, length(*at)) for at in places]
    found = exponents(rates(places), samples, lambda *drawn, axis: means(drawn, axis))
    np.testing.assert_allclose([each.mean for each in found], expected, atol=1e-12)


@pytest.mark.parametrize(("name", "fit"), [("lattice", fit_tail), ("layer", area)])
def test_the_exponents_of_l_c_are_found_again(name, fit):
    """Where lengths are a block or more, and the range holds three of them."""
    length, expected = LAWS[name]
    made = surfaces(lambda *at: 0.6 * length(*at), runs=40 if fit is fit_tail else 120)
    fitted = {at: fits(sizes, fit)[SIZES[-1]] for at, sizes in refined(made).items()}
    spacings = [at.spacing for at in fitted]
    exponents_found = length_exponents(fitted.values(), rates(fitted), spacings)
    for found, exponent in zip(exponents_found, expected, strict=True):
        close(found, exponent, 0.3)


@pytest.mark.parametrize("name", LAWS)
def test_the_exponents_of_the_lowest_friction_are_found_again(name):
    """Inside the sizes of pillars, which end at 20 and 240 µm; runs scatter by 1e-3."""
    length, expected = LAWS[name]
    made = refined(surfaces(best=lambda *at: 2.0 * length(*at), runs=20))
    for found, exponent in zip(minimum_exponents(rates(made), made), expected, strict=True):
        close(found, exponent, 0.05)


def test_surfaces_are_of_one_size_in_metres_and_of_one_distance():
    made = lattices(sixty, sixty, runs=3)
    other = Scene(18, 3, 3), Scene(48, 8, 16), Scene(48, 8, 8, direction="y")
    found = layers(made | {scene: next(iter(made.values())) for scene in other})
    assert set(found) == {Layer(*map(float, at)) for at in PLACES}
    assert all(tuple(sizes) == SIZES for sizes in found.values())


def test_the_same_disorder_per_area_is_a_scatter_that_goes_with_one_over_the_spacing():
    found = surfaces()
    assert set(refined(found)) == {at for at in found if at.scatter == 0.1}
    assert set(evenly_disordered(found)) == {(20, 10, 0.05), (10, 10, 0.1), (5, 10, 0.2)}


def test_the_page_says_what_a_length_follows(monkeypatch):
    """A friction-minimising pillar that goes with the root of spacing times scatter, 60 µm."""
    monkeypatch.setattr("springblock.beyond.resampling._RESAMPLES", 200)
    *sentences, table = answers(
        lattices(sixty, lambda spacing, l_z, scatter: 60.0 * (spacing * scatter) ** 0.5, runs=12)
    )
    alike, even = (line for line in sentences if line.startswith("**friction-minimising pillar"))
    assert "with the layer unchanged" in alike
    assert "with the lattice in part" in alike
    assert "at the same disorder per area" in even
    assert "with the lattice unchanged" in even
    assert len(table.splitlines()) == 9


def test_two_lattices_are_too_few():
    made = lattices(sixty, sixty, runs=3)
    assert not list(answers({s: r for s, r in made.items() if s.n_blocks != 96}))
