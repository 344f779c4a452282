"""All cases, and the rows of results/tables/stability.parquet."""

from collections.abc import Iterator
from dataclasses import asdict
from typing import Any

import pyarrow as pa

from springblock.accuracy.stability import (
    block,
    load,
    overflow,
    rest,
    size,
    step,
    surface,
    weakening,
)
from springblock.accuracy.stability.cases import Case, Outcome
from springblock.io.schemas import column
from springblock.solver import INTEGRATORS

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

KINDS = (step, block, surface, weakening, load, size, rest, overflow)


def all_cases() -> Iterator[Case]:
    """Every kind, by both integrators."""
    yield step.lattice_case()
    for kind in KINDS:
        for integrator in INTEGRATORS:
            yield from kind.cases(integrator)


def row(case: Case, outcome: Outcome) -> dict[str, Any]:
    """One row of the table."""
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
