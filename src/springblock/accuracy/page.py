"""The page that says what a reader may trust; every number in it comes from the tables."""

from collections.abc import Callable, Iterable, Sequence
from math import floor, isfinite, log10, sqrt
from statistics import median

from springblock.accuracy.budget import (
    STUDY_SEEDS,
    Bias,
    best,
    choices,
    excess,
    halving,
    study_budget,
)
from springblock.accuracy.conventions import (
    DELAY,
    ENERGY_TOLERANCE,
    ENSEMBLE,
    HORIZON_NUDGE,
    LENGTH,
    MEANS,
    OUT_OF_LINE,
    PAPER_STEP,
    PLAIN,
    SCENES,
    ensemble_error,
    half_width,
    order,
)
from springblock.io.rows import Row, markdown_table, select
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
of a mean over {ensemble} seeds; the bias must be smaller. All in percent:

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

#: The section on ensembles of the study's own size, without and with their table.
_WITHOUT = """With `production: true` in its configuration a study measures errors with its own
number of blocks, in a quarter of an hour; this page was written without that table.
"""

_WITH = """Ensembles of flat, pillared (20 wide, 20 apart) and grooved surfaces (58 wide, 62 apart,
with pawls of 8 and grooves of 2), {n_blocks} x {n_blocks} blocks, pulled along x, {fewest} to
{most} seeds each: the table `production`, made with `production: true`. Means over them at
the default, and l_c along x, ± half the 95 % interval (the statistical error) ± the largest modulus
in the 95 % interval of the bias (the numerical error):

{values}

These biases, against a step of {finest:.0e} s with the same seeds, and their 95 % intervals:
Student's, and of l_c bootstrap percentiles. In brackets the standard error of a mean over
{ensemble} seeds, of l_c from {length_ensemble}. All in percent; t_max - t_avg in percent of t_max:

{biases}

The total error of an ensemble is the root of bias² + variance/seeds. Another step buys more seeds
or fewer for the CPU time that the study's seeds cost at the default: {ensemble} seeds, for l_c
{length_ensemble}. The bias is the estimate without what its own scatter adds; in square brackets,
it is the lower or the upper end of its 95 % interval. That of {finest:.0e} s, which is unknown,
is neglected. Errors in percent:

{budgets}

Halving the error costs so many times the CPU time: four where only scatter is left, less where the
prelude is a large share, more where a finer step must take over.

One step has to serve them all. Total errors over those of the best step, in the worst case:

{excess}
"""

