"""CPU times of codes that run in turn, so that a busy or slowing machine affects all of them."""

import time
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Runs = dict[str, Callable[[], object]]  #: what is timed, by its name


class Missing(Exception):
    """A code cannot be timed on this machine, for the reason that the message gives."""


def interleaved(
    runs: Runs, repetitions: int, clock: Callable[[], float] = time.process_time
) -> dict[str, Array]:
    """Time all runs in turn (A B A B ...); return the seconds of each repetition by name.

    Ratios of two runs are taken within repetitions.
    """
    seconds = np.empty((repetitions, len(runs)))
    for repetition in seconds:
        for k, run in enumerate(runs.values()):
            start = clock()
            run()
            repetition[k] = clock() - start
    return dict(zip(runs, seconds.T, strict=True))
