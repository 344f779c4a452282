"""What pages show of the statements, from the rows of the table `claims`."""

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields
from itertools import groupby
from operator import itemgetter
from typing import Any

from springblock.analysis.statistics import Interval, number
from springblock.io.rows import Row
from springblock.study.claims import STATEMENTS
from springblock.study.claims.rule import Case, Statement

_SHOWN = {"1": ("", 1.0), "s": (" µs", 1e6)}  #: units that pages show otherwise


@dataclass(frozen=True)
class Judged:
    """A statement with its rows of the table `claims`, and what pages show of each.

    Added to each row are `case`, its columns that are not null, and `shown` and `claimed`, the
    value with its interval and the claimed range, as texts.
    """

    statement: Statement
    rows: Sequence[Row]
    verdict: str
    holds: int  #: cases
    cases: int

    @property
    def deciding(self) -> Row | None:
        """The finding that decided the verdict, None without any.

        That is the one with the smallest margin, the clearest failure, or the first open one.
        """
        outcomes = {"reproduced": "holds", "not settled": "open", "not tested": ""}
        outcome = outcomes.get(self.verdict, "fails")
        rows = [row for row in self.rows if row["outcome"] == outcome]
        if outcome == "open":
            return rows[0]
        return (max if outcome == "fails" else min)(rows, key=_clearness, default=None)

    @property
    def table(self) -> tuple[list[str], list[tuple[str, ...]]]:
        """Header and lines of the table of findings, without columns that are empty."""
        shown = {"statistic": "statistic", "value": "shown", "claimed": "claimed"}
        columns = {f.name: [row["case"].get(f.name, "") for row in self.rows] for f in fields(Case)}
        columns |= {name: [row[key] for row in self.rows] for name, key in shown.items()}
        columns["outcome"] = [row["outcome"] for row in self.rows]
        filled = {name: cells for name, cells in columns.items() if any(cells)}
        return list(filled), list(zip(*filled.values(), strict=True))


def judged(table: Iterable[Row]) -> list[Judged]:
    """Return the statements of the table `claims` with their rows, in the order of the table."""
    known, found = {each.id: each for each in STATEMENTS}, []
    for name, group in groupby(table, key=itemgetter("id")):
        rows = [_with_texts(row) for row in group]
        same = (rows[0][key] for key in ("verdict", "holds", "cases"))
        found.append(Judged(known[name], rows, *same))
    return found


def values(table: Iterable[Row]) -> dict[str, Any]:
    """Return the values of the page `claims.md`: the statements, and their verdicts counted."""
    parts = judged(table)
    counts: dict[str, Counter[str]] = {"registered": Counter(), "changed": Counter()}
    for part in parts:
        counts["changed" if part.statement.changed else "registered"][part.verdict] += 1
    return {"parts": parts, "counts": counts | {"all": counts["registered"] + counts["changed"]}}


def _with_texts(row: Row) -> Row:
    unit, factor = _SHOWN.get(row["unit"], (f" {row['unit']}", 1.0))
    interval = Interval(row["value"], row["together_low"], row["together_high"])
    known = {f.name: row[f.name] for f in fields(Case) if row[f.name] is not None}
    case = {key: value if isinstance(value, str) else f"{value:g}" for key, value in known.items()}
    return row | {"shown": number(interval, unit, factor), "claimed": _range(row), "case": case}


def _range(row: Row) -> str:
    low, high = row["claimed_low"], row["claimed_high"]
    if math.isinf(high):
        return f"> {low:.3g}"
    return f"< {high:.3g}" if math.isinf(low) else f"{low:.3g} to {high:.3g}"


def _clearness(row: Row) -> tuple[float, float]:
    """Return the margin to the nearest limit over the arm of the interval, and the margin itself.

    Exact values have no arm, and the margin alone orders them.
    """
    value, low, high = row["value"], row["together_low"], row["together_high"]
    ways = []
    for limit in filter(math.isfinite, (row["claimed_low"], row["claimed_high"])):
        arm, margin = value - low if limit < value else high - value, abs(value - limit)
        ways.append((margin / arm if arm > 0.0 else math.inf, margin))
    return min(ways)
