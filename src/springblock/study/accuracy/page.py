"""Values and tables of the page on numerical errors."""

from collections.abc import Iterable, Sequence
from itertools import product
from math import sqrt
from statistics import median
from typing import Any, NamedTuple

from springblock.analysis.statistics import Interval
from springblock.analysis.suspects import ENERGY_TOLERANCE, OUT_OF_LINE
from springblock.io.rows import Row, alike, select
from springblock.model.defaults import PAPER_STEP, STEP
from springblock.model.material import Material
from springblock.study.accuracy import conventions
from springblock.study.accuracy.conventions import (
    DELAY,
    ENSEMBLE,
    LENGTH,
    MEANS,
    ORDERED,
    PLAIN,
    SCENES,
    half_width,
)

#: Realisations of a scene in the study, by quantity; the decay length needs more.
STUDY_SEEDS = {"static_friction": ENSEMBLE, DELAY: ENSEMBLE, LENGTH: 60}

_COARSE = 2.0 * STEP  #: the alternative to the default
_SINGLE = ("force", *MEANS, "t_det before horizon")
_SCALES = {"s": 1e6}  #: from the units of the table to those of the page
_PERCENT = 100.0


class Errors(NamedTuple):
    """Errors of a quantity of one scene at the default step; all but the value in percent."""

    quantity: str
    scene: str
    value: Interval
    numerical: float  #: largest bias, in the unit of the value
    bias: Interval
    finest: float  #: largest bias of the finest step
    largest: float  #: far end of the bias plus the finest step's
    scatter: float  #: standard error of the study's mean
    cost: float  #: CPU time of the double step over that of the default
    change: float  #: by which the double step changes the quantity


def values(
    precision: list[Row], stability: list[Row], realisations: list[Row], production: list[Row]
) -> dict[str, Any]:
    """Return what the template names, from the rows of the tables."""
    single = select(precision, comparison="reference")
    leapfrog = select(single, integrator="leapfrog")
    default = select(leapfrog, step=STEP)
    finest_single = select(leapfrog, step=min(row["step"] for row in leapfrog))
    residuals = [abs(row["energy_error"]) for row in realisations]
    steps = sorted({row["step"] for row in production})
    flat = select(leapfrog, scene="flat", step=steps[0])
    found = errors(production)
    return {
        "known": conventions,
        "paper_step": PAPER_STEP,
        "energy_tolerance": ENERGY_TOLERANCE,
        "out_of_line": OUT_OF_LINE,
        "step": STEP,
        "coarse": _COARSE,
        "limit": 2.0 / Material().omega_max,  # s, of the leapfrog without damping
        "length_ensemble": STUDY_SEEDS[LENGTH],
        "n_blocks": production[0]["n_blocks"],
        "seeds": min(row["realisations"] for row in production),
        "steps": steps,
        "quantities": [*MEANS, DELAY, LENGTH],
        "errors": found,
        "double": max(
            (each for each in found.values() if each.quantity == "t_avg"),
            key=lambda each: each.change / each.scatter,
        ),
        "of_steps": [_of_step(select(production, step=step)) for step in reversed(steps)],
        "flat": {row["quantity"]: row["error"] for row in flat},
        "flat_blocks": flat[0]["n_blocks"],
        "singles": {name: _by_scene(default, name) for name in _SINGLE},
        "single_blocks": sorted(row["n_blocks"] for row in default),
        "single_seeds": min(row["realisations"] for row in default),
        "reached": select(default, quantity="horizon reached"),
        "finest_single": finest_single[0]["step"],
        "floor": max(row["error"] for row in finest_single if row["quantity"] in ORDERED),
        "orders": {
            (row["quantity"], row["scene"], row["integrator"]): _interval(row, "error")
            for row in select(precision, comparison="order")
        },
        "plain": [
            _by_scene(select(single, integrator=PLAIN, step=step), "static_friction")
            for step in (PAPER_STEP, 2.0 * PAPER_STEP)
        ],
        "n_runs": len(residuals),
        "usual_energy": max(abs(row["energy_error"]) for row in alike(realisations)),
        "worst_energy": max(residuals),
        "median_energy": median(residuals),
        "stability": stability,
        "families": sorted({row["family"] for row in stability}),
    }


def errors(production: Sequence[Row]) -> dict[tuple[str, str], Errors]:
    """Return the errors at the default step by quantity and scene, from the table `production`."""
    found = (_errors(rows) for rows in _cases(production))
    return {(each.quantity, each.scene): each for each in found}


def finest_bias(rows: Iterable[Row]) -> float:
    """Largest bias of the finest step h itself, as a share of the quantity.

    For an error of order p it is the bias of the next step, r h, against h over r^p - 1. We take
    p = 1, the lower bound of orders across events, and the far end of the 95 % interval.
    """
    finest, following = sorted(rows, key=lambda row: row["step"])[:2]
    return _far_end(following) / (following["step"] / finest["step"] - 1.0)


def _cases(production: Sequence[Row]) -> Iterable[list[Row]]:
    """Yield the rows of each quantity on each scene that has it."""
    for quantity, scene in product((*MEANS, DELAY, LENGTH), SCENES):
        if rows := select(production, quantity=quantity, scene=scene):
            yield rows


def _errors(rows: Sequence[Row]) -> Errors:
    """Return the errors of one quantity of one scene from its rows at all steps."""
    (row,), (coarse,) = select(rows, step=STEP), select(rows, step=_COARSE)
    scale, unit = row["scale"], _SCALES.get(row["unit"], 1.0)
    half = half_width(row["deviation"], row["realisations"])
    finest = finest_bias(rows)
    largest = _far_end(row) + finest
    seeds = STUDY_SEEDS.get(row["quantity"], ENSEMBLE)
    return Errors(
        quantity=row["quantity"],
        scene=row["scene"],
        value=Interval(*(unit * (row["value"] + each) for each in (0.0, -half, half))),
        numerical=unit * scale * largest,
        bias=_bias(row),
        finest=_PERCENT * finest,
        largest=_PERCENT * largest,
        scatter=_PERCENT * row["deviation"] / scale / sqrt(seeds),
        cost=coarse["cpu_seconds"] / row["cpu_seconds"],
        change=float(abs(_bias(coarse).mean - _bias(row).mean)),
    )


def _of_step(rows: Sequence[Row]) -> dict[str, Any]:
    """Return the CPU time of a step and its largest bias of each quantity."""
    worst = [
        max(select(rows, quantity=name), key=lambda row: abs(row["bias"] / row["scale"]))
        for name in MEANS
    ]
    return {
        "step": rows[0]["step"],
        "seconds": max(row["cpu_seconds"] for row in rows),
        "biases": [_bias(row) for row in worst],
    }


def _bias(row: Row) -> Interval:
    """Return a bias with its interval, in percent."""
    return Interval(*(_PERCENT * each / row["scale"] for each in _interval(row, "bias")))


def _interval(row: Row, name: str) -> Interval:
    return Interval(row[name], row["ci_low"], row["ci_high"])


def _far_end(row: Row) -> float:
    """Far end of the 95 % interval of a bias, as a share of the quantity."""
    return max(abs(row["ci_low"]), abs(row["ci_high"])) / float(row["scale"])


def _by_scene(rows: Iterable[Row], quantity: str) -> dict[str, float]:
    """Return the errors of a quantity by scene."""
    return {row["scene"]: row["error"] for row in select(rows, quantity=quantity)}
