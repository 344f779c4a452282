"""Values of the page on the mechanism."""

import pytest

from springblock.study.mechanism.page import values
from study.mechanism import chapter


@pytest.fixture(scope="module")
def found():
    """Values from tables made up."""
    tables = chapter.rows, chapter.damped, chapter.springs, chapter.grooves, chapter.settings
    return values(*(rows() for rows in tables))


def test_changes_are_those_from_one_model_to_the_next_in_percent(found):
    assert found["change"]["sticking"][6].mean == pytest.approx(100.0 * (0.8 / 0.65 - 1.0), 1e-4)
    assert found["change"]["simulation"][20].mean == pytest.approx(-7.7, abs=0.1)
    assert str(found["minimum"]["simulation"]) == "20 (or 6)"


def test_damped_runs_are_compared_with_load_transfer_seed_by_seed(found):
    """The drag is gamma m v/(P l²) = 1e7/s 1.2e-12 kg 5e-4 m/s / 5e-6 N."""
    damped = found["damped"][1e7]
    assert damped["drag"] == pytest.approx(1.2e-3)
    assert damped["excess"] == pytest.approx([0.01] * 2)
    assert damped["minimum"].place == 6


def test_springs_are_told_by_their_ratio_to_the_papers(found):
    assert {*found["springs"]} == {"0.5", "2"}
    assert found["springs"]["2"]["minimum"]["simulation"].place == 20
    assert found["springs"]["2"]["uneven"] == chapter.UNEVEN[6]


def test_settings_are_named_by_what_differs_from_the_papers_surfaces(found):
    assert [*found["settings"]] == [
        "",
        "gamma 1e+06 1/s",
        "edges periodic",
        "periodic gamma 1e+06 1/s",
    ]
    assert found["settings"]["periodic gamma 1e+06 1/s"]["prominence"].high == pytest.approx(0.09)
    names = ["", "gamma 1e+06 1/s"]
    assert found["least"]("size", names) == pytest.approx(6.0)
    assert found["most"]("size", names) == pytest.approx(6.02)
