"""The rule from intervals to verdicts, and what the table and the page make of it."""

import numpy as np
import pytest

from beyond.made_up import record
from springblock import compute_prelude
from springblock.analysis.estimate import Estimate, Proportion
from springblock.analysis.statistics import mean_interval, proportion_interval, students_t
from springblock.beyond.question import by_scene
from springblock.claims.page import page
from springblock.claims.rule import Claim, Evidence, Finding, outcomes, verdict
from springblock.claims.table import SCHEMA, rows
from springblock.cli.claims import _stress
from springblock.io.parquet import rows_to_table
from springblock.model.blockmap import BlockMap
from springblock.model.scene import Scene

INF = float("inf")


def finding(low, high, claimed=(0.0, INF), n=10**6, **case):
    estimate = Estimate((low + high) / 2.0, low, high, n)
    return Finding(case, "a difference", estimate, claimed, "tables/some: row", "s")


HOLDS, FAILS, OPEN = (1.0, 2.0), (-2.0, -1.0), (-0.1, 0.2)
WEAK = (-1.0, 2.0)  #: around 1.5, where others hold, it would reach 0


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
    assert finding(*interval, claimed).outcome() == outcome


@pytest.mark.parametrize(
    ("intervals", "expected"),
    [
        ([HOLDS, HOLDS], "reproduced"),
        ([FAILS, FAILS], "not reproduced"),
        ([HOLDS, FAILS], "depends on"),
        ([HOLDS, FAILS, OPEN], "depends on"),
        ([HOLDS, OPEN], "not settled"),
        ([FAILS, OPEN], "not reproduced"),
        ([FAILS, WEAK], "not reproduced"),
        ([HOLDS, HOLDS, WEAK], "reproduced"),
        ([HOLDS, HOLDS, WEAK, OPEN], "not settled"),
        ([HOLDS, WEAK], "not settled"),
        ([HOLDS, HOLDS, WEAK, WEAK], "not settled"),
        ([HOLDS, HOLDS, WEAK, FAILS], "depends on"),
        ([WEAK, WEAK], "not settled"),
        ([OPEN], "not settled"),
        ([], "not tested"),
    ],
)
def test_cases_decide_together(intervals, expected):
    findings = [finding(*interval, n_p=i) for i, interval in enumerate(intervals)]
    assert verdict(findings)[0] == expected


def test_all_findings_of_a_case_must_hold():
    for other, expected in (
        (HOLDS, "reproduced"),
        (FAILS, "not reproduced"),
        (OPEN, "not settled"),
    ):
        assert verdict([finding(*HOLDS, n_p=6), finding(*other, n_p=6)])[0] == expected


def test_a_case_with_a_finding_without_power_could_not_have_held():
    found = [finding(*HOLDS, n_p=i) for i in (6, 20)]
    found += [finding(*OPEN, n_p=60), finding(*WEAK, n_p=60)]
    assert outcomes(found) == ["holds", "holds", "open", "underpowered"]
    assert verdict(found)[0] == "reproduced"


def test_what_is_not_reproduced_names_its_open_cases():
    findings = [finding(*FAILS, n_p=6), finding(*OPEN, n_p=20)]
    assert verdict(findings) == ("not reproduced", "n_p: fails for 6; open for 20")


def test_only_the_same_statistic_in_other_cases_tells_what_power_is_wanted():
    weak = finding(*WEAK, n_p=6)
    other = Finding({"n_p": 20}, "another", Estimate(1.5, 1.0, 2.0, 9), (0.0, INF), "")
    assert outcomes([weak, other, other]) == ["open", "holds", "holds"]


def test_four_in_five_estimates_of_a_powerful_finding_hold():
    """Its error is 1: then the arm of 1.96 and 0.84 errors must lie above the edge."""
    half = float(students_t(10**6 - 1))
    open_one = finding(-half, half)
    assert open_one.had_power_at(1.96 + 0.85, 1)
    assert not open_one.had_power_at(1.96 + 0.83, 1)


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


def test_intervals_of_shares_stay_exact_together():
    found = Proportion.of(proportion_interval(19, 20), 20).limits(5)
    assert found == pytest.approx(tuple(map(float, proportion_interval(19, 20, 0.99)[1:])))
    assert Proportion.of(proportion_interval(20, 20), 20).limits(5)[1] == 1.0


def test_what_settles_an_open_finding_follows_from_its_distance_to_the_edge():
    """0.5 ± 1.5 needs arms of a third: nine times the realisations, less what Student's t gains."""
    assert finding(-1.0, 2.0, n=1000).settled_by() == pytest.approx(9000, rel=0.03)
    assert finding(-1.0, 2.0, n=10).settled_by() == pytest.approx(90 * (1.99 / 2.26) ** 2, rel=0.03)
    assert finding(-1.0, 2.0, n=1000).settled_by(30) > 20_000
    assert finding(-1.0, 2.0, claimed=(0.0, 1.0), n=1000).settled_by() == pytest.approx(
        9000, rel=0.03
    )
    assert finding(-2.0, 1.0, n=1000).settled_by() == pytest.approx(9000, rel=0.03)  # to fail
    assert np.isinf(finding(-1.0, 1.0, n=10).settled_by())  # on the edge
    assert np.isnan(finding(*HOLDS, n=10).settled_by())
    assert np.isnan(finding(np.nan, np.nan, n=1).settled_by())


