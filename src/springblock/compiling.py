"""A word to those who wait for the compiler."""

import logging
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
