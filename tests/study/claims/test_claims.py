"""Each statement is reproduced by data made to its measure, and not once they are changed."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache, partial
from itertools import chain
from typing import Any

import numpy as np
import pytest

from springblock.io.records import Record
from springblock.study.claims import STATEMENTS
from springblock.study.claims.rule import TESTS, Evidence, verdict
from study.claims import paper
from study.claims.paper import FLAT, PILLARS, Change, peaks

FORMS = {statement.id: statement.form for statement in STATEMENTS}


@cache
def records() -> list[Record]:
    return paper.realisations()


def judge(name: str, evidence: Evidence) -> str:
    return verdict(FORMS[name], list(TESTS[name](evidence)))[0]


def shifted(microseconds: int) -> Change:
    """The force curve so much later, and the blocks when they were."""
    return lambda run: {"force": np.roll(run.force, microseconds)}


def moved(times: Callable[[Record], np.ndarray]) -> Change:
    """Other detachment times."""
    return lambda run: {"t_det": times(run)}


def sticking(friction: float) -> Change:
    """Another static friction."""
    return lambda run: {"normal_force": run.force.max() / (friction + run.static_friction / 100.0)}


def constant(name: str, value: float) -> Change:
    """Another constant of the material."""
    return lambda run: {"scene": replace(run.scene, **{name: value})}


def patch(run: Record) -> dict[str, Any]:
    """All precursors in one spot."""
    t_det = np.maximum(run.t_det, 1.01 * run.t_max)
    t_det[10:20, 10:20] = np.linspace(0.80, 0.89, 100).reshape(10, 10) * run.t_max
    return {"t_det": t_det}


def lone(run: Record) -> dict[str, Any]:
    """All precursors are apart from each other."""
    t_det = np.maximum(run.t_det, 1.01 * run.t_max)
    t_det[::3, ::3] = 0.9 * run.t_max
    return {"t_det": t_det}


def steady(run: Record) -> dict[str, Any]:
    """One block after another at a constant rate, from before the load peaks to after them."""
    t_det, blocks = run.t_det.copy(), np.isfinite(run.t_det)
    t_det[blocks] = 1e-6 * np.linspace(150.0, 330.0, np.count_nonzero(blocks))
    return {"t_det": t_det, "detachments": paper.counted(t_det, len(run.time))}


def calm(run: Record) -> dict[str, Any]:
    """Blocks that slide do not stop."""
    return {"switches": run.detachments}


def with_strain(*places: int) -> Change:
    """Other displacements at the snapshots: the made-up ones at these places."""
    return lambda run: {"snapshots": run.snapshots[list(places)]}


scattered = moved(lambda run: np.random.default_rng(run.seed).permuted(run.t_det))
two_peaks = peaks((220.0, 0.60), (300.0, 0.65))
narrow = peaks((300.0, 0.60), width=1.0)
mirrored = moved(lambda run: 2.0 * run.t_avg - run.t_det)  # what was early is late
turned = moved(lambda run: run.t_det.T)
at_once = moved(lambda run: np.where(np.isfinite(run.t_det), run.t_avg, np.nan))
REFUTED, PARTLY = "not reproduced", "reproduced in part"

#: Statement, scenes whose realisations are changed, how, and the verdict then.
CHANGES = [
    ("isolated_precursors", [FLAT], patch, REFUTED),
    ("not_all_nucleate", [FLAT], patch, REFUTED),
    ("not_all_nucleate", [FLAT], scattered, REFUTED),
    ("peak_before_average", [FLAT], shifted(9), REFUTED),
    ("onset", [FLAT], shifted(9), REFUTED),
    ("residual_strains", [FLAT], with_strain(0, 1, 1, 0), PARTLY),
    ("residual_strains", [FLAT], with_strain(1, 1, 1, 0), REFUTED),
    ("small_pillars", PILLARS[:1], peaks((200.0, 0.78), width=40.0), REFUTED),
    ("detachment_order", PILLARS, mirrored, REFUTED),
    ("always_in_order", PILLARS[1:2], mirrored, REFUTED),
    ("edges_before_peak", PILLARS, shifted(-200), REFUTED),
    ("region_of_precursors", PILLARS, shifted(100), PARTLY),
    ("region_of_precursors", PILLARS, lone, REFUTED),
    ("peak_after_average", PILLARS[2:], shifted(-100), REFUTED),
    ("many_precursors", PILLARS, shifted(-250), REFUTED),
    ("intermediate_size", PILLARS[2:], sticking(0.50), REFUTED),
    ("two_peaks", [paper.ALONG], peaks((300.0, 0.65)), REFUTED),
    ("only_along", [paper.ACROSS], peaks((200.0, 0.65), (300.0, 0.70)), REFUTED),
    ("hierarchy_needed", [paper.BARE_ALONG], two_peaks, REFUTED),
    ("anisotropy_needed", [paper.SQUARE], two_peaks, REFUTED),
    ("across_sticks_better", [paper.BARE_ALONG], sticking(0.80), REFUTED),
    ("faster_along", [paper.BARE_ACROSS], at_once, REFUTED),
    ("same_ratio", [paper.STIFF], sticking(0.70), REFUTED),
    ("same_ratio", [paper.STIFF], shifted(9), REFUTED),
]


#: Statement, its table, the factor for l_c or c in some of its rows, and the verdict then.
FACTORS = [
    ("correlated_along", "correlation", -0.5, {"side": "x"}, PARTLY),
    ("correlated_along", "correlation", 9.0, {"side": "y", "r": 1}, PARTLY),
    ("three_blocks", "correlation_length", 0.5, {}, REFUTED),
    ("three_blocks", "correlation_length", 0.5, {"n_p": 20}, PARTLY),
    ("growing_length", "correlation_length", 0.5, {"n_p": 60}, REFUTED),
]

#: Part of a statement, scenes whose realisations are changed, and how: this part fails.
PARTS = [
    ("rounder_and_longer", "width of the force peak", PILLARS[1:2], narrow),
    ("rounder_and_longer", "duration of the transition", PILLARS[1:2], at_once),
    ("correlated_along", "events", PILLARS, turned),
    ("further_levels", "two load peaks, only along", [paper.DEEP_ACROSS], two_peaks),
    ("further_levels", "a load peak for every level", [paper.DEEP_ALONG], two_peaks),
    ("quasi_static_phase", "quiet beside", [paper.ALONG], steady),
    ("quasi_static_phase", "precursors slip again", [paper.ALONG], calm),
    ("quasi_static_phase", "the core at rest", [paper.ALONG], mirrored),
    ("quasi_static_phase", "the surface stressed", paper.SCENES, constant("mu_dynamic", 0.66)),
]


@pytest.mark.parametrize("name", sorted({name for name, *_ in CHANGES + FACTORS + PARTS}))
def test_data_as_the_paper_has_them_reproduce_it(name):
    assert judge(name, paper.evidence(records())) == "reproduced"


@pytest.mark.parametrize(("name", "scenes", "change", "expected"), CHANGES)
def test_other_realisations_change_the_verdict(name, scenes, change, expected):
    other = paper.evidence(paper.changed(records(), scenes, change))
    assert judge(name, other) == expected


@pytest.mark.parametrize(("name", "table", "factor", "wanted", "expected"), FACTORS)
def test_other_correlations_change_the_verdict(name, table, factor, wanted, expected):
    judged = paper.evidence(records())
    for row in chain.from_iterable(getattr(judged, table).values()):
        if wanted.items() <= row.items():
            row |= {key: factor * value for key, value in row.items() if isinstance(value, float)}
    assert judge(name, judged) == expected


@pytest.mark.parametrize(("name", "part", "scenes", "change"), PARTS)
def test_other_realisations_refute_a_part_of_a_statement(name, part, scenes, change):
    findings = TESTS[name](paper.evidence(paper.changed(records(), scenes, change)))
    failed = {each.case.part[: len(part)] for each in findings if each.outcome(10) == "fails"}
    assert part in failed


@pytest.mark.parametrize(("grooves", "expected"), [(0.1, "reproduced"), (0.3, REFUTED)])
def test_the_stress_is_compared_with_that_on_the_same_pillars(grooves, expected, monkeypatch):
    known = {paper.ALONG: grooves, paper.PLAIN: 0.2}
    monkeypatch.setattr("springblock.study.claims.grooves.unevenness", known.get)
    assert judge("more_uniform", paper.evidence(records())) == expected


@pytest.mark.parametrize(("later", "expected"), [(0, REFUTED), (-250, "reproduced")])
def test_few_blocks_of_very_large_pillars_detach_early(later, expected, monkeypatch):
    monkeypatch.setattr("springblock.study.claims.pillars._LARGE", 24)
    other = paper.evidence(paper.changed(records(), PILLARS[2:], shifted(later)))
    assert judge("negligible_edges", other) == expected


@pytest.fixture
def scattered_more(monkeypatch):
    """Realisations of pillars, and the same as if their thresholds scattered more."""
    monkeypatch.setattr("springblock.study.claims.pillars._COMPARED", (2, 6, 24))
    others = [replace(scene, mu_static_std=0.2) for scene in PILLARS]
    return [
        {scene: [paper.record(scene, seed) for seed in range(60)] for scene in scenes}
        for scenes in (PILLARS, others)
    ]


def test_the_order_of_mean_times_is_tested_with_other_scatters(scattered_more):
    usual, others = scattered_more
    found = TESTS["always_in_order"](Evidence(records=usual | others))
    means = [each.case for each in found if each.case.part == "mean times"]
    assert {(case.n_p, case.constant_value) for case in means} == {(6, 0.2), (24, 0.2)}
    turned = {s: [replace(run, **mirrored(run)) for run in runs] for s, runs in others.items()}
    assert judge("always_in_order", Evidence(records=usual | others)) == "reproduced"
    assert judge("always_in_order", Evidence(records=usual | turned)) == REFUTED


@pytest.mark.parametrize(("lowest", "expected"), [(1, "reproduced"), (2, REFUTED)])
def test_where_friction_is_lowest_is_compared_with_l_c_for_every_scatter(
    lowest, expected, scattered_more
):
    usual, others = scattered_more
    place = [*others][lowest]
    others[place] = [replace(run, normal_force=2.0 * run.normal_force) for run in others[place]]
    assert judge("size_like_length", Evidence(records=usual | others)) == expected


def in_windows(rng: np.random.Generator) -> np.ndarray:
    """Sums over eight neighbours along a side, whose correlation falls along a straight line."""
    drawn = rng.standard_normal((24, 31))
    return np.lib.stride_tricks.sliding_window_view(drawn, 8, axis=1).sum(axis=-1)


@pytest.mark.parametrize(
    ("fields", "expected"), [(partial(paper.by_side, 24), "reproduced"), (in_windows, REFUTED)]
)
def test_c_x_is_told_from_other_curves(fields, expected):
    runs, place = [], PILLARS[2].pattern.origins[0]
    for seed in range(300):
        times = np.full((paper.N, paper.N), np.nan)
        drawn = fields(np.random.default_rng(seed))
        times[place[0] : place[0] + 24, place[1] : place[1] + 24] = drawn
        runs.append(replace(records()[0], scene=PILLARS[2], t_det=times))
    assert judge("exponential", Evidence(records={PILLARS[2]: runs})) == expected


@pytest.mark.parametrize(("bias", "expected"), [(1e-4, "reproduced"), (0.1, REFUTED)])
def test_a_bias_beyond_the_scatter_changes_the_verdict(bias, expected):
    assert judge("step_suffices", Evidence(precision=paper.precision(bias))) == expected


def test_one_realisation_settles_nothing():
    one = paper.evidence([run for run in records() if run.seed == 0])
    found = {name: judge(name, one) for name, *_ in CHANGES}
    assert set(found.values()) == {"not settled"}
