"""What the paper says of its model and method (section 2)."""

from collections.abc import Iterator

from springblock.accuracy.conventions import PAPER_STEP, ensemble_error
from springblock.claims.ranges import within
from springblock.claims.rule import Evidence, Finding, claim
from springblock.claims.samples import interval
from springblock.io.rows import select


@claim(
    "A step of 1e-8 s suffices",
    "2",
    "h = 1e-8 s reduces integration errors under the statistical uncertainty. Tested: bias "
    "within one standard error of an ensemble of 20, on small surfaces.",
    "the table `work_precision`",
)
def step_suffices(evidence: Evidence) -> Iterator[Finding]:
    """The bias at h = 1e-8 s stays within the standard error of an ensemble, as in accuracy.md."""
    for row in select(evidence.precision, step=PAPER_STEP, comparison="paired"):
        keys = {key: row[key] for key in ("scene", "quantity")}
        scatter = select(evidence.precision, comparison="scatter", **keys)
        if not scatter:
            continue
        limit = ensemble_error(scatter[0])
        yield Finding(
            {"integrator": row["integrator"], **keys},
            f"relative bias at h = {PAPER_STEP:.0e} s",
            interval(row, "error"),
            within(limit),
            f"tables/work_precision: comparison = paired, step = {PAPER_STEP:.0e}",
        )
