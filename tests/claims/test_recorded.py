"""No statistic, range or interval changes unnoticed on the made-up evidence.

`PYTHONPATH=tests python -m claims.test_recorded` records the findings after an intended change.
"""

from pathlib import Path

import pandas as pd

from claims import paper
from springblock.claims import CLAIMS
from springblock.claims.rule import describe

RECORDED = Path(__file__).with_name("findings.csv")


def findings() -> pd.DataFrame:
    evidence = paper.evidence(paper.realisations(paper.CURVES))
    rows = [
        {
            "claim": claim.test.__name__,
            "form": claim.form,
            "case": describe(found.case),
            "statistic": found.statistic,
            "unit": found.unit,
            "n": found.estimate.n,
            "value": found.estimate.value,
            "ci_low": found.estimate.ci_low,
            "ci_high": found.estimate.ci_high,
            "lowest": found.claimed[0],
            "highest": found.claimed[1],
        }
        for claim in CLAIMS
        for found in claim.test(evidence)
    ]
    return pd.DataFrame(rows)


def test_findings_are_those_recorded():
    recorded = pd.read_csv(RECORDED).fillna({"case": ""})
    pd.testing.assert_frame_equal(findings(), recorded, rtol=1e-6, atol=1e-12, check_dtype=False)


if __name__ == "__main__":
    findings().to_csv(RECORDED, index=False, float_format="%.9g")
