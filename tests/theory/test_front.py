"""Passage of a slip front at a depth: first order in the disorder."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from springblock import Material
from springblock.theory.front import Front

#: Stripes of 80 µm under slip weakening, with disorder over 10 µm.
MATERIAL = Material(
    law="slip_weakening", slip_distance=1e-7, healing="none", correlation_length=1e-5
)
SHAPES = ("along", "across")
BOTH = pytest.mark.parametrize("shape", SHAPES)


def front(shape, depth=1.125e-5, **varied):
    """At a depth in m, by default of the centres of the row beyond l_z with l = 2.5 µm."""
    return Front.of(replace(MATERIAL, **varied), shape, depth, 8e-5, 8e-5)


@pytest.mark.parametrize(
    ("shape", "expected", "scatter"),
    [
        ("along", [0.901, 0.673, 0.443, 0.274], 0.0621),
        ("across", [0.842, 0.511, 0.236, 0.091], 0.0766),
    ],
)
def test_the_row_beyond_one_layer_thickness(shape, expected, scatter):
    found = front(shape)
    r = 1e-6 * np.array([5, 10, 15, 20])
    assert found.correlation(r) == pytest.approx(expected, abs=6e-4)
    assert found.scatter == pytest.approx(scatter, abs=1e-4)


@BOTH
@pytest.mark.parametrize("slip_distance", [1e-8, 1e-7])
def test_an_even_change_of_friction_shifts_the_load_as_in_the_base_state(shape, slip_distance):
    """At q = 0; with the weakening zone shorter than the depth, and as long.

    tau_s and tau_d increase by the same, which changes m and leaves Delta: P = p + m.
    """
    base, change = front(shape, slip_distance=slip_distance), 1e-5
    more = replace(base, groups=replace(base.groups, residual=base.groups.residual + change))
    expected = (more.load - base.load) / change + 1.0
    ends = np.array([0.0, base.depth - base.weakening, base.depth])
    shift = 0.0
    for start, end in pairwise(ends):
        node, weight = np.polynomial.legendre.leggauss(40)
        x = start + (node + 1.0) / 2.0 * (end - start)
        felt = base.influence(np.zeros(1), x)[0] * base.factors(x).sum(axis=0)
        shift += base.shift * (weight * felt).sum() / 2.0 * (end - start)
    assert shift == pytest.approx(expected, rel=1e-5)


@BOTH
def test_short_waves_are_felt_near_the_front_only(shape):
    """phi_q tends to exp[-(s - x) sqrt(1 - w + q² lambda_t²)] where q lambda_t is large."""
    found, q = front(shape), np.array([20.0])
    x = np.linspace(0.8, 1.0, 5) * found.depth
    decay = np.sqrt(1.0 - 1.0 / found.groups.kappa + (q * found.along) ** 2)
    assert found.influence(q, x)[0] == pytest.approx(np.exp(-(found.depth - x) * decay), rel=1e-3)


def test_a_front_at_the_edge_has_the_correlation_of_the_disorder():
    """Nothing is averaged: c(r) = exp(-r²/xi²)."""
    r = 1e-6 * np.array([5, 10, 15])
    for shape in SHAPES:
        found = front(shape, depth=1e-8)
        assert found.correlation(r) == pytest.approx(np.exp(-((r / 1e-5) ** 2)), abs=2e-3)


def test_fronts_average_over_three_times_the_width_along_sliding():
    """lambda_t/lambda_n is √3 on edges along sliding, and 1/√3 across."""
    along, across = (front(shape) for shape in SHAPES)
    assert along.along == pytest.approx(3.0 * across.along)
    r = np.array([1e-5])
    assert along.correlation(r) > across.correlation(r) > np.exp(-1.0)
    assert along.scatter < across.scatter


@BOTH
def test_the_scatter_of_the_load_is_linear_in_that_of_the_friction(shape):
    twice = front(shape, mu_static_std=0.2, mu_dynamic_std=0.1)
    assert twice.scatter == pytest.approx(2.0 * front(shape).scatter)
