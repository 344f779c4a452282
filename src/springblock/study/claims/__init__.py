"""The statements of the paper that the study tests.

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525. `statements.toml` has all that
is said of them; the modules of this folder register their tests under the same names.
"""

import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from springblock.study.claims import flat, grooves, pillars, sides  # noqa: F401 - registers their tests
from springblock.study.claims.rule import TESTS, Statement


def statements(data: Mapping[str, Mapping[str, Any]]) -> list[Statement]:
    """Return the statements of a file in its order, with titles in place of the names of others."""
    titles = {name: f"“{entry['title']}”" for name, entry in data.items()}
    found = []
    for name, entry in data.items():
        texts = {key: " ".join(str(text).split()).format_map(titles) for key, text in entry.items()}
        found.append(Statement(id=name, test=TESTS[name], **texts))
    return found


#: In the order of the page.
STATEMENTS = statements(
    tomllib.loads(Path(__file__).with_name("statements.toml").read_text(encoding="utf-8"))
)
