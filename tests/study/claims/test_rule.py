"""Statements as data, and the rule from intervals to verdicts."""

import csv
import math
from dataclasses import replace

import numpy as np
import pytest

from springblock.analysis.estimate import Estimate
from springblock.io.parquet import rows_to_table
from springblock.study.claims import STATEMENTS
from springblock.study.claims.page import Judged, values
from springblock.study.claims.rule import INF, TESTS, Case, Evidence, Finding, Statement, verdict
from springblock.study.claims.table import SCHEMA, rows
from springblock.study.pages import rendered
from studies import ROOT


def finding(low, high, claimed=(0.0, INF), n=10**6, **case):
    estimate = Estimate((low + high) / 2.0, low, high, n)
    return Finding(Case(**case), "a difference", estimate, claimed, unit="s")


HOLDS, FAILS, OPEN = (1.0, 2.0), (-2.0, -1.0), (-0.1, 0.2)


@pytest.mark.parametrize(
    ("outcome", "claimed", "intervals"),
    [
        ("holds", (0.0, INF), [HOLDS]),
        ("fails", (0.0, INF), [FAILS, (0.0, 0.0)]),  # more than nothing is claimed
        ("open", (0.0, INF), [OPEN, (math.nan, math.nan)]),
        ("holds", (-INF, 0.0), [FAILS]),
        ("holds", (-1.0, 1.0), [(-0.1, 0.1)]),
        ("open", (-1.0, 1.0), [(0.9, 1.1)]),
        ("fails", (-1.0, 1.0), [(1.1, 1.2)]),
    ],
)
def test_an_interval_decides_by_where_it_lies(outcome, claimed, intervals):
    assert {finding(*each, claimed).outcome(1) for each in intervals} == {outcome}


@pytest.mark.parametrize(
    ("intervals", "universal", "general"),
    [
        ([HOLDS, HOLDS], "reproduced", "reproduced"),
        ([FAILS, FAILS], "not reproduced", "not reproduced"),
        ([HOLDS, FAILS], "not reproduced", "reproduced in part"),
        ([HOLDS, FAILS, OPEN], "not reproduced", "reproduced in part"),
        ([HOLDS, OPEN], "not settled", "not settled"),
        ([FAILS, OPEN], "not reproduced", "not reproduced"),
        ([], "not tested", "not tested"),
    ],
)
def test_the_form_of_a_statement_says_what_its_cases_decide(intervals, universal, general):
    findings = [finding(*interval, n_p=i) for i, interval in enumerate(intervals)]
    counts = intervals.count(HOLDS), len(intervals)
    assert verdict("universal", findings) == (universal, *counts)
    assert verdict("general", findings) == (general, *counts)


@pytest.mark.parametrize(
    ("other", "word"), [(HOLDS, "reproduced"), (FAILS, "not reproduced"), (OPEN, "not settled")]
)
def test_all_findings_of_a_case_must_hold_and_one_that_fails_decides_it(other, word):
    found = verdict("general", [finding(*each, n_p=6) for each in (HOLDS, other)])
    assert found == (word, word == "reproduced", 1)


def test_a_verdict_needs_findings_that_hold_jointly():
    """Alone the interval lies above zero; as one of two, at 97.5 %, it does not."""
    near = Finding(Case(n_p=1), "slope", Estimate(1.005, 0.01, 2.0, 20), (0.0, INF))
    words = [verdict("general", [near] * k)[0] for k in (1, 2)]
    assert words == ["reproduced", "not settled"]


def with_findings(name: str, *findings: Finding) -> Statement:
    """One of the statements, with these findings."""
    statement = next(each for each in STATEMENTS if each.id == name)
    return replace(statement, form="general", test=lambda _: findings)


GROWS = with_findings(
    "growing_length", *(finding(*each, n_p=i) for i, each in enumerate([HOLDS, FAILS]))
)
MISSING = with_findings("two_peaks")


def test_the_table_has_a_row_for_each_finding_and_one_for_what_is_missing():
    first, second, third = rows_to_table(rows([GROWS, MISSING], Evidence()), SCHEMA).to_pylist()
    assert (first["value"], first["ci_low"], first["ci_high"]) == (1.5, 1.0, 2.0)
    assert (first["n_p"], second["n_p"], first["fit"]) == (0, 1, None)
    assert (first["outcome"], second["outcome"]) == ("holds", "fails")
    assert (first["verdict"], first["holds"], first["cases"]) == ("reproduced in part", 1, 2)
    assert (third["verdict"], third["holds"], third["cases"]) == ("not tested", 0, 0)
    assert np.isnan(third["value"])


def judged(*findings: Finding) -> Judged:
    (part,) = values(rows([with_findings("growing_length", *findings)], Evidence()))["parts"]
    return part


@pytest.mark.parametrize(
    ("intervals", "decided"),
    [
        ([HOLDS, (8.0, 9.0)], 0),  # the smallest margin
        ([HOLDS, FAILS, (-9.0, -8.0)], 2),  # the clearest failure
        ([HOLDS, (-1.0, 2.0), (-1.0, 1.4)], 1),  # the first that is open
    ],
)
def test_one_finding_decides_a_verdict(intervals, decided):
    found = [finding(*interval, n_p=i, n=100) for i, interval in enumerate(intervals)]
    assert judged(*found).deciding["n_p"] == decided


def test_the_page_has_each_statement_with_its_count_and_the_finding_that_decides():
    page = rendered("claims/page.md", **values(rows([GROWS, *STATEMENTS[:2]], Evidence())))
    deciding = "a difference, n_p = 1: -1500000 [-2071797, -928203] µs | > 0 |"
    judged = f"| {GROWS.title} | general | **reproduced in part** | 1 of 2 | changed | {deciding}"
    assert judged in page
    assert page.count(" | **not tested** | ") == 2


def test_every_test_has_a_statement_and_every_statement_a_test():
    assert {each.id for each in STATEMENTS} == set(TESTS)
    assert {each.form for each in STATEMENTS} == {"universal", "general"}


def registered(name):
    with (ROOT / "docs/registration" / name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_every_statement_is_as_registered():
    """One that is new, or in another form, has a reason; what is no longer tested is listed."""
    forms = {row["claim"]: row["form"] for row in registered("register.csv")}
    others = [each for each in STATEMENTS if each.form != forms.get(each.title)]
    assert all(each.changed for each in others)
    left = {row["claim"] for row in registered("retired.csv")}
    assert left == set(forms) - {each.title for each in STATEMENTS}
