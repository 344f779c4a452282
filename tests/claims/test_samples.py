"""Quantities of realisations, and parts of surfaces, that statements are tested with."""

from dataclasses import replace

import numpy as np
import pytest

from claims import paper
from claims.paper import ACROSS, ALONG, FLAT, PLAIN, peaks
from springblock import draw_friction
from springblock.analysis.estimate import Estimate
from springblock.claims.flat import (
    fronts,
    localized_stick_slip,
    not_all_nucleate,
    single_events,
    strain_left,
    weakest_first,
)
from springblock.claims.grooves import across_sticks_better
from springblock.claims.load_peaks import (
    both_peaks,
    main_rate,
    mean_rate,
    rate_between,
    slips_again,
    small_force_suffices,
)
from springblock.claims.pillars import _over_t_avg, _rings
from springblock.claims.rule import Evidence
from springblock.claims.samples import (
    compared,
    difference,
    first_patch,
    isolated,
    magnitude,
    mean,
    position,
    rates,
)
from springblock.claims.sides import (
    larger_events,
    misfits,
    mixed,
    paired_difference,
)
from springblock.claims.stress import elastic_forces
from springblock.claims.surfaces import core, edge, from_edge, grooved_parts, pillars_of
from springblock.model.material import Material
from springblock.model.scene import Scene

RUN = paper.record(FLAT, 0)


def test_a_block_is_isolated_while_its_neighbours_rest():
    t_det = np.full((6, 6), 5.0)
    t_det[0, 0], t_det[0, 1], t_det[4, 4] = 1.0, 2.0, 1.0
    run = replace(RUN, t_det=t_det, time=4.0 * np.arange(3.0), force=np.array([0.0, 1.0, 0.0]))
    assert isolated(run) == pytest.approx(2 / 3)
    assert not_all_nucleate.__wrapped__(run) == pytest.approx(1 / 3)
    assert single_events(run) == pytest.approx(1 / 2)
    assert np.isnan(isolated(replace(run, time=0.4 * np.arange(3.0))))


def test_the_m_blocks_that_go_first_are_compared_with_the_m_weakest():
    """Three go first: the two weakest, and the fourth in place of the third."""
    weakest = np.argsort(draw_friction(6, RUN.seed, RUN.material)[0], axis=None)
    t_det = np.full(36, 5.0)
    t_det[weakest[[0, 1, 3]]] = 1.0
    curve = {"time": 4.0 * np.arange(3.0), "force": np.array([0.0, 1.0, 0.0])}
    run = replace(RUN, t_det=t_det.reshape(6, 6), **curve)
    assert weakest_first.__wrapped__(run) == pytest.approx(2 / 3)


def test_one_surface_slid_in_two_directions_is_compared_seed_by_seed():
    """What differs from seed to seed, but not between the directions, adds no scatter."""
    drawn, gain = 8.0 * np.arange(5.0), np.array([1.0, 3.0, 2.0, 3.0, 1.0])
    forces = {ALONG: drawn, ACROSS: drawn + gain, PLAIN: drawn + gain}
    runs = {
        scene: [replace(RUN, scene=scene, seed=k, normal_force=force[k]) for k in range(5)]
        for scene, force in forces.items()
    }
    evidence = Evidence(records=runs | {ALONG: runs[ALONG][::-1]})
    first, second = (
        compared(evidence, "", lambda run: run.normal_force, scene, ALONG).estimate
        for scene in (ACROSS, PLAIN)
    )
    assert first == mean(gain)
    assert second == difference(forces[PLAIN], drawn)


def test_a_position_has_no_interval_where_its_ends_are_not_told_apart():
    sample, zero, one = (np.array(s) for s in ([2.0, 3.0], [1.0, 2.0], [51.0, 52.0, 50.0]))
    found = position(sample, zero, one)
    assert found.value == pytest.approx(1.0 / 49.5)
    assert found.ci_low < found.value < found.ci_high
    assert found.n == 2  # that of the smallest sample
    assert np.isnan(position(sample, zero, zero).ci_low)
    assert np.isnan(position(sample[:1], zero, one).value)


def test_a_magnitude_may_be_as_large_as_the_further_end_of_its_interval():
    for (low, high), expected in (
        ((1.0, 3.0), (1.0, 3.0)),
        ((-3.0, -1.0), (1.0, 3.0)),
        ((-3.0, 1.0), (-1.0, 3.0)),
    ):
        found = magnitude(Estimate((low + high) / 2.0, low, high, 20))
        assert (found.ci_low, found.ci_high) == expected


