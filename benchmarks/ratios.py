"""Two ratios of CPU times with upper limits: `make bench-ratios`.

The leapfrog over the C loop, and the start of a job over the import of numba. Both sides of a ratio
run in turn, so that a slow or busy machine changes both. The exit status is 1 if a ratio exceeds
its limit.
"""

import os
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from subprocess import run

import numpy as np

from benchmarks.speed import STEPS, N, Solver, c_loop_in_motion
from benchmarks.timing import Missing, interleaved

#: Limits. On an AMD EPYC the ratios are 1.20 and 2.45, with standard deviations of 0.02 and 0.08
#: from one measurement to the next; with AVX-512 that of the kernel is 1.05.
KERNEL, START = 1.4, 3.0
REPETITIONS = 15


def kernel() -> float:
    """Return the CPU time of the leapfrog over that of the C loop; raises Missing."""
    solver, loop = Solver("leapfrog", N), c_loop_in_motion(N)
    return _ratio(partial(solver.advance, STEPS), partial(loop, STEPS), time.process_time)


def start() -> float:
    """Return the CPU time of a job with next to no steps over that of importing numba."""
    with tempfile.TemporaryDirectory() as folder:
        job = ["-m", "springblock", "simulate", "--n-blocks", "12", "--duration", "2e-6"]
        ours = partial(_python, [*job, "--output", str(Path(folder, "run.parquet"))])
        ours()  # compiled first
        return _ratio(ours, partial(_python, ["-c", "import numba"]), _of_children)


def _python(arguments: Sequence[str]) -> None:
    run([sys.executable, *arguments], check=True, capture_output=True)


def _of_children() -> float:
    """Return the CPU time of all processes that this one has waited for, s."""
    times = os.times()
    return times.children_user + times.children_system


def _ratio(
    ours: Callable[[], object], theirs: Callable[[], object], clock: Callable[[], float]
) -> float:
    seconds = interleaved({"ours": ours, "theirs": theirs}, REPETITIONS, clock)
    return float(np.median(seconds["ours"] / seconds["theirs"]))


if __name__ == "__main__":
    of_start = start()
    print(f"start of a job over `import numba`: {of_start:.3f}, limit {START}")
    try:
        of_kernel = kernel()
    except Missing as reason:
        sys.exit(f"The C loop cannot be timed: {reason}")
    print(f"leapfrog over C loop: {of_kernel:.3f}, limit {KERNEL}")
    sys.exit(of_kernel > KERNEL or of_start > START)
