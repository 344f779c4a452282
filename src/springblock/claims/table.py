"""The table of claims: one row per finding."""

from collections.abc import Iterable

import numpy as np
import pyarrow as pa

from springblock.claims.rule import Claim, Evidence, Finding, Row, describe, verdict
from springblock.statistics import Interval
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
        for finding in findings or [_nothing(claim)]:
            value, low, high = (float(number) for number in finding.interval)
            table.append(
                {
                    "claim": claim.name,
                    "section": claim.section,
                    "statement": claim.statement,
                    "case": describe(finding.case),
                    "statistic": finding.statistic,
                    "unit": finding.unit,
                    "value": value,
                    "ci_low": low,
                    "ci_high": high,
                    "claimed_low": finding.claimed[0],
                    "claimed_high": finding.claimed[1],
                    "outcome": finding.outcome,
                    "verdict": judged,
                    "depends_on": depends_on,
                    "rests_on": finding.rests_on,
                }
            )
    return table


def _nothing(claim: Claim) -> Finding:
    unknown = Interval(*np.full(3, np.nan))
    return Finding({}, "", unknown, (np.nan, np.nan), f"missing: {claim.needs}")
