"""Predictions for a sample, from the theory of the layer."""

from dataclasses import replace

import numpy as np
import pytest

from springblock.theory.layer import PLAIN, best_width
from springblock.theory.predict import best, predict

SLIP = replace(PLAIN, slip_distance=1e-7)


def test_squares_of_the_registered_size_have_the_registered_friction():
    """a* = 80 µm and 0.8051 with l_z = 10 µm and d_c = 100 nm, on lattices eight times as fine."""
    found = predict(SLIP, "square", 8e-5, 8e-5)
    assert found.static_friction == pytest.approx(0.8051, abs=0.002)
    assert predict(SLIP, "square", 5.6e-5, 5.6e-5).static_friction > found.static_friction
    assert predict(SLIP, "square", 1.2e-4, 1.2e-4).static_friction > found.static_friction


@pytest.mark.parametrize("shape", ["across", "along"])
def test_the_best_stripes_are_those_of_the_map_of_widths(shape):
    found = best(SLIP, shape)
    expected = best_width(SLIP.mu_dynamic / (1.0 - SLIP.mu_dynamic), found.kappa)
    assert found.width / found.decay == pytest.approx(expected, rel=0.05)


def test_the_best_width_is_sought_as_far_as_gaps_may_be_wide():
    """With gaps of up to 50 l_z, ten times as wide as the stripes."""
    found = best(SLIP, "across", 10.0)
    assert 2.0 < found.width / SLIP.thickness < 5.0 + 1e-6
    assert found.static_friction < predict(SLIP, "across", 2e-5, 2e-4).static_friction


def test_lengths_scale_with_the_layer():
    """Of a layer twice as thick, with twice the slip distance at half the spring constant."""
    thick = replace(SLIP, thickness=2.0 * SLIP.thickness, slip_distance=2.0 * SLIP.slip_distance)
    one, two = predict(SLIP, "across", 5e-5, 5e-5), predict(thick, "across", 1e-4, 1e-4)
    np.testing.assert_allclose(np.array(two[1:]) / one[1:], [1.0, 2.0, 1.0, 2.0, 2.0])


@pytest.mark.parametrize(
    ("material", "given", "sentence"),
    [
        (replace(SLIP, law="coulomb", slip_distance=0.0, healing="instant"), (), "needs the law"),
        (replace(SLIP, mu_dynamic=1.0), (), "mu_static above mu_dynamic"),
        (SLIP, ("disc", 1e-5, 1e-5), "shape must be one of across, along, square, not 'disc'"),
        (SLIP, ("square", 1e-5, 0.0), "gap = 0 m must be 0.1 to 50 times thickness"),
        (SLIP, ("square", 80.0, 80.0), "width = 80 m must be .* lengths are in m"),
    ],
)
def test_what_the_theory_is_not_for_is_refused(material, given, sentence):
    with pytest.raises(ValueError, match=sentence):
        predict(material, *(given or ("across", 5e-5, 5e-5)))
