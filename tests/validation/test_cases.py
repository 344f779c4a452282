"""Every stiff or extreme case of the table `stability` comes out as expected."""

import pytest

from springblock.study.accuracy.stability import all_cases


@pytest.mark.parametrize("case", [*all_cases()], ids=lambda case: case.name)
def test_the_outcome_is_the_expected_one(case):
    assert case.outcome().outcome == case.expected
