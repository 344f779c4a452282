"""Constants that tables, page and figures share."""

import numpy as np

from springblock.analysis.statistics import students_t

SCENES = ("flat", "pillared", "grooved")
MEANS = ("static_friction", "t_max", "t_avg")  #: quantities averaged over ensembles
#: Quantities whose orders of convergence are measured.
ORDERED = ("static_friction", "t_det before horizon")
DELAY = "t_max - t_avg"  #: by how much the force peak comes after the mean detachment
LENGTH = "decay length"  #: of c(r) along the sides of pillars
PLAIN = "plain rk4"  #: Runge-Kutta with the friction of each stage
SAMPLE_INTERVAL = 8e-8  #: s, of runs on small surfaces
#: Usual realisations per scene; biases are compared with the standard error of their mean.
ENSEMBLE = 20
#: Relative change of the thresholds that defines the horizon: the largest that is small compared
#: with any scatter.
HORIZON_NUDGE = 1e-5


def half_width(deviation: float, count: int) -> float:
    """Return half of Student's 95 % interval of a mean over `count` seeds."""
    return float(students_t(count - 1) * deviation / np.sqrt(count))
