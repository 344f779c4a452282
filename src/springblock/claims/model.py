"""What the paper says of its model and method (section 2)."""

from collections.abc import Iterator

from springblock.accuracy.conventions import PAPER_STEP, ensemble_error
from springblock.claims.rule import Claim, Evidence, Finding
from springblock.claims.samples import interval, select


def step_suffices(evidence: Evidence) -> Iterator[Finding]:
    """The bias at h = 1e-8 s stays within the standard error of an ensemble, as in accuracy.md.

    Runge-Kutta with the friction of each stage is compared run by run: its error in static
    friction has no interval.
    """
    rows = select(evidence.precision, step=PAPER_STEP)
    plain = select(rows, integrator="plain rk4", quantity="static_friction")
    for row in select(rows, comparison="paired") + plain:
        keys = {key: row[key] for key in ("scene", "quantity")}
        scatter = select(evidence.precision, comparison="scatter", **keys)
        if not scatter:
            continue
        limit = ensemble_error(scatter[0])
        kind = "bias" if row["comparison"] == "paired" else "error"
        yield Finding(
            {"integrator": row["integrator"], **keys},
            f"relative {kind} at h = {PAPER_STEP:.0e} s",
            interval(row, "error"),
            (-limit, limit),
            f"tables/work_precision: comparison = {row['comparison']}, step = {PAPER_STEP:.0e}",
        )


CLAIMS = (
    Claim(
        "A step of 1e-8 s suffices",
        "2",
        "h = 1e-8 s reduces integration errors under the statistical uncertainty. Tested: bias "
        'within one standard error of an ensemble of 20. "plain rk4" is Runge-Kutta with the '
        "friction of each stage.",
        "the table `work_precision`",
        step_suffices,
    ),
)
