"""How CPU time is measured, and the rows of the table that is printed.

CPU time counts, and that of the clock on the wall only where several cores share the work. What is
compared runs in turn, a repetition of each and then the next of each (A B A B ...), so that a
machine that gets slower or busier does so for all. Values are medians over the repetitions; a ratio
is the median of the ratios within them.
"""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Runs = dict[str, Callable[[], object]]  #: what is timed in turn, by its name


class Missing(Exception):
    """A peer cannot be timed here; the message says why."""


#: Names that history.csv finds its rows by.
BLOCK_STEP = "ns per block and step"
WITH_PRELUDE = "with the prelude"


@dataclass(frozen=True)
class Row:
    """What was measured of one thing, in all repetitions, and what it is compared with."""

    part: str
    name: str
    unit: str
    values: Array | float  #: of each repetition; NaN if missing
    scene: str = ""
    n_blocks: int = 0
    reference: Array | float = np.nan  #: of the same repetitions
    at_peak: Array | float = np.nan  #: if the core did nothing but multiply-adds
    note: str = ""

    @property
    def value(self) -> float:
        """Median over the repetitions."""
        return float(np.median(self.values))

    @property
    def ratio(self) -> float:
        """Value over what it is compared with."""
        return float(np.median(self.values / np.asarray(self.reference)))

    @property
    def of_peak(self) -> float:
        """Share of the core's peak."""
        return float(np.median(self.at_peak / np.asarray(self.values)))

    def cells(self) -> tuple[str, ...]:
        """Return the row as text."""
        low, high = np.quantile(self.values, [0.25, 0.75])
        return (
            self.part,
            self.name,
            self.scene,
            str(self.n_blocks or ""),
            "missing" if np.isnan(self.value) else _three_digits(self.value),
            f"{_three_digits(low)} - {_three_digits(high)}" if np.size(self.values) > 1 else "",
            self.unit,
            "" if np.isnan(self.of_peak) else f"{100.0 * self.of_peak:.0f} %",
            "" if np.isnan(self.ratio) else f"{self.ratio:.2f}",
            self.note,
        )


def _three_digits(value: float) -> str:
    return f"{value:#.3g}".rstrip(".")


def interleaved(
    runs: Mapping[str, Callable[[], object]],
    repetitions: int,
    clock: Callable[[], float] = time.process_time,
) -> dict[str, Array]:
    """Seconds of every run by a clock, of the CPU, one number per repetition, taken in turn."""
    seconds = np.empty((repetitions, len(runs)))
    for repetition in seconds:
        for k, run in enumerate(runs.values()):
            start = clock()
            run()
            repetition[k] = clock() - start
    return dict(zip(runs, seconds.T, strict=True))


def printed(rows: Sequence[Row]) -> str:
    """The rows as one table of text."""
    head = ("part", "what", "scene", "N", "value", "quartiles", "unit", "of peak", "ratio", "note")
    lines = [head, *(row.cells() for row in rows)]
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip()
        for line in lines
    )
