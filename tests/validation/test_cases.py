"""Every stiff or extreme case of the table `stability` comes out as expected."""

import pytest

from springblock.accuracy.stability import all_cases
from springblock.accuracy.stability.surfaces import layer

CASES = list(all_cases())


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_the_outcome_is_the_expected_one(case):
    assert case.outcome().outcome == case.expected


@pytest.mark.parametrize("ratio", [1e-4, 1e4])
def test_layers_have_the_stiffness_and_the_strain_of_their_names(ratio):
    material = layer(ratio, 1e-3)
    assert material.k_s / material.k_int == pytest.approx(ratio)
    load = material.pressure * material.spacing**2
    assert load / material.k_s == pytest.approx(1e-3 * material.spacing)


def test_each_case_has_its_own_name():
    assert len({case.name for case in CASES}) == len(CASES)
