"""Rows of means of ensembles and of their changes, and these rows as text."""

from collections.abc import Sequence
from typing import Any

from springblock.analysis.ensembles import Change, Ensemble, from_first, mean
from springblock.analysis.statistics import Interval, number
from springblock.io.rows import Row
from springblock.model.scene import FIELDS, LENGTHS, differing

#: Units of lengths and constants, by name.
UNITS = {
    name: unit
    for name, each in FIELDS.items()
    if (unit := each.metadata["unit"]) not in ("1", "name")
}

#: Lengths and times that are zero where there is none.
_NONE_AT_ZERO = {*LENGTHS, "duration", "snapshot_times"}


def means(members: Sequence[Ensemble], of: Sequence[str], by: Sequence[str] = ()) -> list[Row]:
    """Return a row for each ensemble: what tells it apart, its number of runs and its means."""
    names = by or differing(each.names for each in members)
    shares = [float(f"{each.values('contact_fraction').mean():.4g}") for each in members]
    shown = len(set(shares)) > 1
    return [
        {name: each.names.get(name) for name in names}
        | ({"contact_fraction": share} if shown else {})
        | {"runs": len(each.rows)}
        | {name: mean(each, name) for name in of}
        for each, share in zip(members, shares, strict=True)
    ]


def differences(changed: Sequence[Change], of: Sequence[str]) -> list[Row]:
    """Return a row for each change: its ensemble, its numbers of runs and mean differences."""
    names = differing(each.names for each in changed)
    return [
        {name: each.names.get(name) for name in names}
        | {
            "runs": f"{len(each.first.rows)}, {len(each.second.rows)}",
            "difference": "by seed" if each.paired else "of means",
        }
        | {name: each.of(name) for name in of}
        for each in changed
    ]


def changes_from_first(members: Sequence[Ensemble], of: Sequence[str]) -> list[Row]:
    """Return a row for each change from the first value of a parameter to another one."""
    found = list(from_first(members))
    rows = differences([change for *_, change in found], of)
    return [
        {"from": f"{name} = {first} {UNITS.get(name, '')}".rstrip(), "to": str(other)} | row
        for (name, first, other, _), row in zip(found, rows, strict=True)
    ]


def in_words(rows: Sequence[Row]) -> tuple[list[str], list[list[str]]]:
    """Return the headings of rows, with units, and their cells; times are in µs.

    Columns without any value are left out.
    """
    columns = {
        _heading(name, value): [_cell(name, row[name]) for row in rows]
        for name, value in rows[0].items()
    }
    filled = {head: cells for head, cells in columns.items() if any(cells)}
    return list(filled), [list(row) for row in zip(*filled.values(), strict=True)]


def _heading(name: str, value: Any) -> str:
    unit = "µs" if _is_time(name, value) else UNITS.get(name)
    return f"{name} ({unit})" if unit else name


def _cell(name: str, value: Any) -> str:
    if isinstance(value, Interval):
        return number(value, factor=1e6 if _is_time(name, value) else 1.0)
    if name == "direction" and value not in ("x", "y", None):
        return f"{value}°"
    none = value is None or (name in _NONE_AT_ZERO and not value)
    return "" if none else str(value)


def _is_time(name: str, value: Any) -> bool:
    return isinstance(value, Interval) and name.startswith("t_")
