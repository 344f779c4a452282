"""How the kernels are compiled, and where their machine code is kept."""

import hashlib
import inspect
import logging
import os
import pickle
import sysconfig
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import llvmlite.binding
import numba
import numpy as np
from numba import njit, types
from numba.core import caching
from numba.core.compiler import Compiler, CompileResult
from numba.core.serialize import dumps
from numba.extending import intrinsic

from springblock.files import BLANK, read_sealed, write_sealed
from springblock.provenance import digest

_LOG = logging.getLogger(__name__)


def _caches() -> Path:
    """Folder for what can be made again."""
    try:
        home = Path.home()
    except RuntimeError:  # a user who has none, as in some containers; a stranger's folder won't do
        home = Path(os.devnull)
    return Path(os.environ.get("XDG_CACHE_HOME") or home / ".cache") / "springblock"


#: Where machine code is kept. A function inlined from another file may change: each state of the
#: sources has a folder of its own. Unlike nodes share it.
FOLDER = Path(os.environ.get("NUMBA_CACHE_DIR") or _caches()) / digest("compile")

#: What machine code depends on besides its source, the types and the processor.
_TOOLS = (
    sysconfig.get_config_var("EXT_SUFFIX"),
    numba.__version__,
    np.__version__,
    *(
        os.environ.get(f"NUMBA_{setting}")
        for setting in ("OPT", "BOUNDSCHECK", "DEBUGINFO", "LOOP_VECTORIZE", "SLP_VECTORIZE")
    ),
)


def _wide_vectors() -> str | None:
    """Features of a processor with AVX-512, of which vectors of 512 bits are to be made use of.

    LLVM prefers half of that, lest the clock slows down, as it did on the first of them. None
    leaves the choice to numba.
    """
    try:
        features = llvmlite.binding.get_host_cpu_features()
    except RuntimeError:  # LLVM does not know this processor
        return None
    return f"{features.flatten()},-prefer-256-bit" if features.get("avx512f") else None


if not (numba.config.CPU_NAME or numba.config.CPU_FEATURES):
    numba.config.CPU_FEATURES = _wide_vectors()


class _Restrict(Compiler):  # type: ignore[misc]
    """Promises that the arrays handed to a function do not overlap, as `restrict` does in C.

    Every row would otherwise begin with a check of each array against all others.
    """

    def define_pipelines(self):
        self.state.flags.noalias = True
        return super().define_pipelines()


class _Kept(caching.NullCache):  # type: ignore[misc]
    """Machine code of one function, a file for each kind of processor and of arguments.

    Unlike numba's own, it is known to be whole, no two processes mistake each other's for theirs,
    and it is loaded as it is: numba makes ready to compile first, which takes a quarter of a short
    job. Where it cannot be kept, each process compiles what it needs.
    """

    def __init__(self, compiled: Any) -> None:
        function = compiled.py_func
        self._name = f"{function.__module__}.{function.__qualname__}"
        self._source = _content(inspect.getfile(function)), function.__code__.co_firstlineno
        self._depends_on_more = bool(function.__closure__)
        self._makes_arrays = compiled.targetoptions.get("_nrt", True)

    def _file(self, types_given: object, codegen: Any) -> Path:
        made_for = (self._source, types_given, codegen.magic_tuple(), _TOOLS)
        return FOLDER / f"{self._name}-{hashlib.sha256(repr(made_for).encode()).hexdigest()[:32]}"

    def load_overload(self, sig: object, target_context: Any) -> Any:
        try:
            kept = read_sealed(self._file(sig, target_context.codegen()))
        except (OSError, ValueError):  # not there, or damaged
            _say_compiling()
            return None
        if self._makes_arrays:
            target_context.refresh()
        return CompileResult._rebuild(target_context, *pickle.loads(kept))

    def save_overload(self, sig: object, result: Any) -> None:
        code = result._asdict()["library"]
        if self._depends_on_more or code.has_dynamic_globals:  # addresses of this process
            return
        try:
            made = dumps(result._reduce()) + BLANK
            write_sealed(self._file(sig, code.codegen), made)
        except OSError as error:
            _say_not_kept(error.strerror)


@cache
def _content(source: str) -> str:
    """Digest of a source file as it is when it is imported."""
    return hashlib.sha256(Path(source).read_bytes()).hexdigest()


@cache
def _say_compiling() -> None:
    _LOG.warning("compiling once for this processor and this kind of run, some 15 s")


@cache
def _say_not_kept(error: str) -> None:
    _LOG.warning("machine code cannot be kept for the next time in %s: %s", FOLDER, error)


def keep(compiled: Any) -> Any:
    """Let machine code of what numba compiles be kept."""
    if not numba.config.DISABLE_JIT:  # and left it a function of Python's
        compiled._cache = _Kept(compiled)
    return compiled


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
    return keep(njit(**_OPTIONS)(function))


@intrinsic
def add(typingctx, total, term):
    """Return total + term, for sums whose order the compiler may choose.

    A loop that ends in such sums can be vectorised without leave to reorder anything else.
    """

    def generate(context, builder, signature, arguments):
        return builder.fadd(*arguments, flags=("reassoc", "nsz"))

    return types.float64(types.float64, types.float64), generate
