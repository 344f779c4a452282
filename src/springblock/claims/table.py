"""The table `claims`: one row per finding."""

from collections.abc import Iterable
from dataclasses import asdict
from itertools import chain

import numpy as np
import pyarrow as pa

from springblock.analysis.estimate import UNKNOWN
from springblock.claims.rule import (
    ENOUGH,
    Case,
    Evidence,
    Finding,
    RowsByScene,
    Statement,
    verdict,
)
from springblock.claims.surfaces import elastic_forces, with_and_without_grooves
from springblock.io.records import Record, by_scene
from springblock.io.rows import Row
from springblock.io.schemas import column, numbers, texts
from springblock.model.scene import Scene

#: Columns that tell the cases of a statement apart, null where they do not.
CASE = [
    field.with_nullable(True)
    for field in (
        column("n_p", pa.int32(), "blocks", "side of a pillar"),
        column("against_n_p", pa.int32(), "blocks", "side of the pillars compared with"),
        column("n_p2", pa.int32(), "blocks", "width of a pawl"),
        column("n_s2", pa.int32(), "blocks", "width of a groove"),
        column("n_p3", pa.int32(), "blocks", "size of the parts of a pawl"),
        column("along_3", pa.string(), "x or y", "direction of the grooves of level 3"),
        column("degrees", pa.float64(), "°", "angle from the grooves to the sliding direction"),
        column("constant", pa.string(), "1", "constant of the material"),
        column("constant_value", pa.float64(), "SI", "its value"),
        column("integrator", pa.string(), "1", "integrator"),
        column("fit", pa.string(), "1", "curve fitted to c(r), whose length is l_c"),
        column("part", pa.string(), "1", "part of a surface, or reading of the paper's words"),
    )
]
SCHEMA = pa.schema(
    [
        *texts(
            id="name of the statement in the code",
            claim="title of the statement",
            section="section of the paper",
            form="universal, general or existential",
        ),
        *CASE,
        *texts(
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
            verdict="verdict on the statement, from all its rows",
        ),
        column("holds", pa.int32(), "1", "cases of the statement that hold"),
        column("cases", pa.int32(), "1", "all its cases; 0 if not tested"),
        *texts(
            rests_on="files, scenes and rows behind the value, separated by ';'",
        ),
    ]
)
_MISSING = Finding(Case(), "", UNKNOWN, (np.nan, np.nan), "")


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
    estimate, (low, high) = finding.estimate, finding.estimate.limits(together)
    return asdict(finding.case) | {
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
    compared = chain.from_iterable(with_and_without_grooves(found))
    stress = {scene: elastic_forces(scene, found[scene][0].material) for scene in compared}
    return Evidence(tested, **by_name, stress=stress, precision=list(tables["precision"]))
