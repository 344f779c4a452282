"""What becomes of the paper's statements: a rule from intervals to verdicts, a table and a page.

`springblock.statements` holds the statements and measures what they are about.
"""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import Any

import pyarrow as pa

from springblock.files import markdown_table
from springblock.scene import Scene
from springblock.statistics import Interval
from springblock.tables import Record, column

Row = dict[str, Any]
Case = Mapping[str, str | int | float]

#: One row per finding.
CLAIMS = pa.schema(
    [
        column("claim", pa.string(), "1", "short name of the statement"),
        column("section", pa.string(), "1", "where the paper makes it"),
        column("statement", pa.string(), "1", "what the paper says, in short"),
        column("case", pa.string(), "1", "the surface, part or quantity looked at"),
        column("statistic", pa.string(), "1", "what the value is"),
        column("unit", pa.string(), "1", "unit of the five numbers that follow"),
        column("value", pa.float64(), "see unit", "the statistic; NaN if not tested"),
        column("ci_low", pa.float64(), "see unit", "lower end of its 95 % interval"),
        column("ci_high", pa.float64(), "see unit", "upper end"),
        column("claimed_low", pa.float64(), "see unit", "the statement claims more than this"),
        column("claimed_high", pa.float64(), "see unit", "and less than this"),
        column("outcome", pa.string(), "1", "of this row: holds, fails or open"),
        column("verdict", pa.string(), "1", "on the statement, from all its rows"),
        column("depends_on", pa.string(), "1", "what tells cases that hold from those that fail"),
        column("rests_on", pa.string(), "1", "files, scenes and rows behind the value, by ';'"),
    ]
)


@dataclass(frozen=True, eq=False)
class Evidence:
    """What statements are tested on. What was not simulated or measured is absent."""

    #: rows of the table `realisations` by scene and seed
    summaries: Mapping[Scene, Mapping[int, Row]] = field(default_factory=dict)
    #: whole realisations by scene
    records: Mapping[Scene, Sequence[Record]] = field(default_factory=dict)
    correlation: Sequence[Row] = ()  #: rows of the table of that name
    correlation_length: Sequence[Row] = ()
    precision: Sequence[Row] = ()  #: rows of the table `work_precision`


@dataclass(frozen=True)
class Finding:
    """A statistic with its 95 % interval, and the open range in which the statement puts it."""

    case: Case
    statistic: str
    interval: Interval
    claimed: tuple[float, float]
    rests_on: str  #: separated by "; "
    unit: str = "1"

    @property
    def outcome(self) -> str:
        """Whether the statement "holds", "fails" or stays "open" here.

        It holds where the interval lies within the claimed range, fails where it lies wholly
        outside, and is open where it does neither or there is no interval.
        """
        (_, low, high), (lowest, highest) = self.interval, self.claimed
        if lowest < low and high < highest:
            return "holds"
        return "fails" if high <= lowest or low >= highest else "open"


@dataclass(frozen=True)
class Claim:
    """A statement of the paper, and how to test it."""

    name: str
    section: str
    statement: str
    needs: str  #: what must have been simulated or measured
    test: Callable[[Evidence], Iterable[Finding]]


def verdict(findings: Sequence[Finding]) -> tuple[str, str]:
    """Judge a statement by its findings; return the verdict and what it depends on.

    All findings of a case must hold for the case to hold, and one that fails makes it fail. The
    statement is "reproduced" where all cases hold and "not reproduced" where all fail. It
    "depends on" what differs between cases where some hold and some fail. It is "not settled"
    otherwise: some interval lies across the edge of its claimed range. Without any finding it is
    "not tested".
    """
    if not findings:
        return "not tested", ""
    outcomes = [(dict(case[0].case), _together(case)) for case in _cases(findings)]
    found = {outcome for _, outcome in outcomes}
    if found == {"holds"}:
        return "reproduced", ""
    if found == {"fails"}:
        return "not reproduced", ""
    if {"holds", "fails"} <= found:
        return "depends on", _difference(outcomes)
    return "not settled", ""


def _cases(findings: Sequence[Finding]) -> list[list[Finding]]:
    return [list(group) for _, group in groupby(findings, key=lambda finding: dict(finding.case))]


