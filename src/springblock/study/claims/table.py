"""The table `claims`: one row per finding."""

from collections.abc import Iterable
from dataclasses import asdict, fields
from typing import get_args

import numpy as np
import pyarrow as pa

from springblock.analysis.estimate import UNKNOWN
from springblock.io.records import Record, by_scene
from springblock.io.rows import Row, scene_of
from springblock.io.schemas import column, numbers, texts
from springblock.model.scene import Scene
from springblock.study.claims import STATEMENTS
from springblock.study.claims.rule import ENOUGH, Case, Evidence, Finding, Statement, verdict

_TYPES = {int: pa.int32(), str: pa.string(), float: pa.float64()}
#: Columns that tell the cases of a statement apart, null where they do not.
_CASE = [
    column(each.name, _TYPES[get_args(each.type)[0]], **each.metadata).with_nullable(True)
    for each in fields(Case)
]
SCHEMA = pa.schema(
    [
        *texts(
            id="name of the statement in the code",
            claim="title of the statement",
            section="section of the paper",
            form="universal or general",
        ),
        *_CASE,
        *texts(statistic="definition of the value", unit="unit of value to claimed_high"),
        *numbers(
            "see unit",
            value="the statistic; NaN if not tested",
            ci_low="lower limit of its 95 % interval",
            ci_high="upper limit",
            together_low="lower limit simultaneous with the statement's other rows (Bonferroni)",
            together_high="upper limit",
            claimed_low="lower limit of the claimed range",
            claimed_high="upper limit",
        ),
        column("realisations", pa.int32(), "1", "number of realisations; 0: exact"),
        *texts(outcome="holds, fails or open", verdict="on the statement, from all its rows"),
        column("holds", pa.int32(), "1", "cases of the statement that hold"),
        column("cases", pa.int32(), "1", "all its cases; 0 if not tested"),
        *texts(rests_on="scenes behind the value, with whose names their folders begin"),
    ]
)
_MISSING = Finding(Case(), "", UNKNOWN, (np.nan, np.nan))


def rows(statements: Iterable[Statement], evidence: Evidence) -> list[Row]:
    """Test every statement: a row for each finding, or one without, if data are missing."""
    table: list[Row] = []
    for each in statements:
        findings = list(each.test(evidence))
        word, holds, cases = verdict(each.form, findings)
        same: Row = {"id": each.id, "claim": each.title, "section": each.section}
        same |= {"form": each.form, "verdict": word, "holds": holds, "cases": cases}
        table += [same | _measured(one, max(1, len(findings))) for one in findings or [_MISSING]]
    return table


def _measured(finding: Finding, together: int) -> Row:
    """Return the columns of one finding of several `together`."""
    estimate, names = finding.estimate, ("value", "ci_low", "ci_high")
    row = asdict(finding.case) | {name: getattr(estimate, name) for name in names}
    row |= {"statistic": finding.statistic, "unit": finding.unit}
    row["rests_on"] = "; ".join(scene.folder for scene in finding.scenes)
    row["together_low"], row["together_high"] = estimate.limits(together)
    row["claimed_low"], row["claimed_high"] = finding.claimed
    return row | {"realisations": estimate.n, "outcome": finding.outcome(together)}


def judged(
    records: Iterable[Record],
    correlation: Iterable[Row] = (),
    correlation_length: Iterable[Row] = (),
    work_precision: Iterable[Row] = (),
) -> list[Row]:
    """Return the rows of all statements, from realisations and the rows of tables, by name.

    Scenes with too few realisations are left out, and in tables those with other constants.
    """
    found = by_scene(records)
    usual = next(iter(found)).constants if found else {}
    tested = {scene: runs for scene, runs in found.items() if len(runs) >= ENOUGH}

    def of_tested(table: Iterable[Row]) -> dict[Scene, list[Row]]:
        scenes = by_scene(table, scene_of)
        return {s: scenes[s] for s in scenes if s in tested and s.constants == usual}

    correlations = of_tested(correlation), of_tested(correlation_length)
    return rows(STATEMENTS, Evidence(tested, *correlations, precision=list(work_precision)))
