"""Statements as data, and the rule from intervals to verdicts."""

import csv
import math
import re
from collections import Counter
from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import t

from springblock import Material, compute_prelude
from springblock.analysis.estimate import Estimate, Proportion
from springblock.analysis.statistics import mean_interval, proportion_interval
from springblock.claims import STATEMENTS, statements
from springblock.claims.rule import Case, Evidence, Finding, Statement, verdict
from springblock.claims.stress import elastic_forces
from springblock.claims.summary import Judged, _clearness, values
from springblock.claims.table import CASE, SCHEMA, rows
from springblock.io.parquet import rows_to_table
from springblock.model.scene import Scene
from springblock.pages import rendered

INF = float("inf")
ROOT = Path(__file__).parents[2]
REGISTER = ROOT / "docs/registration"


def finding(low, high, claimed=(0.0, INF), n=10**6, **case):
    estimate = Estimate((low + high) / 2.0, low, high, n)
    return Finding(Case(**case), "a difference", estimate, claimed, "tables/some: row", "s")


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
def test_the_form_of_a_statement_says_what_its_cases_decide(
    intervals, universal, general, existential
):
    findings = [finding(*interval, n_p=i) for i, interval in enumerate(intervals)]
    found = [verdict(form, findings) for form in ("universal", "general", "existential")]
    assert [each.word for each in found] == [universal, general, existential]
    assert {each[1:] for each in found} == {(intervals.count(HOLDS), len(intervals))}


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
    found = verdict("general", [finding(*each, n_p=6) for each in intervals])
    assert found == (expected, expected == "reproduced", 1)


def test_a_verdict_needs_findings_that_hold_jointly():
    """Alone the interval lies above zero; as one of two, at 97.5 %, it does not."""
    near = Finding(Case(n_p=1), "slope", Estimate(1.005, 0.01, 2.0, 20), (0.0, INF), "")
    assert verdict("general", [near]).word == "reproduced"
    assert verdict("general", [near, replace(near, case=Case(n_p=2))]).word == "not settled"


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
    values = rng.normal(size=12)
    half = t.ppf(1.0 - 0.005, 11) * values.std(ddof=1) / np.sqrt(12)
    found = Estimate.of(mean_interval(values), 12).limits(5)
    assert found == pytest.approx((values.mean() - half, values.mean() + half))


def test_intervals_of_shares_stay_exact_together():
    found = Proportion.of(proportion_interval(19, 20), 20).limits(5)
    assert found == pytest.approx(tuple(map(float, proportion_interval(19, 20, 0.99)[1:])))
    assert Proportion.of(proportion_interval(20, 20), 20).limits(5)[1] == 1.0


def test_a_range_bounds_an_interval():
    share = Estimate(0.95, 0.92, 0.98, 20, bounds=(0.0, 1.0))
    assert share.limits(1000)[1] == 1.0
    assert share.limits(1000)[0] < 0.9


def test_what_has_no_scatter_is_decided_at_any_level():
    exact = Finding(Case(), "", Estimate(0.1, 0.1, 0.1), (0.0, INF), "")
    assert exact.outcome(1000) == "holds"
    assert Estimate(0.1, 0.1, 0.1).limits(1000) == (0.1, 0.1)


def with_findings(name: str, *findings: Finding) -> Statement:
    """One of the statements, with these findings."""
    statement = next(each for each in STATEMENTS if each.id == name)
    return replace(statement, form="general", test=lambda _: findings)


GROWS = with_findings(
    "growing_length", *(finding(*each, n_p=i) for i, each in enumerate([HOLDS, FAILS]))
)
MISSING = with_findings("rapid_but_smooth")


def test_the_table_has_a_row_for_each_finding_and_one_for_what_is_missing():
    first, second, third = rows_to_table(rows([GROWS, MISSING], Evidence()), SCHEMA).to_pylist()
    assert (first["value"], first["ci_low"], first["ci_high"]) == (1.5, 1.0, 2.0)
    assert (first["n_p"], second["n_p"], first["side"]) == (0, 1, None)
    assert (first["outcome"], second["outcome"]) == ("holds", "fails")
    assert (first["verdict"], first["holds"], first["cases"]) == ("reproduced in part", 1, 2)
    assert (third["verdict"], third["holds"], third["cases"]) == ("not tested", 0, 0)
    assert np.isnan(third["value"])


