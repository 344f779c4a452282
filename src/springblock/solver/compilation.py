"""How the kernels are compiled, and where their machine code is kept."""

import os
import sysconfig
from collections.abc import Callable
from pathlib import Path
from typing import Any
from uuid import uuid4

import llvmlite.binding
import numba
from numba import njit, types
from numba.core import caching
from numba.core.compiler import Compiler
from numba.extending import intrinsic

from springblock.sources import digest


def _default_cache() -> Path:
    base = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(base) / "springblock"


# Numba finds stale machine code by the time stamp of the file that holds the function, and does
# not see that a function inlined from another file has changed. One folder per digest does. Its
# index tells processors and their features apart, so unlike nodes can share the folder.
numba.config.CACHE_DIR = str(
    Path(os.environ.get("NUMBA_CACHE_DIR") or _default_cache())
    / f"{digest('springblock.solver')}-{sysconfig.get_python_version()}"
)


def _wide_vectors() -> str | None:
    """Features of a processor with AVX-512, of which vectors of 512 bits are to be made use of.

    LLVM prefers half of that, lest the clock slows down, as it did on the first of them. None
    leaves the choice to numba, which tells processors apart in its cache.
    """
    try:
        features = llvmlite.binding.get_host_cpu_features()
    except RuntimeError:  # LLVM does not know this processor
        return None
    return f"{features.flatten()},-prefer-256-bit" if features.get("avx512f") else None


if not (numba.config.CPU_NAME or numba.config.CPU_FEATURES):
    numba.config.CPU_FEATURES = _wide_vectors()


class _OwnFiles(caching.IndexDataCacheFile):  # type: ignore[misc]
    """Files of machine code that no two processes give the same name.

    Numba counts them. Processes that compile at a time, for other types or on other processors,
    could then overwrite each other's and load what is not theirs; now all that may happen is
    that the index forgets one of them, which is then compiled again.
    """

    def __init__(self, cache_path: str, filename_base: str, source_stamp: object):
        super().__init__(cache_path, filename_base, source_stamp)
        self._data_name_pattern = f"{filename_base}.{uuid4().hex}-{{number:d}}.nbc"


caching.IndexDataCacheFile = _OwnFiles


class _Restrict(Compiler):  # type: ignore[misc]
    """Promises that the arrays handed to a function do not overlap, as `restrict` does in C.

    Every row would otherwise begin with a check of each array against all others.
    """

    def define_pipelines(self):
        self.state.flags.noalias = True
        return super().define_pipelines()


class _Kept(caching.FunctionCache):  # type: ignore[misc]
    """Machine code that is loaded as it is.

    Numba makes ready to compile before it looks for kept code: it loads all that it knows of
    Python and NumPy, a quarter of what a short job costs. Should there be something to compile,
    it makes ready for that by itself.
    """

    def load_overload(self, sig, target_context):
        return self._load_overload(sig, target_context)


#: Fused multiply-adds are allowed; nothing that would lose a NaN or reorder a sum. References to
#: arrays are not counted, which costs an atomic operation for each array in each call: kernels
#: make no arrays.
_OPTIONS = {
    "nogil": True,
    "error_model": "numpy",
    "fastmath": {"contract", "nsz"},
    "pipeline_class": _Restrict,
    "_nrt": False,
}


def kernel(function: Callable[..., Any]) -> Any:
    """Compile a function for the types that it is called with, and keep its machine code."""
    compiled = njit(**_OPTIONS)(function)
    compiled._cache = _Kept(function)
    return compiled


@intrinsic
def add(typingctx, total, term):
    """Return total + term, for sums whose order the compiler may choose.

    A loop that ends in such sums can be vectorised without leave to reorder anything else.
    """

    def generate(context, builder, signature, arguments):
        return builder.fadd(*arguments, flags=("reassoc", "nsz"))

    return types.float64(types.float64, types.float64), generate
