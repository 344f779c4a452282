"""Quantities of realisations, and parts of surfaces, that statements are tested with."""

from dataclasses import replace
from operator import attrgetter

import numpy as np
import pytest

from springblock import compute_prelude
from springblock.model.scene import Scene
from springblock.simulation.peaks import Peaks
from springblock.study.claims.flat import (
    ensemble_error,
    single_events,
    starts_no_front,
    strain_left,
)
from springblock.study.claims.grooves import (
    over_all,
    over_most,
    prominent,
    rate_between,
    slips_again,
    unevenness,
)
from springblock.study.claims.rule import ENOUGH, Evidence
from springblock.study.claims.samples import compared, difference, isolated, mean, position
from springblock.study.claims.sides import correlated_along
from springblock.study.claims.table import judged
from study.claims import paper
from study.claims.paper import ACROSS, ALONG, FLAT, PLAIN

RUN = paper.record(FLAT, 0)


def test_statements_are_tested_on_scenes_with_enough_realisations():
    runs = [paper.record(FLAT, seed) for seed in range(ENOUGH)]
    assert {ENOUGH} == {row["realisations"] for row in judged(runs)} - {0}
    assert {row["realisations"] for row in judged(runs[1:])} == {0}


def test_a_block_is_isolated_while_its_neighbours_rest():
    t_det = np.full((6, 6), 5.0)
    t_det[0, 0], t_det[0, 1], t_det[4, 4] = 1.0, 2.0, 1.0
    run = replace(RUN, t_det=t_det, time=4.0 * np.arange(3.0), force=np.array([0.0, 1.0, 0.0]))
    assert isolated(run) == pytest.approx(2 / 3)
    assert single_events(run) == pytest.approx(1 / 2)
    assert np.isnan(isolated(replace(run, time=0.4 * np.arange(3.0))))


def test_one_surface_slid_in_two_directions_is_compared_seed_by_seed():
    """What differs from seed to seed, but not between the directions, adds no scatter."""
    drawn, gain = 8.0 * np.arange(5.0), np.array([1.0, 3.0, 2.0, 3.0, 1.0])
    runs = {
        scene: [replace(RUN, seed=k, normal_force=force[k]) for k in range(5)]
        for scene, force in ((ALONG, drawn), (ACROSS, drawn + gain), (PLAIN, drawn + gain))
    }
    evidence, force = Evidence(runs | {ALONG: runs[ALONG][::-1]}), attrgetter("normal_force")
    found = [compared(evidence, "", force, (scene, ALONG)).estimate for scene in (ACROSS, PLAIN)]
    assert found == [mean(gain), difference(drawn + gain, drawn)]


def test_a_position_has_no_interval_where_its_ends_are_not_told_apart():
    sample, zero, one = (np.array(s) for s in ([2.0, 3.0], [1.0, 2.0], [51.0, 52.0, 50.0]))
    found = position(sample, zero, one)
    assert found.value == pytest.approx(1.0 / 49.5)
    assert found.ci_low < found.value < found.ci_high
    assert found.n == 2  # that of the smallest sample
    assert np.isnan(position(sample, zero, zero).ci_low)
    assert np.isnan(position(sample[:1], zero, one).value)


def test_the_first_block_of_a_front_is_the_precursor_that_started_it():
    """When half of the blocks have detached there is one front of 24 blocks, and a cluster of 9."""
    t_det = np.full((8, 8), 9.0)
    t_det[:4, :6] = t_det[5:8, 5:8] = 4.0
    t_det[0, 0], t_det[3, 5], t_det[5, 5] = 1.0, 2.0, 3.0
    t_det[7, 0] = 6.0  # half of all blocks have detached at 5
    run = replace(RUN, t_det=t_det, time=5.0 * np.arange(3.0), force=np.array([0.0, 1.0, 0.0]))
    assert starts_no_front(run) == pytest.approx(32 / 33)


