"""Compilation of the kernels by numba, and the folder of their machine code.

Machine code is cached in `springblock/<digest>` in `$NUMBA_CACHE_DIR`, or else in the user's cache
folder; numba keeps that of each processor apart. The digest is that of the solver's sources: numba
alone would notice a change of a function, but not of those that it calls. Where nothing can be
written, each process compiles. An import of this module leaves numba's settings unchanged.
"""

import contextlib
import fcntl
import hashlib
import logging
import os
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import numba
from numba import njit, types
from numba.extending import intrinsic, overload

_warn_once = cache(logging.getLogger(__name__).warning)


def _digest() -> str:
    """Return the digest of the solver's sources, 16 digits."""
    content = hashlib.sha256()
    for file in sorted(Path(__file__).parent.glob("*.py")):
        content.update(file.name.encode() + file.read_bytes())
    return content.hexdigest()[:16]


@contextlib.contextmanager
def _locked(folder: Path) -> Iterator[None]:
    """Let one process at a time write to a folder; raise OSError where it cannot."""
    with (folder / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def _cache_folder() -> Path:
    """Return the folder for machine code; raise OSError if nothing can be written there."""
    home = numba.config.CACHE_DIR or os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    folder = Path(home).absolute() / "springblock" / _digest()
    folder.mkdir(parents=True, exist_ok=True)
    with _locked(folder):
        return folder


try:
    FOLDER: Path | None = _cache_folder()
    _COMPILING = "compiling once for this processor and this kind of run, some 15 s"
except (OSError, RuntimeError) as error:  # RuntimeError: there is no home
    FOLDER = None
    _COMPILING = f"compiling for this process alone, some 15 s, because nothing is cached: {error}"


#: Fused multiply-adds are allowed, but nothing that would drop a NaN or reorder a sum.
_OPTIONS = {"nogil": True, "error_model": "numpy", "fastmath": {"contract", "nsz"}}

try:  # private parts of numba; without them kernels are slower, and may differ in last bits
    from numba.core.compiler import Compiler, Flags
    from numba.core.cpu import CPUTargetOptions

    class _Restrict(Compiler):  # type: ignore[misc]
        """Compiler that assumes that the array arguments of a function do not overlap.

        Otherwise every loop over a row would begin with a check of each pair of arrays.
        """

        def define_pipelines(self):
            _warn_once(_COMPILING)
            self.state.flags.noalias = True
            return super().define_pipelines()

    if hasattr(Flags, "noalias") and hasattr(CPUTargetOptions, "_nrt"):
        # kernels make no arrays; with `_nrt` each call would count references by atomic operations
        _OPTIONS |= {"pipeline_class": _Restrict, "_nrt": False}
except ImportError:
    pass


def kernel(function: Callable[..., Any]) -> Any:
    """Compile a function for the types of its arguments, and cache its machine code."""
    if FOLDER is None:
        return njit(**_OPTIONS)(function)
    before, numba.config.CACHE_DIR = numba.config.CACHE_DIR, str(FOLDER)
    try:  # the folder of a function is fixed here
        compiled = njit(cache=True, **_OPTIONS)(function)
    finally:
        numba.config.CACHE_DIR = before
    if not hasattr(compiled, "_cache"):  # interpreted, or a numba whose cache cannot be locked
        return njit(**_OPTIONS)(function)
    compiled._cache.save_overload = _one_at_a_time(compiled._cache.save_overload, FOLDER)
    return compiled


def _one_at_a_time(save: Callable[..., None], folder: Path) -> Callable[..., None]:
    """Return a function that saves machine code while no other process does.

    If two processes added code for different types to one function, numba would mix up their files.
    """

    def save_locked(*compiled: Any) -> None:
        try:
            with _locked(folder):
                save(*compiled)
        except OSError as error:
            _warn_once(f"machine code cannot be cached in {folder}: {error}")

    return save_locked


@intrinsic
def add(typingctx, total, term):
    """Return total + term, an addition within a sum that the compiler may reorder.

    This allows a loop with sums to be vectorised, while all other operations keep their order.
    """

    def generate(context, builder, signature, arguments):
        return builder.fadd(*arguments, flags=("reassoc", "nsz"))

    return types.float64(types.float64, types.float64), generate


def method(name: str, usual: type = object) -> Any:
    """Return the function that calls the static method `name` of its first argument, a NamedTuple.

    None, and a class without this method, have that of `usual`. Compiled callers choose when they
    are compiled, and LLVM inlines the method; if numba inlined it instead, assignments to arrays
    of the tuple would be lost.
    """

    def own(kind: type) -> Any:
        return getattr(kind, name, None) or getattr(usual, name)

    def chosen(first, *others):
        return own(type(first))(first, *others)

    @overload(chosen, strict=False)
    def compiled(first, *others):
        return own(getattr(first, "instance_class", usual))

    return chosen
