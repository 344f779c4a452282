"""The pages in docs are those that the code writes today, but for what was measured."""

import re
from itertools import product
from pathlib import Path

from springblock.accuracy import page as accuracy_page
from springblock.claims import Evidence, rows
from springblock.claims import page as claims_page
from springblock.realisation import STEP
from springblock.statements import STATEMENTS
from validation.stability import CASES

DOCS = Path(__file__).parents[1] / "docs"
QUANTITIES = ["force", "static_friction", "t_max", "t_avg", "order", "horizon"]
QUANTITIES += ["t_det before horizon", "t_det before peak"]
#: Comparisons that the page on errors rests on, with integrators and steps.
COMPARISONS = {
    "reference": (["leapfrog", "rk4", "plain rk4"], [1e-9, STEP]),
    "paired": (["leapfrog"], [STEP]),
    "scatter": (["leapfrog"], [STEP]),
}


def numberless(text):
    """Lines of the page on errors, which numbers and nothing else may tell apart."""
    return re.sub(r"[-+]?\d+(\.\d+)?(e[-+]\d+)?", "#", text).splitlines()


def unmeasured(text):
    """Lines of the page on statements that hold for any study."""
    measured = ("|", "Verdict: ", "Rests on", "- realisations/", "- tables/")
    return [line for line in text.splitlines() if line and not line.startswith(measured)]


def test_the_page_on_errors_is_what_the_code_writes():
    keys = ("comparison", "integrator", "step", "scene", "quantity")
    numbers = {"error": 0.1, "ci_low": 0.0, "ci_high": 0.2, "realisations": 2, "n_blocks": 8}
    precision = [
        dict(zip(keys, (comparison, *row), strict=True)) | numbers
        for comparison, (integrators, steps) in COMPARISONS.items()
        for row in product(integrators, steps, ("flat", "pillared", "grooved"), QUANTITIES)
    ]
    stability = [{"family": case.family, "expected": "", "outcome": ""} for case in CASES]
    text = accuracy_page(precision, stability, [{"energy_error": 1e-5}])
    assert numberless((DOCS / "accuracy.md").read_text()) == numberless(text)


def test_the_page_on_statements_is_what_the_code_writes():
    text = claims_page(rows(STATEMENTS, Evidence()))
    assert unmeasured((DOCS / "claims.md").read_text()) == unmeasured(text)