def test_differences_of_the_same_runs_add_errors():
    first, second = Estimate(5.0, 2.0, 6.0, 20), Estimate(1.0, 0.0, 5.0, 10)
    assert paired_difference(first, second) == Estimate(4.0, -3.0, 6.0, 10)


def test_the_first_patch_is_placed_from_the_edge_to_the_centre():
    times = np.ones((9, 9))
    for y, x, expected in ((0, 3, 0.5 * 24 / 49), (3, 3, 1.0 - 0.5 / 49)):
        early = times.copy()
        early[y : y + 3, x : x + 3] = 0.0
        assert first_patch(early, 3) == pytest.approx(expected)


def test_rates_count_what_detaches_around_a_sample():
    run = replace(RUN, detachments=np.array([0, 1, 2, 3, 0, 0]), time=np.arange(6.0))
    assert rates(run, 3.0).tolist() == [1.0, 3.0, 6.0, 5.0, 3.0, 0.0]


def test_a_front_has_more_than_twenty_blocks():
    """When half of the blocks have detached: two of 54 and 54 blocks, and a cluster of 20."""
    t_det = np.full((16, 16), 9.0)
    t_det[:6, :9] = t_det[9:15, :9] = t_det[:4, 11:] = 4.0
    assert fronts(replace(RUN, t_det=t_det)) == 2


def test_times_may_be_divided_by_t_avg():
    run = replace(RUN, t_det=np.full((6, 6), 8.0), time=4.0 * np.arange(3.0), force=np.eye(3)[1])
    assert _over_t_avg(lambda run: 3.0 / run.t_max)(run) == pytest.approx(3.0 / 8.0)


def test_events_along_the_sliding_direction_hold_whole_sides():
    """In each run all blocks of a row detach together, and rows one after another.

    Two of three runs are equal: of four blocks from different runs, two along x detach together.
    """
    scene = paper.PILLARS[1]
    rows = 0.02 * np.arange(paper.N)[:, None] + np.zeros(paper.N)
    made = paper.record(scene, 0)
    runs = [replace(made, t_det=(0.2 + late + rows) * made.t_max) for late in (0.0, 0.0, 0.3)]
    (found,) = larger_events(Evidence(records={scene: runs}))
    assert found.estimate.value == pytest.approx((4.0 - 4.0 / 3.0) - (1.0 - 1.0))


def test_mixed_sides_keep_each_place_and_take_it_from_another_realisation():
    times = np.arange(3.0)[:, None, None, None] + 10.0 * np.arange(4.0) + np.zeros((3, 2, 2, 4))
    assert mixed(times).shape == times.shape
    assert mixed(times)[1, 1, 0].tolist() == [1.0, 12.0, 20.0, 31.0]


def test_of_several_load_peaks_the_two_most_prominent_count():
    small = peaks((100.0, 0.64), (220.0, 0.62), (300.0, 0.65), (345.0, 0.645))
    run = paper.record(ALONG, 0)
    found = both_peaks(replace(run, **small(run)))
    assert (found.first, found.second) == (100, 300)
    assert both_peaks(replace(run, **peaks((300.0, 0.65))(run))) is None
    assert 240.0 < 1e6 * run.time[both_peaks(run).valley] < 280.0


def test_the_force_grows_to_the_second_load_peak_by_a_part_of_its_drop():
    run = paper.record(ALONG, 0)
    found = both_peaks(replace(run, **peaks((220.0, 0.66), (300.0, 0.60), width=40.0)(run)))
    growth = found.run.force[found.second] - found.lowest
    drop = found.run.force.max() - 0.05 * found.run.normal_force  # to mu_dynamic
    assert small_force_suffices.__wrapped__(found) == pytest.approx(growth / drop)


def test_the_mean_detachment_rate_is_that_from_the_first_to_the_last():
    times = np.array([5.0, *range(20, 29), 50.0, np.nan])
    run = replace(RUN, t_det=times)
    assert mean_rate(run) == pytest.approx(11.0 / 45.0)
    # nine of eleven detach in 8 s; the deciles are at 20 and 28 s
    assert main_rate(run) == pytest.approx(0.8 * 11.0 / 8.0)


def test_strain_that_is_left_is_not_that_which_replaces_it():
    rng = np.random.default_rng(0)
    old, new = (np.cumsum(rng.standard_normal((60, 60)), axis=1) for _ in "on")
    fields = np.zeros((3, 2, 60, 60))
    fields[:, 0] = old, 0.5 * old + 0.1, new
    left, scatter = strain_left(replace(RUN, snapshots=fields), 0)
    assert left == pytest.approx([1.0, 0.5, 0.0], abs=0.05)
    assert scatter == pytest.approx([1.0, 0.5, 1.0], abs=0.05)


