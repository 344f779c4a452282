"""The paper's constants and derived quantities (section 2)."""

import math
from dataclasses import fields, replace

import numpy as np
import pytest

from springblock import Material
from springblock.model.material import LAWS

PAPER = Material()
MAY_VANISH = {"gamma", "mu_static", "mu_static_std", "mu_dynamic", "mu_dynamic_std"}
MAY_VANISH |= {"correlation_length", *filter(None, LAWS.values())}
NAMES = [field.name for field in fields(Material)]
NUMBERS = [name for name in NAMES if name not in ("distribution", "law", "healing")]


@pytest.mark.parametrize(
    ("name", "value", "twice_as_thick"),
    [
        ("k_int", 75.0, 150.0),
        ("k_s", 75.0, 37.5),
        ("mass", 1.2e-12, 2.4e-12),
        ("block_load", 5e-6, 5e-6),
        ("omega_min", math.sqrt(75.0 / 1.2e-12), math.sqrt(37.5 / 2.4e-12)),
        ("omega_max", math.sqrt(525.0 / 1.2e-12), math.sqrt(937.5 / 2.4e-12)),
    ],
)
def test_derived_constants_are_the_papers(name, value, twice_as_thick):
    """K_int = 3/4 E l_z, K_s = K_int l²/l_z², m = rho l² l_z, F_n = P l².

    m ω² is K_s in phase, and K_s + 6 K_int for the wave that alternates along one axis.
    """
    assert getattr(PAPER, name) == pytest.approx(value, rel=1e-15, abs=0)  # a handful of roundings
    thick = replace(PAPER, thickness=2e-5)
    assert getattr(thick, name) == pytest.approx(twice_as_thick, rel=1e-15, abs=0)


def test_whole_numbers_count_as_numbers():
    assert Material(youngs_modulus=10_000_000) == PAPER
    assert type(Material(density=np.int16(1200)).density) is float


def test_items_name_every_constant():
    assert Material(**dict(PAPER.items())) == PAPER
    assert [name for name, _ in PAPER.items()] == NAMES


@pytest.mark.parametrize("name", NUMBERS)
def test_invalid_constants_are_refused_by_name_and_only_damping_and_friction_may_vanish(name):
    for value in ("1", None, True, 1j):
        with pytest.raises(TypeError, match=rf"Material\.{name} must be a number, not {value!r}"):
            replace(PAPER, **{name: value})
    for value in (-1.0, math.nan, math.inf, 10**400):
        with pytest.raises(ValueError, match=rf"Material\.{name} must be finite and .*positive"):
            replace(PAPER, **{name: value})
    if name in MAY_VANISH:
        assert getattr(replace(PAPER, **{name: 0}), name) == 0.0
    else:
        with pytest.raises(ValueError, match=rf"Material\.{name} must be finite and positive"):
            replace(PAPER, **{name: 0})


@pytest.mark.parametrize(
    ("constants", "derived"),
    [
        ({"density": 1e-320}, "mass"),
        ({"thickness": 1e-200}, "k_s"),
        ({"pressure": 1e308, "spacing": 1e10, "thickness": 1e10}, "block_load"),
        ({"youngs_modulus": 1e308, "thickness": 1e3}, "k_int"),
    ],
)
def test_constants_that_overflow_together_are_refused(constants, derived):
    with pytest.raises(ValueError, match=f"Material.({derived}) outside the range"):
        Material(**constants)


@pytest.mark.parametrize(
    ("constants", "sentence"),
    [
        ({"distribution": "gauss"}, "distribution must be one of normal, .* uniform, not 'gauss'"),
        ({"law": "stribeck"}, "law must be one of coulomb, slip_weakening, velocity_weakening"),
        ({"law": "slip_weakening"}, "slip_distance must be positive with slip_weakening, not 0.0"),
        ({"slip_distance": 1e-7}, "slip_distance must be zero with coulomb, not 1e-07"),
        ({"healing": "slow"}, "healing must be one of instant, none, not 'slow'"),
        ({"healing": "none"}, "healing must be instant with coulomb, not 'none'"),
        ({"law": "velocity_weakening"}, "speed_scale must be positive with velocity_weakening"),
        ({"speed_scale": 0.1}, "speed_scale must be zero with coulomb, not 0.1"),
    ],
)
def test_a_law_has_its_own_constant_only(constants, sentence):
    with pytest.raises(ValueError, match=rf"^Material\.{sentence}"):
        Material(**constants)
