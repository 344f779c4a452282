"""The statements of the paper that the study can test, each with its test.

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525. `statements.toml` has all that
is said of them; the modules have their tests, under the same names.
"""

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from springblock.claims import flat, grooves, load_peaks, pillars, sides, stress
from springblock.claims.rule import Statement

_FILE = Path(__file__).with_name("statements.toml")
_CHAPTERS = stress, flat, pillars, sides, grooves, load_peaks
_TESTS = {name: test for chapter in _CHAPTERS for name, test in vars(chapter).items()}
_TEXTS = ("words", "criterion", "remark", "changed")
_KEYS = dict.fromkeys(("title", "section", "figure", "form", *_TEXTS)).keys()
_FORMS = ("universal", "general", "existential")


def statements(data: Mapping[str, Mapping[str, Any]]) -> list[Statement]:
    """Return the statements of a file in their order, with titles in place of the names of others.

    Raises
    ------
    ValueError
        If a statement has no test, a wrong key or form, or refers to one that does not exist.
    """
    for name, entry in data.items():
        if name not in _TESTS:
            raise _wrong(name, "no module of this folder has a test of this name")
        if wrong := entry.keys() ^ _KEYS:
            raise _wrong(name, f"{min(wrong)} is missing or no key; keys are {', '.join(_KEYS)}")
        if entry["form"] not in _FORMS:
            raise _wrong(name, f"form is {entry['form']!r}; choose from {', '.join(_FORMS)}")
    titles = {name: f"“{entry['title']}”" for name, entry in data.items()}
    return [
        _statement(number, name, entry, titles)
        for number, (name, entry) in enumerate(data.items(), 1)
    ]


def _statement(
    number: int, name: str, entry: Mapping[str, Any], titles: Mapping[str, str]
) -> Statement:
    try:
        texts = {key: " ".join(entry[key].split()).format_map(titles) for key in _TEXTS}
    except KeyError as error:
        raise _wrong(name, f"{{{error.args[0]}}} is no statement of this file") from None
    return Statement(**{**entry, **texts}, number=number, id=name, test=_TESTS[name])


def _wrong(name: str, what: str) -> ValueError:
    return ValueError(f"{_FILE.name}, [{name}]: {what}")


#: In the order of the page.
STATEMENTS = statements(tomllib.loads(_FILE.read_text(encoding="utf-8")))
