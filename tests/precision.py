"""Rows of the tables behind the page on errors, of the right shape; their numbers mean nothing."""

from itertools import product

from springblock.accuracy.conventions import PAPER_STEP, PLAIN, SCENES
from springblock.defaults import STEP

QUANTITIES = ["force", "static_friction", "t_max", "t_avg", "order", "horizon"]
QUANTITIES += ["t_det before horizon", "t_det before peak"]
#: Integrators and steps of each comparison.
COMPARISONS = {
    "reference": (["leapfrog", "rk4", PLAIN], [1e-9, PAPER_STEP, STEP]),
    "paired": (["leapfrog"], [STEP]),
    "scatter": (["leapfrog"], [STEP]),
}


def precision_rows():
    """Rows of the table `work_precision`."""
    keys = ("comparison", "integrator", "step", "scene", "quantity")
    numbers = {"error": 0.1, "ci_low": 0.0, "ci_high": 0.2, "realisations": 2, "n_blocks": 8}
    return [
        dict(zip(keys, (comparison, *row), strict=True)) | numbers
        for comparison, (integrators, steps) in COMPARISONS.items()
        for row in product(integrators, steps, SCENES, QUANTITIES)
    ]
