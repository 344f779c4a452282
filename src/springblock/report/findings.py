"""Numbers of a study's findings, from its tables; `findings.html` puts them into prose."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from springblock.analysis.lowest import lowest
from springblock.analysis.statistics import Interval, difference_interval, mean_interval, number
from springblock.beyond.question import is_even
from springblock.claims.ranges import PLAIN, SCALED
from springblock.io.records import by_scene
from springblock.io.rows import Row, select
from springblock.model.scene import Scene
from springblock.plotting.style import MICRO

#: Fits of c(r) as the report writes them, and the names of their lengths.
_FITS = {SCALED: ("A exp(-r/l_d)", "l_d"), PLAIN: (PLAIN, "l_c")}

Tables = Mapping[str, Sequence[Row]]  #: rows by name of the table
Runs = Mapping[Scene, Sequence[Row]]  #: rows of the table `realisations`, by scene


def main_runs(rows: Iterable[Row]) -> dict[Scene, list[Row]]:
    """Return realisations with the paper's pattern and the study's constants, on the commonest N.

    Some sizes of pillars need an N up to a tenth larger, which their period divides.
    """
    by_constants = by_scene(rows, Scene.from_row)
    found = {scene: own for scene, own in by_constants.items() if not scene.varied}
    sizes = Counter(scene.n_blocks for scene in found for _ in found[scene])
    common = max(sizes, key=lambda size: sizes[size], default=0)
    return {s: rows for s, rows in found.items() if common <= s.n_blocks <= 1.1 * common}


def findings(tables: Tables) -> dict[str, dict[str, Any]]:
    """Return the numbers of each finding that the study has, by its name and theirs."""
    family = _family(main_runs(tables.get("realisations", [])))
    found = {
        "friction": _friction(tables, family),
        "order": _order(tables, family),
        "correlation": _correlation(tables),
        "peaks": _peaks(tables),
    }
    return {name: numbers for name, numbers in found.items() if numbers}


def _family(runs: Runs) -> dict[int, Sequence[Row]]:
    """Return the runs along x on the flat surface, 0, and on pillars with n_s = n_p, by n_p."""
    plain = [s for s in runs if is_even(s) or (not s.lengths and s.direction == "x")]
    return {scene.n_p: runs[scene] for scene in sorted(plain, key=lambda scene: scene.n_p)}


def _friction(tables: Tables, family: Mapping[int, Sequence[Row]]) -> dict[str, Any]:
    """Return static friction on a flat surface and on pillars of each size."""
    samples = {size: np.array([row["static_friction"] for row in family[size]]) for size in family}
    flat = samples.pop(0, None)
    if flat is None or not samples:
        return {}
    least = lowest(samples)
    size = int(least.place)
    rows = _tested(tables, "Lowest static friction at an intermediate n_p")
    below = [_quoted(row) for row in rows if row["verdict"] == "reproduced"]
    candidates = " or ".join(f"{each:g}" for each in sorted({size, *least.alike}))
    low = f"Static friction is lowest on pillars of {candidates} blocks, with gaps of equal width"
    return {
        "title": low if below else "Static friction and the size of pillars",
        "n_blocks": family[size][0]["n_blocks"],
        "flat": number(mean_interval(flat)),
        "least": number(mean_interval(samples[size])),
        "size": size,
        "sizes": list(samples),
        "alike": [f"{each:g}" for each in least.alike if each != size],
        "change": _change(difference_interval(samples[size], flat)),
        "below": below,
        "rows": [
            (
                f"n_p = {n_p}" if n_p else "flat",
                str(len(rows)),
                number(mean_interval([row["static_friction"] for row in rows])),
                number(_lag(rows), factor=MICRO),
            )
            for n_p, rows in family.items()
        ],
    }


def _order(tables: Tables, family: Mapping[int, Sequence[Row]]) -> dict[str, Any]:
    """Return the order of detachment on pillars, and the surfaces with t_max before t_avg."""
    inward = select(_tested(tables, "Order of detachment on a pillar"), verdict="reproduced")
    alone = _by_size(_tested(tables, "The order of detachment never changes"))
    precursors = _tested(tables, "Precursors are negligible on very large pillars")
    peaks: dict[str, list[int]] = {"before": [], "after": [], "unsettled": []}
    for size, rows in family.items():
        peaks[_sign(_lag(rows), "before", "after", "unsettled")].append(size)
    numbers = {
        "inward": bool(inward),
        "shares": [(size, _quoted(alone[size])) for size in (6, 20, 60) if size in alone],
        "precursors": [_quoted(row) for row in precursors],
        "peaks": peaks if family else {},
    }
    title = "Pillars detach from their edges inward" if inward else "The order of detachment"
    return {"title": title, **numbers} if any(numbers.values()) else {}


def _correlation(tables: Tables) -> dict[str, Any]:
    """Return l_c of first detachment times along the sides of pillars, in blocks."""
    rows = _tested(tables, "Correlation length of about three blocks or more")
    values = [row["value"] for row in rows]
    growth = _tested(tables, "Correlation length grows with n_p")
    if not rows:
        return {}
    span = f"{min(values):.1f} to {max(values):.1f}"
    return {
        "title": "Along the sliding direction, detachment times on large pillars are correlated "
        f"over {span} blocks",
        "fits": [
            (letters, [(size, _quoted(row)) for size, row in _by_size(own).items()])
            for curve, letters in _FITS.items()
            if (own := select(rows, fit=curve))
        ],
        "growth": [
            (length, _sign(_interval(row), "decreases", "increases", ""), _quoted(row))
            for curve, (_, length) in _FITS.items()
            for row in select(growth, fit=curve)
        ],
    }


def _peaks(tables: Tables) -> dict[str, Any]:
    """Return the fall of the force between two load peaks, with hierarchy and without."""
    along = _by_size(_tested(tables, "Two load peaks along grooves"))
    alone = _tested(tables, "Without hierarchy one load peak")
    if not along:
        return {}
    failing = select(alone, outcome="fails")
    # On pillars alone, most of the prominence comes from the fluctuations of single runs.
    others = {
        f"pawls of {row['n_p2']} between grooves of {row['n_s2']} (no pillars)": row
        for row in failing
        if not row["n_p"]
    }
    ordered = sorted(along.items(), key=lambda pair: -pair[1]["value"])
    return {
        "title": "Two load peaks do not need hierarchy" if others else "When the load peaks twice",
        "least": f"{ordered[0][1]['claimed_low']:g}",
        "along": [(size, _quoted(row)) for size, row in ordered],
        "others": [(name, _quoted(row)) for name, row in others.items()],
        "is_open": not alone or alone[0]["verdict"] == "not settled",
    }


def _tested(tables: Tables, claim: str) -> list[Row]:
    """Return the rows of a statement that the study has tested."""
    rows = select(tables.get("claims", []), claim=claim)
    return [row for row in rows if row["verdict"] != "not tested"]


def _by_size(rows: Iterable[Row]) -> dict[int, Row]:
    """Return rows of the table `claims` by n_p2 or else n_p of their case."""
    return {size: row for row in rows if (size := row["n_p2"] or row["n_p"])}


def _interval(row: Row) -> Interval:
    return Interval(row["value"], row["together_low"], row["together_high"])


def _quoted(row: Row) -> str:
    """Write the value of a finding on a statement as the page of statements does."""
    value, low, high = _interval(row)
    return f"{value:.3g} [{low:.3g}, {high:.3g}]"


def _lag(rows: Sequence[Row]) -> Interval:
    return mean_interval([row["t_max"] - row["t_avg"] for row in rows])


def _sign(difference: Interval, negative: str, positive: str, unknown: str) -> str:
    """Return the word for the sign of a difference, `unknown` where its interval includes zero."""
    if difference.high < 0.0:
        return negative
    return positive if difference.low > 0.0 else unknown


def _change(difference: Interval) -> str:
    """Say by how much static friction on pillars is lower or higher than on the flat surface."""
    word = _sign(difference, "lower", "higher", "")
    if not word:
        return f"does not differ significantly ({number(difference)})"
    low, high = sorted(map(abs, (difference.low, difference.high)))
    return f"is {word} by {number(Interval(abs(difference.mean), low, high))}"
