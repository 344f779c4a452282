"""Each claim is reproduced by data made to its measure, and not once they are changed."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from claims import paper
from claims.paper import ACROSS, ALONG, DEEP_ALONG, FLAT, PILLARS
from springblock.claims import CLAIMS
from springblock.claims.correlation import apart, between
from springblock.claims.flat import isolated, lonely
from springblock.claims.grooves import edge, grooved_parts
from springblock.claims.rule import Claim, Evidence, Row, verdict
from springblock.claims.samples import difference, position
from springblock.scene import Scene
from springblock.statistics import Interval
from springblock.tables import Record

BY_NAME = {claim.test.__name__: claim for claim in CLAIMS}


@cache
def records() -> tuple[Record, ...]:
    return tuple(paper.as_in_the_paper())


def judge(claim: Claim, evidence: Evidence) -> str:
    return verdict(list(claim.test(evidence)))[0]


def shifted(microseconds: float) -> Callable[[Record], dict[str, Any]]:
    return lambda run: {"t_max": run.t_max + 1e-6 * microseconds}


def mirrored(run: Record) -> dict[str, Any]:
    """What detached early detaches late."""
    return {"t_det": 2.0 * run.t_avg - run.t_det}


def patch(run: Record) -> dict[str, Any]:
    """All precursors in one spot."""
    t_det = np.maximum(run.t_det, 1.01 * run.t_max)
    t_det[10:20, 10:20] = np.linspace(0.80, 0.89, 100).reshape(10, 10) * run.t_max
    return {"t_det": t_det}


def tilted(run: Record) -> dict[str, Any]:
    """Later at the right of the surface."""
    return {"t_det": run.t_det + 1e-6 * np.arange(paper.N)}


def peaks(*places: tuple[float, float], width: float = 15.0) -> Callable[[Record], dict[str, Any]]:
    def change(run: Record) -> dict[str, Any]:
        time = 1e6 * run.time
        hills = [height * np.exp(-(((time - place) / width) ** 2)) for place, height in places]
        return {"force": sum(hills), "static_friction": max(height for _, height in places)}

    return change


def sticking(friction: float) -> Callable[[Record], dict[str, Any]]:
    return lambda run: {"static_friction": friction + run.static_friction / 100.0}


#: Claim, scenes whose realisations are changed, how, and the verdict then.
CHANGES = [
    ("isolated_precursors", [FLAT], patch, "not reproduced"),
    ("not_all_nucleate", [FLAT], patch, "not reproduced"),
    ("peak_before_average", [FLAT], shifted(9.0), "not reproduced"),
    ("uniform", [FLAT], tilted, "depends on"),
    ("pillars_alike", PILLARS, tilted, "not reproduced"),
    ("small_pillars", PILLARS[:1], peaks((200.0, 0.78), width=40.0), "depends on"),
    ("detachment_order", PILLARS, mirrored, "not reproduced"),
    ("detachment_order", PILLARS[1:2], mirrored, "depends on"),
    ("edges_before_peak", PILLARS, shifted(-100.0), "not reproduced"),
    ("peak_after_average", PILLARS, shifted(-100.0), "not reproduced"),
    ("peak_after_average", PILLARS[2:], shifted(-100.0), "depends on"),
    ("many_precursors", PILLARS, shifted(-250.0), "not reproduced"),
    ("rounded_peak", PILLARS, peaks((300.0, 0.70), width=2.0), "not reproduced"),
    ("rounded_peak", [FLAT], peaks((100.0, 0.80), width=15.0), "depends on"),
    ("intermediate_size", PILLARS[2:], sticking(0.50), "not reproduced"),
    ("sharper_again", PILLARS[2:], peaks((300.0, 0.70), width=90.0), "not reproduced"),
    ("two_peaks", [ALONG], peaks((300.0, 0.65)), "not reproduced"),
    ("two_peaks", [ACROSS], peaks((200.0, 0.65), (300.0, 0.70)), "not reproduced"),
    ("further_levels", [DEEP_ALONG], peaks((300.0, 0.65)), "not reproduced"),
    ("second_peak_decides", [ALONG], peaks((220.0, 0.65), (300.0, 0.60)), "not reproduced"),
    ("rest_between_peaks", [ALONG], mirrored, "not reproduced"),
    ("edges_before_core", [ALONG, ACROSS], mirrored, "not reproduced"),
    ("edges_before_core", [ACROSS], mirrored, "depends on"),
    ("grooved_order", [ALONG], mirrored, "not reproduced"),
    ("across_sticks_better", [ALONG], sticking(0.75), "not reproduced"),
]


def multiplied(table: Any, factor: float, **wanted: Any) -> dict[Scene, list[Row]]:
    """Multiply all correlations, or lengths, and their intervals where rows have what is wanted."""
    keys = {"correlation", "l_c", "ci_low", "ci_high", "tail", "tail_low", "tail_high"}

    def change(row: Row) -> Row:
        if any(row[name] != value for name, value in wanted.items()):
            return row
        return {**row, **{k: factor * row[k] for k in keys & set(row)}}

    return {scene: [change(row) for row in rows] for scene, rows in table.items()}


#: Claim, the factor for l_c or c in some rows of the tables, and the verdict then.
FACTORS = [
    ("long_along_short_across", -0.5, {"side": "x"}, "not reproduced"),
    ("long_along_short_across", 9.0, {"side": "y", "r": 1}, "not reproduced"),
    ("exponential", 2.0, {"r": 4}, "not reproduced"),
    ("three_blocks", 0.5, {}, "not reproduced"),
    ("three_blocks", 0.5, {"n_p": 20}, "depends on"),
    ("three_blocks", 0.9, {"n_p": 20}, "not settled"),
    ("growing_length", 0.5, {"n_p": 60}, "not reproduced"),
    ("same_length", 0.4, {"n_p": 58}, "not reproduced"),
]


@pytest.mark.parametrize("name", BY_NAME)
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


def test_a_bias_beyond_the_scatter_changes_the_verdict():
    biased = Evidence(precision=paper.precision(bias=0.1))
    assert judge(BY_NAME["step_suffices"], biased) == "not reproduced"


def test_every_verdict_is_seen_to_change():
    seen = {name for name, *_ in CHANGES + FACTORS} | {"step_suffices"}
    assert seen == set(BY_NAME)


@pytest.mark.parametrize("name", BY_NAME)
def test_what_was_not_simulated_is_not_tested(name):
    assert judge(BY_NAME[name], Evidence()) == "not tested"


def test_one_realisation_settles_nothing():
    one = [run for run in records() if run.seed == 0]
    judged = {judge(BY_NAME[name], paper.evidence(one)) for name, *_ in CHANGES}
    assert judged == {"not settled"}


def test_a_block_is_isolated_while_its_neighbours_rest():
    t_det = np.full((6, 6), 5.0)
    t_det[0, 0], t_det[0, 1], t_det[4, 4] = 1.0, 2.0, 1.0
    run = replace(records()[0], t_det=t_det, t_max=4.0)
    assert isolated(run, 1.0) == pytest.approx(2 / 3)
    assert lonely(run) == pytest.approx(1 / 3)
    assert np.isnan(isolated(run, 0.1))


def test_samples_are_compared_seed_by_seed():
    first, second = {0: 1.0, 1: 5.0, 2: 9.0}, {1: 4.0, 2: 8.0, 7: 0.0}
    assert tuple(difference(first, second)) == (1.0, 1.0, 1.0)
    assert tuple(position({0: 2.0, 1: 3.0}, {0: 1.0, 1: 2.0}, {0: 5.0, 1: 6.0})) == (0.25,) * 3


def test_differences_of_intervals_add_errors_or_their_squares():
    numbers = ((5.0, 2.0, 6.0), (1.0, 0.0, 5.0))
    first, second = (Interval(*map(np.array, three)) for three in numbers)
    assert tuple(apart(first, second)) == (4.0, -3.0, 6.0)
    assert tuple(between(first, second)) == pytest.approx((4.0, -1.0, 4.0 + 2.0**0.5))


def test_parts_of_a_grooved_pillar_hold_each_contact_block_once():
    (y, x), size = ALONG.pattern.origins[0], ALONG.n_p
    contact = ALONG.pattern.contact[y : y + size, x : x + size]
    parts = [mask.astype(int) for mask in grooved_parts(ALONG).values()]
    np.testing.assert_array_equal(sum(parts), contact)
    assert edge(contact)[[0, 4, 6], 10].all()  # beside the margin and the first groove
    assert not edge(contact)[2, 10]
