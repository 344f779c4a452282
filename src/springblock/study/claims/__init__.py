"""The statements of the paper that the study tests.

Costagliola, Bosia & Pugno 2022, doi:10.1016/j.ijsolstr.2022.111525. `statements.toml` has all that
is said of them; the modules of this folder register their tests under the same names.
"""

import tomllib
from pathlib import Path

from springblock.study.claims import flat, grooves, pillars, sides  # noqa: F401 - registers their tests
from springblock.study.claims.rule import TESTS, Statement

_ENTRIES = tomllib.loads(Path(__file__).with_name("statements.toml").read_text(encoding="utf-8"))
#: By the names with which the texts of other statements refer to them.
_TITLES = {name: f"“{entry['title']}”" for name, entry in _ENTRIES.items()}
#: In the order of the page.
STATEMENTS = [
    Statement(
        id=name,
        test=TESTS[name],
        **{key: " ".join(str(text).split()).format_map(_TITLES) for key, text in entry.items()},
    )
    for name, entry in _ENTRIES.items()
]