#: Of what is not called by its symbol.
_NAMES = {
    "force": "force before t_max, largest",
    "static_friction": "static friction",
    "t_det before horizon": "t_det before the horizon",
    "t_det before peak": "t_det before the peak",
    "order": "1 - rank correlation of t_det",
}
_UNITS = {"1": ("", 1.0), "s": (" (µs)", 1e6), "blocks": (" (blocks)", 1.0)}
_QUANTITIES = (*MEANS, DELAY, LENGTH)
_FLOOR = ("static_friction", "t_det before horizon")
_SINGLE = ("force", *MEANS, "t_det before horizon", "t_det before peak", "order")
_PERCENT = 100.0
_BUDGETS = ["", "scene", "CPU time (s)", "error, default", "best step (s) x seeds", "error, best"]


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
    scatter = select(precision, comparison="scatter")
    coarsest = max(row["step"] for row in paired)
    residuals = [abs(row["energy_error"]) for row in realisations]
    return _PAGE.format(
        step=STEP,
        smallest=min(row["n_blocks"] for row in single),
        largest=max(row["n_blocks"] for row in single),
        n_seeds=single[0]["realisations"],
        singles=_by_scene("relative error", _SINGLE, default, lambda row: f"{row['error']:.1e}"),
        orders=_by_scene("order", _FLOOR, single, _orders),
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
        fine=scatter[0]["step"],
        ensemble=ENSEMBLE,
        paired=_by_scene("bias", MEANS, [*select(paired, step=STEP), *scatter], _paired_bias),
        full_size=_full_size(production),
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


def _full_size(rows: Sequence[Row]) -> str:
    """Fill the section in from the rows of the table `production`; without them say so."""
    if not rows:
        return _WITHOUT
    default, means = select(rows, step=STEP), ("t_max", "t_avg")
    cases = _cases(rows, STUDY_SEEDS)
    return _WITH.format(
        n_blocks=rows[0]["n_blocks"],
        fewest=min(row["realisations"] for row in rows),
        most=max(row["realisations"] for row in rows),
        finest=min(row["step"] for row in rows),
        ensemble=ENSEMBLE,
        length_ensemble=STUDY_SEEDS[LENGTH],
        values=_by_scene("value", _QUANTITIES, default, _value),
        biases=_by_scene("bias", _QUANTITIES, default, _bias),
        budgets=markdown_table([*_BUDGETS, "halving costs"], map(_budget, cases)),
        excess=_excesses({"of those above": cases, "of t_max and t_avg": _cases(rows, means)}),
    )


def _cases(rows: Sequence[Row], quantities: Iterable[str]) -> list[list[Row]]:
    """Return the rows of each quantity and scene that was measured."""
    pairs = [(quantity, scene) for quantity in quantities for scene in SCENES]
    found = [select(rows, scene=scene, quantity=quantity) for quantity, scene in pairs]
    return [case for case in found if case]


def _by_scene(
    heading: str, quantities: Iterable[str], rows: Sequence[Row], text: Callable[..., str]
) -> str:
    """Lay out what `text` says of the rows of a quantity, in a line, and a scene, in a column."""
    lines = []
    for quantity in quantities:
        cells = [select(rows, scene=scene, quantity=quantity) for scene in SCENES]
        said = [text(*cell) if cell else "" for cell in cells]
        lines.append([_NAMES.get(quantity, quantity), *said])
    return markdown_table([heading, *SCENES], lines)


def _orders(*rows: Row) -> str:
    """Return the orders of both integrators, to one digit."""
    each = [select(rows, integrator=name) for name in ("leapfrog", "rk4")]
    found = [order([row["step"] for row in of], [row["error"] for row in of]) for of in each]
    return ", ".join(f"{number:.1f}" for number in found)


def _paired_bias(bias: Row, scatter: Row) -> str:
    """Return a bias ± half its interval, and the error of a mean, in percent."""
    half = _PERCENT / 2.0 * (bias["ci_high"] - bias["ci_low"])
    error = _PERCENT * ensemble_error(scatter)
    return f"{_PERCENT * bias['error']:+.3f} ± {half:.3f} ({error:.2f})"


def _value(row: Row) -> str:
    """Return the value ± statistical ± numerical error, to two digits of the first."""
    unit, factor = _UNITS[row["unit"]]
    value, scale = factor * row["value"], factor * row["scale"]
    statistical = factor * half_width(row["deviation"], row["realisations"])
    places = max(0, 1 - floor(log10(statistical)))
    numbers = (value, statistical, scale * Bias.of(row).high)
    return " ± ".join(f"{number:.{places}f}" for number in numbers) + unit


def _bias(row: Row) -> str:
    """Return a bias with its interval, and the error of the study's mean, in percent."""
    percent = _PERCENT / row["scale"]
    bias, low, high = (percent * row[key] for key in ("bias", "ci_low", "ci_high"))
    error = percent * row["deviation"] / sqrt(STUDY_SEEDS.get(row["quantity"], ENSEMBLE))
    return f"{bias:+.3f} [{low:+.3f}, {high:+.3f}] ({error:.2f})"


def _budget(rows: list[Row]) -> list[str]:
    """Say what the study's CPU time buys in one scene, at the default step and at the best."""
    budget, cases = study_budget(rows), [choices(rows, bias) for bias in Bias._fields]
    chosen = best(cases[0], budget)

    def error(wanted: float) -> str:
        steps = [step for case in cases for step in case if step.step == wanted]
        return _between(".3f", [_PERCENT * step.error(budget) for step in steps])

    return [
        _NAMES.get(rows[0]["quantity"], rows[0]["quantity"]),
        rows[0]["scene"],
        f"{budget:.1f}",
        error(STEP),
        f"{chosen.step:.0e} x {chosen.seeds(budget):.0f}",
        error(chosen.step),
        _between(".1f", [halving(case, budget) for case in cases]),
    ]


def _excesses(groups: dict[str, list[list[Row]]]) -> str:
    """Lay out the largest excess of each step in each group of cases."""

    def worst(cases: list[list[Row]], bias: str) -> list[float]:
        found = [excess(choices(rows, bias), study_budget(rows)).values() for rows in cases]
        return [max(of_step) for of_step in zip(*found, strict=True)]

    lines = []
    for name, cases in groups.items():
        by_step = zip(*(worst(cases, bias) for bias in Bias._fields), strict=True)
        lines.append([name, *(_between(".2f", numbers) for numbers in by_step)])
    steps = [choice.step for choice in choices(groups["of those above"][0])]
    return markdown_table(["step (s)", *(f"{step:.0e}" for step in steps)], lines)


def _between(digits: str, numbers: Sequence[float]) -> str:
    """Return the first number, and in brackets the smallest and the largest; all finite or none."""
    if not isfinite(numbers[0]):
        return "no seed"
    return f"{numbers[0]:{digits}} [{min(numbers):{digits}}, {max(numbers):{digits}}]"
