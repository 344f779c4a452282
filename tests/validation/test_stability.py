"""Every stiff or extreme case comes out as expected."""

import pytest

from validation.stability import CASES


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_the_outcome_is_the_expected_one(case):
    assert case.outcome().outcome == case.expected


def test_there_are_enough_cases_each_with_its_own_name():
    assert len({case.name for case in CASES}) == len(CASES) >= 40
