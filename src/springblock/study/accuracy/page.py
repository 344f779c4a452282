"""Values and tables of the page on numerical errors."""

from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import product
from math import isnan, sqrt
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
_FULL = 40  #: seeds of each scene of `config/full.yaml`, at least
_INTEGRATORS = ("leapfrog", "rk4")
_SINGLE_STEPS = (PAPER_STEP, 2.0 * PAPER_STEP)  #: at which methods are compared
_SCALES = {"s": 1e6}  #: from the units of the table to those of the page
_PERCENT = 100.0


class Errors(NamedTuple):
    """Errors of a quantity of one scene at the default step; all but the value in percent."""

    quantity: str
    scene: str
    value: Interval
    numerical: float  #: largest bias, in the unit of the value
    largest: float  #: largest bias: far end of its interval plus the bias of the finest step
    scatter: float  #: standard error of the study's mean
    cost: float  #: CPU time of the double step over that of the default
    change: float  #: by which the double step changes the quantity


def values(
    precision: list[Row], stability: list[Row], realisations: list[Row], production: list[Row]
) -> dict[str, Any]:
    """Return what the template names, from the rows of the tables."""
    single = select(precision, comparison="reference")
    leapfrog = select(single, integrator="leapfrog")
    finest_single = select(leapfrog, step=min(row["step"] for row in leapfrog))
    frictions = select(single, quantity="static_friction")
    plain = select(frictions, integrator=PLAIN)
    paper, double_step = (_by_scene(select(plain, step=step)) for step in _SINGLE_STEPS)
    residuals = [abs(row["energy_error"]) for row in realisations]
    steps = sorted({row["step"] for row in production}, reverse=True)
    seeds = min(row["realisations"] for row in production)
    found = errors(production)
    return {
        "known": conventions,
        "paper_step": PAPER_STEP,
        "energy_tolerance": ENERGY_TOLERANCE,
        "out_of_line": OUT_OF_LINE,
        "step": STEP,
        "coarse": _COARSE,
        "limit": 2.0 / Material().omega_max,  # s, of the leapfrog without damping
        "n_blocks": production[0]["n_blocks"],
        "seeds": seeds,
        "full": seeds >= _FULL,
        "errors": found,
        "bounds": {
            name: f"{max(each.largest for each in _of(found, name)):.2f} %"
            for name in (*MEANS, LENGTH)
        },
        "scatters": [_span(each.scatter for each in _of(found, name)) for name in MEANS],
        "double": max(_of(found, "t_avg"), key=lambda each: each.change / each.scatter),
        "of_steps": [_of_step(select(production, step=step)) for step in steps],
        "singles": [
            _of_method(select(frictions, integrator=integrator, step=step))
            for integrator, step in product((*_INTEGRATORS, PLAIN), _SINGLE_STEPS)
        ],
        "single_blocks": sorted(row["n_blocks"] for row in finest_single),
        "single_seeds": min(row["realisations"] for row in finest_single),
        "growth": [double_step[scene] / paper[scene] for scene in SCENES],
        "finest_single": finest_single[0]["step"],
        "floor": max(row["error"] for row in finest_single if row["quantity"] in ORDERED),
        "orders": {
            (row["quantity"], row["scene"], row["integrator"]): _interval(row, "error")
            for row in select(precision, comparison="order")
        },
        "n_runs": len(residuals),
        "usual_energy": max(abs(row["energy_error"]) for row in alike(realisations)),
        "worst_energy": max(residuals),
        "stability": stability,
        "families": {
            name: _of_family(select(stability, family=name))
            for name in dict.fromkeys(row["family"] for row in stability)
        },
    }


def errors(production: Sequence[Row]) -> dict[tuple[str, str], Errors]:
    """Return the errors at the default step by quantity and scene, from the table `production`."""
    keys = product((*MEANS, DELAY, LENGTH), SCENES)
    every = {key: select(production, quantity=key[0], scene=key[1]) for key in keys}
    return {key: _errors(rows) for key, rows in every.items() if rows}


def finest_bias(rows: Iterable[Row]) -> float:
    """Largest bias of the finest step h itself, as a share of the quantity.

    For an error of order p it is the bias of the next step, r h, against h over r^p - 1. We take
    p = 1, the lower bound of orders across events, and the far end of the 95 % interval.
    """
    finest, following = sorted(rows, key=lambda row: row["step"])[:2]
    return _far_end(following) / (following["step"] / finest["step"] - 1.0)


def _errors(rows: Sequence[Row]) -> Errors:
    """Return the errors of one quantity of one scene from its rows at all steps."""
    (row,), (coarse,) = select(rows, step=STEP), select(rows, step=_COARSE)
    scale, unit = row["scale"], _SCALES.get(row["unit"], 1.0)
    half = half_width(row["deviation"], row["realisations"])
    largest = _far_end(row) + finest_bias(rows)
    seeds = STUDY_SEEDS.get(row["quantity"], ENSEMBLE)
    return Errors(
        quantity=row["quantity"],
        scene=row["scene"],
        value=Interval(*(unit * (row["value"] + each) for each in (0.0, -half, half))),
        numerical=unit * scale * largest,
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


def _of_method(rows: Sequence[Row]) -> list[str]:
    """Return method, step, longest CPU time and errors in percent, as cells of a line."""
    cost, found = max(row["cpu_seconds"] for row in rows), _by_scene(rows)
    shown = [f"{_PERCENT * found[scene]:.2g}" for scene in SCENES]
    return [rows[0]["integrator"], f"{rows[0]['step']:.0e}", f"{cost:.2g}", *shown]


def _of_family(rows: Sequence[Row]) -> list[str]:
    """Return range, outcomes, and the largest errors of each integrator, as cells of a line."""
    ends = [each(row["parameter"] for row in rows) for each in (min, max)]
    counts = Counter(row["outcome"] for row in rows)
    outcomes = ", ".join(f"{outcome} {count}" for outcome, count in counts.items())
    largest = (
        "; ".join(_largest(select(rows, integrator=name), column) for name in _INTEGRATORS)
        for column in ("relative_error", "energy_error")
    )
    return [f"{ends[0]:g} to {ends[1]:g}".replace("inf", "∞"), outcomes, *largest]


def _largest(rows: Iterable[Row], column: str) -> str:
    """Return the largest absolute value of a column that is not NaN."""
    found = [abs(row[column]) for row in rows if not isnan(row[column])]
    return f"{max(found):.1g}" if found else "–"


def _span(values: Iterable[float]) -> str:
    """Return the least and the largest of some values."""
    every = list(values)
    return f"{min(every):.2f} to {max(every):.2f}"


def _of(found: dict[tuple[str, str], Errors], quantity: str) -> list[Errors]:
    """Return the errors of a quantity on all scenes that have it."""
    return [each for each in found.values() if each.quantity == quantity]


def _bias(row: Row) -> Interval:
    """Return a bias with its interval, in percent."""
    return Interval(*(_PERCENT * each / row["scale"] for each in _interval(row, "bias")))


def _interval(row: Row, name: str) -> Interval:
    return Interval(row[name], row["ci_low"], row["ci_high"])


def _far_end(row: Row) -> float:
    """Far end of the 95 % interval of a bias, as a share of the quantity."""
    return max(abs(row["ci_low"]), abs(row["ci_high"])) / float(row["scale"])


def _by_scene(rows: Iterable[Row]) -> dict[str, float]:
    """Return errors by scene."""
    return {row["scene"]: row["error"] for row in rows}