def test_stick_slip_is_counted_from_the_force_minimum_to_the_fall_after_the_next_maximum():
    force = np.interp(np.arange(101.0), [0, 10, 20, 40, 60, 100], [0.0, 1.0, 0.2, 0.8, 0.4, 0.4])
    end = 40 + int(np.argmax(force[40:] < force[20:].mean()))
    switches = np.where((np.arange(101) >= 20) & (np.arange(101) < end), 1, 0)
    times = np.full((6, 6), 1e-5)
    times[:2], times[-2:] = 0.9e-5, 1.1e-5
    curves = {"force": force, "time": 1e-6 * np.arange(101.0), "t_det": times}
    run = replace(RUN, contact=np.ones((6, 6), bool), switches=switches, **curves)
    durations = (end - 20) / 2.0
    assert localized_stick_slip.__wrapped__(run) == pytest.approx((end - 20) / 36 / durations)
    later = replace(run, switches=switches + 5 * (np.arange(101) >= end))
    assert localized_stick_slip.__wrapped__(later) == localized_stick_slip.__wrapped__(run)


def test_only_grooves_of_two_blocks_or_less_are_narrow():
    scenes = [Scene(48, n_p2=8, n_s2=width, direction=way) for width in (2, 4) for way in "xy"]
    runs = [replace(RUN, seed=seed) for seed in range(3)]
    found = across_sticks_better(Evidence(records=dict.fromkeys(scenes, runs)))
    assert [each.case.n_s2 for each in found] == [2]


def test_further_slips_are_divided_by_the_blocks_detached_at_the_lowest_force():
    run = paper.record(ALONG, 0)
    run = replace(run, **peaks((220.0, 0.60), (300.0, 0.65))(run))
    between = (run.time >= 2.2e-4) & (run.time < 3.0e-4)
    times = np.linspace(1.5e-4, 3.3e-4, run.t_det.size).reshape(run.t_det.shape)
    run = replace(run, t_det=times, switches=run.detachments + between)
    found = both_peaks(run)
    detached = np.count_nonzero(run.t_det <= run.time[found.valley])
    assert detached < np.count_nonzero(run.t_det <= run.time[found.second])
    slips = np.count_nonzero(between[found.first : found.second])
    assert slips_again.__wrapped__(found) == pytest.approx(slips / detached)


def test_rates_between_load_peaks_are_per_second():
    run = paper.record(ALONG, 0)
    run = replace(run, **peaks((220.0, 0.60), (300.0, 0.65))(run))
    detachments = np.where(run.time < 2.5e-4, 1, 3)
    found = both_peaks(replace(run, detachments=detachments))
    total = detachments[found.first : found.second].sum()
    assert rate_between(found) == pytest.approx(total / found.apart)


def test_parts_of_a_grooved_pillar_hold_each_contact_block_once():
    contact, edges = (pillars_of(each, ALONG)[0] for each in (ALONG.contact, edge(ALONG.contact)))
    parts = [mask.astype(int) for mask in grooved_parts(ALONG).values()]
    np.testing.assert_array_equal(sum(parts), contact)
    assert edges[[0, 4, 6], 10].all()  # beside the margin and the first groove
    assert not edges[2, 10]


def test_blocks_at_the_border_of_a_surface_bear_what_those_inside_bear():
    """They are no edge: no neighbour without contact pulls on them, as it does beside a groove."""
    grooves = Scene(12, n_p2=4, n_s2=2)
    forces = np.hypot(*elastic_forces(grooves, Material()))
    inside, edges = (each(grooves.contact) for each in (core, edge))
    border = inside & (from_edge(12) == 0)
    assert border.any()
    np.testing.assert_allclose(forces[border], forces[inside].mean(), rtol=1e-9)
    assert forces[edges].min() > 1.1 * forces[inside].max()


@pytest.mark.parametrize(("n_p", "rings"), [(4, 1), (5, 2), (6, 2)])
def test_a_pillar_has_a_second_ring_if_it_has_a_centre_within(n_p, rings):
    assert len(list(_rings(n_p))) == rings


def test_each_kind_of_curve_fits_itself_best():
    r = np.arange(1.0, 7.0)
    curves = np.exp(-r / 3.0), (1.0 + r) ** -0.5, np.maximum(0.0, 1.0 - r / 8.0)
    for kind, distances in enumerate(zip(*misfits(0.7 * np.array(curves)), strict=True)):
        assert np.argmin(distances) == kind
        assert distances[kind] < 5e-3  # lengths are tried 3.5 % apart
