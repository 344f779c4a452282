"""Two small kernels in a process of their own, and a folder for their machine code."""

import os
import subprocess
import sys
from pathlib import Path

KERNELS = """
import logging
import os
import numpy as np
from numba import njit
from springblock.solver.compilation import keep, kernel

logging.basicConfig(format="%(message)s")
FACTOR = 2.0
ONE_HALF = np.dtype(os.environ.get("OF_TYPE", "float64")).type(0.5)

@kernel
def twice(x):
    return FACTOR * x

@keep
@njit
def doubled(x):
    return np.full(3, x).sum()

assert twice(ONE_HALF) == FACTOR * 0.5 and doubled(1.0) == 3.0
print(*(sum(function.stats.cache_hits.values()) for function in (twice, doubled)))
"""
COMPILING = "compiling once for this processor and this kind of run, some 15 s"


def run_kernels(
    folder: Path, kernels: str = KERNELS, **environment: str
) -> tuple[list[str], list[str], int]:
    """Whether the kernels were kept in `folder`, 0 or 1 each, what was said, and the exit code."""
    script = folder.parent / "kernels.py"
    script.write_text(kernels)
    ours = {**os.environ, "NUMBA_CACHE_DIR": str(folder), **environment}
    done = subprocess.run([sys.executable, str(script)], env=ours, capture_output=True, text=True)
    return done.stdout.split(), done.stderr.splitlines(), done.returncode
