"""The rule from intervals to verdicts, and what the table and the page make of it."""

import csv
import math
import re
from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import t

from springblock import Material, compute_prelude
from springblock.analysis.estimate import Estimate, Proportion
from springblock.analysis.statistics import mean_interval, proportion_interval, students_t
from springblock.claims import CLAIMS
from springblock.claims import page as pages
from springblock.claims.page import CHANGED, _clearness, page
from springblock.claims.rule import Claim, Evidence, Finding, boundary, verdict
from springblock.claims.stress import elastic_forces
from springblock.claims.table import SCHEMA, rows
from springblock.io.parquet import rows_to_table
from springblock.model.scene import Scene

INF = float("inf")
ROOT = Path(__file__).parents[2]
REGISTER = ROOT / "docs/registration"


def finding(low, high, claimed=(0.0, INF), n=10**6, **case):
    estimate = Estimate((low + high) / 2.0, low, high, n)
    return Finding(case, "a difference", estimate, claimed, "tables/some: row", "s")


HOLDS, FAILS, OPEN = (1.0, 2.0), (-2.0, -1.0), (-0.1, 0.2)


@pytest.mark.parametrize(
    ("interval", "claimed", "outcome"),
    [
        (HOLDS, (0.0, INF), "holds"),
        (FAILS, (0.0, INF), "fails"),
        (OPEN, (0.0, INF), "open"),
        (FAILS, (-INF, 0.0), "holds"),
        ((-0.1, 0.1), (-1.0, 1.0), "holds"),
        ((0.9, 1.1), (-1.0, 1.0), "open"),
        ((1.1, 1.2), (-1.0, 1.0), "fails"),
        ((0.0, 0.0), (0.0, 1.0), "fails"),  # more than nothing is claimed
        ((float("nan"), float("nan")), (0.0, INF), "open"),
    ],
)
def test_an_interval_decides_by_where_it_lies(interval, claimed, outcome):
    assert finding(*interval, claimed).outcome(1) == outcome


@pytest.mark.parametrize(
    ("intervals", "universal", "general", "existential"),
    [
        ([HOLDS, HOLDS], "reproduced", "reproduced", "reproduced"),
        ([FAILS, FAILS], "not reproduced", "not reproduced", "not reproduced"),
        ([HOLDS, FAILS], "not reproduced", "reproduced in part", "reproduced"),
        ([HOLDS, FAILS, OPEN], "not reproduced", "reproduced in part", "reproduced"),
        ([HOLDS, OPEN], "not settled", "not settled", "reproduced"),
        ([FAILS, OPEN], "not reproduced", "not reproduced", "not settled"),
        ([OPEN], "not settled", "not settled", "not settled"),
        ([], "not tested", "not tested", "not tested"),
    ],
)
def test_the_form_of_a_claim_says_what_its_cases_decide(intervals, universal, general, existential):
    findings = [finding(*interval, n_p=i) for i, interval in enumerate(intervals)]
    assert verdict("universal", findings)[0] == universal
    assert verdict("general", findings)[0] == general
    assert verdict("existential", findings)[0] == existential


@pytest.mark.parametrize(
    ("intervals", "expected"),
    [
        ([HOLDS, HOLDS], "reproduced"),
        ([HOLDS, FAILS], "not reproduced"),
        ([HOLDS, OPEN], "not settled"),
        ([FAILS, OPEN], "not reproduced"),
    ],
)
def test_all_findings_of_a_case_must_hold_and_one_that_fails_decides_it(intervals, expected):
    assert verdict("general", [finding(*each, n_p=6) for each in intervals])[0] == expected


def test_a_verdict_needs_findings_that_hold_jointly():
    """Alone the interval lies above zero; as one of two, at 97.5 %, it does not."""
    near = Finding({"n_p": 1}, "slope", Estimate(1.005, 0.01, 2.0, 20), (0.0, INF), "")
    assert verdict("general", [near])[0] == "reproduced"
    assert verdict("general", [near, replace(near, case={"n_p": 2})])[0] == "not settled"


def test_many_findings_hold_together_as_often_as_one_does(rng):
    """Of thirty means that are zero, one or two miss it if each has its own 95 %."""
    misses = np.zeros(2)
    for sample in rng.normal(size=(300, 30, 12)):
        estimates = [Estimate.of(mean_interval(values), 12) for values in sample]
        for i, together in enumerate((1, 30)):
            limits = [estimate.limits(together) for estimate in estimates]
            misses[i] += any(not low < 0.0 < high for low, high in limits)
    assert misses[0] / 300 == pytest.approx(1.0 - 0.95**30, abs=0.08)
    assert misses[1] / 300 == pytest.approx(0.05, abs=0.04)  # 3 errors


def test_intervals_of_means_are_students_at_their_joint_level(rng):
    """For other numbers of realisations, those expected of samples with the same scatter."""
    values = rng.normal(size=12)
    found = Estimate.of(mean_interval(values), 12)
    for n in (12, 40):
        half = t.ppf(1.0 - 0.005, n - 1) * values.std(ddof=1) / np.sqrt(n)
        assert found.limits(5, n) == pytest.approx((values.mean() - half, values.mean() + half))


