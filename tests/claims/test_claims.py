"""Each statement is reproduced by data made to its measure, and not once they are changed."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache, partial
from typing import Any

import numpy as np
import pytest

from claims import paper
from claims.paper import (
    ACROSS,
    ALONG,
    BARE_ACROSS,
    BARE_ALONG,
    DEEP_ALONG,
    FEW,
    FLAT,
    MANY,
    PILLARS,
    SHORTER,
    SQUARE,
    STIFF,
    STIFFER,
    WIDER,
    Change,
    peaks,
)
from springblock.analysis.lowest import Lowest
from springblock.claims import STATEMENTS
from springblock.claims.rule import Evidence, Statement, verdict
from springblock.claims.stress import rank_correlation
from springblock.claims.surfaces import from_edge
from springblock.io.records import Record
from springblock.io.rows import Row
from springblock.model.scene import Scene

BY_NAME = {statement.id: statement for statement in STATEMENTS}


@cache
def records() -> list[Record]:
    return paper.realisations(paper.CURVES)


def judge(statement: Statement, evidence: Evidence) -> str:
    return verdict(statement.form, list(statement.test(evidence))).word


def shifted(microseconds: int) -> Change:
    """The force curve so much later, and the blocks when they were."""
    return lambda run: {"force": np.roll(run.force, microseconds)}


def moved(times: Callable[[Record], np.ndarray]) -> Change:
    """Other detachment times."""
    return lambda run: {"t_det": times(run)}


def sticking(friction: float) -> Change:
    """Another static friction, and a hundredth of its scatter."""
    return lambda run: {"normal_force": run.force.max() / (friction + run.static_friction / 100.0)}


def constant(name: str, value: float) -> Change:
    """Another constant of the material."""
    return lambda run: {"scene": replace(run.scene, **{name: value})}


def late_avalanche(run: Record) -> dict[str, Any]:
    """Most detachments are counted long after the mean one."""
    return {"detachments": np.roll(run.detachments, 50)}


def all_again(run: Record) -> dict[str, Any]:
    """Every fifth block slides anew in every microsecond."""
    return {"switches": run.detachments + run.contact.sum() // 5}


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


def further_with_pawls(run: Record) -> dict[str, Any]:
    """Load peaks that are further apart the wider the pawls are."""
    first = 280.0 - run.scene.n_p - 5.0 * run.scene.n_p2
    return peaks((first, 0.59), (300.0, 0.61), width=6.0)(run)


def calm(run: Record) -> dict[str, Any]:
    """Blocks that slide do not stop."""
    return {"switches": run.detachments}


def with_strain(*places: int) -> Change:
    """Other displacements at the snapshots: the made-up ones at these places."""
    return lambda run: {"snapshots": run.snapshots[list(places)]}


two_peaks = peaks((220.0, 0.60), (300.0, 0.65))
mirrored = moved(lambda run: 2.0 * run.t_avg - run.t_det)  # what was early is late
tilted = moved(lambda run: run.t_det + 1e-6 * np.arange(paper.N))  # later at the right
elsewhere = moved(lambda run: np.roll(run.t_det, 7, axis=1))
turned = moved(lambda run: run.t_det.T)
at_once = moved(lambda run: np.where(np.isfinite(run.t_det), run.t_avg, np.nan))
delayed = moved(lambda run: run.t_det + 1e-4)

REFUTED, PARTLY = "not reproduced", "reproduced in part"

#: Statement, scenes whose realisations are changed, how, and the verdict then.
CHANGES = [
    ("isolated_precursors", [FLAT], patch, REFUTED),
    ("not_all_nucleate", [FLAT], patch, REFUTED),
    ("peak_before_average", [FLAT], shifted(9), REFUTED),
    ("weakest_first", [FLAT], elsewhere, REFUTED),
    ("onset", [FLAT], shifted(9), REFUTED),
    ("avalanche_follows", [FLAT], shifted(9), REFUTED),
    ("peaks_apart", [FLAT], shifted(5), REFUTED),
    ("average_is_propagation", [FLAT], late_avalanche, REFUTED),
    ("localized_stick_slip", [FLAT], all_again, REFUTED),
    ("residual_strains", [FLAT], with_strain(0, 1, 1, 0), PARTLY),
    ("residual_strains", [FLAT], with_strain(1, 1, 1, 0), REFUTED),
    ("uniform", [FLAT], tilted, REFUTED),
    ("pillars_alike", PILLARS, tilted, REFUTED),
    ("small_pillars", PILLARS[:1], peaks((200.0, 0.78), width=40.0), REFUTED),
    ("detachment_order", PILLARS, mirrored, REFUTED),
    ("order_of_stress", PILLARS, mirrored, REFUTED),
    ("always_in_order", PILLARS[1:2], mirrored, REFUTED),
    ("edges_before_peak", PILLARS, shifted(-200), REFUTED),
    ("region_of_precursors", PILLARS, shifted(100), PARTLY),
    ("region_of_precursors", PILLARS, lone, REFUTED),
    ("nucleation_near_edge", PILLARS, mirrored, REFUTED),
    ("centre_last", PILLARS, mirrored, REFUTED),
    ("larger_events", PILLARS, turned, REFUTED),
    ("same_mean_time", PILLARS, tilted, PARTLY),
    ("whole_sides", PILLARS, at_once, REFUTED),
    ("most_precursors", PILLARS[1:2], shifted(-250), REFUTED),
    ("roundest_peak", PILLARS[1:2], peaks((300.0, 0.60), width=1.0), REFUTED),
    ("longest_transition", PILLARS[1:2], at_once, REFUTED),
    ("peak_after_average", PILLARS[2:], shifted(-100), REFUTED),
    ("many_precursors", PILLARS, shifted(-250), REFUTED),
    ("rounded_peak", PILLARS, peaks((300.0, 0.70), width=2.0), REFUTED),
    ("intermediate_size", PILLARS[2:], sticking(0.50), REFUTED),
    ("sharper_again", PILLARS[2:], peaks((300.0, 0.70), width=90.0), REFUTED),
    ("two_peaks", [ALONG], peaks((300.0, 0.65)), REFUTED),
    ("only_along", [ACROSS], peaks((200.0, 0.65), (300.0, 0.70)), REFUTED),
    ("further_levels", [DEEP_ALONG], peaks((300.0, 0.65)), REFUTED),
    ("peak_for_every_level", [DEEP_ALONG], two_peaks, REFUTED),
    ("hierarchy_needed", [BARE_ALONG], two_peaks, REFUTED),
    ("anisotropy_needed", [SQUARE], two_peaks, REFUTED),
    ("quiet_between_peaks", [ALONG], steady, REFUTED),
    ("edges_make_first_peak", [ALONG], mirrored, REFUTED),
    ("slips_again", [ALONG], calm, REFUTED),
    ("second_peak_decides", [ALONG], peaks((220.0, 0.65), (300.0, 0.60)), REFUTED),
    ("rest_between_peaks", [ALONG], mirrored, REFUTED),
    ("stressed_between_peaks", [ALONG, ACROSS], constant("mu_dynamic", 0.66), REFUTED),
    ("small_force_suffices", [ALONG], two_peaks, REFUTED),
    ("rapid_but_smooth", [ALONG], peaks((300.0, 0.60), width=1.0), REFUTED),
    ("edges_before_core", [ALONG, ACROSS], mirrored, REFUTED),
    ("grooved_order", [ALONG], mirrored, REFUTED),
    ("across_sticks_better", [BARE_ALONG], sticking(0.80), REFUTED),
    ("faster_along", [BARE_ACROSS], at_once, REFUTED),
    ("number_of_fronts", [FEW[0], MANY[0]], at_once, "reproduced"),  # largest in between
    ("number_of_fronts", [FEW[0], MANY[0], FLAT], at_once, REFUTED),
    ("onset_in_any_case", MANY[1:2], shifted(9), REFUTED),
    ("damping", [FLAT], constant("gamma", 5e3), REFUTED),
    ("same_ratio", [STIFF], sticking(0.70), REFUTED),
    ("same_ratio", [STIFF], shifted(9), REFUTED),
    ("same_ratio", [STIFFER], shifted(9), REFUTED),
    ("interval_follows_lengths", [ALONG, *SHORTER, *WIDER], further_with_pawls, REFUTED),
    ("pillar_length_matters", SHORTER, sticking(0.678), REFUTED),
]


def multiplied(table: Any, factor: float, **wanted: Any) -> dict[Scene, list[Row]]:
    """Multiply all correlations, or lengths, and their intervals where rows have what is wanted."""

    def change(row: Row) -> Row:
        if any(row[name] != value for name, value in wanted.items()):
            return row
        return {k: factor * v if isinstance(v, float) else v for k, v in row.items()}

    return {scene: [change(row) for row in rows] for scene, rows in table.items()}


#: Statement, the factor for l_c or c in some rows of the tables, and the verdict then.
FACTORS = [
    ("long_along_short_across", -0.5, {"side": "x"}, REFUTED),
    ("long_along_short_across", 9.0, {"side": "y", "r": 1}, REFUTED),
    ("three_blocks", 0.5, {}, REFUTED),
    ("three_blocks", 0.5, {"n_p": 20}, PARTLY),
    ("growing_length", 0.5, {"n_p": 60}, REFUTED),
    ("same_length", 0.4, {"n_p": 58}, REFUTED),
    ("same_shape", 0.2, {"n_p": 58, "r": 4}, REFUTED),
    ("uncorrelated_across", 30.0, {"r": 1, "direction": "y"}, REFUTED),
]

#: Statement, and what makes another stress of that before the first detachment on each scene.
STRESS = [
    ("trivial_stress", lambda scene, field: field * np.linspace(0.5, 1.5, paper.N)),
    ("larger_across", lambda scene, field: field.transpose(0, 2, 1)),
    ("same_stress", lambda scene, field: field * np.linspace(0.5, 1.5, paper.N)),
    ("more_uniform", lambda scene, field: field ** (9.0 if scene.n_p2 else 1.0)),
    ("external_bear_more", lambda scene, field: np.stack([1.0 / field[0], field[1]])),
    ("edges_bear_more_across", lambda scene, field: field * (2.0 if scene == ALONG else 1.0)),
]


@pytest.mark.parametrize("name", sorted({name for name, *_ in CHANGES + FACTORS}))
def test_data_as_the_paper_has_them_reproduce_it(name):
    assert judge(BY_NAME[name], paper.evidence(records())) == "reproduced"


@pytest.mark.parametrize(("name", "scenes", "change", "expected"), CHANGES)
def test_other_realisations_change_the_verdict(name, scenes, change, expected):
    other = paper.evidence(paper.changed(records(), scenes, change))
    assert judge(BY_NAME[name], other) == expected


@pytest.mark.parametrize(("name", "factor", "wanted", "expected"), FACTORS)
def test_other_correlations_change_the_verdict(name, factor, wanted, expected):
    judged = paper.evidence(records())
    table = "correlation" if {"r", "side"} & set(wanted) else "correlation_length"
    rows = multiplied(getattr(judged, table), factor, **wanted)
    assert judge(BY_NAME[name], replace(judged, **{table: rows})) == expected


@pytest.mark.parametrize(("name", "change"), STRESS)
def test_another_stress_changes_the_verdict(name, change):
    judged = Evidence(stress=paper.stress())
    stress = {scene: change(scene, field) for scene, field in judged.stress.items()}
    assert judge(BY_NAME[name], judged) == "reproduced"
    assert judge(BY_NAME[name], replace(judged, stress=stress)) == "not reproduced"


def test_the_edges_of_a_pillar_are_its_two_outermost_rings():
    large = PILLARS[2]
    y, x = large.pattern.origins[0]
    inside = np.zeros((paper.N, paper.N), bool)
    inside[y + 2 : y + 22, x + 2 : x + 22] = True
    late_inside = moved(lambda run: np.where(inside, 1.1 * run.t_max, run.t_det))
    other = paper.evidence(paper.changed(records(), [large], late_inside))
    assert judge(BY_NAME["edges_before_peak"], other) == "reproduced"


#: Less than 5 from the edge of 20 x 20, between the shares of all patches and of all blocks.
BY_CHANCE = 1.0 - 0.37 * (10 / 16) ** 2 - 0.63 * (10 / 20) ** 2


@pytest.mark.parametrize(
    ("near_edge", "inner", "expected"),
    [
        (BY_CHANCE, 10, "reproduced"),
        (0.85 * BY_CHANCE, 10, "reproduced"),
        (0.7 * BY_CHANCE, 10, REFUTED),
        (1.25 * BY_CHANCE, 10, REFUTED),
        (0, 2, REFUTED),
    ],
)
def test_fronts_begin_anywhere_if_neither_the_edge_nor_the_centre_is_preferred(
    near_edge, inner, expected, rng
):
    """First patches have centres near the edge, or among the `inner` x `inner` blocks inside."""
    depth, runs = from_edge(20), []
    edge = np.argwhere((depth >= 2) & (depth < 5))
    for _ in range(2000):
        centre = rng.integers(inner, size=2) + 10 - inner // 2
        y, x = rng.choice(edge) if rng.random() < near_edge else centre
        times = np.ones((20, 20))
        times[y - 2 : y + 3, x - 2 : x + 3] = 0.5
        runs.append(replace(records()[0], scene=Scene(20), t_det=times))
    evidence = Evidence(records={Scene(20): runs})
    assert judge(BY_NAME["nucleation_anywhere"], evidence) == expected


@pytest.mark.parametrize(("share", "expected"), [(0.05, "reproduced"), (0.2, REFUTED)])
@pytest.mark.parametrize("name", ["negligible_edges", "front_after_peak"])
def test_few_blocks_of_very_large_pillars_detach_early(name, share, expected):
    times = np.full((120, 120), np.nan)
    early = np.random.default_rng(0).permutation(3600) < 3600 * share
    times[30:90, 30:90] = np.where(early, 0.9, 1.1).reshape(60, 60)
    scene, peak = Scene(120, 60, 60), {"time": np.arange(3.0), "force": np.array([0.0, 1.0, 0.0])}
    runs = [replace(records()[k], scene=scene, t_det=times, **peak) for k in range(3)]
    assert judge(BY_NAME[name], Evidence(records={scene: runs})) == expected


def test_the_springs_of_the_slider_are_those_of_half_the_layer():
    (found,) = BY_NAME["shear_springs"].test(paper.evidence(records()[:1]))
    assert found.estimate.value == pytest.approx(2.0)
    assert found.outcome(1) == "fails"
    assert not [*BY_NAME["shear_springs"].test(Evidence())]  # which has no realisations


@pytest.mark.parametrize("inside", [1, 36])
def test_blocks_under_equal_stress_do_not_weaken_the_order(inside, rng):
    """The edges of a pillar bear more, in turn, and go first; blocks inside bear the same."""
    stress = np.concatenate([np.arange(2.0, 22.0), np.ones(inside)])
    order = np.concatenate([-np.arange(2.0, 22.0), rng.random(inside)])
    maps = order + 1e-6 * rng.standard_normal((20, len(order)))
    assert rank_correlation(stress, maps).value == pytest.approx(-1.0, abs=1e-12)
    assert abs(rank_correlation(stress, rng.random(maps.shape)).value) < 0.6


def test_where_two_sizes_may_have_the_lowest_friction_neither_speaks_against_the_other(monkeypatch):
    """What holds wherever it is lowest stays; what one of the two alone would refute is open."""
    evidence = paper.evidence(records())
    known = {f.case.n_p: f.outcome(1) for f in BY_NAME["most_precursors"].test(evidence)}
    assert set(known.values()) == {"holds"}
    monkeypatch.setattr(
        "springblock.claims.pillars._lowest", lambda _, scenes: Lowest(scenes[0], scenes[:2])
    )
    found = {f.case.n_p: f for f in BY_NAME["most_precursors"].test(evidence)}
    assert len(found) == len(known) + 1  # the lowest itself as well
    may_be_lowest = list(found.values())[:2]
    assert all(np.isinf(each.estimate.ci_high) for each in may_be_lowest)
    assert "fails" not in [each.outcome(1) for each in may_be_lowest]


@pytest.mark.parametrize(("pawls", "expected"), [(5, "holds"), (11, "fails")])
def test_edges_are_half_of_narrow_pawls(pawls, expected):
    scenes = [Scene(paper.N, 23, 25, pawls, 1, direction=direction) for direction in "xy"]
    (found,) = BY_NAME["equal_parts"].test(Evidence(stress=dict.fromkeys(scenes, np.ones(0))))
    assert found.outcome(1) == expected


def test_the_interval_of_a_size_over_l_c_includes_all_sizes_that_may_have_the_lowest_friction(
    monkeypatch,
):
    monkeypatch.setattr("springblock.claims.pillars._COMPARED", (2, 6, 24))
    evidence, found = paper.evidence(records()), []
    for chosen in (slice(0, 1), slice(1, 2), slice(0, 2)):
        monkeypatch.setattr(
            "springblock.claims.pillars._lowest", lambda _, s, c=chosen: Lowest(s[c][0], s[c])
        )
        found.append([each.estimate for each in BY_NAME["size_like_length"].test(evidence)])
    for small, large, either in zip(*found, strict=True):
        for together in (1, 12):  # intervals; the distance between sizes is not a statistical error
            (low, _), (_, high) = small.limits(together), large.limits(together)
            assert either.limits(together) == (low, high)
            assert low < small.value < large.value < high
    assert len(found[0]) == 2


@pytest.mark.parametrize(("lowest", "expected"), [(1, "reproduced"), (2, REFUTED)])
def test_where_friction_is_lowest_is_compared_with_l_c_for_every_scatter(
    lowest, expected, monkeypatch
):
    monkeypatch.setattr("springblock.claims.pillars._COMPARED", (2, 6, 24))
    scattered = [replace(scene, **{"mu_static_std": 0.2}) for scene in PILLARS]
    runs = {scene: [paper.record(scene, seed) for seed in range(60)] for scene in PILLARS}
    others = {new: runs[old] for new, old in zip(scattered, PILLARS, strict=True)}
    others[scattered[lowest]] = [
        replace(run, normal_force=2.0 * run.normal_force) for run in others[scattered[lowest]]
    ]
    judged = Evidence(records={**runs, **others})
    assert judge(BY_NAME["size_like_length"], judged) == expected


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
    assert judge(BY_NAME["exponential"], Evidence(records={PILLARS[2]: runs})) == expected


@pytest.mark.parametrize(("bias", "expected"), [(1e-4, "reproduced"), (0.1, REFUTED)])
def test_a_bias_beyond_the_scatter_changes_the_verdict(bias, expected):
    judged = Evidence(precision=paper.precision(bias))
    assert judge(BY_NAME["step_suffices"], judged) == expected


def test_one_realisation_settles_nothing():
    one = paper.evidence([run for run in records() if run.seed == 0])
    found = {name: judge(BY_NAME[name], one) for name, *_ in CHANGES}
    assert set(found.values()) == {"not settled"}
