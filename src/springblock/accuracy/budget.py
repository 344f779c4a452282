"""Bias of ensembles, with bounds."""

from collections.abc import Iterable, Sequence
from itertools import product
from math import sqrt
from typing import NamedTuple

from springblock.accuracy.conventions import DELAY, ENSEMBLE, LENGTH, SCENES
from springblock.io.rows import Row, select
from springblock.model.defaults import STEP

Cases = dict[tuple[str, str], list[Row]]  #: rows at each step, by quantity and scene
#: Realisations of a scene in the study, by quantity; the decay length needs more.
STUDY_SEEDS = {"static_friction": ENSEMBLE, DELAY: ENSEMBLE, LENGTH: 60}


class Bias(NamedTuple):
    """Modulus of a bias, as a share of the quantity, and the far end of its 95 % interval."""

    estimate: float
    high: float

    @classmethod
    def of(cls, row: Row) -> "Bias":
        """Return the bias in a row of the table `production`.

        The scatter of a measured bias b, E[b²] = bias² + error², is subtracted.
        """
        squared = max(row["bias"] ** 2 - row["bias_error"] ** 2, 0.0)
        high = max(abs(row["ci_low"]), abs(row["ci_high"]))
        return cls(sqrt(squared) / row["scale"], high / row["scale"])


def measured(rows: Iterable[Row], quantities: Iterable[str]) -> Cases:
    """Rows of the table `production`, finest step first, by quantity and scene that have any."""
    ordered = sorted(rows, key=lambda row: row["step"])
    keys = product(quantities, SCENES)
    found = {key: select(ordered, quantity=key[0], scene=key[1]) for key in keys}
    return {key: rows for key, rows in found.items() if rows}


def at(step: float, rows: Iterable[Row]) -> Row:
    """Return the one row of this step."""
    (row,) = select(rows, step=step)
    return row


def finest_bias(rows: Iterable[Row]) -> float:
    """Largest bias of the finest step h itself, as a share of the quantity.

    For an error of order p it is the bias of the next step, r h, against h over r^p - 1. We take
    p = 1, the lower bound of orders across events, and the far end of the 95 % interval.
    """
    finest, following = sorted(rows, key=lambda row: row["step"])[:2]
    return Bias.of(following).high / (following["step"] / finest["step"] - 1.0)


def largest_bias(rows: Sequence[Row]) -> float:
    """Far end of the interval of the default's bias plus the finest step's, as a share."""
    return Bias.of(at(STEP, rows)).high + finest_bias(rows)
