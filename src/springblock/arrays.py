"""Files of several arrays (.npz), read without running or unpacking what a stranger put there."""

import zlib
from pathlib import Path
from typing import Any, BinaryIO
from zipfile import BadZipFile, ZipFile

import numpy as np
from numpy.typing import NDArray

#: Bytes that a packed file may become: the largest prelude has six states of 4096 x 4096 blocks.
_MOST = 2**32
#: What reading a file raises that is no such file, beside ValueError.
_TORN = BadZipFile, EOFError, MemoryError, OSError, RuntimeError, TypeError, zlib.error


def read_arrays(source: Path | BinaryIO) -> dict[str, NDArray[Any]]:
    """Read plain arrays by their names; anything else is never loaded.

    Raises
    ------
    ValueError
        Where it is no such file, or would become much larger in memory than it is.
    """
    try:
        with ZipFile(source) as packed:
            parts = packed.infolist()
        size, stored = (sum(p.file_size for p in parts), sum(p.compress_size for p in parts))
        if size > max(_MOST, stored):
            raise ValueError(f"it would take {size} bytes; {_MOST} are the most that are unpacked")
        if not isinstance(source, Path):
            source.seek(0)
        with np.load(source, allow_pickle=False) as arrays:
            found = dict(arrays)
    except _TORN as error:
        raise ValueError(str(error)) from error
    others = [name for name, part in found.items() if not isinstance(part, np.ndarray)]
    if others:
        raise ValueError(f"{others[0]} in it is no array")
    return found
