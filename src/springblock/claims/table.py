"""The table `claims`: one row per finding."""

from collections.abc import Iterable

import numpy as np
import pyarrow as pa

from springblock.analysis.estimate import UNKNOWN
from springblock.claims.rule import Claim, Evidence, Finding, describe, verdict
from springblock.io.rows import Row
from springblock.io.schemas import column

SCHEMA = pa.schema(
    [
        column("claim", pa.string(), "1", "short name of the statement"),
        column("section", pa.string(), "1", "where the paper makes it"),
        column("form", pa.string(), "1", "universal, general or existential"),
        column(
            "statement", pa.string(), "1", 'the paper\'s words, and after "Tested:" the criterion'
        ),
        column("case", pa.string(), "1", "surface, part or reading that the row is about"),
        column("statistic", pa.string(), "1", "definition of the value"),
        column("unit", pa.string(), "1", "unit of the seven numbers that follow"),
        column("value", pa.float64(), "see unit", "the statistic; NaN if not tested"),
        column("ci_low", pa.float64(), "see unit", "lower end of its 95 % interval"),
        column("ci_high", pa.float64(), "see unit", "upper end"),
        column(
            "together_low",
            pa.float64(),
            "see unit",
            "lower end of the 95 % interval simultaneous with those of the statement's other rows "
            "(Bonferroni)",
        ),
        column("together_high", pa.float64(), "see unit", "upper end"),
        column("claimed_low", pa.float64(), "see unit", "the statement claims more than this"),
        column("claimed_high", pa.float64(), "see unit", "and less than this"),
        column("realisations", pa.int32(), "1", "behind the value; 0: exact"),
        column("outcome", pa.string(), "1", "of this row: holds, fails or open"),
        column(
            "needed",
            pa.float64(),
            "1",
            "realisations that decide with a power of 90 %, if value and scatter are the true ones",
        ),
        column("verdict", pa.string(), "1", "on the statement, from all its rows"),
        column("boundary", pa.string(), "1", "where the statement holds and where it fails"),
        column("rests_on", pa.string(), "1", "files, scenes and rows behind the value, by ';'"),
    ]
)


def rows(claims: Iterable[Claim], evidence: Evidence) -> list[Row]:
    """Test every claim: a row for each finding, or one that names the missing data."""
    table = []
    for claim in claims:
        findings = list(claim.test(evidence))
        judged, where = verdict(claim.form, findings)
        missing = Finding({}, "", UNKNOWN, (np.nan, np.nan), f"missing: {claim.needs}")
        for finding in findings or [missing]:
            estimate, together = finding.estimate, max(1, len(findings))
            low, high = estimate.limits(together)
            row = {
                "claim": claim.name,
                "section": claim.section,
                "form": claim.form,
                "statement": claim.statement,
                "case": describe(finding.case),
                "statistic": finding.statistic,
                "unit": finding.unit,
                "value": estimate.value,
                "ci_low": estimate.ci_low,
                "ci_high": estimate.ci_high,
                "together_low": low,
                "together_high": high,
                "claimed_low": finding.claimed[0],
                "claimed_high": finding.claimed[1],
                "realisations": estimate.n,
                "outcome": finding.outcome(together),
                "needed": finding.needed(together),
                "verdict": judged,
                "boundary": where,
                "rests_on": finding.rests_on,
            }
            table.append(row)
    return table
