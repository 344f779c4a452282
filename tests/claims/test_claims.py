"""Each claim is reproduced by data made to its measure, and not once they are changed."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache
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
    UNDAMPED,
    WIDER,
)
from springblock.analysis.estimate import Estimate
from springblock.claims import CLAIMS
from springblock.claims.flat import not_all_nucleate
from springblock.claims.load_peaks import both_peaks, partial_slope
from springblock.claims.rule import Claim, Evidence, Finding, verdict
from springblock.claims.samples import difference, first_patch, isolated, magnitude, position, rates
from springblock.claims.sides import events, mixed, paired_difference, unpaired_difference
from springblock.claims.stress import rank_correlation
from springblock.claims.surfaces import edge, grooved_parts
from springblock.io.records import Record
from springblock.io.rows import Row
from springblock.model.scene import Scene

BY_NAME = {claim.test.__name__: claim for claim in CLAIMS}


def peak_at(t_max: float) -> dict[str, np.ndarray]:
    """A force curve of three samples whose maximum is at this time, s."""
    return {"time": t_max * np.arange(3.0), "force": np.array([0.0, 1.0, 0.0])}


@cache
def records() -> list[Record]:
    return paper.realisations(paper.CURVES)


@cache
def of_all_lengths() -> list[Record]:
    return records() + paper.realisations(paper.SHORTER_CURVES)


def made_for(name: str) -> list[Record]:
    """Realisations on which the statement is true; some are about pillars of many lengths."""
    many = name in ("interval_follows_lengths", "pillar_length_matters")
    return of_all_lengths() if many else records()


def judge(claim: Claim, evidence: Evidence) -> str:
    return verdict(claim.form, list(claim.test(evidence)))[0]


Change = Callable[[Record], dict[str, Any]]  #: what to replace of a realisation


def shifted(microseconds: int) -> Change:
    """The force curve so much later, and the blocks when they were."""
    return lambda run: {"force": np.roll(run.force, microseconds)}


def moved(times: Callable[[Record], np.ndarray]) -> Change:
    """Other detachment times."""
    return lambda run: {"t_det": times(run)}


def sticking(friction: float) -> Change:
    """Another static friction, and a hundredth of its scatter."""
    return lambda run: {"normal_force": run.force.max() / (friction + run.static_friction / 100.0)}


def sliding(friction: float) -> Change:
    """Another dynamic friction."""
    return lambda run: {"constants": {**run.constants, "mu_dynamic": friction}}


def peaks(*places: tuple[float, float], width: float = 15.0) -> Change:
    """Load peaks at these times in µs, of these heights."""

    def change(run: Record) -> dict[str, Any]:
        time = 1e6 * run.time
        hills = [height * np.exp(-(((time - place) / width) ** 2)) for place, height in places]
        return {"force": sum(hills)}

    return change


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


def cornered(run: Record) -> dict[str, Any]:
    """A corner of the surface detaches first."""
    t_det = run.t_det.copy()
    t_det[:5, :5] = 0.5 * run.t_max
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


two_peaks = peaks((220.0, 0.60), (300.0, 0.65))
far_apart = peaks((200.0, 0.59), (300.0, 0.61), width=6.0)
mirrored = moved(lambda run: 2.0 * run.t_avg - run.t_det)  # what was early is late
tilted = moved(lambda run: run.t_det + 1e-6 * np.arange(paper.N))  # later at the right
elsewhere = moved(lambda run: np.roll(run.t_det, 7, axis=1))
turned = moved(lambda run: run.t_det.T)
at_once = moved(lambda run: np.where(np.isfinite(run.t_det), run.t_avg, np.nan))
delayed = moved(lambda run: run.t_det + 1e-4)
without_fronts = moved(lambda run: np.maximum(run.t_det, 1.02 * run.t_max))

REFUTED, PARTLY = "not reproduced", "reproduced in part"

#: Claim, scenes whose realisations are changed, how, and the verdict then.
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
    ("nucleation_anywhere", [FLAT], cornered, REFUTED),
    ("uniform", [FLAT], tilted, REFUTED),
    ("pillars_alike", PILLARS, tilted, REFUTED),
    ("small_pillars", PILLARS[:1], peaks((200.0, 0.78), width=40.0), REFUTED),
    ("detachment_order", PILLARS, mirrored, REFUTED),
    ("detachment_order", PILLARS[1:2], mirrored, PARTLY),
    ("order_of_stress", PILLARS, mirrored, REFUTED),
    ("order_of_stress", PILLARS[1:2], mirrored, PARTLY),
    ("always_in_order", PILLARS[1:2], mirrored, REFUTED),
    ("edges_before_peak", PILLARS, shifted(-200), REFUTED),
    ("region_of_precursors", PILLARS, shifted(100), REFUTED),
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
    ("rounded_peak", [FLAT], peaks((100.0, 0.80), width=15.0), PARTLY),
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
    ("stick_slip", [ALONG], calm, REFUTED),
    ("second_peak_decides", [ALONG], peaks((220.0, 0.65), (300.0, 0.60)), REFUTED),
    ("rest_between_peaks", [ALONG], mirrored, REFUTED),
    ("stressed_between_peaks", [ALONG], two_peaks, REFUTED),
    ("stressed_between_peaks", [ALONG], sliding(0.66), REFUTED),
    ("small_force_suffices", [ALONG], two_peaks, REFUTED),
    ("small_force_suffices", [ALONG], sliding(0.60), PARTLY),
    ("rapid_but_smooth", [ALONG], peaks((300.0, 0.60), width=1.0), PARTLY),
    ("edges_before_core", [ALONG, ACROSS], mirrored, REFUTED),
    ("edges_before_core", [ACROSS], mirrored, PARTLY),
    ("grooved_order", [ALONG], mirrored, REFUTED),
    ("across_sticks_better", [BARE_ALONG], sticking(0.80), REFUTED),
    ("faster_along", [BARE_ACROSS], at_once, REFUTED),
    ("number_of_fronts", [FEW[0], MANY[0]], without_fronts, REFUTED),
    ("onset_in_any_case", MANY[1:2], delayed, REFUTED),
    ("damping", [UNDAMPED], calm, "not settled"),
    ("same_ratio", [STIFF], sticking(0.70), REFUTED),
    ("same_ratio", [STIFF], shifted(9), REFUTED),
    ("interval_follows_lengths", WIDER[:1], far_apart, "not settled"),
    ("interval_follows_lengths", [ALONG, *SHORTER, *WIDER], further_with_pawls, REFUTED),
    ("pillar_length_matters", SHORTER, sticking(0.678), REFUTED),
]


def multiplied(table: Any, factor: float, **wanted: Any) -> dict[Scene, list[Row]]:
    """Multiply all correlations, or lengths, and their intervals where rows have what is wanted."""
    keys = {f"{name}{end}" for name in ("ci", "tail", "residual") for end in ("", "_low", "_high")}
    keys |= {"correlation", "l_c"}

    def change(row: Row) -> Row:
        if any(row[name] != value for name, value in wanted.items()):
            return row
        return {**row, **{k: factor * row[k] for k in keys & set(row)}}

    return {scene: [change(row) for row in rows] for scene, rows in table.items()}


#: Claim, the factor for l_c or c in some rows of the tables, and the verdict then.
FACTORS = [
    ("long_along_short_across", -0.5, {"side": "x"}, REFUTED),
    ("long_along_short_across", 9.0, {"side": "y", "r": 1}, REFUTED),
    ("three_blocks", 0.5, {}, REFUTED),
    ("three_blocks", 0.5, {"n_p": 20}, PARTLY),
    ("three_blocks", 0.88, {"n_p": 20}, "not settled"),
    ("growing_length", 0.5, {"n_p": 60}, REFUTED),
    ("same_length", 0.4, {"n_p": 58}, REFUTED),
    ("same_shape", 0.2, {"n_p": 58, "r": 4}, REFUTED),
    ("same_shape", 0.2, {"n_p": 58, "r": 4, "side": "x"}, PARTLY),
    ("uncorrelated_across", 9.0, {"r": 1, "direction": "y"}, REFUTED),
]

#: Claim, and what makes another stress of that before the first detachment on each scene.
STRESS = [
    ("trivial_stress", lambda scene, field: field * np.linspace(0.5, 1.5, paper.N)),
    ("larger_across", lambda scene, field: field.transpose(0, 2, 1)),
    ("same_stress", lambda scene, field: field * np.linspace(0.5, 1.5, paper.N)),
    ("more_uniform", lambda scene, field: field ** (9.0 if scene.n_p2 else 1.0)),
    ("external_bear_more", lambda scene, field: np.stack([1.0 / field[0], field[1]])),
    ("edges_bear_more_across", lambda scene, field: field * (2.0 if scene == ALONG else 1.0)),
]
#: Tested by themselves: algebra, geometry, errors, very large pillars, and scatter.
_APART = {
    "shear_springs",
    "equal_parts",
    "step_suffices",
    "negligible_edges",
    "front_after_peak",
    "size_like_length",
    "exponential",
}


@pytest.mark.parametrize("name", sorted(set(BY_NAME) - _APART | {"step_suffices"}))
def test_data_as_the_paper_has_them_reproduce_it(name):
    assert judge(BY_NAME[name], paper.evidence(made_for(name))) == "reproduced"


@pytest.mark.parametrize(("name", "scenes", "change", "expected"), CHANGES)
def test_other_realisations_change_the_verdict(name, scenes, change, expected):
    other = paper.evidence(paper.changed(made_for(name), scenes, change))
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


@pytest.mark.parametrize(("share", "expected"), [(0.05, "reproduced"), (0.2, REFUTED)])
@pytest.mark.parametrize("name", ["negligible_edges", "front_after_peak"])
def test_few_blocks_of_very_large_pillars_detach_early(name, share, expected):
    times = np.full((120, 120), np.nan)
    early = np.random.default_rng(0).permutation(3600) < 3600 * share
    times[30:90, 30:90] = np.where(early, 0.9, 1.1).reshape(60, 60)
    scene = Scene(120, 60, 60)
    runs = [replace(records()[k], scene=scene, t_det=times, **peak_at(1.0)) for k in range(3)]
    assert judge(BY_NAME[name], Evidence(records={scene: runs})) == expected


def test_the_springs_of_the_slider_are_those_of_half_the_layer():
    found = list(BY_NAME["shear_springs"].test(paper.evidence(records()[:1])))
    assert [each.estimate.value for each in found] == pytest.approx([2.0, 1.0])
    assert [each.outcome() for each in found] == ["fails", "holds"]


@pytest.mark.parametrize("inside", [1, 16, 36])
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
    known = {f.case["n_p"]: f.outcome() for f in BY_NAME["roundest_peak"].test(evidence)}
    assert set(known.values()) == {"holds"}
    monkeypatch.setattr("springblock.claims.pillars._lowest_of", lambda _, scenes: scenes[:2])
    found = {f.case["n_p"]: f for f in BY_NAME["roundest_peak"].test(evidence)}
    assert len(found) == len(known) + 1  # the lowest itself as well
    may_be_lowest = list(found.values())[:2]
    assert all(np.isinf(each.estimate.ci_high) for each in may_be_lowest)
    assert "fails" not in [each.outcome() for each in may_be_lowest]


@pytest.mark.parametrize(("rise", "outcome"), [(0.1, "holds"), (0.0, "open"), (-0.1, "fails")])
def test_a_slope_is_as_certain_as_its_surfaces_are_alike(rise, outcome, rng):
    """It is that of one length alone, whatever the other does that goes along with it."""
    x = np.arange(10.0)
    beside = 0.5 * x + rng.standard_normal(10)
    found = partial_slope(beside, x, 3.0 * beside + rise * x + 0.1 * rng.standard_normal(10))
    assert found.ci_low < rise < found.ci_high
    assert Finding({}, "slope", found, (0.0, np.inf), "").outcome() == outcome


@pytest.mark.parametrize(("pawls", "expected"), [(5, ["holds", "fails"]), (11, ["fails", "holds"])])
def test_edges_are_half_of_narrow_pawls_or_where_they_are_broad_themselves(pawls, expected):
    scenes = [Scene(paper.N, 23, 25, pawls, 1, direction=direction) for direction in "xy"]
    found = BY_NAME["equal_parts"].test(Evidence(stress=dict.fromkeys(scenes, np.ones(0))))
    assert [each.outcome() for each in found] == expected


@pytest.mark.parametrize(("lowest", "expected"), [(1, "reproduced"), (2, PARTLY)])
def test_where_friction_is_lowest_is_compared_with_l_c_for_every_scatter(
    lowest, expected, monkeypatch
):
    monkeypatch.setattr("springblock.claims.pillars._COMPARED", (2, 6, 24))
    scattered = [replace(scene, varied={"mu_static_std": 0.2}) for scene in PILLARS]
    runs = {scene: [r for r in records() if r.scene == scene] for scene in PILLARS}
    others = {new: runs[old] for new, old in zip(scattered, PILLARS, strict=True)}
    others[scattered[lowest]] = [
        replace(run, normal_force=2.0 * run.normal_force) for run in others[scattered[lowest]]
    ]
    judged = Evidence(records={**runs, **others})
    assert judge(BY_NAME["size_like_length"], judged) == expected


def in_parts(rng: np.random.Generator) -> np.ndarray:
    return paper.by_side(24, rng)


def in_windows(rng: np.random.Generator) -> np.ndarray:
    """Sums over eight neighbours along a side, whose correlation falls along a straight line."""
    drawn = rng.standard_normal((24, 31))
    return np.lib.stride_tricks.sliding_window_view(drawn, 8, axis=1).sum(axis=-1)


@pytest.mark.parametrize(("fields", "expected"), [(in_parts, "reproduced"), (in_windows, REFUTED)])
def test_c_x_is_told_from_other_curves(fields, expected):
    runs, place = [], PILLARS[2].pattern.origins[0]
    for seed in range(300):
        times = np.full((paper.N, paper.N), np.nan)
        times[place[0] : place[0] + 24, place[1] : place[1] + 24] = fields(
            np.random.default_rng(seed)
        )
        runs.append(replace(records()[0], scene=PILLARS[2], t_det=times))
    assert judge(BY_NAME["exponential"], Evidence(records={PILLARS[2]: runs})) == expected


def test_a_bias_beyond_the_scatter_changes_the_verdict():
    biased = Evidence(precision=paper.precision(bias=0.1))
    assert judge(BY_NAME["step_suffices"], biased) == REFUTED


def test_every_verdict_is_seen_to_change():
    assert {name for name, *_ in [*CHANGES, *FACTORS, *STRESS]} | _APART == set(BY_NAME)


@pytest.mark.parametrize("name", BY_NAME)
def test_what_was_not_simulated_is_not_tested(name):
    assert judge(BY_NAME[name], Evidence()) == "not tested"


def test_one_realisation_settles_nothing():
    one = paper.evidence([run for run in of_all_lengths() if run.seed == 0])
    found = {name: judge(BY_NAME[name], one) for name, *_ in CHANGES}
    assert set(found.values()) == {"not settled"}


def test_a_block_is_isolated_while_its_neighbours_rest():
    t_det = np.full((6, 6), 5.0)
    t_det[0, 0], t_det[0, 1], t_det[4, 4] = 1.0, 2.0, 1.0
    run = replace(records()[0], t_det=t_det, **peak_at(4.0))
    assert isolated(run, 1.0) == pytest.approx(2 / 3)
    assert not_all_nucleate.test.__wrapped__(run) == pytest.approx(1 / 3)
    assert np.isnan(isolated(run, 0.1))


def test_surfaces_are_independent_samples_of_any_size():
    found = difference(np.array([1.0, 5.0, 9.0]), np.array([4.0, 8.0]))
    assert (found.value, found.n) == (-1.0, 2)
    assert found.ci_low < -9.0 < 7.0 < found.ci_high  # nothing is gained by seeds in common


def test_a_position_has_no_interval_where_its_ends_are_not_told_apart():
    sample, zero, one = (np.array(s) for s in ([2.0, 3.0], [1.0, 2.0], [51.0, 52.0, 50.0]))
    found = position(sample, zero, one)
    assert found.value == pytest.approx(1.0 / 49.5)
    assert found.ci_low < found.value < found.ci_high
    assert np.isnan(position(sample, zero, zero).ci_low)


@pytest.mark.parametrize(
    ("limits", "expected"),
    [((1.0, 3.0), (1.0, 3.0)), ((-3.0, -1.0), (1.0, 3.0)), ((-3.0, 1.0), (-1.0, 3.0))],
)
def test_a_magnitude_may_be_as_large_as_the_further_end_of_its_interval(limits, expected):
    for sign in (1.0, -1.0):
        low, high = sorted(sign * limit for limit in limits)
        found = magnitude(Estimate((low + high) / 2.0, low, high, 20))
        assert (found.ci_low, found.ci_high) == expected
    assert magnitude(Estimate(0.5, -3.0, 1.0, 20)).ci_high == 3.0


def test_differences_of_intervals_add_errors_or_their_squares():
    first, second = Estimate(5.0, 2.0, 6.0, 20), Estimate(1.0, 0.0, 5.0, 10)
    assert paired_difference(first, second) == Estimate(4.0, -3.0, 6.0, 10)
    found = unpaired_difference(first, second)
    limits = (found.value, found.ci_low, found.ci_high)
    assert limits == pytest.approx((4.0, -1.0, 4.0 + 2.0**0.5))


def test_the_first_patch_is_placed_from_the_edge_to_the_centre():
    times = np.ones((9, 9))
    for y, x, expected in ((0, 3, 0.5 * 24 / 49), (3, 3, 1.0 - 0.5 / 49)):
        early = times.copy()
        early[y : y + 3, x : x + 3] = 0.0
        assert first_patch(early, 3) == pytest.approx(expected)


def test_rates_count_what_detaches_around_a_sample():
    run = replace(records()[0], detachments=np.array([0, 1, 2, 3, 0, 0]), time=np.arange(6.0))
    assert rates(run, 3.0).tolist() == [1.0, 3.0, 6.0, 5.0, 3.0, 0.0]


def test_an_event_ends_where_neighbours_detach_apart():
    times = np.array([[0.500, 0.504, 0.508, 0.600, 0.602], [0.5, 0.6, 0.7, 0.8, 0.9]])
    assert events(times).tolist() == [2, 5]


def test_mixed_sides_keep_each_place_and_take_it_from_another_realisation():
    times = np.arange(3.0)[:, None, None, None] + 10.0 * np.arange(4.0) + np.zeros((3, 2, 2, 4))
    assert mixed(times).shape == times.shape
    assert mixed(times)[1, 1, 0].tolist() == [1.0, 12.0, 20.0, 31.0]


def test_of_several_load_peaks_the_two_most_prominent_count():
    small = peaks((100.0, 0.64), (220.0, 0.62), (300.0, 0.65), (345.0, 0.63))
    run = next(run for run in records() if run.scene == ALONG)
    found = both_peaks(replace(run, **small(run)))
    assert (found.first, found.second) == (100, 300)
    assert both_peaks(replace(run, **peaks((300.0, 0.65))(run))) is None
    assert 240.0 < 1e6 * run.time[both_peaks(run).valley] < 280.0


def test_parts_of_a_grooved_pillar_hold_each_contact_block_once():
    (y, x), size = ALONG.pattern.origins[0], ALONG.n_p
    contact = ALONG.pattern.contact[y : y + size, x : x + size]
    parts = [mask.astype(int) for mask in grooved_parts(ALONG).values()]
    np.testing.assert_array_equal(sum(parts), contact)
    assert edge(contact)[[0, 4, 6], 10].all()  # beside the margin and the first groove
    assert not edge(contact)[2, 10]
