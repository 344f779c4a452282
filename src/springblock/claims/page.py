"""The page of claims, written from their table."""

import math
from collections.abc import Sequence
from itertools import groupby

from springblock.claims.rule import Row
from springblock.files import markdown_table

_LINE = 100  #: characters

_PAGE = """# What becomes of the paper's statements

Written by `snakemake claims` from the table `claims`, which rests on the tables `realisations`,
`correlation`, `correlation_length` and `work_precision` and on the realisations of flat, pillared
and grooved surfaces. Units are SI, lengths count blocks.

## The rule

Every statement claims a range for some statistic, in one or several cases. A finding *holds*
where the 95 % interval of the statistic lies within that range, *fails* where it lies wholly
outside, and is *open* where it lies across an edge. All findings of a case must hold for the case
to hold; one that fails makes it fail. The statement is

- **reproduced** where all cases hold,
- **not reproduced** where all fail,
- **depends on** what differs between cases where some hold and some fail,
- **not settled** otherwise,
- **not tested** where what it needs was not simulated or measured.

Intervals are bootstrap intervals over realisations unless the statistic says otherwise.
Differences between scenes are paired, the same seed drawing the same coefficients, save those of
correlation lengths, which combine the intervals of both. Other seeds must not change a verdict
called reproduced:

    snakemake --config first_seed=1000 results=results/offset

{summary}

Not tested here: that results are the same for other Young's moduli at the same ratio to the
pressure; how slider velocity, pressure and scatter change the number of fronts; that the time
between the load peaks follows the difference of the length scales.

{sections}
"""


def page(table: Sequence[Row]) -> str:
    """Write the page from the rows of the table `claims`."""
    by_claim = [list(group) for _, group in groupby(table, key=lambda row: row["claim"])]
    summary = [
        [f"{i}. {part[0]['claim']}", _in_short(part[0])] for i, part in enumerate(by_claim, 1)
    ]
    sections = [_section(i, part) for i, part in enumerate(by_claim, 1)]
    return _PAGE.format(
        summary=markdown_table(["statement", "verdict"], summary), sections="\n\n".join(sections)
    )


def _in_short(row: Row) -> str:
    """The verdict, without a list of cases that would not fit a line."""
    whole = _verdict(row)
    return whole if len(whole) <= _LINE else whole.split(":")[0]


def _verdict(row: Row) -> str:
    return f"**{row['verdict']}** {row['depends_on']}".strip()


def _section(number: int, part: Sequence[Row]) -> str:
    first = part[0]
    lines = [
        f"## {number}. {first['claim']}",
        f"{first['statement']} (section {first['section']})",
        f"Verdict: {_verdict(first)}.",
    ]
    if first["verdict"] == "not tested":
        lines[-1] += f" {first['rests_on'].capitalize()}."
    else:
        header = ["case", "statistic", "value [95 % interval]", "claimed", "outcome"]
        lines.append(markdown_table(header, [_cells(row) for row in part]))
        sources = dict.fromkeys(name for row in part for name in row["rests_on"].split("; "))
        lines.append("\n".join(["Rests on", "", *(f"- {source}" for source in sources)]))
    return "\n\n".join(lines)


def _cells(row: Row) -> list[str]:
    value = f"{row['value']:.3g} [{row['ci_low']:.3g}, {row['ci_high']:.3g}]"
    unit = "" if row["unit"] == "1" else f" {row['unit']}"
    return [row["case"], row["statistic"], value + unit, _range(row), row["outcome"]]


def _range(row: Row) -> str:
    low, high = row["claimed_low"], row["claimed_high"]
    if math.isinf(high):
        return f"> {low:.3g}"
    return f"< {high:.3g}" if math.isinf(low) else f"{low:.3g} to {high:.3g}"
