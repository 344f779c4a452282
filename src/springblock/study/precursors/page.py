"""Values of the page on slip precursors."""

import math
from collections.abc import Sequence
from typing import Any

from springblock.analysis.statistics import Interval
from springblock.io.rows import Row, select

#: Registered bounds, from which on the interval decides: of l_c, relative, and of c(r) of fronts.
ACCEPTED, CLOSE = 0.1, 0.03


def values(rows: Sequence[Row]) -> dict[str, Any]:
    """Return what the template names, from the rows of the table `precursors`."""
    lengths = [
        row | {"found": _interval(row), "mark": "" if _agrees(row) else "†"}
        for row in select(rows, quantity="l_c")
        if not math.isnan(row["simulated"] + row["predicted"])
    ]
    fronts = [row for row in rows if row["quantity"].endswith("_um")]
    fine = [row for row in fronts if row["spacing"] < 3e-6]
    return {
        "paper": {edge: _of_paper(rows, edge) for edge in ("along", "across")},
        "lengths": lengths,
        "by_what": {
            what: {row["edge"]: row for row in lengths if row["what"] == what}
            for what in dict.fromkeys(row["what"] for row in lengths)
        },
        "agreeing": sum(map(_agrees, lengths)),
        "fine": len(fine),
        "within": sum(_difference(row) <= CLOSE or _is_within(row) for row in fine),
        "arm": sum(row["simulated_high"] - row["simulated_low"] for row in fine) / len(fine) / 2.0,
        "furthest": max(fine, key=_difference),
        "difference": max(map(_difference, fine)),
        "coarse": max(map(_difference, (row for row in fronts if row not in fine))),
        "reaches": [row | {"found": _interval(row)} for row in select(rows, quantity="reach")],
        "scatters": [row | {"found": _interval(row)} for row in select(rows, quantity="scatter")],
    }


def _of_paper(rows: Sequence[Row], edge: str) -> dict[str, Row]:
    """Return the rows of an edge with the paper's constants by quantity."""
    found = select(rows, edge=edge, what="paper")
    return {row["quantity"]: row | {"found": _interval(row)} for row in found}


def _interval(row: Row) -> Interval:
    return Interval(row["simulated"], row["simulated_low"], row["simulated_high"])


def _agrees(row: Row) -> bool:
    """Whether the prediction lies in the interval, or within 10 % of the simulation."""
    return _is_within(row) or _difference(row) <= ACCEPTED * row["predicted"]


def _is_within(row: Row) -> bool:
    return bool(row["simulated_low"] <= row["predicted"] <= row["simulated_high"])


def _difference(row: Row) -> float:
    return float(abs(row["simulated"] - row["predicted"]))
