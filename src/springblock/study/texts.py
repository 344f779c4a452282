"""Check of the characters and the length of all texts in a configuration.

These texts also reach shells, Snakemake, which reads braces in paths as wildcards, and the
submission of cluster jobs, which puts the values of `--config` in double quotes.
"""

import re
import reprlib
from collections.abc import Mapping
from typing import Any

#: Letters and digits of any script and a few other characters; no leading "-", no spaces at ends.
_TEXT = re.compile(r"(?![- ])[\w ./+,@()-]*(?<! )")
_WHOLE, _PART = 1000, 200  #: largest number of bytes of a text, and between two slashes
_LARGEST = 2**63  #: upper bound of whole numbers in columns of tables


def check_texts(value: Any, key: str = "") -> None:
    """Refuse texts and keys that a column cannot hold, and whole numbers too large for it."""
    if isinstance(value, Mapping):
        for name, inner in value.items():
            _check_text(name, f"{key or 'the configuration'} has the key")
            check_texts(inner, f"{key}.{name}" if key else name)
    elif isinstance(value, list):
        for i, inner in enumerate(value):
            check_texts(inner, f"{key}.{i}")
    elif isinstance(value, str):
        _check_text(value, f"{key} is")
    elif isinstance(value, int) and abs(value) >= _LARGEST:
        raise ValueError(f"{key} is {reprlib.repr(value)}; a whole number must be below 2**63")


def _check_text(text: Any, holds: str) -> None:
    shown = f"{holds} {reprlib.repr(text)}"
    if not isinstance(text, str):
        raise ValueError(f"{shown}, which must be a text")
    if not _TEXT.fullmatch(text):
        raise ValueError(
            f"{shown}; a text may hold only letters, digits, . _ / + , @ ( ) - and spaces between "
            "them, and must not begin with -"
        )
    if len(text.encode()) > _WHOLE or max(len(part.encode()) for part in text.split("/")) > _PART:
        raise ValueError(
            f"{shown} of {len(text)} characters; a text may have {_WHOLE} bytes, "
            f"and {_PART} between two slashes"
        )
