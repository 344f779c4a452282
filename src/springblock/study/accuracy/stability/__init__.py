"""Stiff and extreme cases, and the rows of results/tables/stability.parquet.

Each case has an expected outcome, a word, and is run to find its outcome. Most compare a number
with its closed form or with an accurate integration, within a tolerance that follows from the order
of the scheme. A release is placed within its step: exactly where the force rises linearly, as it
does before the first release. A stop is placed at the end of its step. Values that depend on stops,
or on damping that is stiff within a step, may be wrong by their change in one step. Most cases also
bound the residual of the energy balance (`Pull.keeps_energy`).

Units in the code, unless they are said to be SI: forces in F_n, lengths in F_n/K_s, times in
1/omega with omega² = K_s/m, and speeds in F_n omega/K_s.
"""

import sys
from collections.abc import Iterator

import pyarrow as pa
from tqdm import tqdm

from springblock.io.rows import Row
from springblock.io.schemas import numbers, texts
from springblock.solver.integrators import INTEGRATORS
from springblock.study.accuracy.stability import one_block, surfaces
from springblock.study.accuracy.stability.cases import Case

SCHEMA = pa.schema(
    [
        *texts(
            case="name of the case",
            family="parameter that is extreme",
            integrator=" or ".join(INTEGRATORS),
        ),
        *numbers(
            "1",
            parameter="its value. step: h over the stability limit; stiffness: "
            "K_s/K_int; strain: displacement of a column of blocks, over l; damping: gamma/omega, "
            "omega² = K_s/m; scatter: standard deviation of mu_s, twice that of mu_d; "
            "coefficients: mu_d/mu_s; speed: v K_s/(F_n omega); load: strain of the springs; "
            "weakening: (mu_s - mu_d) F_n over K_s d_c or m omega v_c; "
            "rupture front: (tau_0 - mu_d)/(mu_s - mu_d); size: N; "
            "overflow: the value that overflows",
        ),
        *texts(expected="required outcome", outcome="outcome"),
        *numbers(
            "1", energy_error="residual of the energy balance over the work; NaN without a run"
        ),
        *texts(quantity="quantity that is compared"),
        *numbers(
            "1",
            value="its value; NaN without one",
            closed_form="exact or accurately integrated value; NaN if unknown",
            relative_error="value/closed_form - 1; NaN where one is NaN",
            tolerance="largest accepted relative_error, or NaN",
        ),
    ]
)

#: In the order of the table.
FAMILIES = (
    surfaces.steps,
    one_block.frictions,
    surfaces.stiffnesses,
    one_block.weakenings,
    surfaces.loads,
    surfaces.fronts,
    surfaces.sizes,
    surfaces.overflows,
)


def all_cases() -> Iterator[Case]:
    """Yield each case with each integrator."""
    for cases in FAMILIES:
        for integrator in INTEGRATORS:
            yield from cases(integrator)


def measure(part: str) -> list[Row]:
    """Run all cases, which are one part; return a row for each.

    Outcomes that are not the expected ones are a ValueError that names their cases.
    """
    rows, wrong = [], []
    for case in tqdm(list(all_cases()), unit="case"):
        found = case.outcome()
        tqdm.write(f"{case.name}: {found.outcome}", file=sys.stderr)
        judged = {"case": case.name, "relative_error": found.relative_error}
        rows.append({**vars(case), **vars(found), **judged})
        if found.outcome != case.expected:
            wrong.append(f"{case.name}: expected {case.expected!r}, not {found.outcome!r}")
    if wrong:
        raise ValueError("\n".join(wrong))
    return rows