def test_a_case_has_the_columns_of_the_table():
    assert [field.name for field in fields(Case)] == [field.name for field in CASE]


def judged(statement: Statement) -> Judged:
    (part,) = values(rows([statement], Evidence()))["parts"]
    return part


@pytest.mark.parametrize(
    ("intervals", "decided"),
    [
        ([HOLDS, (8.0, 9.0)], 0),  # the smallest margin
        ([HOLDS, FAILS, (-9.0, -8.0)], 2),  # the clearest failure
        ([HOLDS, (-1.0, 2.0), (-1.0, 1.4)], 1),  # the first that is open
    ],
)
def test_one_finding_decides_a_verdict(intervals, decided):
    found = [finding(*interval, n_p=i, n=100) for i, interval in enumerate(intervals)]
    assert judged(with_findings("growing_length", *found)).deciding["n_p"] == decided


def test_the_table_of_findings_has_the_columns_that_tell_cases_apart():
    found = [finding(*HOLDS, n_p=6, side="x"), finding(-1.0, 2.0, n_p=20, n=1000)]
    header, lines = judged(with_findings("growing_length", *found)).table
    assert header == ["n_p", "side", "value", "claimed", "outcome"]
    assert lines[0] == ("6", "x", "1500000 [928203, 2071797] µs", "> 0", "holds")
    assert [line[-1] for line in lines] == ["holds", "open"]


def test_the_page_has_each_statement_with_its_number_mark_and_count():
    page = rendered("claims.md", **values(rows([GROWS, *STATEMENTS[:2]], Evidence())))
    (line,) = (line for line in page.splitlines() if line.startswith(f"| [{GROWS.heading}]"))
    assert line.split(" | ")[1:5] == ["general", "**reproduced in part**", "1 of 2", "changed"]
    assert f"\n## {GROWS.heading}\n" in page
    assert f"Changed after registration: {GROWS.changed}" in page
    assert page.count("Registered before its data.") == sum(
        not each.changed for each in (GROWS, *STATEMENTS[:2])
    )


ENTRY = {"title": "It grows", "section": "3.2", "figure": 7, "form": "general", "words": "It does."}
ENTRY |= {"criterion": "It grows.", "remark": "As {onset}.", "changed": ""}


def test_a_statement_names_another_by_its_title():
    one, other = statements({"growing_length": ENTRY, "onset": ENTRY | {"title": "It begins"}})
    assert (one.number, other.number, one.remark) == (1, 2, "As “It begins”.")


@pytest.mark.parametrize(
    ("name", "changes", "message"),
    [
        ("shrinking", {}, r"\[shrinking\]: no module .* has a test"),
        ("onset", {"figures": 7}, r"\[onset\]: figures is missing or no key; keys are title,"),
        ("onset", {"form": "grand"}, r"form is 'grand'; choose from universal,"),
        ("onset", {"words": "{offset}"}, r"\[onset\]: \{offset\} is no statement"),
        ("onset", {"remark": None}, r"\[onset\]: remark is missing"),
    ],
)
def test_a_statement_that_is_not_complete_is_refused(name, changes, message):
    entry = {key: text for key, text in (ENTRY | changes).items() if text is not None}
    with pytest.raises(ValueError, match=message):
        statements({"onset": ENTRY, name: entry})


def registered(name):
    with (REGISTER / name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_every_statement_is_as_registered():
    """One that is new, or in another form, has a reason."""
    forms = {row["claim"]: row["form"] for row in registered("register.csv")}
    others = [each for each in STATEMENTS if each.form != forms.get(each.title)]
    assert all(each.changed for each in others)
    assert set(forms) <= {each.title for each in STATEMENTS}


@pytest.mark.parametrize("place", ["docs/claims.md", "docs/registration/README.md"])
def test_pages_count_the_verdicts_of_the_registered_tests(place):
    found = Counter(row["verdict"] for row in registered("confirmed.csv"))
    text = " ".join((ROOT / place).read_text(encoding="utf-8").split())
    said = re.search(r"gave,?[^.]* \d+ reproduced[^.]* not settled\.", text)
    names = ("reproduced", "reproduced in part", "not reproduced", "not settled")
    numbers = [int(number) for number in re.findall(r"(\d+) (?:reproduced|in part|not)", said[0])]
    assert numbers == [found[name] for name in names]


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
