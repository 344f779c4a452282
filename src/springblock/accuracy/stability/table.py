"""All cases, and the rows of results/tables/stability.parquet."""

import sys
from collections.abc import Iterator
from dataclasses import asdict

import pyarrow as pa
from tqdm import tqdm

from springblock.accuracy.stability import lattice, limits, one_block
from springblock.accuracy.stability.cases import Case
from springblock.io.rows import Row
from springblock.io.schemas import column
from springblock.solver.integrators import INTEGRATORS

SCHEMA = pa.schema(
    [
        column("case", pa.string(), "1", "name of the case"),
        column("family", pa.string(), "1", "what is taken to its extremes"),
        column("integrator", pa.string(), "1", "leapfrog or rk4; both where no step is taken"),
        column(
            "parameter",
            pa.float64(),
            "1",
            "what varies within the family. step: h over the stability limit; stiffness: "
            "K_s/K_int; strain: F_n/(K_s l), how far a block slips over l; damping: gamma/omega, "
            "omega² = K_s/m; scatter: standard deviation of mu_s, twice that of mu_d; "
            "coefficients: mu_d/mu_s; speed: v K_s/(F_n omega); load: strain of the springs; "
            "weakening: (mu_s - mu_d) F_n over K_s d_c or m omega v_c; "
            "size: N; rest: number of steps; overflow: the value that is too much",
        ),
        column("expected", pa.string(), "1", "outcome that the case must have"),
        column("outcome", pa.string(), "1", "outcome that it has"),
        column("energy_error", pa.float64(), "1", "energy missing over work; NaN without a run"),
        column("quantity", pa.string(), "1", "what value is"),
        column("value", pa.float64(), "1", "the quantity that is judged; NaN where there is none"),
        column("closed_form", pa.float64(), "1", "what it should be; NaN where that is unknown"),
        column("relative_error", pa.float64(), "1", "value/closed_form - 1; NaN without either"),
        column("tolerance", pa.float64(), "1", "largest relative_error that is accepted, or NaN"),
    ]
)

#: In the order of the table.
FAMILIES = (
    limits.steps,
    one_block.frictions,
    lattice.stiffnesses,
    one_block.weakenings,
    lattice.loads,
    lattice.sizes,
    one_block.rests,
    limits.overflows,
)


def all_cases() -> Iterator[Case]:
    """Return every case, by both integrators."""
    yield limits.highest_mode_case()
    for cases in FAMILIES:
        for integrator in INTEGRATORS:
            yield from cases(integrator)


def stability_rows() -> list[Row]:
    """Try every case; return a row for each.

    Raises
    ------
    ValueError
        Where a case came out otherwise than expected; names each of them.
    """
    rows = [_row(case) for case in tqdm(list(all_cases()), unit="case")]
    wrong = [
        f"{row['case']}: expected {row['expected']!r}, not {row['outcome']!r}"
        for row in rows
        if row["outcome"] != row["expected"]
    ]
    if wrong:
        raise ValueError("\n".join(wrong))
    return rows


def _row(case: Case) -> Row:
    outcome = case.outcome()
    tqdm.write(f"{case.name}: {outcome.outcome}", file=sys.stderr)
    return {
        "case": case.name,
        "family": case.family,
        "integrator": case.integrator,
        "parameter": case.parameter,
        "expected": case.expected,
        "quantity": case.quantity,
        **asdict(outcome),
        "relative_error": outcome.relative_error,
    }
