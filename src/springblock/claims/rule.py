"""What a claim is and rests on, and the rule from intervals to verdicts."""

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import Any, Literal

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
#: universal: always, only, all, a superlative; existential: can; general: all others.
Form = Literal["universal", "general", "existential"]

ENOUGH = 20  #: realisations from which on a surface is looked at by itself
_POWER = 1.28  #: standard errors that nine in ten estimates stay below
_MANY = 10**6  #: realisations beyond which nobody would go


@dataclass(frozen=True, eq=False)
class Evidence:
    """What claims are tested on, by scene. What was not simulated or measured is absent."""

    records: Records = field(default_factory=dict)
    correlation: RowsByScene = field(default_factory=dict)
    correlation_length: RowsByScene = field(default_factory=dict)
    #: Tangential force on each block before the first detaches, over its mean; NaN off contact.
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

    def outcome(self, together: int = 1) -> str:
        """Whether the claim "holds", "fails" or stays "open" here, as one of several findings.

        It holds where the interval lies within the claimed range, fails where it lies wholly
        outside, and is open where it does neither or there is no interval.
        """
        return self._outcome(*self.estimate.limits(together))

    def _outcome(self, low: float, high: float) -> str:
        lowest, highest = self.claimed
        if lowest < low and high < highest:
            return "holds"
        return "fails" if high <= lowest or low >= highest else "open"

    def needed(self, together: int = 1) -> float:
        """Realisations that decide nine times in ten, if value and scatter are the true ones.

        Of the smallest sample, where it is one of several, which are to grow in proportion. To 2 %;
        infinite if a million would not do, NaN where chance plays no part or there is no
        interval.
        """
        if self.estimate.n < 2 or math.isnan(self.estimate.ci_low):
            return math.nan
        alone = self.estimate.limits(1)
        error = (alone[1] - alone[0]) / 2.0 / float(students_t(self.estimate.n - 1))
        n = 2
        while n < _MANY:
            low, high = self.estimate.limits(together, n)
            spare = _POWER * error * math.sqrt(self.estimate.n / n)
            if self._outcome(low - spare, high + spare) != "open":
                return n
            n = math.ceil(1.02 * n)
        return math.inf


Test = Callable[[Evidence], Iterable[Finding]]


@dataclass(frozen=True)
class Claim:
    """A statement of the paper, and how to test it."""

    name: str
    section: str
    form: Form
    statement: str
    figure: int  #: of the paper, which shows what the statement speaks of
    needs: str  #: what must have been simulated or measured
    test: Test


def claim(
    name: str, section: str, figure: int, needs: str, form: Form = "general"
) -> Callable[[Test], Claim]:
    """Make a claim of a test, which yields findings from evidence.

    Its docstring is the statement: what the paper says and, after "Tested:", what number a word
    without one stands for. `section` and `figure` are the paper's.
    """

    def made(test: Test) -> Claim:
        statement = " ".join((test.__doc__ or "").split())
        return Claim(name, section, form, statement, figure, needs, test)

    return made


def verdict(form: Form, findings: Sequence[Finding]) -> tuple[str, str]:
    """Judge a claim by its findings; return the verdict and where the claim holds and fails.

    All findings of a case must hold for the case to hold, and one that fails makes it fail.

    - One case refutes a universal claim, and one suffices for an existential one.
    - A claim with cases that hold and cases that fail is "reproduced in part".
    - Without one that fails it is "not settled" while any case is open, else "reproduced".
    - It is "not reproduced" where cases fail and none holds, and "not tested" without findings.
    """
    if not findings:
        return "not tested", ""
    cases = [
        (case, _together({finding.outcome(len(findings)) for finding in group}))
        for case, group in groupby(findings, key=lambda finding: finding.case)
    ]
    found = {outcome for _, outcome in cases}
    if form == "existential" and "holds" in found:
        return "reproduced", boundary(cases, "holds")
    if form == "universal" and "fails" in found:
        return "not reproduced", boundary(cases, "fails")
    if {"holds", "fails"} <= found:
        return "reproduced in part", boundary(cases, "holds", "fails", "open")
    if "fails" in found and form == "general":
        return "not reproduced", boundary(cases, "fails", "open")
    if "open" in found:
        return "not settled", boundary(cases, "open")
    return ("reproduced" if "holds" in found else "not reproduced"), ""


def _together(found: Collection[str]) -> str:
    return next(kind for kind in ("fails", "open", "holds") if kind in found)


#: How a case is called by the value of a key, in a sentence.
_WORDS = {
    "n_p": "on pillars of {} blocks",
    "n_p2": "with pawls of {} blocks",
    "degrees": "at {}° from the grooves",
    "t/t_max below": "for blocks that detach before {} t_max",
    "small against": "against {}",
    "mu_static_std": "where thresholds scatter by {}",
}


def boundary(cases: Sequence[tuple[Case, str]], *outcomes: str) -> str:
    """Say in words which cases have these outcomes; nothing where all cases have the same.

    Cases are told apart by the first key that tells their outcomes apart, or else by all keys that
    differ between them. Values of a single key that follow one another among those tested make a
    range.
    """
    keys = dict.fromkeys(key for case, _ in cases for key in case)
    telling = [key for key in keys if len({case.get(key) for case, _ in cases}) > 1]
    if len({outcome for _, outcome in cases}) < 2 or not telling:
        return ""
    seen = {key: {(case.get(key), outcome) for case, outcome in cases} for key in telling}
    alone = [key for key in telling if len(dict(seen[key])) == len(seen[key])]
    telling = alone[:1] or telling
    parts = []
    for outcome in outcomes:
        chosen = [found == outcome for _, found in cases]
        if not any(chosen):
            continue
        if len(telling) == 1:
            names = _runs_of([case.get(telling[0]) for case, _ in cases], chosen)
        else:
            shown = [case for case, found in cases if found == outcome]
            short = [{key: case[key] for key in telling if key in case} for case in shown]
            names = list(dict.fromkeys(map(describe, short)))
        words = _WORDS.get(telling[0], "for {}") if len(telling) == 1 else "for {}"
        verb = "is open" if outcome == "open" else outcome
        parts.append(f"{verb} {words.format(_listed(names))}")
    return f"It {'; it '.join(parts)}."


def _runs_of(values: Sequence[Any], chosen: Sequence[bool]) -> list[str]:
    """Values that are chosen, in order; numbers next to one another among all as "a to b"."""
    pairs = dict.fromkeys(zip(values, chosen, strict=True))
    if not all(isinstance(value, int | float) for value in values):
        return [str(value) for value, taken in pairs if taken]
    runs = [list(run) for taken, run in groupby(sorted(pairs), key=lambda pair: pair[1]) if taken]
    ends = [(run[0][0], run[-1][0]) for run in runs]
    return [f"{a:g}" if a == b else f"{a:g} to {b:g}" for a, b in ends]


def _listed(names: Sequence[str]) -> str:
    return " and ".join(filter(None, [", ".join(names[:-1]), names[-1]]))


def describe(case: Case) -> str:
    """Write a case as "key = value, ..."."""
    return ", ".join(f"{key} = {value}" for key, value in case.items())
