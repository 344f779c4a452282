"""A word to those who wait for the compiler, and what it need not load."""

import importlib
import logging
import sys
from functools import cache
from pathlib import Path

import numba

_LOG = logging.getLogger(__name__)


@cache
def announce(integrator: str, cores: int) -> None:
    """Say that an integrator is compiled now, where no machine code of it is kept; once a process.

    A warning of the logger `springblock.compiling`, which Python writes to stderr by itself.
    """
    kernel = integrator if cores == 1 else "parallel"
    if not any(Path(numba.config.CACHE_DIR).rglob(f"{kernel}.*.nbi")):
        _LOG.warning("compiling %s once, about 15 s", integrator)


def spare_blas() -> None:
    """Load numba without SciPy's BLAS, which no kernel calls and which takes 0.2 s to load.

    For processes of the command line alone: functions compiled in them cannot use `np.dot`.
    """
    blas = "scipy.linalg.cython_blas"
    if blas not in sys.modules:
        sys.modules[blas] = None  # type: ignore[assignment]  # numba goes on without
        importlib.import_module("numba.np.arraymath")
        del sys.modules[blas]
