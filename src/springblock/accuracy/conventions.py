"""Constants that tables, page, figures and claims share, and the test for suspect residuals.

The workflow imports this module at every start: no slow imports.
"""

from collections import defaultdict
from collections.abc import Iterable, Mapping
from statistics import median
from typing import Any

import numpy as np

from springblock.analysis.statistics import students_t
from springblock.io.rows import Row, scene_of

SCENES = ("flat", "pillared", "grooved")
COMPARISONS = ("reference", "paired")
MEANS = ("static_friction", "t_max", "t_avg")  #: quantities averaged over ensembles
#: Quantities whose orders of convergence are measured.
ORDERED = ("static_friction", "t_det before horizon")
DELAY = "t_max - t_avg"  #: by how much the force peak comes after the mean detachment
LENGTH = "decay length"  #: of c(r) along the sides of pillars
PLAIN = "plain rk4"  #: Runge-Kutta with the friction of each stage
PAPER_STEP = 1e-8  #: s
SAMPLE_INTERVAL = 8e-8  #: s, of runs on small surfaces
#: Usual realisations per scene; biases are compared with the standard error of their mean.
ENSEMBLE = 20
#: Relative change of the thresholds that defines the horizon: the largest that is small compared
#: with any scatter.
HORIZON_NUDGE = 1e-5
#: Energy residual, as a share of the slider's work, that no realisation should exceed.
ENERGY_TOLERANCE = 5e-4
#: Largest residual over the median of its scene.
OUT_OF_LINE = 10.0


def half_width(deviation: float, count: int) -> float:
    """Return half of Student's 95 % interval of a mean over `count` seeds."""
    return float(students_t(count - 1) * deviation / np.sqrt(count))


def ensemble_error(scatter: Mapping[str, Any], realisations: int = ENSEMBLE) -> float:
    """Return the standard error of a mean over `realisations`, from a row with another number."""
    half = (scatter["ci_high"] - scatter["ci_low"]) / 2.0
    count = scatter["realisations"]
    deviation = half / students_t(count - 1) * count**0.5
    return float(deviation / realisations**0.5)


def suspects(realisations: Iterable[Row]) -> list[Row]:
    """Return rows whose energy residual is too large, or out of line with those of their scene."""
    groups = defaultdict(list)
    for row in realisations:
        groups[scene_of(row)].append(row)
    found = []
    for rows in groups.values():
        usual = median(abs(row["energy_error"]) for row in rows)
        limit = min(ENERGY_TOLERANCE, OUT_OF_LINE * usual)
        found += [row for row in rows if not abs(row["energy_error"]) <= limit]
    return found