def test_all_of_few_realisations_settle_a_share_sooner_than_roots_say():
    all_of_20 = Finding({}, "", Proportion.of(proportion_interval(20, 20), 20), (0.9, INF), "")
    assert all_of_20.outcome() == "open"
    assert all_of_20.settled_by() == pytest.approx(np.log(0.025) / np.log(0.9), rel=0.06)


def test_what_has_no_scatter_is_decided_at_any_level():
    exact = Finding({}, "", Estimate(0.1, 0.1, 0.1), (0.0, INF), "")
    assert exact.outcome(1000) == "holds"
    assert Estimate(0.1, 0.1, 0.1).limits(1000) == (0.1, 0.1)


@pytest.mark.parametrize(
    ("cases", "expected"),
    [
        (
            [(HOLDS, 20, 1), (HOLDS, 60, 2), (FAILS, 6, 1), (OPEN, 10, 2)],
            "n_p: holds for 20 and 60; fails for 6; open for 10",
        ),
        (
            [(HOLDS, 20, 1), (HOLDS, 60, 2), (FAILS, 20, 2)],
            "n_p, ring: holds for n_p = 20, ring = 1 and n_p = 60, ring = 2; "
            "fails for n_p = 20, ring = 2",
        ),
        (
            [(HOLDS, 10, 0), (FAILS, 10, 1), (FAILS, 6, 0)],
            "n_p, ring: holds for n_p = 10, ring = 0; "
            "fails for n_p = 10, ring = 1 and n_p = 6, ring = 0",
        ),
    ],
)
def test_what_a_verdict_depends_on_is_what_tells_the_cases_apart(cases, expected):
    findings = [finding(*interval, n_p=n_p, ring=ring) for interval, n_p, ring in cases]
    assert verdict(findings) == ("depends on", expected)


SOME = [
    Claim("It grows", "3.2", "It grows.", 1, "sizes", lambda _: [finding(*HOLDS, n_p=6)]),
    Claim("It shrinks", "3.3", "It shrinks.", 1, "two sizes", lambda _: []),
]


def test_the_table_has_a_row_for_each_finding_and_one_for_what_is_missing():
    first, second = rows_to_table(rows(SOME, Evidence()), SCHEMA).to_pylist()
    assert (first["value"], first["ci_low"], first["ci_high"]) == (1.5, 1.0, 2.0)
    assert (first["case"], first["outcome"], first["verdict"]) == ("n_p = 6", "holds", "reproduced")
    assert (second["verdict"], second["rests_on"]) == ("not tested", "missing: two sizes")
    assert np.isnan(second["value"])


def test_the_page_holds_the_numbers_and_what_is_missing():
    text = page(rows(SOME, Evidence()))
    in_short = "a difference is 1.5 [1, 2] s, claimed > 0."
    assert f"| [1. It grows](#1-it-grows) | **reproduced** | {in_short} |" in text
    assert "| n_p = 6 | a difference | 1.5 [1, 2] s | > 0 | holds |" in text
    assert "Verdict: **not tested**. Missing: two sizes." in text


def test_the_page_holds_what_would_settle_a_statement_and_the_level_of_its_intervals():
    found = [finding(*WEAK, n=1000, n_p=6)]
    claim = Claim("It grows", "3.2", "", 1, "", lambda _: found)
    assert "| open: about 9100 realisations would settle it |" in page(rows([claim], Evidence()))
    found[:] = [finding(*HOLDS, n_p=i) for i in range(5)]
    text = page(rows([claim], Evidence()))
    assert "value [95 % interval together, 99 % alone]" in text
    assert "5 of 5 hold, most narrowly a difference is 1.5 [" in text


def test_the_command_finds_the_scene_of_a_prelude(tmp_path):
    scenes = [Scene(12, 4, 2), Scene(12, 4, 2, direction="y")]
    file = tmp_path / "prelude.npz"
    compute_prelude(scenes[1].pattern.contact, direction="y").save(file)
    found = _stress(
        [file], {scene: [record(scene, 0, np.zeros((12, 12)), 0.7)] for scene in scenes}
    )
    assert list(found) == scenes[1:]
    field, contact = found[scenes[1]], scenes[1].pattern.contact
    assert np.isnan(field[~contact]).all()
    assert field[contact].mean() == pytest.approx(1.0)
    np.testing.assert_allclose(field, field[:, ::-1], rtol=1e-6)  # across the sliding direction
    pillar = field[1:5, 1:5]
    assert pillar[0, 1] > pillar[1, 0] > pillar[1, 1]  # edges across, along, inside


def test_the_command_leaves_surfaces_out_that_the_paper_could_not_have():
    mask = BlockMap("all-00000000", np.ones((12, 12), bool))
    scenes = [Scene(12), Scene(12, n_rows=6), Scene(12, edges="periodic"), Scene(mask=mask)]
    scenes += [Scene(12, mu_static_field=BlockMap("one-00000000", np.ones((12, 12))))]
    assert by_scene(scenes, lambda scene: scene) == {scenes[0]: scenes[:1]}
    assert by_scene([scene.row for scene in scenes], Scene.from_row).keys() == {scenes[0]}
