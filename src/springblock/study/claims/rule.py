"""Statements, their findings, and the rule that derives verdicts from intervals."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from operator import attrgetter
from typing import Any

from springblock.analysis.estimate import Estimate
from springblock.io.records import Record
from springblock.io.rows import Row
from springblock.model.scene import Scene

Records = Mapping[Scene, Sequence[Record]]  #: realisations
RowsByScene = Mapping[Scene, Sequence[Row]]  #: of a table
Range = tuple[float, float]

ENOUGH = 20  #: realisations that a surface needs to be tested
# Open ranges in which statements place a statistic. A word of the paper is one number throughout.
INF = float("inf")
POSITIVE, NEGATIVE = (0.0, INF), (-INF, 0.0)
NEARLY_ALL = (0.9, INF)  #: "all" and "none"
MOST, FEWER_THAN_HALF = (0.5, INF), (-INF, 0.5)
NEGLIGIBLE = (-INF, 0.1)
COMPARABLE = (0.5, 2.0)  #: a ratio
_WORST_FIRST = ("fails", "open", "holds")


def _of_case(unit: str, meaning: str) -> Any:
    return field(default=None, metadata={"unit": unit, "meaning": meaning})


@dataclass(frozen=True)
class Case:
    """What a statement is tested on, and in which reading; None where it does not apply.

    Each field is a column of the table `claims`.
    """

    n_p: int | None = _of_case("blocks", "side of a pillar")
    against_n_p: int | None = _of_case("blocks", "side of the pillars compared with")
    n_p2: int | None = _of_case("blocks", "width of a pawl")
    n_s2: int | None = _of_case("blocks", "width of a groove")
    n_p3: int | None = _of_case("blocks", "size of the parts of a pawl")
    along_3: str | None = _of_case("x or y", "direction of the grooves of level 3")
    degrees: float | None = _of_case("°", "angle from the grooves to the sliding direction")
    constant: str | None = _of_case("1", "constant of the material")
    constant_value: float | None = _of_case("SI", "its value")
    integrator: str | None = _of_case("1", "integrator")
    fit: str | None = _of_case("1", "curve fitted to c(r), whose length is l_c")
    part: str | None = _of_case("1", "part of a surface, or reading of the paper's words")


@dataclass(frozen=True, eq=False)
class Evidence:
    """Data that statements are tested on; scenes that were not simulated are absent."""

    records: Records = field(default_factory=dict)
    correlation: RowsByScene = field(default_factory=dict)
    correlation_length: RowsByScene = field(default_factory=dict)
    precision: Sequence[Row] = ()  #: rows of the table `work_precision`: other, small surfaces


@dataclass(frozen=True)
class Finding:
    """A statistic with its interval, and the range (without its ends) that is claimed for it."""

    case: Case
    statistic: str
    estimate: Estimate
    claimed: Range
    scenes: Iterable[Scene] = ()  #: behind the value
    unit: str = "1"

    def outcome(self, together: int) -> str:
        """Return whether the claim "holds", "fails" or is "open", one of `together` findings.

        That is where the interval lies within the claimed range, wholly outside, or neither.
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
    figure: str  #: of the paper, to which the statement refers
    form: str  #: universal: always, only, all, necessary, negligible; general: all others
    words: str
    criterion: str
    remark: str
    changed: str
    test: Test


def verdict(form: str, findings: Sequence[Finding]) -> tuple[str, int, int]:
    """Return the verdict on a statement, the number of cases that hold, and of all cases.

    A case holds if all its findings hold, and fails if one fails. A case that fails refutes a
    universal statement; a general one is "reproduced in part" if other cases hold. Without a
    failing case, a statement is "not settled" while a case is open.
    """
    cases = [
        min((finding.outcome(len(findings)) for finding in group), key=_WORST_FIRST.index)
        for _, group in groupby(findings, key=attrgetter("case"))
    ]
    found = set(cases)
    word = "not settled" if "open" in found else "reproduced" if found else "not tested"
    if "fails" in found:
        word = "reproduced in part" if form == "general" and "holds" in found else "not reproduced"
    return word, cases.count("holds"), len(cases)
