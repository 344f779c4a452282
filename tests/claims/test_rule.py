"""The rule from intervals to verdicts, and what the table and the page make of it."""

import numpy as np
import pyarrow.parquet as pq
import pytest
from click.testing import CliRunner

from springblock.claims.page import page
from springblock.claims.rule import Claim, Evidence, Finding, verdict
from springblock.claims.table import SCHEMA, rows
from springblock.cli import main
from springblock.scene import Scene
from springblock.statistics import Interval
from springblock.tables import SUMMARY, rows_to_table, write

INF = float("inf")


def finding(low, high, claimed=(0.0, INF), **case):
    interval = Interval(*map(np.array, ((low + high) / 2.0, low, high)))
    return Finding(case, "a difference", interval, claimed, "tables/some: row", "s")


HOLDS, FAILS, OPEN = (1.0, 2.0), (-2.0, -1.0), (-1.0, 2.0)


@pytest.mark.parametrize(
    ("interval", "claimed", "outcome"),
    [
        (HOLDS, (0.0, INF), "holds"),
        (FAILS, (0.0, INF), "fails"),
        (OPEN, (0.0, INF), "open"),
        (FAILS, (-INF, 0.0), "holds"),
        ((-0.1, 0.1), (-1.0, 1.0), "holds"),
        ((0.9, 1.1), (-1.0, 1.0), "open"),
        ((1.1, 1.2), (-1.0, 1.0), "fails"),
        ((0.0, 0.0), (0.0, 1.0), "fails"),  # more than nothing is claimed
        ((float("nan"), float("nan")), (0.0, INF), "open"),
    ],
)
def test_an_interval_decides_by_where_it_lies(interval, claimed, outcome):
    assert finding(*interval, claimed).outcome == outcome


@pytest.mark.parametrize(
    ("intervals", "expected"),
    [
        ([HOLDS, HOLDS], "reproduced"),
        ([FAILS, FAILS], "not reproduced"),
        ([HOLDS, FAILS], "depends on"),
        ([HOLDS, FAILS, OPEN], "depends on"),
        ([HOLDS, OPEN], "not settled"),
        ([FAILS, OPEN], "not settled"),
        ([], "not tested"),
    ],
)
def test_cases_decide_together(intervals, expected):
    findings = [finding(*interval, n_p=i) for i, interval in enumerate(intervals)]
    assert verdict(findings)[0] == expected


@pytest.mark.parametrize(
    ("intervals", "expected"),
    [
        ([HOLDS, HOLDS], "reproduced"),
        ([HOLDS, FAILS], "not reproduced"),
        ([HOLDS, OPEN], "not settled"),
    ],
)
def test_all_findings_of_a_case_must_hold(intervals, expected):
    assert verdict([finding(*interval, n_p=6) for interval in intervals])[0] == expected


def test_what_a_verdict_depends_on_is_what_tells_the_cases_apart():
    cases = [(HOLDS, 20, 1), (HOLDS, 60, 2), (FAILS, 6, 1), (OPEN, 10, 2)]
    findings = [finding(*interval, n_p=n_p, ring=ring) for interval, n_p, ring in cases]
    assert verdict(findings)[1] == "n_p: holds for 20 and 60; fails for 6; open for 10"
    findings = [finding(*interval, n_p=n_p, ring=ring) for interval, n_p, ring in cases[:2]]
    findings += [finding(*FAILS, n_p=20, ring=2)]
    expected = "n_p, ring: holds for n_p = 20, ring = 1 and n_p = 60, ring = 2; "
    assert verdict(findings)[1] == expected + "fails for n_p = 20, ring = 2"


SOME = [
    Claim("It grows", "3.2", "It grows.", "sizes", lambda _: [finding(*HOLDS, n_p=6)]),
    Claim("It shrinks", "3.3", "It shrinks.", "two sizes", lambda _: []),
]


def test_the_table_has_a_row_for_each_finding_and_one_for_what_is_missing():
    first, second = rows_to_table(rows(SOME, Evidence()), SCHEMA).to_pylist()
    assert (first["value"], first["ci_low"], first["ci_high"]) == (1.5, 1.0, 2.0)
    assert (first["case"], first["outcome"], first["verdict"]) == ("n_p = 6", "holds", "reproduced")
    assert (second["verdict"], second["rests_on"]) == ("not tested", "missing: two sizes")
    assert np.isnan(second["value"])


def test_the_page_says_the_rule_the_numbers_and_what_is_missing():
    text = page(rows(SOME, Evidence()))
    assert "| 1. It grows | **reproduced** |" in text
    assert "| n_p = 6 | a difference | 1.5 [1, 2] s | > 0 | holds |" in text
    assert "Verdict: **not tested**. Missing: two sizes." in text
    assert "first_seed=1000" in text


def test_the_command_reports_what_was_not_simulated(tmp_path, monkeypatch):
    monkeypatch.setattr("springblock.commands.claims.read_records", lambda batches: [])
    row = dict.fromkeys(SUMMARY.names, 0) | Scene(12).row | {"integrator": "leapfrog"}
    table, claims, text = (tmp_path / name for name in ("table", "claims.parquet", "claims.md"))
    write(rows_to_table([row | {"t_avg": 1.0}], SUMMARY), table, {})
    options = {"realisations": table, "configuration": "0", "output": claims, "page": text}
    arguments = [part for key, value in options.items() for part in (f"--{key}", str(value))]
    outcome = CliRunner().invoke(main, ["claims", str(table), *arguments])
    assert outcome.exit_code == 0, outcome.output
    verdicts = {row["claim"]: row["verdict"] for row in pq.read_table(claims).to_pylist()}
    assert verdicts.pop("t_max < t_avg on flat surfaces") == "not settled"  # a single run
    assert set(verdicts.values()) == {"not tested"}
    assert "not tested" in text.read_text()


def test_cases_that_differ_in_several_keys_are_told_apart_by_all_of_them():
    cases = [(HOLDS, 10, 0), (FAILS, 10, 1), (FAILS, 6, 0)]
    findings = [finding(*interval, n_p=n_p, ring=ring) for interval, n_p, ring in cases]
    judged, depends_on = verdict(findings)
    assert judged == "depends on"
    keys, cases = depends_on.split(": ")
    assert keys == "n_p, ring"
    assert cases == (
        "holds for n_p = 10, ring = 0; fails for n_p = 10, ring = 1 and n_p = 6, ring = 0"
    )
