"""What an ensemble misses and what it costs: which step is best for so much CPU time.

The mean over k seeds is off by its bias, which the step leaves, and by its scatter, which falls
with k. Their root mean square is the total error,

    E² = bias² + deviation²/k,    k = (CPU time - that of the prelude)/(CPU time of a realisation).

Where a bias falls with step², and the cost of a realisation with 1/step, the best step leaves a
bias of half the standard error, and E falls with CPU time to the power 2/5.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import product
from math import inf, sqrt
from typing import NamedTuple

from springblock.accuracy.conventions import DELAY, ENSEMBLE, LENGTH, SCENES
from springblock.io.rows import Row, select
from springblock.model.defaults import STEP

Cases = dict[tuple[str, str], list[Row]]  #: rows at each step, by quantity and scene
#: Realisations of a scene in the study, by what errors are asked of; the decay length needs more.
STUDY_SEEDS = {"static_friction": ENSEMBLE, DELAY: ENSEMBLE, LENGTH: 60}


class Bias(NamedTuple):
    """Modulus of a bias, as a share of the quantity, and the ends of its 95 % interval."""

    estimate: float
    low: float
    high: float

    @classmethod
    def of(cls, row: Row) -> "Bias":
        """Take it from a row of the table `production`.

        A measured bias is too large by its own scatter, E[b²] = bias² + error²: what that adds is
        taken off. An interval that holds 0 leaves an upper limit alone.
        """
        squared = max(row["bias"] ** 2 - row["bias_error"] ** 2, 0.0)
        ends = sorted((abs(row["ci_low"]), abs(row["ci_high"])))
        low = 0.0 if row["ci_low"] <= 0.0 <= row["ci_high"] else ends[0]
        return cls(*(number / row["scale"] for number in (sqrt(squared), low, ends[1])))


@dataclass(frozen=True)
class Choice:
    """A step to compute ensembles with; errors are shares of the quantity."""

    step: float  #: s
    bias: float
    deviation: float  #: standard deviation of a realisation
    cpu_seconds: float  #: of a realisation
    prelude_seconds: float = 0.0  #: shared by all realisations

    def spent(self, seeds: float) -> float:
        """CPU time of so many seeds, s."""
        return self.prelude_seconds + seeds * self.cpu_seconds

    def seeds(self, budget: float) -> float:
        """How many seeds so much CPU time, s, allows; not rounded."""
        return (budget - self.prelude_seconds) / self.cpu_seconds

    def error(self, budget: float) -> float:
        """Total error for so much CPU time, s; infinite where that is less than a realisation's."""
        seeds = self.seeds(budget)
        return sqrt(self.bias**2 + self.deviation**2 / seeds) if seeds >= 1.0 else inf

    def cost(self, error: float) -> float:
        """CPU time of such a total error, s; infinite where the bias alone is as large."""
        left = error**2 - self.bias**2
        return self.spent(max(self.deviation**2 / left, 1.0)) if left > 0.0 else inf


def measured(rows: Iterable[Row], quantities: Iterable[str]) -> Cases:
    """Return the rows of each quantity and scene that has any, finest step first."""
    ordered = sorted(rows, key=lambda row: row["step"])
    keys = product(quantities, SCENES)
    found = {key: select(ordered, quantity=key[0], scene=key[1]) for key in keys}
    return {key: rows for key, rows in found.items() if rows}


def choices(rows: Iterable[Row], bias: str = "estimate") -> list[Choice]:
    """Steps of one scene and quantity, finest first; biases are estimates or ends of intervals.

    `rows` are those of the table `production`, `bias` names a field of `Bias`. The bias of the
    finest step, which `finest_bias` bounds, is neglected.
    """
    return [
        Choice(
            step=row["step"],
            bias=getattr(Bias.of(row), bias),
            deviation=row["deviation"] / row["scale"],
            cpu_seconds=row["cpu_seconds"],
            prelude_seconds=row["prelude_seconds"],
        )
        for row in sorted(rows, key=lambda row: row["step"])
    ]


def finest_bias(rows: Iterable[Row]) -> float:
    """Largest bias that the finest step h may have itself, as a share of the quantity.

    Of order p, it is the bias of the next step, r h, from that of h, over r^p - 1. We take p = 1,
    the lower bound of orders across events, and the far end of the 95 % interval.
    """
    finest, following = sorted(rows, key=lambda row: row["step"])[:2]
    return Bias.of(following).high / (following["step"] / finest["step"] - 1.0)


def largest_bias(rows: Iterable[Row]) -> float:
    """Far end of the interval of the default's bias plus the finest step's, as a share."""
    rows = list(rows)
    (default,) = select(rows, step=STEP)
    return Bias.of(default).high + finest_bias(rows)


def best(steps: Sequence[Choice], budget: float) -> Choice:
    """Choose the step of the smallest total error for so much CPU time, s."""
    return min(steps, key=lambda step: step.error(budget))


def halving(steps: Sequence[Choice], budget: float) -> float:
    """How many times the CPU time, s, half the total error costs, always at the best step.

    Four, where nothing but scatter is left.
    """
    error = best(steps, budget).error(budget) / 2.0
    return min(step.cost(error) for step in steps) / budget


def study_budget(rows: Sequence[Row], fold: float = 1.0) -> float:
    """CPU time of `fold` times the study's seeds at the default step, s; `rows` as of `choices`."""
    (default,) = (choice for choice in choices(rows) if choice.step == STEP)
    return default.spent(fold * STUDY_SEEDS.get(rows[0]["quantity"], ENSEMBLE))


def excess(steps: Sequence[Choice], budget: float) -> dict[float, float]:
    """Total error at each step over that at the best one, for so much CPU time, s."""
    least = best(steps, budget).error(budget)
    return {step.step: step.error(budget) / least for step in steps}
