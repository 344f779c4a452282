"""The register of statements, written down before the run on fresh seeds that judges them.

`register.csv` is the table `claims` of earlier seeds, with the verdicts that these gave and, beside
them, those of version 1.0.0, whose rule was another.
"""

import csv
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from springblock.io.rows import Row, markdown_table

_FOLDER = Path(__file__).parent
#: What is registered of a statement, beside its ranges and cases.
_REGISTERED, _SETS = ("form", "statement"), ("range", "cases")


def reasons() -> dict[str, str]:
    """Return why a statement, its test or its range is not the one that was registered."""
    _, _, *lines = (_FOLDER / "reasons.md").read_text(encoding="utf-8").splitlines()
    return dict(line.strip("| ").split(" | ") for line in lines)


def registered() -> list[Row]:
    """Return the rows of the register, all as text."""
    with (_FOLDER / "register.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def verdicts() -> dict[str, Row]:
    """Return a row of each registered statement, with its earlier verdicts."""
    return {row["claim"]: row for row in registered()}


def changes(table: Sequence[Row]) -> str:
    """Say in a Markdown table what differs between the register and what was tested."""
    before, now = _statements(registered()), _statements(table)
    changed = {name: _difference(before.get(name), now[name]) for name in now}
    why = reasons()
    lines = [
        [name, difference, why.get(name, "no reason is given")]
        for name, difference in changed.items()
        if difference
    ]
    header = ["statement", "changed", "why"]
    return markdown_table(header, lines) if lines else "Nothing has been changed since."


def _statements(table: Sequence[Row]) -> dict[str, dict[str, Any]]:
    """What is registered of each statement that was tested: words, form, ranges and cases."""
    found: dict[str, dict[str, Any]] = {}
    for row in table:
        if row["verdict"] == "not tested":
            continue
        new = {name: row[name] for name in _REGISTERED} | {name: set() for name in _SETS}
        said = found.setdefault(row["claim"], new)
        said["range"].add((float(row["claimed_low"]), float(row["claimed_high"])))
        said["cases"].add(row["case"])
    return found


def _difference(before: dict[str, Any] | None, now: dict[str, Any]) -> str:
    """Name what differs; of ranges and cases what is new, since not all need to be simulated."""
    if before is None:
        return "new"
    names = [name for name in _REGISTERED if before[name] != now[name]]
    return ", ".join(names + [name for name in _SETS if now[name] - before[name]])
