"""The section of the page on ensembles of the study's own size."""

from collections.abc import Callable, Iterable, Sequence
from functools import partial
from math import floor, isfinite, log10, sqrt

from springblock.accuracy.budget import (
    STUDY_SEEDS,
    Bias,
    Choice,
    best,
    choices,
    excess,
    halving,
    study_budget,
)
from springblock.accuracy.conventions import DELAY, ENSEMBLE, LENGTH, MEANS, SCENES, half_width
from springblock.io.rows import Row, markdown_table, select
from springblock.model.defaults import STEP

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
it is the lower or the upper end of its 95 % interval. That of {finest:.0e} s, which is not known,
counts as none. Errors in percent:

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
_PERCENT = 100.0
_BUDGETS = ["", "scene", "CPU time (s)", "error, default", "best step (s) x seeds", "error, best"]


def section(rows: Sequence[Row]) -> str:
    """Fill the section in from the rows of the table `production`; without them say so."""
    if not rows:
        return _WITHOUT
    default = select(rows, step=STEP)
    cases, means = _cases(rows, STUDY_SEEDS), _cases(rows, ("t_max", "t_avg"))
    return _WITH.format(
        n_blocks=rows[0]["n_blocks"],
        fewest=min(row["realisations"] for row in rows),
        most=max(row["realisations"] for row in rows),
        finest=min(row["step"] for row in rows),
        ensemble=ENSEMBLE,
        length_ensemble=STUDY_SEEDS[LENGTH],
        values=by_scene("value", _QUANTITIES, partial(_cell, default, _value)),
        biases=by_scene("bias", _QUANTITIES, partial(_cell, default, _bias)),
        budgets=markdown_table([*_BUDGETS, "halving costs"], map(_budget, cases)),
        excess=_excesses({"of those above": cases, "of t_max and t_avg": means}),
    )


def _cases(rows: Sequence[Row], quantities: Iterable[str]) -> list[list[Row]]:
    """Rows of each quantity and scene that was measured."""
    pairs = [(quantity, scene) for quantity in quantities for scene in SCENES]
    found = [select(rows, scene=scene, quantity=quantity) for quantity, scene in pairs]
    return [case for case in found if case]


def by_scene(name: str, quantities: Iterable[str], cell: Callable[[str, str], str]) -> str:
    """Lay out a line per quantity and a column per scene."""
    lines = [
        [_NAMES.get(quantity, quantity), *(cell(scene, quantity) for scene in SCENES)]
        for quantity in quantities
    ]
    return markdown_table([name, *SCENES], lines)


def _cell(rows: list[Row], text: Callable[[Row], str], scene: str, quantity: str) -> str:
    """Return the text of the row, or nothing where the quantity was not measured."""
    return "".join(map(text, select(rows, scene=scene, quantity=quantity)))


def _value(row: Row) -> str:
    """Value ± statistical ± numerical error, to two digits of the first."""
    unit, factor = _UNITS[row["unit"]]
    value, scale = factor * row["value"], factor * row["scale"]
    statistical = factor * half_width(row["deviation"], row["realisations"])
    places = max(0, 1 - floor(log10(statistical)))
    numbers = (value, statistical, scale * Bias.of(row).high)
    return " ± ".join(f"{number:.{places}f}" for number in numbers) + unit


def _bias(row: Row) -> str:
    percent = _PERCENT / row["scale"]
    bias, low, high = (percent * row[key] for key in ("bias", "ci_low", "ci_high"))
    error = percent * row["deviation"] / sqrt(STUDY_SEEDS.get(row["quantity"], ENSEMBLE))
    return f"{bias:+.3f} [{low:+.3f}, {high:+.3f}] ({error:.2f})"


def _by_bias(rows: list[Row]) -> list[list[Choice]]:
    """Steps with the estimated bias, and with the ends of its interval."""
    return [choices(rows, bias) for bias in Bias._fields]


def _budget(rows: list[Row]) -> list[str]:
    """What the study's CPU time buys in one scene."""
    budget, cases = study_budget(rows), _by_bias(rows)
    chosen = best(cases[0], budget)

    def error(wanted: float) -> str:
        (steps,) = zip(*([s for s in case if s.step == wanted] for case in cases), strict=True)
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
    """Largest excess of each step in each group of cases."""
    found = {name: _worst(cases) for name, cases in groups.items()}
    steps = sorted(next(iter(found.values())))
    lines = [[name, *(worst[step] for step in steps)] for name, worst in found.items()]
    return markdown_table(["step (s)", *(f"{step:.0e}" for step in steps)], lines)


def _worst(cases: list[list[Row]]) -> dict[float, str]:
    """Largest excess of each step, by the biases of `_by_bias`."""
    found = [
        [excess(steps, study_budget(rows)) for rows, steps in zip(cases, alike, strict=True)]
        for alike in zip(*map(_by_bias, cases), strict=True)
    ]
    return {
        step: _between(".2f", [max(case[step] for case in each) for each in found])
        for step in found[0][0]
    }


def _between(digits: str, numbers: Sequence[float]) -> str:
    """The first number, and in brackets the smallest and the largest; all finite or none."""
    if not isfinite(numbers[0]):
        return "no seed"
    return f"{numbers[0]:{digits}} [{min(numbers):{digits}}, {max(numbers):{digits}}]"
