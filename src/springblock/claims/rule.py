"""Statements, their findings, and the rule that derives verdicts from intervals."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from operator import attrgetter
from typing import NamedTuple

from springblock.analysis.estimate import Estimate
from springblock.io.records import Record
from springblock.io.rows import Row
from springblock.model.numbers import Array
from springblock.model.scene import Scene

Records = Mapping[Scene, Sequence[Record]]  #: realisations
RowsByScene = Mapping[Scene, Sequence[Row]]  #: of a table
Range = tuple[float, float]

ENOUGH = 20  #: realisations that a surface needs to be tested
_WORST_FIRST = ("fails", "open", "holds")


@dataclass(frozen=True)
class Case:
    """What a statement is tested on, and in which reading; None where it does not apply.

    Each field is a column of the table `claims`.
    """

    n_p: int | None = None
    against_n_p: int | None = None  #: of the pillars with which those of n_p are compared
    n_p2: int | None = None
    n_s2: int | None = None
    n_p3: int | None = None
    along_3: str | None = None
    degrees: float | None = None  #: from the grooves to the sliding direction
    constant: str | None = None  #: of the material
    constant_value: float | None = None
    integrator: str | None = None
    fit: str | None = None  #: curve whose length is l_c
    part: str | None = None  #: of the surface or of the statement, or reading of its words


@dataclass(frozen=True, eq=False)
class Evidence:
    """Data that statements are tested on; scenes that were not simulated are absent."""

    records: Records = field(default_factory=dict)
    correlation: RowsByScene = field(default_factory=dict)
    correlation_length: RowsByScene = field(default_factory=dict)
    #: Tangential force on each block of grooved pillars, and of the same without grooves, before
    #: the first detachment, over its mean; NaN off contact.
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
        low, high = self.estimate.limits(together)
        lowest, highest = self.claimed
        if (lowest < low or math.isinf(lowest)) and (high < highest or math.isinf(highest)):
            return "holds"
        return "fails" if high <= lowest or low >= highest else "open"


Test = Callable[[Evidence], Iterable[Finding]]
TESTS: dict[str, Test] = {}  #: by the name of their statement


def tests_statement(test: Test) -> Test:
    """Register a function of the evidence as the test of the statement that has its name."""
    TESTS[test.__name__] = test
    return test


@dataclass(frozen=True)
class Statement:
    """A statement of the paper, and how to test it; `statements.toml` explains its texts."""

    id: str
    title: str
    section: str  #: of the paper
    figure: int  #: of the paper, to which the statement refers
    #: universal: always, only, all, uniform, necessary, negligible, the most; existential: can;
    #: general: all others.
    form: str
    words: str
    criterion: str
    remark: str
    changed: str
    test: Test


class Verdict(NamedTuple):
    """A verdict with the number of cases that hold, and of all cases."""

    word: str
    holds: int
    cases: int


def verdict(form: str, findings: Sequence[Finding]) -> Verdict:
    """Judge a statement by its findings.

    A case holds if all its findings hold, and fails if one fails.

    - One failing case refutes a universal statement; one that holds suffices for an existential
      one.
    - A general statement with cases that hold and cases that fail is "reproduced in part".
    - Without a failing case it is "not settled" while a case is open, otherwise "reproduced".
    - It is "not reproduced" where cases fail and none holds; an existential one only if all fail,
      otherwise it is "not settled" while a case is open.
    - It is "not tested" without findings.
    """
    cases = [
        min((finding.outcome(len(findings)) for finding in group), key=_WORST_FIRST.index)
        for _, group in groupby(findings, key=attrgetter("case"))
    ]
    return Verdict(_word(form, set(cases)), cases.count("holds"), len(cases))


def _word(form: str, found: set[str]) -> str:
    """Return the verdict from the outcomes of cases."""
    if not found:
        return "not tested"
    if form == "existential" and "holds" in found:
        return "reproduced"
    if form == "universal" and "fails" in found:
        return "not reproduced"
    if {"holds", "fails"} <= found:
        return "reproduced in part"
    if "fails" in found and form == "general":
        return "not reproduced"
    if "open" in found:
        return "not settled"
    return "reproduced" if "holds" in found else "not reproduced"
