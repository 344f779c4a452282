"""Compilation of the kernels by numba, and the cache of their machine code.

Machine code is cached in `springblock/<digest>` in `$NUMBA_CACHE_DIR`, or else in the user's cache
folder; the digest covers the sources of the solver, numba's release and settings, and the
processor. Files are loaded only if their checksums match. Where nothing can be cached, each process
compiles. An import of this module leaves numba's settings unchanged. But if it declares the first
function of a process, the vector width chosen in `_processor_features` holds for all its functions.
"""

import contextlib
import fcntl
import hashlib
import logging
import os
import stat
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import llvmlite.binding
import numba
from numba import njit, types
from numba.extending import intrinsic, overload

_LOG = logging.getLogger(__name__)


@contextlib.contextmanager
def _setting(name: str, value: object) -> Iterator[None]:
    """Change one of numba's settings temporarily."""
    before = getattr(numba.config, name)
    setattr(numba.config, name, value)
    try:
        yield
    finally:
        setattr(numba.config, name, before)


def _processor_features() -> str | None:
    """Return the processor features for numba to use; None leaves the choice to numba.

    With AVX-512, vectors have 512 bits. LLVM prefers 256, since the first of these processors
    reduced their clock rate for longer ones. NUMBA_CPU_NAME or NUMBA_CPU_FEATURES override this.
    """
    config = numba.config
    if config.CPU_NAME is not None or config.CPU_FEATURES is not None:
        return config.CPU_FEATURES
    try:
        features = llvmlite.binding.get_host_cpu_features()
    except RuntimeError:  # pragma: no cover - only on a processor that LLVM does not know
        return None
    return f"{features.flatten()},-prefer-256-bit" if features.get("avx512f") else None


_FEATURES = _processor_features()

# Numba reads the features once in a process, when the first function is declared: this one.
with _setting("CPU_FEATURES", _FEATURES):
    njit(lambda: None)


def _digest() -> str:
    """Return the digest of sources, numba's release and settings, and processor; 16 digits."""
    name = numba.config.CPU_NAME or llvmlite.binding.get_host_cpu_name()
    of_place = ("CACHE_DIR", "NUMBA_DEFAULT_NUM_THREADS", "NUMBA_NUM_THREADS")
    known = vars(numba.config).items()
    settings = sorted((key, value) for key, value in known if key.isupper() and key not in of_place)
    content = hashlib.sha256(repr((numba.__version__, name, _FEATURES, settings)).encode())
    for file in sorted(Path(__file__).parent.glob("*.py")):
        content.update(file.name.encode() + file.read_bytes())
    return content.hexdigest()[:16]


def _cache_folder() -> Path:
    """Return the folder for machine code, to which only this user can write: numba executes it.

    As for the keys of ssh, this includes all folders above, but for those like /tmp from which only
    owners can remove files. The owner of / is root, or stands for root in a container.
    """
    home = os.environ.get("NUMBA_CACHE_DIR") or os.environ.get("XDG_CACHE_HOME")
    folder = Path(home or Path.home() / ".cache").absolute() / "springblock" / _digest()
    for each in (*reversed(folder.parents), folder):
        each.mkdir(mode=0o700, exist_ok=True)
    folder = folder.resolve()
    for each in (folder, *folder.parents):
        status, is_own = each.stat(), each in (folder, folder.parent)
        owners = {os.getuid()} if is_own else {os.getuid(), Path("/").stat().st_uid, 0}
        is_open = status.st_mode & 0o022 and (is_own or not status.st_mode & stat.S_ISVTX)
        if status.st_uid not in owners or is_open:
            raise PermissionError(f"others can write to {each}")
    if not os.access(folder, os.W_OK):
        raise PermissionError(f"{folder} is read-only")
    return folder


try:
    FOLDER: Path | None = _cache_folder()
    _COMPILING = "compiling once for this processor and this kind of run, some 15 s"
except (OSError, RuntimeError) as error:
    FOLDER = None
    _COMPILING = f"compiling for this process alone, some 15 s, because nothing is cached: {error}"


_warn_once = cache(_LOG.warning)


