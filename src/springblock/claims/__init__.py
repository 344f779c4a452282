"""The statements of the paper that the study tests.

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525. `statements.toml` has all that
is said of them; the modules of this folder register their tests under the same names.
"""

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from springblock.claims import flat, grooves, load_peaks, pillars, sides  # noqa: F401 - registers
from springblock.claims.rule import TESTS, Statement

_FILE = Path(__file__).with_name("statements.toml")
_TEXTS = ("words", "criterion", "remark", "changed")
_KEYS = {"title", "section", "figure", "form", *_TEXTS}
_FORMS = ("universal", "general", "existential")


def statements(data: Mapping[str, Mapping[str, Any]]) -> list[Statement]:
    """Return the statements of a file in its order, with titles in place of the names of others.

    Raises
    ------
    ValueError
        If a statement has no test, a wrong key or form, or refers to one that does not exist.
    """
    titles = {name: f"“{entry.get('title')}”" for name, entry in data.items()}
    return [_statement(name, entry, titles) for name, entry in data.items()]


def _statement(name: str, entry: Mapping[str, Any], titles: Mapping[str, str]) -> Statement:
    place = f"{_FILE.name}, [{name}]"
    if name not in TESTS:
        raise ValueError(f"{place}: no function registered by `tests_statement` has this name")
    if wrong := entry.keys() ^ _KEYS:
        raise ValueError(f"{place}: {min(wrong)} is missing or no key; keys are {sorted(_KEYS)}")
    if entry["form"] not in _FORMS:
        raise ValueError(f"{place}: form is {entry['form']!r}; choose from {', '.join(_FORMS)}")
    try:
        texts = {key: " ".join(entry[key].split()).format_map(titles) for key in _TEXTS}
    except KeyError as error:
        raise ValueError(f"{place}: {{{error.args[0]}}} is no statement of this file") from None
    return Statement(**{**entry, **texts}, id=name, test=TESTS[name])


#: In the order of the page.
STATEMENTS = statements(tomllib.loads(_FILE.read_text(encoding="utf-8")))
