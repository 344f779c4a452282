"""What a claim is and rests on, and the rule from intervals to verdicts."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import Any

from springblock.scene import Scene
from springblock.statistics import Interval
from springblock.tables import Record

Row = dict[str, Any]
Table = Mapping[Scene, Sequence[Row]]  #: rows of a table, by scene
Case = Mapping[str, str | int | float]
Range = tuple[float, float]


@dataclass(frozen=True, eq=False)
class Evidence:
    """What claims are tested on, by scene. What was not simulated or measured is absent."""

    records: Mapping[Scene, Sequence[Record]] = field(default_factory=dict)  #: realisations
    summaries: Table = field(default_factory=dict)  #: the table `realisations`
    correlation: Table = field(default_factory=dict)
    correlation_length: Table = field(default_factory=dict)
    precision: Sequence[Row] = ()  #: rows of the table `work_precision`, whose scenes are others


@dataclass(frozen=True)
class Finding:
    """A statistic with its 95 % interval, and the open range in which the claim puts it."""

    case: Case
    statistic: str
    interval: Interval
    claimed: Range
    rests_on: str  #: separated by "; "
    unit: str = "1"

    @property
    def outcome(self) -> str:
        """Whether the claim "holds", "fails" or stays "open" here.

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
    """Judge a claim by its findings; return the verdict and what it depends on.

    All findings of a case must hold for the case to hold, and one that fails makes it fail. The
    claim is "reproduced" where all cases hold and "not reproduced" where all fail. It
    "depends on" what differs between cases where some hold and some fail. It is "not settled"
    otherwise: some interval lies across the edge of its claimed range. Without any finding it is
    "not tested".
    """
    if not findings:
        return "not tested", ""
    cases = groupby(findings, key=lambda finding: finding.case)
    outcomes = [(case, _together(group)) for case, group in cases]
    found = {outcome for _, outcome in outcomes}
    if found == {"holds"}:
        return "reproduced", ""
    if found == {"fails"}:
        return "not reproduced", ""
    if {"holds", "fails"} <= found:
        return "depends on", _difference(outcomes)
    return "not settled", ""


def _together(findings: Iterable[Finding]) -> str:
    outcomes = {finding.outcome for finding in findings}
    return next(outcome for outcome in ("fails", "open", "holds") if outcome in outcomes)


_BOTH = ("holds", "fails")


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
