"""What pages show of the statements, from the rows of the table `claims`."""

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields
from itertools import groupby
from operator import itemgetter
from typing import Any

from springblock.analysis.statistics import Interval, number
from springblock.claims import STATEMENTS
from springblock.claims.rule import Case, Statement
from springblock.io.rows import Row

_VERDICTS = ("reproduced", "reproduced in part", "not reproduced", "not settled", "not tested")
_CASE = [field.name for field in fields(Case)]
_SHOWN = {"1": ("", 1.0), "s": (" µs", 1e6)}  #: units that pages show otherwise


@dataclass(frozen=True)
class Judged:
    """A statement with its rows of the table `claims`, and what pages show of each.

    Added to each row are `case`, its columns that are not null, and `shown` and `claimed`, the
    value with its interval and the claimed range, as texts.
    """

    statement: Statement
    rows: Sequence[Row]

    @property
    def verdict(self) -> str:
        """Verdict on the statement."""
        return str(self.rows[0]["verdict"])

    @property
    def holds(self) -> int:
        """Number of cases that hold."""
        return int(self.rows[0]["holds"])

    @property
    def cases(self) -> int:
        """Number of all cases."""
        return int(self.rows[0]["cases"])

    @property
    def statistic(self) -> str:
        """Statistic of all its findings; "" if they differ."""
        first, *others = {row["statistic"] for row in self.rows}
        return "" if others else str(first)

    @property
    def deciding(self) -> Row | None:
        """The finding that decided the verdict, None without any.

        That is the one with the smallest margin, the clearest failure, or the first open one.
        """
        if self.verdict == "not tested":
            return None
        kind, choose, key = {
            "reproduced": ("holds", min, _clearness),
            "reproduced in part": ("fails", max, _clearness),
            "not reproduced": ("fails", max, _clearness),
            "not settled": ("open", min, lambda _: (0.0, 0.0)),  # the first
        }[self.verdict]
        return choose((row for row in self.rows if row["outcome"] == kind), key=key)

    @property
    def table(self) -> tuple[list[str], list[tuple[str, ...]]]:
        """Header and lines of the table of findings, without columns that are empty."""
        columns = {name: [row["case"].get(name, "") for row in self.rows] for name in _CASE}
        if not self.statistic:
            columns["statistic"] = [row["statistic"] for row in self.rows]
        columns["value"] = [row["shown"] for row in self.rows]
        columns |= {name: [row[name] for row in self.rows] for name in ("claimed", "outcome")}
        filled = {name: cells for name, cells in columns.items() if any(cells)}
        return list(filled), list(zip(*filled.values(), strict=True))


def judged(table: Iterable[Row]) -> list[Judged]:
    """Return the statements of the table `claims` with their rows, in the order of the table."""
    known = {each.id: each for each in STATEMENTS}
    parts = groupby(table, key=itemgetter("id"))
    return [Judged(known[name], [_with_texts(row) for row in rows]) for name, rows in parts]


def counted(parts: Iterable[Judged]) -> dict[str, int]:
    """Count the verdicts that occur, from reproduced to not tested."""
    found = Counter(part.verdict for part in parts)
    return {verdict: found[verdict] for verdict in _VERDICTS if found[verdict]}


def values(table: Iterable[Row]) -> dict[str, Any]:
    """Return the values of the page `claims.md`."""
    parts = judged(table)
    by_mark = {
        "registered": [part for part in parts if not part.statement.changed],
        "changed": [part for part in parts if part.statement.changed],
        "all": parts,
    }
    counts = {mark: counted(some) for mark, some in by_mark.items()}
    return {
        "parts": parts,
        "counts": counts,
        "title": {each.id: f"“{each.title}”" for each in STATEMENTS},
    }


def _with_texts(row: Row) -> Row:
    unit, factor = _SHOWN.get(row["unit"], (f" {row['unit']}", 1.0))
    interval = Interval(row["value"], row["together_low"], row["together_high"])
    texts = {"shown": number(interval, unit, factor), "claimed": _range(row)}
    return row | texts | {"case": {key: _text(row[key]) for key in _CASE if row[key] is not None}}


def _text(value: str | float) -> str:
    return value if isinstance(value, str) else f"{value:g}"


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
    for limit in (row["claimed_low"], row["claimed_high"]):
        if math.isfinite(limit):
            arm = value - low if limit < value else high - value
            margin = abs(value - limit)
            ways.append((margin / arm if arm > 0.0 else math.inf, margin))
    return min(ways)
