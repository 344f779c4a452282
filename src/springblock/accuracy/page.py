"""The page that says what a reader may trust; every number in it comes from the tables."""

from collections.abc import Sequence
from statistics import median
from typing import Any

from springblock.accuracy import full_size
from springblock.accuracy.conventions import (
    ENERGY_TOLERANCE,
    ENSEMBLE,
    HORIZON_NUDGE,
    MEANS,
    OUT_OF_LINE,
    PAPER_STEP,
    PLAIN,
    ensemble_error,
    order,
)
from springblock.accuracy.full_size import by_scene
from springblock.io.rows import Row, select
from springblock.model.defaults import STEP

_PAGE = """# What to trust, and how far

Written by `snakemake accuracy` from the tables `work_precision`, `stability` and `realisations`.
The default is the leapfrog with a step of {step:.0e} s.

## Single runs, up to a horizon

Single runs are compared with a reference that shares no code with the solver: DOP853 with every
detachment and stop located as an event, on surfaces of {smallest} to {largest} blocks a side.
Errors at the default, root mean square over {n_seeds} seeds:

{singles}

Both integrators are of second order across detachments. Orders measured with steps from 1e-8 s on
(leapfrog, rk4):

{orders}

With the finest step, {finest:.0e} s, static friction and t_det before the horizon differ from the
reference by no more than {floor:.0e}: the floor of every error plot.

Runge-Kutta with the friction of each stage, as one would first write it, does not converge. Its
static friction on the flat surface is wrong by {plain:.1%} at the paper's step of {paper:.0e} s,
and still by {plain_fine:.1%} at {plain_finest:.1e} s.

Avalanches reorder. Thresholds nudged by {nudge:.0e} shift detachments by more than 0.1 % of t_max
from {pillared:.0%} (pillared), {grooved:.0%} (grooved) and {flat:.0%} (flat) of t_max on, or not
before the run ends; on patterned surfaces of full size, well before the force peak. Beyond this
horizon no step makes single runs agree, and ensembles are compared instead.

## Ensembles

Bias of the mean at the default with its 95 % interval over {n_paired} or more paired seeds
({n_ensemble} x {n_ensemble} blocks, against a step of {fine:.1e} s); in brackets the standard error
of a mean over {ensemble} seeds, which it must stay under. All in percent:

{paired}

## At full size

{full_size}
## Every production run

The largest energy residual of {n_runs} realisations is {worst_energy:.1e} of the slider's work,
the median {median_energy:.1e}. The study warns of any above {tolerance:.0e}, or above
{out_of_line:.0f} times the median of its scene.

## Stiff and extreme cases

{n_agree} of {n_cases} cases came out as expected, in these families: {families}.

## Not to be trusted

- Detachment times of single blocks on patterned surfaces beyond the horizon, and everything after
  the force peak of a single run.
- Steps near the stability limit: at {coarsest:.0e} s static friction, t_max and t_avg are biased
  by up to {coarse_bias:.1%}.
- Large strains: the model's springs stay linear in their length, real rubber does not. A spring at
  half or twice its length ends the run.
"""


def page(
    precision: list[Row],
    stability: list[Row],
    realisations: list[Row],
    production: Sequence[Row] = (),
) -> str:
    """Fill the page in from the rows of the tables, of which `production` may be absent."""
    single = select(precision, comparison="reference")
    default = select(single, integrator="leapfrog", step=STEP)
    finest = select(single, integrator="leapfrog", step=min(row["step"] for row in single))
    plain = select(single, integrator=PLAIN, scene="flat", quantity="static_friction")
    slowest = min(plain, key=lambda row: row["step"])
    (plain_paper,) = select(plain, step=PAPER_STEP)
    paired = select(precision, comparison="paired", integrator="leapfrog")
    coarsest = max(row["step"] for row in paired)
    residuals = [abs(row["energy_error"]) for row in realisations]
    return _PAGE.format(
        step=STEP,
        smallest=min(row["n_blocks"] for row in single),
        largest=max(row["n_blocks"] for row in single),
        n_seeds=single[0]["realisations"],
        singles=_single_errors(default),
        orders=_orders(single),
        finest=finest[0]["step"],
        floor=max(row["error"] for row in finest if row["quantity"] in _FLOOR),
        paper=PAPER_STEP,
        plain=plain_paper["error"],
        plain_fine=slowest["error"],
        plain_finest=slowest["step"],
        nudge=HORIZON_NUDGE,
        **{row["scene"]: row["error"] for row in select(default, quantity="horizon")},
        n_paired=min(row["realisations"] for row in paired),
        n_ensemble=paired[0]["n_blocks"],
        fine=select(precision, comparison="scatter")[0]["step"],
        ensemble=ENSEMBLE,
        paired=_biases(select(paired, step=STEP), select(precision, comparison="scatter")),
        full_size=full_size.section(production),
        n_runs=len(residuals),
        worst_energy=max(residuals),
        median_energy=median(residuals),
        tolerance=ENERGY_TOLERANCE,
        out_of_line=OUT_OF_LINE,
        n_cases=len(stability),
        n_agree=sum(row["outcome"] == row["expected"] for row in stability),
        families=", ".join(sorted({row["family"] for row in stability})),
        coarsest=coarsest,
        coarse_bias=max(abs(row["error"]) for row in select(paired, step=coarsest)),
    )


_FLOOR = ("static_friction", "t_det before horizon")
_SINGLE = ("force", *MEANS, *_FLOOR[1:], "t_det before peak", "order")


def _one(rows: list[Row], **wanted: Any) -> Row:
    (row,) = select(rows, **wanted)
    return row


def _orders(single: list[Row]) -> str:
    def cell(scene: str, quantity: str) -> str:
        found = []
        for name in ("leapfrog", "rk4"):
            rows = select(single, scene=scene, integrator=name, quantity=quantity)
            found.append(order([row["step"] for row in rows], [row["error"] for row in rows]))
        return ", ".join(f"{number:.1f}" for number in found)

    return by_scene("order", _FLOOR, cell)


def _single_errors(default: list[Row]) -> str:
    def cell(scene: str, quantity: str) -> str:
        return f"{_one(default, scene=scene, quantity=quantity)['error']:.1e}"

    return by_scene("relative error", _SINGLE, cell)


def _biases(paired: list[Row], scatter: list[Row]) -> str:
    def cell(scene: str, quantity: str) -> str:
        bias = _one(paired, scene=scene, quantity=quantity)
        half = 50.0 * (bias["ci_high"] - bias["ci_low"])
        error = 100.0 * ensemble_error(_one(scatter, scene=scene, quantity=quantity))
        return f"{100.0 * bias['error']:+.3f} ± {half:.3f} ({error:.2f})"

    return by_scene("bias", MEANS, cell)
