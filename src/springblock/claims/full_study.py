"""Verdicts of the full study, which reports of other studies quote.

`python -m springblock.claims.full_study TABLE` renews them from the table `claims` of a full study.
"""

import csv
import sys
from pathlib import Path

from springblock.io.parquet import load
from springblock.io.rows import Row

FILE = Path(__file__).with_suffix(".csv")
_COLUMNS = ("id", "verdict", "holds", "cases")


def verdicts() -> dict[str, Row]:
    """Return the verdict on each statement, its cases that hold and all its cases, by its name."""
    with FILE.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    return {row["id"]: row | {key: int(row[key]) for key in ("holds", "cases")} for row in rows}


def renew(table: Path, file: Path = FILE) -> None:
    """Write the verdicts of a table `claims`."""
    first = {row["id"]: row for row in load(table, _COLUMNS).to_pylist()}
    with file.open("w", encoding="utf-8", newline="") as target:
        writer = csv.DictWriter(target, _COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(first.values())


if __name__ == "__main__":
    renew(Path(sys.argv[1]))
