"""Two ratios that must not rise: the kernel to a C loop, and the start of a job to that of numba.

    python -m benchmarks.ratios    # or `make bench-ratios`; exit status 1 if one exceeds its limit

Both sides of a ratio run in turn and count CPU time, so that a slow or busy machine changes both.
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
from benchmarks.timing import Missing, Runs, interleaved

#: Limits. On an AMD EPYC the ratios are 1.20 and 2.45, with standard deviations of 0.02 and 0.08
#: from one measurement to the next; with AVX-512 that of the kernel is 1.05.
KERNEL, START = 1.4, 3.0
REPETITIONS = 15


def kernel() -> float:
    """Return the CPU time of the leapfrog over that of the C loop; raises Missing."""
    solver, loop = Solver("leapfrog", N), c_loop_in_motion(N)
    return _ratio({"ours": partial(solver.advance, STEPS), "theirs": partial(loop, STEPS)})


def start() -> float:
    """Return the CPU time of a job with next to no steps over that of importing numba."""
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder, "run.parquet")
        job = ["-m", "springblock", "simulate", "--n-blocks", "12", "--duration", "2e-6"]
        job += ["--output", str(output)]
        _python(job)  # compiled first
        alone = partial(_python, ["-c", "import numba"])
        return _ratio({"ours": partial(_python, job), "theirs": alone}, _of_children)


def _python(arguments: Sequence[str]) -> None:
    run([sys.executable, *arguments], check=True, capture_output=True)


def _of_children() -> float:
    """Return the CPU time of all processes that this one has waited for, s."""
    times = os.times()
    return times.children_user + times.children_system


def _ratio(runs: Runs, clock: Callable[[], float] = time.process_time) -> float:
    seconds = interleaved(runs, REPETITIONS, clock)
    return float(np.median(seconds["ours"] / seconds["theirs"]))


def main() -> None:
    """Print both ratios beside their limits."""
    exceeded = False
    for name, measure, limit in (
        ("leapfrog over C loop", kernel, KERNEL),
        ("start of a job over `import numba`", start, START),
    ):
        try:
            ratio = measure()
        except Missing as why:
            print(f"{name}: not measured, {why}")
            continue
        exceeded |= ratio > limit
        print(f"{name}: {ratio:.3f}, limit {limit}")
    sys.exit(exceeded)


if __name__ == "__main__":
    main()
