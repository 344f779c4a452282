"""Warnings where slip weakening depends on the lattice, or on healing."""

from dataclasses import replace

import numpy as np
import pytest

from springblock import Material, Setup, Surface, simulate
from springblock.simulation import resolution

#: kappa = 0.94 on stripes with a contact fraction of 1/2: a long process zone.
FINE = Material(
    law="slip_weakening", slip_distance=5e-8, spacing=2.4e-6, mu_static_std=0.0, mu_dynamic_std=0.0
)


def doubts(material, duration=None, direction="x"):
    contact = np.outer([True] * 3, np.arange(16) < 8)
    surface = Surface.draw(contact, 0, material, periodic=True)
    run = simulate(surface, Setup(material, step=1e-8), direction, duration)
    return list(resolution.doubts(surface, material, direction, run))


@pytest.mark.parametrize(
    ("changes", "direction", "named"),
    [
        ({"spacing": 2.4e-6}, "x", None),
        ({"spacing": 2.5e-6}, "x", "choose at most 2.4e-06 m"),  # a fifth of 1.22 l_z
        ({"spacing": 2.4e-6}, "y", "choose at most 1.4e-06 m"),  # of 0.71 l_z
        ({"spacing": 2.4e-6}, 60.0, "choose at most 1.7e-06 m"),  # sqrt(1/2 + cos²) l_z
        ({"spacing": 1.4e-6}, "y", None),
        ({"spacing": 2e-6, "slip_distance": 1e-8}, "x", "choose at most 1.5e-06 m"),  # c_0/6
        ({"law": "coulomb", "slip_distance": 0.0}, "y", None),
        ({"mu_static": 0.6}, "x", None),  # nothing weakens: the process zone is infinite
    ],
)
def test_a_lattice_that_does_not_resolve_the_weakening_is_named(changes, direction, named):
    """c_0/6 or lambda/5 of the edges there are, here along y."""
    found = doubts(replace(FINE, **changes), duration=2e-6, direction=direction)
    assert len(found) == (named is not None)
    assert not named or named in found[0]


@pytest.mark.parametrize(
    ("healing", "gamma", "is_told"),
    [("instant", 5e3, True), ("none", 5e3, False), ("instant", 1e7, False)],
)
def test_blocks_that_heal_and_slip_again_before_the_peak_are_told(healing, gamma, is_told):
    material = replace(FINE, healing=healing, gamma=gamma, slip_distance=2e-8)
    found = doubts(material)
    assert any("heal and slip again" in each for each in found) == is_told
