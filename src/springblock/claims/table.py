"""The table `claims`: one row per finding."""

from collections.abc import Iterable

import numpy as np
import pyarrow as pa

from springblock.analysis.estimate import UNKNOWN
from springblock.claims.rule import (
    ENOUGH,
    Claim,
    Evidence,
    Finding,
    RowsByScene,
    describe,
    verdict,
)
from springblock.claims.stress import elastic_forces
from springblock.io.records import Record, by_scene
from springblock.io.rows import Row
from springblock.io.schemas import column, numbers, texts
from springblock.model.scene import Scene

SCHEMA = pa.schema(
    [
        *texts(
            claim="short name of the statement",
            section="section of the paper",
            form="universal, general or existential",
            statement='the paper\'s words, and after "Test:" the criterion',
            case="surface, part or reading that the row is about",
            statistic="definition of the value",
            unit="unit of the numbers from value to claimed_high",
        ),
        *numbers(
            "see unit",
            value="the statistic; NaN if not tested",
            ci_low="lower limit of its 95 % interval",
            ci_high="upper limit",
            together_low="lower limit of the 95 % interval simultaneous with those of the "
            "statement's other rows (Bonferroni)",
            together_high="upper limit",
            claimed_low="lower limit of the claimed range",
            claimed_high="upper limit",
        ),
        column("realisations", pa.int32(), "1", "number of realisations; 0: exact"),
        *texts(
            outcome="of this row: holds, fails or open",
        ),
        *numbers(
            "1",
            needed="realisations that decide with a power of 90 % if value and standard deviation "
            "are the true ones",
        ),
        *texts(
            verdict="verdict on the statement, from all its rows",
            boundary="where the statement holds and where it fails",
            rests_on="files, scenes and rows behind the value, separated by ';'",
        ),
    ]
)
_WANTED = (
    f"missing: surfaces with {ENOUGH} realisations each, or tables, with which the study of "
    "`config/full.yaml` has a verdict"
)
_MISSING = Finding({}, "", UNKNOWN, (np.nan, np.nan), _WANTED)


def rows(claims: Iterable[Claim], evidence: Evidence) -> list[Row]:
    """Test every claim: a row for each finding, or one without, if data are missing."""
    table: list[Row] = []
    for claim in claims:
        findings = list(claim.test(evidence))
        judged, where = verdict(claim.form, findings)
        same = {"claim": claim.name, "section": claim.section, "form": claim.form}
        same |= {"statement": claim.statement, "verdict": judged, "boundary": where}
        table += [same | _measured(each, max(1, len(findings))) for each in findings or [_MISSING]]
    return table


def _measured(finding: Finding, together: int) -> Row:
    """Return the columns of one finding of several `together`."""
    estimate, (low, high) = finding.estimate, finding.estimate.limits(together)
    return {
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
        "rests_on": finding.rests_on,
    }


def gathered(records: Iterable[Record], **tables: Iterable[Row]) -> Evidence:
    """Return the evidence of realisations and of rows of tables, by their names in `Evidence`.

    Scenes with too few realisations are left out.
    """
    found = by_scene(records)
    tested = {scene: runs for scene, runs in found.items() if len(runs) >= ENOUGH}
    by_name: dict[str, RowsByScene] = {}
    for name in ("correlation", "correlation_length"):
        rows_of = by_scene(tables[name], Scene.from_row)
        by_name[name] = {scene: rows for scene, rows in rows_of.items() if scene in tested}
    stress = {
        scene: elastic_forces(scene, runs[0].material)
        for scene, runs in found.items()
        if scene.level and not scene.varied and scene.direction in ("x", "y")
    }
    return Evidence(tested, **by_name, stress=stress, precision=list(tables["precision"]))
