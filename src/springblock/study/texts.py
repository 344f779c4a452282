"""What the texts of a configuration may hold, whatever key they belong to.

Others read them, too: shells, Snakemake, in whose paths braces are wildcards, and what submits its
jobs to a cluster, which puts what `--config` holds in double quotes. They take many a character for
their own.
"""

import re
import reprlib
from collections.abc import Mapping
from typing import Any

#: Letters and digits of any script, and a few more; neither an option nor lost at the ends.
_TEXT = re.compile(r"(?![- ])[\w ./+,@()-]*(?<! )")
_WHOLE, _PART = 1000, 200  #: bytes of a text, and of what is between two of its slashes
_LARGEST = 2**63  #: which whole numbers stay below, as columns of tables do


def check_texts(value: Any, key: str = "") -> None:
    """Refuse texts and names of keys that others could take for something else.

    And whole numbers that no column could hold.

    Raises
    ------
    ValueError
        With one sentence that names the key, what it holds and what it may hold.
    """
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
            f"{shown}; a text may hold letters, digits, spaces within and . _ / + , @ ( ) - alone, "
            "and may not begin with -"
        )
    if len(text.encode()) > _WHOLE or max(len(part.encode()) for part in text.split("/")) > _PART:
        raise ValueError(
            f"{shown} of {len(text)} characters; a text may have {_WHOLE} bytes, "
            f"and {_PART} between two slashes"
        )
