"""Two small kernels in a process of their own, and a folder for their machine code."""

import os
import subprocess
import sys
from pathlib import Path

KERNELS = """
import logging
import numpy as np
from springblock.solver.compilation import kernel

logging.basicConfig(format="%(message)s")

@kernel
def doubled(x):
    for i in range(len(x)):
        x[i] = 2.0 * x[i]
    return x[-1]

@kernel
def summed(x):
    total = 0.0
    for i in range(len(x)):
        total += x[i]
    return total

assert doubled(np.arange(5.0)) == 8.0 and summed(np.arange(4.0)) == 6.0
if hasattr(doubled, "stats"):
    print(*(sum(function.stats.cache_hits.values()) for function in (doubled, summed)))
"""
COMPILING = "compiling once for this processor and this kind of run, some 15 s"


def run_kernels(
    folder: Path, before: str = "", **environment: str
) -> tuple[list[str], list[str], int]:
    """Whether each kernel came from the cache in `folder`, 0 or 1, what was said, and exit code."""
    script = folder.parent / "kernels.py"
    if not script.exists():  # numba may judge a source by its time
        script.write_text(before + KERNELS)
    ours = {**os.environ, "NUMBA_CACHE_DIR": str(folder), **environment}
    done = subprocess.run([sys.executable, str(script)], env=ours, capture_output=True, text=True)
    return done.stdout.split(), done.stderr.splitlines(), done.returncode