def test_events_along_the_sliding_direction_hold_whole_sides():
    """In each run all blocks of a row detach together, and rows one after another.

    Two of three runs are equal: of four blocks from different runs, two along x detach together.
    """
    scene = paper.PILLARS[1]
    rows = 0.02 * np.arange(paper.N)[:, None] + np.zeros(paper.N)
    made = paper.record(scene, 0)
    runs = [replace(made, t_det=(0.2 + late + rows) * made.t_max) for late in (0.0, 0.0, 0.3)]
    (found,) = correlated_along(Evidence(records={scene: runs}))
    assert found.estimate.value == pytest.approx((4.0 - 4.0 / 3.0) - (1.0 - 1.0))


def test_a_run_that_has_ended_keeps_its_last_force_in_the_mean():
    """It lies below the load peaks, which the mean over the runs that go on would shift."""
    whole, ends = [paper.record(ALONG, seed) for seed in range(4)], (400, 400, 380, 500)
    ended = [replace(run, force=run.force[:end]) for run, end in zip(whole, ends, strict=True)]
    one, other = (
        prominent(Evidence(records={ALONG: runs}), ALONG, (0.0, 1.0)).estimate
        for runs in (whole, ended)
    )
    assert other.value == pytest.approx(one.value, rel=1e-3)


def test_the_mean_detachment_rate_is_that_from_the_first_to_the_last():
    """Nine of eleven blocks detach in 8 s; the deciles are at 20 and 28 s."""
    times = np.array([5.0, *range(20, 29), 50.0, np.nan])
    curves = {"time": 2.0 * np.arange(4.0), "force": np.eye(4)[2]}
    run = replace(RUN, t_det=times, detachments=np.array([0, 3, 1, 0]), **curves)
    twice = run, Peaks(1, 2, 3)
    assert rate_between(*twice) == pytest.approx(4.0 / 4.0)
    assert over_all(twice) == pytest.approx(45.0 / 11.0)
    assert over_most(twice) == pytest.approx(8.0 / (0.8 * 11.0))


def test_strain_that_is_left_is_not_that_which_replaces_it():
    rng = np.random.default_rng(0)
    old, new = (np.cumsum(rng.standard_normal((60, 60)), axis=1) for _ in "on")
    fields = np.zeros((3, 2, 60, 60))
    fields[:, 0] = old, 0.5 * old + 0.1, new
    left, scatter = strain_left(replace(RUN, snapshots=fields), 0)
    assert left == pytest.approx([1.0, 0.5, 0.0], abs=0.05)
    assert scatter == pytest.approx([1.0, 0.5, 1.0], abs=0.05)


def test_further_slips_are_divided_by_the_blocks_detached_at_the_lowest_force():
    """Two of four blocks have detached at sample 2; from the first peak on, 3 - 1 slips are new."""
    curves = {"time": np.arange(5.0), "switches": np.array([9, 2, 1, 9, 9])}
    run = replace(RUN, t_det=np.array([1.0, 2.0, 3.0, np.nan]), **curves)
    run = replace(run, detachments=np.array([0, 1, 0, 0, 0]))
    assert slips_again((run, Peaks(1, 2, 3))) == pytest.approx(2 / 2)


def test_the_stress_before_any_slip_follows_from_elasticity():
    scene = Scene(12, 4, 2)
    peak = compute_prelude(scene.contact, direction="x").peak[-1]
    computed = np.sqrt(peak)
    found = unevenness(scene)
    assert found == pytest.approx(computed.std() / computed.mean(), rel=0.02)
    assert unevenness(Scene(12)) == pytest.approx(0.0, abs=1e-9)


def test_the_ensemble_error_falls_with_the_root_of_the_number_of_seeds():
    scatter = {"ci_low": -0.01984217, "ci_high": 0.01984217, "realisations": 100}
    assert ensemble_error(scatter, 100) == pytest.approx(0.01, rel=1e-6)
    assert ensemble_error(scatter, 25) == pytest.approx(0.02, rel=1e-6)
