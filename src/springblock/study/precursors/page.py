"""Values of the page on slip precursors."""

import math
from collections.abc import Sequence
from typing import Any

from springblock.analysis.statistics import Interval
from springblock.io.rows import Row, select

#: Registered bounds, from which on the interval decides: of l_c, relative, and of c(r) of fronts.
ACCEPTED, CLOSE = 0.1, 0.03


def values(table: Sequence[Row]) -> dict[str, Any]:
    """Return what the template names, from the rows of the table `precursors`."""
    ends = ("simulated", "simulated_low", "simulated_high")
    rows = [
        row
        | {"found": Interval(*(row[end] for end in ends))}
        | {"apart": abs(row["simulated"] - row["predicted"])}
        for row in table
    ]
    lengths = [
        row | {"mark": "" if _agrees(row, ACCEPTED * row["predicted"]) else "†"}
        for row in select(rows, quantity="l_c")
        if not math.isnan(row["apart"])
    ]
    fronts = [row for row in rows if row["quantity"].endswith("_um")]
    fine = [row for row in fronts if row["spacing"] < 3e-6]
    return {
        "paper": {
            edge: {row["quantity"]: row for row in select(rows, edge=edge, what="paper")}
            for edge in ("along", "across")
        },
        "lengths": lengths,
        "by_what": {
            what: {row["edge"]: row for row in select(lengths, what=what)}
            for what in dict.fromkeys(row["what"] for row in lengths)
        },
        "agreeing": len(select(lengths, mark="")),
        "fine": len(fine),
        "within": sum(_agrees(row, CLOSE) for row in fine),
        "arm": sum(row["simulated_high"] - row["simulated_low"] for row in fine) / len(fine) / 2.0,
        "furthest": max(fine, key=lambda row: row["apart"]),
        "coarse": max(row["apart"] for row in fronts if row not in fine),
        "reaches": select(rows, quantity="reach"),
        "scatters": select(rows, quantity="scatter"),
    }


def _agrees(row: Row, close: float) -> bool:
    """Whether the prediction lies in the interval, or is `close` to the simulation."""
    is_within = row["simulated_low"] <= row["predicted"] <= row["simulated_high"]
    return is_within or row["apart"] <= close
