"""What a claim is and rests on, and the rule from intervals to verdicts."""

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from statistics import median
from typing import Any

from springblock.analysis.estimate import Estimate
from springblock.analysis.statistics import students_t
from springblock.io.records import Record
from springblock.io.rows import Row
from springblock.model.scene import Scene
from springblock.simulation.run import Array

Records = Mapping[Scene, Sequence[Record]]  #: realisations
RowsByScene = Mapping[Scene, Sequence[Row]]  #: of a table
Case = Mapping[str, str | int | float]
Range = tuple[float, float]

ENOUGH = 20  #: realisations from which on a surface is looked at by itself
_POWER = 0.84  #: standard errors that four in five estimates stay below
_MANY = 10**6  #: realisations beyond which nobody would go


@dataclass(frozen=True, eq=False)
class Evidence:
    """What claims are tested on, by scene. What was not simulated or measured is absent."""

    records: Records = field(default_factory=dict)
    summaries: RowsByScene = field(default_factory=dict)  #: the table `realisations`
    correlation: RowsByScene = field(default_factory=dict)
    correlation_length: RowsByScene = field(default_factory=dict)
    #: Tangential force on each block before the first lets go, over its mean; NaN off contact.
    stress: Mapping[Scene, Array] = field(default_factory=dict)
    precision: Sequence[Row] = ()  #: rows of the table `work_precision`, whose scenes are others


def enough(found: Mapping[Scene, Sequence[Any]]) -> dict[Scene, Sequence[Any]]:
    """Leave out scenes with less than 20 realisations, each one item or counted in a row."""
    runs = {scene: _runs(items) for scene, items in found.items()}
    return {scene: items for scene, items in found.items() if runs[scene] >= ENOUGH}


def _runs(items: Sequence[Any]) -> int:
    counted = isinstance(items[0], Mapping) and "realisations" in items[0]
    return int(items[0]["realisations"]) if counted else len(items)


@dataclass(frozen=True)
class Finding:
    """A statistic with its interval, and the open range in which the claim puts it."""

    case: Case
    statistic: str
    estimate: Estimate
    claimed: Range
    rests_on: str  #: separated by "; "
    unit: str = "1"

    def outcome(self, together: int = 1, n: int | None = None) -> str:
        """Whether the claim "holds", "fails" or stays "open" here, as one of several findings.

        It holds where the interval lies within the claimed range, fails where it lies wholly
        outside, and is open where it does neither or there is no interval. With another `n` it
        is the outcome to expect of so many realisations with the same value.
        """
        (low, high), (lowest, highest) = self.estimate.limits(together, n), self.claimed
        if lowest < low and high < highest:
            return "holds"
        return "fails" if high <= lowest or low >= highest else "open"

    def settled_by(self, together: int = 1) -> float:
        """Realisations that would decide an open finding, were its value the true one.

        To 2 %; infinite if a million would not do, NaN where it is decided or has no interval.
        """
        n = self.estimate.n
        if self.outcome(together) != "open" or n < 2:
            return math.nan
        while n < _MANY:
            n = math.ceil(1.02 * n)
            if self.outcome(together, n) != "open":
                return n
        return math.inf

    def had_power_at(self, value: float, together: int) -> bool:
        """Whether it would hold four times in five if this were the true value."""
        low, high = self.estimate.limits(together)
        alone = self.estimate.limits(1)
        error = (alone[1] - alone[0]) / 2.0 / float(students_t(self.estimate.n - 1))
        shift, (lowest, highest) = value - self.estimate.value, self.claimed
        spare = _POWER * error
        return lowest < low + shift - spare and high + shift + spare < highest


Test = Callable[[Evidence], Iterable[Finding]]


@dataclass(frozen=True)
class Claim:
    """A statement of the paper, and how to test it."""

    name: str
    section: str
    statement: str
    figure: int  #: of the paper, which shows what the statement speaks of
    needs: str  #: what must have been simulated or measured
    test: Test


def claim(name: str, section: str, figure: int, needs: str) -> Callable[[Test], Claim]:
    """Make a claim of a test, which yields findings from evidence.

    Its docstring is the statement: what the paper says and, after "Tested:", what number a word
    without one stands for. `section` and `figure` are the paper's.
    """

    def made(test: Test) -> Claim:
        return Claim(name, section, " ".join((test.__doc__ or "").split()), figure, needs, test)

    return made