def test_intervals_of_shares_stay_exact_together():
    found = Proportion.of(proportion_interval(19, 20), 20).limits(5)
    assert found == pytest.approx(tuple(map(float, proportion_interval(19, 20, 0.99)[1:])))
    assert Proportion.of(proportion_interval(20, 20), 20).limits(5)[1] == 1.0


def test_a_range_bounds_an_interval():
    share = Estimate(0.95, 0.92, 0.98, 20, bounds=(0.0, 1.0))
    assert share.limits(1000)[1] == 1.0
    assert share.limits(1000)[0] < 0.9


def test_needed_realisations_decide_nine_times_in_ten(rng):
    """0.5 with a standard deviation of 1 is told from zero by 42 realisations (t test)."""
    half = float(students_t(99)) / 10.0
    n = finding(0.5 - half, 0.5 + half, n=100).needed()
    assert n == pytest.approx(44, abs=3)
    samples = rng.normal(0.5, 1.0, (2000, int(n)))
    held = [Estimate.of(mean_interval(sample), int(n)).limits(1)[0] > 0.0 for sample in samples]
    assert np.mean(held) == pytest.approx(0.9, abs=0.03)


def test_what_cannot_be_decided_needs_more_than_anyone_has():
    assert np.isinf(finding(-1.0, 1.0, n=10).needed())  # on the edge
    assert np.isnan(finding(np.nan, np.nan, n=1).needed())
    assert finding(*HOLDS, n=100).needed() < finding(*HOLDS, n=100).needed(30)


def test_what_has_no_scatter_is_decided_at_any_level():
    exact = Finding({}, "", Estimate(0.1, 0.1, 0.1), (0.0, INF), "")
    assert exact.outcome(1000) == "holds"
    assert Estimate(0.1, 0.1, 0.1).limits(1000) == (0.1, 0.1)


def cases_of(outcomes, *keys):
    """Cases from the values of their keys, each with its outcome."""
    return [
        (dict(zip(keys, values, strict=True)), outcome)
        for outcome, several in outcomes.items()
        for values in several
    ]


@pytest.mark.parametrize(
    ("cases", "expected"),
    [
        (
            cases_of(
                {"holds": [(4,), (20,)], "fails": [(6,), (8,), (10,)], "open": [(60,)]}, "n_p"
            ),
            "It holds at n_p = 4 and 20; it fails at n_p = 6 to 10; it is open at n_p = 60.",
        ),
        (
            cases_of({"holds": [(20, 1), (60, 2)], "fails": [(20, 2)]}, "n_p", "ring"),
            "It holds at n_p = 20 for ring = 1 and at n_p = 60; it fails at n_p = 20 for ring = 2.",
        ),
        (
            cases_of({"holds": [(4, "x"), (6, "x")], "fails": [(4, "y"), (6, "y")]}, "n_p", "side"),
            "It holds on x; it fails on y.",  # by the one key that separates them
        ),
        (  # a limit stands where it can be read as that of one phrase only
            cases_of({"holds": [(4, 1), (4, 2), (20, 1)], "fails": [(20, 2)]}, "n_p", "ring"),
            "It holds at n_p = 20 for ring = 1 and at n_p = 4; it fails at n_p = 20 for ring = 2.",
        ),
        (cases_of({"holds": [("the core",)]}, "part"), ""),
    ],
)
def test_the_boundary_is_what_tells_the_cases_apart(cases, expected):
    assert boundary(cases, "holds", "fails", "open") == expected


@pytest.mark.parametrize(
    ("form", "interval", "expected"),
    [
        ("general", HOLDS, "It holds for ring = 1; it fails for ring = 0."),
        ("general", OPEN, "It fails for ring = 0; it is open for ring = 1."),  # may hold in part
        ("universal", HOLDS, "It fails for ring = 0."),
        ("existential", HOLDS, "It holds for ring = 1."),
        ("existential", OPEN, "It is open for ring = 1."),
    ],
)
def test_a_verdict_names_the_cases_that_decide_it(form, interval, expected):
    assert verdict(form, [finding(*FAILS, ring=0), finding(*interval, ring=1)])[1] == expected


def growing(intervals: list[tuple[float, float]], **more: int) -> Claim:
    found = [finding(*interval, n_p=i, **more) for i, interval in enumerate(intervals)]
    return Claim("It grows", "3.2", "general", "It grows.", 1, lambda _: found)


SHRINKS = Claim("It shrinks", "3.3", "universal", "It shrinks.", 1, lambda _: [])
SOME = [growing([HOLDS]), SHRINKS]


def test_the_table_has_a_row_for_each_finding_and_one_for_what_is_missing():
    first, second = rows_to_table(rows(SOME, Evidence()), SCHEMA).to_pylist()
    assert (first["value"], first["ci_low"], first["ci_high"]) == (1.5, 1.0, 2.0)
    assert (first["case"], first["outcome"], first["verdict"]) == ("n_p = 0", "holds", "reproduced")
    assert second["verdict"] == "not tested"
    assert second["rests_on"].startswith("missing: ")
    assert np.isnan(second["value"])