try:  # internals, which numba may move or change without notice
    from numba.core.caching import FunctionCache, IndexDataCacheFile
    from numba.core.compiler import Compiler
    from numba.core.cpu import CPUTargetOptions
    from numba.core.event import Listener, register
except ImportError:
    Compiler = CPUTargetOptions = FunctionCache = IndexDataCacheFile = Listener = object

#: Whether numba has these internals. Without them kernels are slower and may differ in last bits.
HAS_PRIVATE_PARTS = hasattr(CPUTargetOptions, "_nrt")


class _Restrict(Compiler):  # type: ignore[misc]
    """Compiler that assumes that the array arguments of a function do not overlap.

    Otherwise every loop over a row would begin with a check of each pair of arrays. Kernels make no
    arrays, so `_nrt` is off: it would count references by atomic operations in each call.
    """

    def define_pipelines(self):
        _warn_once(_COMPILING)
        self.state.flags.noalias = True
        return super().define_pipelines()


class _OneCompiler(Listener):  # type: ignore[misc]
    """Lock that lets one process at a time compile and write to the cache.

    If two processes added code for different types to one kernel, numba would mix up their files.
    """

    def __init__(self, file: Path) -> None:
        self._file, self._depth, self._lock = file, 0, -1

    def on_start(self, event):
        self._depth += 1
        if self._depth == 1:
            with contextlib.suppress(OSError):  # a full disk, or a file system without locks
                self._lock = os.open(self._file, os.O_RDWR | os.O_CREAT, 0o600)
                fcntl.flock(self._lock, fcntl.LOCK_EX)

    def on_end(self, event):
        self._depth -= 1
        if self._depth == 0 and self._lock >= 0:
            os.close(self._lock)
            self._lock = -1


class _SealedFiles(IndexDataCacheFile):  # type: ignore[misc]
    """Files of machine code that end with a checksum; those that are damaged count as missing."""

    def _load_index(self):
        return super()._load_index() if _is_whole(self._index_path) else {}

    def _load_data(self, name):
        if not _is_whole(self._data_path(name)):
            raise FileNotFoundError(name)
        return super()._load_data(name)

    @contextlib.contextmanager
    def _open_for_write(self, filepath):
        with super()._open_for_write(filepath) as file:
            yield file
            file.flush()
            file.write(hashlib.sha256(Path(file.name).read_bytes()).digest())


def _is_whole(file: str) -> bool:
    try:
        content = Path(file).read_bytes()
    except OSError:
        return False
    return hashlib.sha256(content[:-32]).digest() == content[-32:]


class _Cache(FunctionCache):  # type: ignore[misc]
    """Cache of a function in sealed files; without space for them, each process compiles."""

    def __init__(self, function):
        super().__init__(function)
        self._cache_file.__class__ = _SealedFiles

    def save_overload(self, *compiled):
        try:
            super().save_overload(*compiled)
        except OSError as error:
            _warn_once(f"machine code cannot be cached in {FOLDER}: {error}")


if FOLDER and HAS_PRIVATE_PARTS:
    register("numba:compiler_lock", _OneCompiler(FOLDER / "lock"))


def cached_njit(function: Callable[..., Any], **options: Any) -> Any:
    """Apply `numba.njit` with the cache folder; without one, each process compiles anew.

    The folder of a function is fixed when the function is declared.
    """
    compiled = njit(**options)(function)
    if FOLDER and HAS_PRIVATE_PARTS:
        # numba refuses a folder in which it cannot make a file
        with _setting("CACHE_DIR", str(FOLDER)), contextlib.suppress(RuntimeError):
            compiled._cache = _Cache(function)
    return compiled


#: Fused multiply-adds are allowed, but nothing that would drop a NaN or reorder a sum.
_OPTIONS = {"nogil": True, "error_model": "numpy", "fastmath": {"contract", "nsz"}}
if HAS_PRIVATE_PARTS:
    _OPTIONS |= {"pipeline_class": _Restrict, "_nrt": False}


def kernel(function: Callable[..., Any]) -> Any:
    """Compile a function for the types of its arguments, and cache its machine code."""
    return cached_njit(function, **_OPTIONS)


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
