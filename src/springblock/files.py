"""Files that are whole or absent, and whether they still are what was written."""

import contextlib
import hashlib
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any, BinaryIO
from uuid import uuid4
from zipfile import BadZipFile, ZipFile

import numpy as np
from numpy.typing import NDArray

#: What mends a file of a study that cannot be used.
MENDING = "`snakemake repair` sets it aside, and the next `snakemake` makes it again"

_MARK = b"springblock-sha256:"
#: Stands once in content to be sealed, where the digest of all of it goes.
BLANK = _MARK + 64 * b"0"


def check_output(path: Path) -> None:
    """Refuse to write to what exists and is not a regular file, as a directory, device or link.

    Renaming a file to it would replace it, as /dev/full for all programs of the machine.
    """
    if path.is_symlink() or (path.exists() and not path.is_file()):
        raise ValueError(f"{path} exists and is not a regular file; choose another name")
    folder = next(folder for folder in path.absolute().parents if folder.exists())
    if not folder.is_dir():
        raise ValueError(f"{path} cannot be written: {folder} is not a folder")


@contextlib.contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """Yield a temporary path beside `path`, and rename it to `path` once it is complete.

    Raises
    ------
    ValueError
        Where there is something at `path` that is not a regular file.
    """
    check_output(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    partial = path.with_name(f".{path.name}.{uuid4().hex}")
    try:
        yield partial
        partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)


def write_sealed(path: Path, content: bytes) -> None:
    """Write content whole or not at all, with the digest of all of it in place of `BLANK`.

    Checksums of Parquet's own cover its pages, not the footer that says where these are.
    """
    with whole_file(path) as partial:
        partial.write_bytes(content.replace(BLANK, _seal(content)))


def read_sealed(path: Path) -> bytes:
    """Read what `write_sealed` wrote.

    Raises
    ------
    ValueError
        Where a single bit is not as it was written, naming the command that mends it.
    """
    content = path.read_bytes()
    start = content.rfind(_MARK)
    if start < 0:
        raise ValueError(
            f"{path} is no whole table (Parquet) of springblock's, since it has no checksum, like "
            f"files of other origin and those cut short; {MENDING}"
        )
    end = start + len(BLANK)
    if _seal(content[:start] + BLANK + content[end:]) != content[start:end]:
        raise ValueError(f"{path} is damaged: its content does not fit its checksum; {MENDING}")
    return content


def _seal(content: bytes) -> bytes:
    return _MARK + hashlib.sha256(content).hexdigest().encode()


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