@pytest.mark.parametrize(
    ("claims", "expected"),
    [
        (SOME, "**Reproduced** (general statement). A difference is 1.5 [1, 2] s (claimed: > 0)."),
        (SOME, "**Not tested** (universal statement). Missing: surfaces with 20 realisations "),
        ([growing([(-1.0, 2.0)], n=1000)], "about 26000 realisations would settle it"),
        ([growing([HOLDS] * 5)], "| at n_p = 4 | 1.5 [0.843, 2.16] s | > 0 | holds |"),
        (
            [growing([HOLDS, FAILS, (-9.0, -8.0)])],  # the clearest failure
            "It holds at n_p = 0; it fails at n_p = 1 and 2. At n_p = 2, a difference is -8.5 [",
        ),
    ],
)
def test_the_page_holds_the_deciding_numbers(claims, expected):
    assert expected in page(rows(claims, Evidence()))


def test_a_test_is_marked_as_registered_or_as_changed_with_its_reason(monkeypatch):
    monkeypatch.setattr(pages, "CHANGED", {"It grows": "0.5 was a slip"})
    text = page(rows(SOME, Evidence()))
    assert "**reproduced** | changed |" in text
    assert "Changed after registration: 0.5 was a slip." in text
    assert text.count("Registered before its data.") == len(SOME) - 1


def registered(name):
    with (REGISTER / name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_every_statement_is_as_registered():
    """One that is new, or in another form, has a reason, and reasons have a statement."""
    forms = {row["claim"]: row["form"] for row in registered("register.csv")}
    others = {claim.name for claim in CLAIMS if claim.form != forms.get(claim.name)}
    assert others <= set(CHANGED) <= {claim.name for claim in CLAIMS}
    assert set(forms) <= {claim.name for claim in CLAIMS}


@pytest.mark.parametrize("place", ["README.md", "docs/claims.md", "docs/registration/README.md"])
def test_pages_count_the_verdicts_of_the_registered_tests(place):
    found = Counter(row["verdict"] for row in registered("confirmed.csv"))
    text = " ".join((ROOT / place).read_text(encoding="utf-8").split())
    said = re.search(r"gave,?[^.]* \d+ reproduced[^.]* not settled\.", text)
    names = ("reproduced", "reproduced in part", "not reproduced", "not settled")
    numbers = [int(number) for number in re.findall(r"(\d+) (?:reproduced|in part|not)", said[0])]
    assert numbers == [found[name] for name in names]


def test_the_readme_counts_registered_and_changed_tests():
    text = " ".join((ROOT / "README.md").read_text(encoding="utf-8").split())
    number, changed = len(registered("confirmed.csv")), len(CHANGED)
    assert f"The tests of {number} statements were registered" in text
    assert f"Of these tests, {changed - len(CLAIMS) + number} were later changed" in text
    assert f"on these {changed} statements are not confirmatory" in text


def test_forces_across_grooves_are_those_of_the_turned_surface():
    across = Scene(12, 5, 7, n_p2=2, n_s2=1, direction="y")
    forces = np.stack(elastic_forces(across, Material()))
    assert (np.isfinite(forces).all(axis=0) == across.contact).all()
    assert np.nanmean(np.hypot(*forces)) == pytest.approx(1.0)


@pytest.mark.parametrize("direction", ["x", "y"])
def test_forces_before_any_slip_follow_from_elasticity(direction):
    scene = Scene(12, 4, 2, direction=direction)
    forces, contact = elastic_forces(scene, Material()), scene.contact
    modulus = np.hypot(*forces)
    assert np.isnan(modulus[~contact]).all()
    assert modulus[contact].mean() == pytest.approx(1.0)
    along = forces[0] if direction == "x" else forces[0].T
    np.testing.assert_allclose(along, along[:, ::-1], rtol=1e-9)
    pillar = along[1:5, 1:5]
    assert pillar[1, 0] > pillar[0, 1] > pillar[1, 1]  # edges across, along, inside
    prelude = compute_prelude(contact, direction=direction)
    computed = np.sqrt(prelude.peak[-1])
    np.testing.assert_allclose(modulus[contact], computed / computed.mean(), rtol=0.02)


@pytest.mark.parametrize(
    ("claimed", "margin"), [((1.0, math.inf), 5.0), ((-math.inf, 5.0), 3.0), ((1.0, 5.0), 3.0)]
)
def test_a_margin_is_in_units_of_the_arm_towards_the_limit(claimed, margin):
    """The value 2 has the interval [1.8, 3]."""
    row = {"value": 2.0, "together_low": 1.8, "together_high": 3.0}
    row |= {"claimed_low": claimed[0], "claimed_high": claimed[1]}
    assert _clearness(row)[0] == pytest.approx(margin)
