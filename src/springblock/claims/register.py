"""The register of statements, written before the run on fresh seeds that judges them.

`register.csv` is the table `claims` of earlier seeds, in the words of its day, with the verdicts on
these seeds and those of version 1.0.0, which had another rule; `confirmed.csv` has the verdicts of
the registered tests on the fresh seeds. Statements are matched by name.
"""

import csv
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from springblock.io.rows import Row, markdown_table

_FOLDER = Path(__file__).parent
_SETS = ("form", "range", "cases")  #: registered properties of a statement


def reasons() -> dict[str, str]:
    """Return, by statement, why its test is not the one that was registered."""
    _, _, *lines = (_FOLDER / "reasons.md").read_text(encoding="utf-8").splitlines()
    return dict(line.strip("| ").split(" | ") for line in lines)


def registered() -> list[Row]:
    """Return the rows of the register, all as text."""
    return _rows("register.csv")


def verdicts() -> dict[str, Row]:
    """Return a row of each registered statement, with its earlier verdicts.

    That of the registered test on the fresh seeds is `confirmed`.
    """
    fresh = {row["claim"]: row["verdict"] for row in _rows("confirmed.csv")}
    return {row["claim"]: row | {"confirmed": fresh.get(row["claim"], "")} for row in registered()}


def _rows(name: str) -> list[Row]:
    with (_FOLDER / name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def changes(table: Sequence[Row]) -> str:
    """List in a Markdown table which tests differ from those registered, and why.

    Forms, ranges and cases are compared. A test that differs in its definition alone is listed by
    its reason; new words for the same test are not.
    """
    before, now, why = _statements(registered()), _statements(table), reasons()
    lines = []
    for name, tested in now.items():
        difference = _difference(before.get(name), tested)
        if difference or name in why:
            lines.append([name, difference or "test", why.get(name, "no reason is given")])
    header = ["statement", "changed", "why"]
    return markdown_table(header, lines) if lines else "Nothing has been changed since."


def _statements(table: Sequence[Row]) -> dict[str, dict[str, set[Any]]]:
    """Return the form, ranges and cases of each statement that was tested."""
    found: dict[str, dict[str, set[Any]]] = {}
    for row in table:
        if row["verdict"] == "not tested":
            continue
        said = found.setdefault(row["claim"], {name: set() for name in _SETS})
        said["form"].add(row["form"])
        said["range"].add((float(row["claimed_low"]), float(row["claimed_high"])))
        said["cases"].add(row["case"])
    return found


def _difference(before: dict[str, set[Any]] | None, now: dict[str, set[Any]]) -> str:
    """Name what is new; what is absent may not have been simulated."""
    if before is None:
        return "new"
    return ", ".join(name for name in _SETS if now[name] - before[name])
