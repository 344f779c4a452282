"""Files that are written whole or not at all, and checked for damage when they are read."""

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

#: Advice for a file of a study that cannot be used.
MENDING = "`snakemake repair` sets it aside, and the next `snakemake` makes it again if needed"

_MARK = b"springblock-sha256:"
#: Placeholder, in content to be sealed, for the digest of the whole content.
BLANK = _MARK + 64 * b"0"


def check_output(path: Path) -> None:
    """Refuse to write to a path that exists and is not a regular file.

    A file is written by renaming, which would replace a device or a link, such as /dev/full.
    """
    if path.is_symlink() or (path.exists() and not path.is_file()):
        raise ValueError(f"{path} exists and is not a regular file; choose another name")
    folder = next(folder for folder in path.absolute().parents if folder.exists())
    if not folder.is_dir():
        raise ValueError(f"{path} cannot be written, because {folder} is not a folder")


@contextlib.contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """Yield a temporary path beside `path`, and rename it to `path` once it is complete.

    A path that exists and is not a regular file is refused.
    """
    check_output(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    partial = path.with_name(f".{path.name}.{uuid4().hex}")
    try:
        yield partial
        partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)


def write_text(path: Path, text: str) -> None:
    """Write a text whole or not at all."""
    with whole_file(path) as partial:
        partial.write_text(text, encoding="utf-8")


def write_sealed(path: Path, content: bytes) -> None:
    """Write content whole or not at all, with its digest in place of `BLANK`.

    The checksums of Parquet cover the pages, but not the footer with their positions.
    """
    with whole_file(path) as partial:
        partial.write_bytes(content.replace(BLANK, _seal(content)))


class UnsealedError(ValueError):
    """A file has no checksum: it is truncated, or another program wrote it."""


def read_sealed(path: Path) -> bytes:
    """Read a file that `write_sealed` has written; a single changed bit is a ValueError."""
    content = path.read_bytes()
    start = content.rfind(_MARK)
    if start < 0:
        raise UnsealedError(
            f"{path} has no checksum; it is truncated, or not a table (Parquet) written by "
            f"springblock; {MENDING}"
        )
    end = start + len(BLANK)
    if _seal(content[:start] + BLANK + content[end:]) != content[start:end]:
        raise ValueError(f"{path} is damaged: its checksum does not match; {MENDING}")
    return content


def _seal(content: bytes) -> bytes:
    return _MARK + hashlib.sha256(content).hexdigest().encode()


#: Largest size of an unpacked file, bytes: a prelude has up to six states of 4096 x 4096 blocks.
_MOST = 2**32
#: Errors, besides ValueError, of reading a file that is damaged or of another type.
_TORN = BadZipFile, EOFError, MemoryError, OSError, RuntimeError, TypeError, zlib.error


def read_arrays(source: Path | BinaryIO) -> dict[str, NDArray[Any]]:
    """Read the arrays of an .npz file by name; pickled objects are never loaded.

    A file that is damaged, of another type, or too large in memory is a ValueError.
    """
    try:
        with ZipFile(source) as packed:
            parts = packed.infolist()
        size, stored = (sum(p.file_size for p in parts), sum(p.compress_size for p in parts))
        if size > max(_MOST, stored):
            raise ValueError(f"it has {size} bytes unpacked; the limit is {_MOST}")
        if not isinstance(source, Path):
            source.seek(0)
        with np.load(source, allow_pickle=False) as arrays:
            found = dict(arrays)
    except _TORN as error:
        raise ValueError(str(error)) from error
    others = [name for name, part in found.items() if not isinstance(part, np.ndarray)]
    if others:
        raise ValueError(f"its part {others[0]} is not an array")
    return found
