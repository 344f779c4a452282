"""Rows of tables as dictionaries: selection, and layout for a page."""

from collections.abc import Iterable, Sequence
from typing import Any

from springblock.model.scene import CONSTANTS, FIELDS, Scene

Row = dict[str, Any]


def scene_of(row: Row) -> Scene:
    """Return the scene of a row of a table, in which fields from files are only names."""
    return Scene(**{name: row[name] for name in FIELDS})


def alike(rows: Iterable[Row]) -> list[Row]:
    """Return the rows with the constants of the first, which are those of the study."""
    every = list(rows)
    return [row for row in every if all(row[name] == every[0][name] for name in CONSTANTS)]


def select(rows: Iterable[Row], **wanted: Any) -> list[Row]:
    """Return the rows that have these values."""
    return [row for row in rows if all(row[key] == value for key, value in wanted.items())]


def limits(name: str, interval: Iterable[Any], ends: str = "") -> Row:
    """Return the columns of a value and of the limits of its interval, which `ends` may name."""
    names = name, f"{ends or name}_low", f"{ends or name}_high"
    return dict(zip(names, map(float, interval), strict=True))


def markdown_table(header: Sequence[str], lines: Iterable[Sequence[str]]) -> str:
    """Return a table in Markdown."""
    cells = [header, ["---"] * len(header), *lines]
    return "\n".join("| " + " | ".join(line) + " |" for line in cells)


def anchor(heading: str) -> str:
    """Return the anchor that Markdown gives to a heading."""
    kept = "".join(c for c in heading.lower() if c.isalnum() or c in " -_")
    return kept.replace(" ", "-")


def listed(names: Sequence[str]) -> str:
    """Join names as a sentence does."""
    return " and ".join(filter(None, [", ".join(names[:-1]), *names[-1:]]))
