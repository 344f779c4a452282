"""Every stiff or extreme case comes out as expected."""

import pytest
from click.testing import CliRunner

from springblock.accuracy.stability.cases import Family, Outcome
from springblock.accuracy.stability.table import all_cases
from springblock.cli import stability

CASES = list(all_cases())


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_the_outcome_is_the_expected_one(case):
    assert case.outcome().outcome == case.expected


def test_there_are_enough_cases_each_with_its_own_name():
    assert len({case.name for case in CASES}) == len(CASES) >= 40


@pytest.mark.parametrize("word", ["agrees", "drifts"])
def test_the_table_is_written_if_each_case_comes_out_as_expected(word, tmp_path, monkeypatch):
    case = Family("rest", "rk4").case("nothing", 0.0, "agrees", "none", lambda _: Outcome(word))
    monkeypatch.setattr(stability, "all_cases", lambda: [case])
    output = tmp_path / "table.parquet"
    outcome = CliRunner().invoke(stability.try_cases, ["--output", output])
    assert (outcome.exit_code == 0) == output.exists() == (word == "agrees")
    assert ("nothing, rk4: expected 'agrees', not 'drifts'" in outcome.output) == (word == "drifts")
