"""Files that are written whole or not at all."""

import contextlib
from collections.abc import Iterator
from pathlib import Path
from uuid import uuid4

#: Advice for a file of a study that cannot be used.
MENDING = "delete it, and `snakemake` makes it again"


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
