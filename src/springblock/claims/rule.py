"""Claims, their findings, and the rule that derives verdicts from intervals."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import Any

from springblock.analysis.estimate import Estimate
from springblock.io.records import Record
from springblock.io.rows import Row, listed
from springblock.model.numbers import Array
from springblock.model.scene import Scene

Records = Mapping[Scene, Sequence[Record]]  #: realisations
RowsByScene = Mapping[Scene, Sequence[Row]]  #: of a table
Case = Mapping[str, str | int | float]
Range = tuple[float, float]

ENOUGH = 20  #: realisations that a surface needs to be tested
_POWER = 1.28  #: 90 % quantile of the standard normal distribution
_MANY = 10**6  #: effectively infinite number of realisations
_WORST_FIRST = ("fails", "open", "holds")


@dataclass(frozen=True, eq=False)
class Evidence:
    """Data that claims are tested on; scenes that were not simulated are absent."""

    records: Records = field(default_factory=dict)
    correlation: RowsByScene = field(default_factory=dict)
    correlation_length: RowsByScene = field(default_factory=dict)
    #: Tangential force on each block before the first detachment, over its mean; NaN off contact.
    stress: Mapping[Scene, Array] = field(default_factory=dict)
    precision: Sequence[Row] = ()  #: rows of the table `work_precision`: other, small surfaces


@dataclass(frozen=True)
class Finding:
    """A statistic with its interval, and the range (without its ends) that is claimed for it."""

    case: Case
    statistic: str
    estimate: Estimate
    claimed: Range
    rests_on: str  #: separated by "; "
    unit: str = "1"

    def outcome(self, together: int) -> str:
        """Return whether the claim "holds", "fails" or is "open", one of `together` findings.

        It holds where the interval lies within the claimed range, fails where it lies wholly
        outside, and is open otherwise or without an interval.
        """
        return self._outcome(*self.estimate.limits(together))

    def _outcome(self, low: float, high: float) -> str:
        lowest, highest = self.claimed
        if (lowest < low or math.isinf(lowest)) and (high < highest or math.isinf(highest)):
            return "holds"
        return "fails" if high <= lowest or low >= highest else "open"

    def needed(self, together: int = 1) -> float:
        """Return the number of realisations that decides with a power of 90 %, within 2 %.

        Value and scatter are taken as the true ones. Where samples are compared it is the size of
        the smallest, if the others grow in proportion. Infinite beyond a million; NaN for exact
        values and without an interval.
        """
        if self.estimate.n < 2 or math.isnan(self.estimate.ci_low):
            return math.nan
        n = 2
        while n < _MANY:
            low, high = self.estimate.limits(together, n)
            spare = _POWER * self.estimate.error * math.sqrt(self.estimate.n / n)
            if self._outcome(low - spare, high + spare) != "open":
                return n
            n = math.ceil(1.02 * n)
        return math.inf


Test = Callable[[Evidence], Iterable[Finding]]


@dataclass(frozen=True)
class Claim:
    """A statement of the paper, and how to test it."""

    name: str
    section: str  #: of the paper
    #: universal: always, only, all, uniform, necessary, negligible, the most; existential: can;
    #: general: all others.
    form: str
    statement: str  #: the paper's words in quotation marks and, after "Test:", the criterion
    figure: int  #: of the paper, to which the statement refers
    test: Test


def verdict(form: str, findings: Sequence[Finding]) -> tuple[str, str]:
    """Judge a claim by its findings; return the verdict and the cases that decide it.

    A case holds if all its findings hold, and fails if one fails.

    - One failing case refutes a universal claim; one that holds suffices for an existential one.
    - A general claim with cases that hold and cases that fail is "reproduced in part".
    - Without a failing case it is "not settled" while a case is open, otherwise "reproduced".
    - It is "not reproduced" where cases fail and none holds; an existential one only if all fail,
      otherwise it is "not settled" while a case is open.
    - It is "not tested" without findings.
    """
    if not findings:
        return "not tested", ""
    cases = []
    for case, group in groupby(findings, key=lambda finding: finding.case):
        outcomes = [finding.outcome(len(findings)) for finding in group]
        cases.append((case, min(outcomes, key=_WORST_FIRST.index)))
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


#: A key of a case with its value, as part of a sentence.
_PHRASES = {
    "n_p": "at n_p = {}",
    "against n_p": "against n_p = {}",
    "n_p2": "with pawls of {} blocks",
    "degrees": "at {}° to the grooves",
    "surface": "on {}",
    "side": "on {}",
    "sides": "on sides {}",
    "sliding": "when sliding {}",
    "E in Pa": "at E = {} Pa",
    "integrator": "with {}",
    "mu_static_std": "at mu_static_std = {}",
    "fit": "with the fit of {}",
    "third level": "with third-level {}",
}


def phrase(key: str, value: str | int | float) -> str:
    """Write a key of a case with its value, or a list of values, as part of a sentence."""
    try:
        value = f"{float(value):g}"
    except ValueError:
        value = str(value)
    other = f"for {key} = {{}}" if value[:1].isdigit() else "for {}"
    return _PHRASES.get(key, other).format(value)


def boundary(cases: Sequence[tuple[Case, str]], *outcomes: str) -> str:
    """Name the cases that have these outcomes, in a sentence; "" if all have the same outcome.

    They are named by the first key that separates the outcomes by itself, or else by all keys that
    differ between cases. Successive values of a key form a range.
    """
    keys = dict.fromkeys(key for case, _ in cases for key in case)
    differing = [key for key in keys if len({case.get(key) for case, _ in cases}) > 1]
    if len({outcome for _, outcome in cases}) < 2 or not differing:
        return ""
    seen = {key: {(case.get(key), outcome) for case, outcome in cases} for key in differing}
    alone = [key for key in differing if len(dict(seen[key])) == len(seen[key])]
    parts = []
    for outcome in outcomes:
        if where := _phrases(cases, alone[:1] or differing, outcome):
            verb = "is open" if outcome == "open" else outcome
            parts.append(f"it {verb} {listed(where)}")
    return capitalised(f"{'; '.join(parts)}.")


def _phrases(cases: Sequence[tuple[Case, str]], keys: Sequence[str], outcome: str) -> list[str]:
    """Name the cases with an outcome, by the first key and, within its values, by the others."""
    if not any(found == outcome for _, found in cases):
        return []
    key, *others = keys
    if not others:
        values = [case.get(key, "") for case, _ in cases]
        return [phrase(key, listed(_ranges(values, [found == outcome for _, found in cases])))]
    limited, whole = [], []
    for value in dict.fromkeys(case.get(key, "") for case, _ in cases):
        group = [(case, found) for case, found in cases if case.get(key, "") == value]
        if all(found == outcome for _, found in group):
            whole.append(phrase(key, value))
        else:
            limited += [f"{phrase(key, value)} {part}" for part in _phrases(group, others, outcome)]
    return limited + whole  # so that no limit seems to apply to all phrases


def _ranges(values: Sequence[Any], chosen: Sequence[bool]) -> list[str]:
    """Return the chosen values in order; three or more successive numbers as "a to b"."""
    pairs = dict.fromkeys(zip(values, chosen, strict=True))
    if not all(isinstance(value, int | float) for value in values):
        return [str(value) for value, taken in pairs if taken]
    names = []
    for taken, successive in groupby(sorted(pairs), key=lambda pair: pair[1]):
        run = [f"{value:g}" for value, _ in successive] if taken else []
        names += run if len(run) < 3 else [f"{run[0]} to {run[-1]}"]
    return names


def capitalised(text: str) -> str:
    """Return the text with a capital first letter, unless it begins with a symbol."""
    first = text.partition(" ")[0]
    return text[:1].upper() + text[1:] if first.isalpha() else text


def describe(case: Case) -> str:
    """Write a case as "key = value, ..."."""
    return ", ".join(f"{key} = {value}" for key, value in case.items())
