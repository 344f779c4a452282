"""Rows of the tables behind the page on errors, of the right shape; their numbers mean nothing."""

from itertools import product
from math import nan

from springblock.io.identity import identity
from springblock.model.defaults import PAPER_STEP
from springblock.model.scene import Scene
from springblock.study.accuracy.conventions import DELAY, LENGTH, MEANS, PLAIN, SCENES
from springblock.study.accuracy.production import STEPS, UNITS

QUANTITIES = [
    "force",
    "static_friction",
    "t_max",
    "t_avg",
    "t_det before horizon",
    "horizon reached",
]
#: Integrators and steps of each comparison.
COMPARISONS = {
    "reference": (["leapfrog", "rk4", PLAIN], [1e-9, min(STEPS), PAPER_STEP, 2.0 * PAPER_STEP]),
    "order": (["leapfrog", "rk4"], [PAPER_STEP]),
}


def precision_rows():
    """Rows of the table `work_precision`."""
    keys = ("comparison", "integrator", "step", "scene", "quantity")
    numbers = {
        "reference": {"error": 0.1, "ci_low": 0.1, "ci_high": 0.1},
        "order": {"error": 2.0, "ci_low": 1.9, "ci_high": 2.1},
    }
    return [
        dict(zip(keys, (comparison, *row), strict=True))
        | numbers[comparison]
        | {"realisations": 2, "n_blocks": 8, "cpu_seconds": 0.02}
        for comparison, (integrators, steps) in COMPARISONS.items()
        for row in product(integrators, steps, SCENES, QUANTITIES)
    ]


def production_rows(seeds=30):
    """Rows of the table `production`: biases of order two, and runs that cost 1e-8 s / step."""
    rows = []
    for scene, quantity, step in product(SCENES, (*MEANS, DELAY, LENGTH), STEPS):
        bias = 2.0 * (step / 8e-8) ** 2 * (step > min(STEPS))
        row = {"scene": scene, "quantity": quantity, "unit": UNITS.get(quantity, "s")}
        row |= {"n_blocks": 120, "step": step, "value": 80.0, "scale": 50.0, "deviation": 10.0}
        row |= {"bias": bias, "bias_error": 0.2 * bias, "ci_low": 0.6 * bias, "ci_high": 1.4 * bias}
        row |= {"realisations": seeds, "cpu_seconds": 1e-8 / step, "prelude_seconds": 0.5}
        if quantity != LENGTH or scene == "pillared":
            rows.append(row)
    return rows


def stability_row(integrator="leapfrog", N=1, outcome="agrees", error=nan):
    """A surface of N x N blocks in the table `stability`."""
    row = {"family": "size", "integrator": integrator, "parameter": N, "expected": outcome}
    return row | {"outcome": outcome, "relative_error": error, "energy_error": 0.1 * error}


def tables(precision=None, production=None):
    """Rows of the four tables behind the page; the energy balance nearly closes."""
    stability = [stability_row(N=1, error=-2e-3), stability_row(N=9, error=1e-3)]
    stability += [stability_row("rk4", N=1, outcome="refused")]
    realisations = [identity(Scene(120)) | {"energy_error": 1e-5}]
    return precision or precision_rows(), stability, realisations, production or production_rows()
