"""The metrics, which README.md defines: what an answer is off by, and how uncertain that is."""

from bisect import bisect_right
from typing import NamedTuple

import numpy as np

from benchmarks.verification.problems import Answer, Reference
from springblock.accuracy.work_precision import root_mean_square
from springblock.model.numbers import Array


class Metrics(NamedTuple):
    """What is compared; NaN where there is no force."""

    t_det: float
    static_friction: float
    force: float
    out_of_order: int


NAMES = (
    "t_det before the horizon, RMS error over t_max",
    "static friction, relative error",
    "force before t_max, largest error over largest force",
    "blocks out of order before the horizon",
)


def errors(answer: Answer, reference: Reference) -> Metrics:
    """What an answer is off by."""
    compared = reference.t_det < reference.horizon
    shift = (answer.t_det - reference.t_det)[compared]
    sequence = answer.t_det[compared][np.argsort(reference.t_det[compared])]
    return Metrics(
        root_mean_square(shift) / reference.t_max,
        float(abs(answer.force.max() / reference.force.max() - 1.0)),
        _before_peak(np.abs(answer.force - reference.force), reference),
        len(sequence) - _longest_rise(sequence),
    )


def uncertainties(reference: Reference) -> Metrics:
    """What an answer may be off by because the reference is.

    For the order: blocks whose t_det is within both uncertainties of another's.
    """
    compared = reference.t_det < reference.horizon
    t_det, by = reference.t_det[compared], reference.t_det_uncertainty[compared]
    close = np.abs(t_det[:, None] - t_det) <= by[:, None] + by
    return Metrics(
        root_mean_square(by) / reference.t_max,
        reference.friction_uncertainty / reference.static_friction,
        _before_peak(reference.force_uncertainty, reference),
        int((close.sum(axis=1) > 1).sum()),
    )


def cells(metrics: Metrics) -> list[str]:
    """Numbers of a line in a table."""
    return [*(f"{value:.2e}" for value in metrics[:3]), f"{metrics.out_of_order}"]


def _before_peak(difference: Array, reference: Reference) -> float:
    """Largest of the differences (n,) before t_max, over the largest force."""
    peak = int(reference.force.argmax())
    return float(difference[:peak].max() / reference.force[peak])


def _longest_rise(values: Array) -> int:
    """Length of the longest part that never falls; others may lie between its members."""
    ends: list[float] = []  # least last value of a rise of each length
    for value in values:
        at = bisect_right(ends, value)
        ends[at : at + 1] = [value]
    return len(ends)
