"""The register of statements, written before the run on new seeds that judges them.

`register.csv` is the table `claims` of the first seeds, in its original wording, with the verdicts
on these seeds and, as `verdict_1_0_0`, those under the former rules; `confirmed.csv` has the
verdicts of the registered tests on the new seeds. Statements are matched by name.
"""

import csv
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from springblock.io.rows import Row, markdown_table

_FOLDER = Path(__file__).parent
_KINDS = ("form", "range", "cases")  #: registered properties of a statement


def table_in(name: str) -> list[list[str]]:
    """Return the rows of a file that is a table in Markdown."""
    _, _, *lines = (_FOLDER / name).read_text(encoding="utf-8").splitlines()
    return [line.strip("| ").split(" | ") for line in lines]


def reasons() -> dict[str, str]:
    """Return, by statement, why its test is not the one that was registered."""
    return dict(table_in("reasons.md"))


def registered(name: str) -> list[Row]:
    """Return the rows of a file of the register, all as text."""
    with (_FOLDER / name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def verdicts() -> dict[str, Row]:
    """Return a row of each registered statement, with its earlier verdicts.

    That of the registered test on the new seeds is `confirmed`.
    """
    fresh = {row["claim"]: row["verdict"] for row in registered("confirmed.csv")}
    rows = {row["claim"]: row for row in registered("register.csv")}
    return {name: row | {"confirmed": fresh.get(name, "")} for name, row in rows.items()}


def moved(table: Sequence[Row]) -> tuple[int, int]:
    """Count the verdicts that are nearer to the paper than those of the registered tests, and those
    that are farther from it.
    """
    order = ("not reproduced", "not settled", "reproduced in part", "reproduced")
    before, now = verdicts(), {row["claim"]: row["verdict"] for row in table}
    both = [(before[name]["confirmed"], now[name]) for name in now if name in before]
    steps = [order.index(b) - order.index(a) for a, b in both if {a, b} <= {*order}]
    return sum(step > 0 for step in steps), sum(step < 0 for step in steps)


def changes(table: Sequence[Row]) -> str:
    """List in a Markdown table which tests differ from those registered, and why.

    Forms, ranges and cases are compared. Only new ones count, since absent ones may not have been
    simulated. A test that differs only in its definition is listed if it has a reason; rewordings
    are not listed.
    """
    before, why = registered("register.csv"), reasons()
    known = {row["claim"] for row in before}
    new = {(name, kind) for name, kind, _ in _properties(table) - _properties(before)}
    lines = []
    for name in dict.fromkeys(row["claim"] for row in table if row["verdict"] != "not tested"):
        changed = [kind for kind in _KINDS if (name, kind) in new] if name in known else ["new"]
        if changed or name in why:
            reason = why.get(name, "no reason is given")
            lines.append([name, ", ".join(changed) or "test", reason])
    header = ["statement", "changed", "why"]
    return markdown_table(header, lines) if lines else "Nothing has been changed since."


def _properties(table: Sequence[Row]) -> set[tuple[str, str, Any]]:
    """Return statements with the kind and the value of each registered property."""
    return {
        (row["claim"], kind, value)
        for row in table
        for kind, value in (
            ("form", row["form"]),
            ("range", (float(row["claimed_low"]), float(row["claimed_high"]))),
            ("cases", row["case"]),
        )
    }