def outcomes(findings: Sequence[Finding]) -> list[str]:
    """Outcome of each finding of a claim: "holds", "fails", "open" or "underpowered".

    The intervals of all findings hold together. An open finding is underpowered where it would
    hold less than four times in five if its true value were the median of those that hold in other
    cases.
    """
    together = len(findings)
    found = [finding.outcome(together) for finding in findings]
    holds = [each for each, outcome in zip(findings, found, strict=True) if outcome == "holds"]
    for i, finding in enumerate(findings):
        values = [other.estimate.value for other in holds if _comparable(other, finding)]
        if found[i] == "open" and values and finding.estimate.n:
            powerful = finding.had_power_at(median(values), together)
            found[i] = "open" if powerful else "underpowered"
    return found


def _comparable(first: Finding, second: Finding) -> bool:
    """The same is claimed of the same statistic in another case."""
    same = (first.statistic, first.claimed) == (second.statistic, second.claimed)
    return same and first.case != second.case


def verdict(findings: Sequence[Finding]) -> tuple[str, str]:
    """Judge a claim by its findings; return the verdict and what it depends on.

    All findings of a case must hold for the case to hold, one that fails makes it fail, and an
    underpowered one leaves it undecided. The claim is made of all its cases:

    - it "depends on" what differs between cases where some hold and some fail;
    - it is "not reproduced" where some fail and none holds: no open case could save it, but one
      may yet show that it depends on something, and these are named;
    - it is "reproduced" where some hold, none fails and none is open but for lack of power, and
      those are fewer than the ones that hold;
    - it is "not settled" otherwise, and "not tested" without any finding.
    """
    if not findings:
        return "not tested", ""
    judged = zip(findings, outcomes(findings), strict=True)
    cases = groupby(judged, key=lambda pair: pair[0].case)
    decided = [(case, _together({outcome for _, outcome in group})) for case, group in cases]
    found = [outcome for _, outcome in decided]
    if {"holds", "fails"} <= set(found):
        return "depends on", _difference(decided)
    if "fails" in found:
        return "not reproduced", _cases(decided, _varied(decided)) if set(found) & _OPEN else ""
    settled = "open" not in found and found.count("holds") > found.count("underpowered")
    return "reproduced" if settled else "not settled", ""


def _together(found: Collection[str]) -> str:
    return next(kind for kind in ("fails", "underpowered", "open", "holds") if kind in found)


_OPEN = {"open", "underpowered"}


def _difference(decided: Sequence[tuple[Case, str]]) -> str:
    """Say by which keys the cases that hold differ from those that fail, and which are which.

    These are the keys that tell them apart by themselves; without such a key, all whose values
    differ.
    """
    keys = dict.fromkeys(key for case, _ in decided for key in case)
    holds, fails = (
        {key: {case.get(key) for case, found in decided if found == which} for key in keys}
        for which in ("holds", "fails")
    )
    telling = [key for key in keys if not holds[key] & fails[key]]
    telling = telling or [key for key in keys if holds[key] != fails[key]]
    names = {(_name(case, telling), found) for case, found in decided}
    if len({name for name, _ in names}) < len(names):  # no key tells them apart without the others
        telling = _varied(decided)
    return _cases(decided, telling)


def _varied(decided: Sequence[tuple[Case, str]]) -> list[str]:
    """Keys that differ between cases."""
    keys = dict.fromkeys(key for case, _ in decided for key in case)
    return [key for key in keys if len({case.get(key) for case, _ in decided}) > 1]


def _cases(decided: Sequence[tuple[Case, str]], telling: Sequence[str]) -> str:
    """Say which cases hold, fail and are open, told apart by these keys."""
    lists = []
    for words, kinds in (("holds", {"holds"}), ("fails", {"fails"}), ("open", _OPEN)):
        cases = [_name(case, telling) for case, found in decided if found in kinds]
        if cases:
            lists.append(f"{words} for {' and '.join(dict.fromkeys(cases))}")
    return f"{', '.join(telling)}: {'; '.join(lists)}"


def _name(case: Case, keys: Sequence[str]) -> str:
    """Name a case by a few of its keys; a single one goes without saying."""
    shown = {key: case[key] for key in keys if key in case}
    return str(case[keys[0]]) if len(keys) == 1 else describe(shown)


def describe(case: Case) -> str:
    """Write a case as "key = value, ..."."""
    return ", ".join(f"{key} = {value}" for key, value in case.items())