def _together(findings: Iterable[Finding]) -> str:
    outcomes = {finding.outcome for finding in findings}
    if outcomes == {"holds"}:
        return "holds"
    return "fails" if "fails" in outcomes else "open"


_BOTH = ("holds", "fails")
_LINE = 100  #: characters


def _difference(outcomes: Sequence[tuple[Case, str]]) -> str:
    """Say by which keys the cases that hold differ from those that fail, and which are which.

    These are the keys that tell them apart by themselves; without such a key, all whose values
    differ.
    """
    keys = dict.fromkeys(key for case, _ in outcomes for key in case)
    holds, fails = (
        {key: {case[key] for case, outcome in outcomes if outcome == which} for key in keys}
        for which in _BOTH
    )
    telling = [key for key in keys if not holds[key] & fails[key]]
    telling = telling or [key for key in keys if holds[key] != fails[key]]
    names = {(_name(case, telling), outcome) for case, outcome in outcomes}
    if len({name for name, _ in names}) < len(names):  # no key tells them apart without the others
        telling = [key for key in keys if len({case[key] for case, _ in outcomes}) > 1]
    lists = []
    for which in (*_BOTH, "open"):
        cases = [_name(case, telling) for case, outcome in outcomes if outcome == which]
        if cases:
            lists.append(f"{which} for {' and '.join(dict.fromkeys(cases))}")
    return f"{', '.join(telling)}: {'; '.join(lists)}"


def _name(case: Case, keys: Sequence[str]) -> str:
    """Name a case by a few of its keys; a single one goes without saying."""
    return str(case[keys[0]]) if len(keys) == 1 else describe({key: case[key] for key in keys})


def describe(case: Case) -> str:
    """Write a case as "key = value, ..."."""
    return ", ".join(f"{key} = {value}" for key, value in case.items())


def rows(claims: Iterable[Claim], evidence: Evidence) -> list[Row]:
    """Test every statement: a row for each finding, or one that says what is missing."""
    table = []
    for claim in claims:
        findings = list(claim.test(evidence))
        judged, depends_on = verdict(findings)
        common = {
            "claim": claim.name,
            "section": claim.section,
            "statement": claim.statement,
            "verdict": judged,
            "depends_on": depends_on,
        }
        table += [{**common, **_finding_row(finding)} for finding in findings]
        if not findings:
            table.append({**common, **_missing_row(claim.needs)})
    return table


def _finding_row(finding: Finding) -> Row:
    value, low, high = (float(number) for number in finding.interval)
    return {
        "case": describe(finding.case),
        "statistic": finding.statistic,
        "unit": finding.unit,
        "value": value,
        "ci_low": low,
        "ci_high": high,
        "claimed_low": finding.claimed[0],
        "claimed_high": finding.claimed[1],
        "outcome": finding.outcome,
        "rests_on": finding.rests_on,
    }


def _missing_row(needs: str) -> Row:
    numbers = ("value", "ci_low", "ci_high", "claimed_low", "claimed_high")
    return {
        "case": "",
        "statistic": "",
        "unit": "1",
        **dict.fromkeys(numbers, math.nan),
        "outcome": "open",
        "rests_on": f"missing: {needs}",
    }


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
        f"Verdict: {_verdict(first)}." + _missing(first),
    ]
    if first["verdict"] != "not tested":
        header = ["case", "statistic", "value [95 % interval]", "claimed", "outcome"]
        lines.append(markdown_table(header, [_cells(row) for row in part]))
        sources = dict.fromkeys(name for row in part for name in row["rests_on"].split("; "))
        lines.append("\n".join(["Rests on", "", *(f"- {source}" for source in sources)]))
    return "\n\n".join(lines)


def _missing(row: Row) -> str:
    return f" {row['rests_on'].capitalize()}." if row["verdict"] == "not tested" else ""


def _cells(row: Row) -> list[str]:
    value = f"{row['value']:.3g} [{row['ci_low']:.3g}, {row['ci_high']:.3g}]"
    unit = "" if row["unit"] == "1" else f" {row['unit']}"
    return [row["case"], row["statistic"], value + unit, _range(row), row["outcome"]]


def _range(row: Row) -> str:
    low, high = row["claimed_low"], row["claimed_high"]
    if math.isinf(high):
        return f"> {low:.3g}"
    return f"< {high:.3g}" if math.isinf(low) else f"{low:.3g} to {high:.3g}"
