"""The table of claims: one row per finding."""

import math
from collections.abc import Iterable

import pyarrow as pa

from springblock.claims.rule import Claim, Evidence, Finding, Row, describe, verdict
from springblock.tables import column

SCHEMA = pa.schema(
    [
        column("claim", pa.string(), "1", "short name of the statement"),
        column("section", pa.string(), "1", "where the paper makes it"),
        column("statement", pa.string(), "1", "what the paper says, in short"),
        column("case", pa.string(), "1", "the surface, part or quantity looked at"),
        column("statistic", pa.string(), "1", "what the value is"),
        column("unit", pa.string(), "1", "unit of the five numbers that follow"),
        column("value", pa.float64(), "see unit", "the statistic; NaN if not tested"),
        column("ci_low", pa.float64(), "see unit", "lower end of its 95 % interval"),
        column("ci_high", pa.float64(), "see unit", "upper end"),
        column("claimed_low", pa.float64(), "see unit", "the statement claims more than this"),
        column("claimed_high", pa.float64(), "see unit", "and less than this"),
        column("outcome", pa.string(), "1", "of this row: holds, fails or open"),
        column("verdict", pa.string(), "1", "on the statement, from all its rows"),
        column("depends_on", pa.string(), "1", "what tells cases that hold from those that fail"),
        column("rests_on", pa.string(), "1", "files, scenes and rows behind the value, by ';'"),
    ]
)


def rows(claims: Iterable[Claim], evidence: Evidence) -> list[Row]:
    """Test every claim: a row for each finding, or one that says what is missing."""
    table = []
    for claim in claims:
        findings = list(claim.test(evidence))
        judged, depends_on = verdict(findings)
        common = {
            "claim": claim.name,
            "section": claim.section,
            "statement": claim.statement,
            "verdict": judged,
            "depends_on": depends_on,
        }
        table += [{**common, **_finding_row(finding)} for finding in findings]
        if not findings:
            table.append({**common, **_missing_row(claim.needs)})
    return table


def _finding_row(finding: Finding) -> Row:
    value, low, high = (float(number) for number in finding.interval)
    return {
        "case": describe(finding.case),
        "statistic": finding.statistic,
        "unit": finding.unit,
        "value": value,
        "ci_low": low,
        "ci_high": high,
        "claimed_low": finding.claimed[0],
        "claimed_high": finding.claimed[1],
        "outcome": finding.outcome,
        "rests_on": finding.rests_on,
    }


def _missing_row(needs: str) -> Row:
    numbers = ("value", "ci_low", "ci_high", "claimed_low", "claimed_high")
    return {
        "case": "",
        "statistic": "",
        "unit": "1",
        **dict.fromkeys(numbers, math.nan),
        "outcome": "open",
        "rests_on": f"missing: {needs}",
    }
