"""The register of statements, written down before the run on fresh seeds that judges them.

`register.csv` is the table `claims` of earlier seeds, with the verdicts that these gave and, beside
them, those of version 1.0.0, whose rule was another.
"""

import csv
from collections.abc import Sequence
from pathlib import Path

from springblock.io.rows import Row, markdown_table

_FILE = Path(__file__).with_name("register.csv")
#: What is registered of a statement, beside its ranges.
_REGISTERED = ("form", "statement")
#: Why a statement, its test or its range is not the one that was registered.
_REASONS: dict[str, str] = {}


def registered() -> list[Row]:
    """Return the rows of the register, all as text."""
    with _FILE.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def verdicts() -> dict[str, Row]:
    """Return a row of each registered statement, with its earlier verdicts."""
    return {row["claim"]: row for row in registered()}


def changes(table: Sequence[Row]) -> str:
    """Say in a Markdown table what differs between the register and what was tested."""
    before, now = _statements(registered()), _statements(table)
    changed = [name for name in before | now if before.get(name) != now.get(name)]
    if not changed:
        return "Nothing has been changed since."
    lines = [[name, _difference(before.get(name), now.get(name))] for name in changed]
    return markdown_table(
        ["statement", "changed", "why"],
        [[*line, _REASONS.get(line[0], "no reason is given")] for line in lines],
    )


def _statements(table: Sequence[Row]) -> dict[str, dict[str, object]]:
    """What is registered of each statement that was tested: words, form and ranges."""
    found: dict[str, dict[str, object]] = {}
    for row in table:
        if row["verdict"] == "not tested":
            continue
        said = found.setdefault(row["claim"], {name: row[name] for name in _REGISTERED})
        ranges = said.setdefault("range", set())
        assert isinstance(ranges, set)
        ranges.add((float(row["claimed_low"]), float(row["claimed_high"])))
    return found


def _difference(before: dict[str, object] | None, now: dict[str, object] | None) -> str:
    if before is None or now is None:
        return "not tested here" if before else "new"
    return ", ".join(name for name in before if before[name] != now.get(name))
