"""Skipping rows and blocks at rest, and friction outside the contact, changes no bit."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from springblock import Material, Pattern, Surface, draw_friction
from springblock.solver import leapfrog
from springblock.solver.integrators import LEAPFROG
from springblock.solver.lattice import Samples, band_from, prepare
from springblock.solver.loop import advance
from springblock.solver.springs import Scratch

STEP, EVERY = 2e-8, 10
#: Loads ten times faster than the paper's, so that a few thousand steps show a whole run.
FAST = Material(slider_velocity=5e-3)


def random_contact(n_y, n_x, share):
    contact = np.random.default_rng(3).random((n_y, n_x)) < share
    contact[n_y // 2] = False  # a row without contact among others
    return contact


SURFACES = {
    "flat": Pattern.flat(12).contact,
    "pillars": Pattern.pillars(12, 3, 3).contact,
    "grooves": Pattern.pillars(14, 8, 6).grooved(2, 1, along="x").contact,
    "random": random_contact(13, 13, 0.6),
    "oblong": random_contact(9, 21, 0.6),
    "narrow": random_contact(23, 3, 0.8),
    "one block": np.outer([0, 1, 0], [0, 1, 0]).astype(bool),
}


def start(contact, seed, material=FAST, periodic=False):
    n_y, n_x = contact.shape
    mu = (field[:n_y, :n_x] for field in draw_friction(max(n_y, n_x), seed))
    surface = Surface(contact, *mu, periodic=periodic)
    return prepare(surface, material, (0.8, 0.6), LEAPFROG, STEP)


def follow(state, constants, steps):
    samples = Samples.empty(steps // EVERY)
    assert advance(LEAPFROG, state, constants, 0, steps, EVERY, samples)[0] == steps
    return samples


def step_by_step(state, constants, steps):
    """Follow a state in calls of one step, each of which begins with all rows awake, none held."""
    taken = [Samples.empty(1) for _ in range(steps)]
    for k, sample in enumerate(taken):
        assert advance(LEAPFROG, state, constants, k, 1, 1, sample)[0] == 1
    force_x, force_y, switches = (np.concatenate(each) for each in zip(*taken, strict=True))
    ends = slice(EVERY - 1, None, EVERY)
    return Samples(force_x[ends], force_y[ends], switches.reshape(-1, EVERY).sum(axis=1))


def assert_same_to_the_bit(one, other, fields):
    for name in fields:
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name), err_msg=name)


MOTION = ("ux", "uy", "vx", "vy", "t_det")
WEAKENING = {
    "slip": replace(FAST, law="slip_weakening", slip_distance=2e-8),
    "no healing": replace(FAST, law="slip_weakening", slip_distance=2e-8, healing="none"),
    "velocity": replace(FAST, law="velocity_weakening", speed_scale=0.1),
}


@pytest.mark.parametrize(("periodic", "band"), [(False, None), (True, 2)])
@pytest.mark.parametrize("surface", SURFACES)
def test_skipping_what_is_at_rest_changes_no_bit(surface, periodic, band):
    """Results do not depend on the rows per band, either; None is the default, all rows."""
    restless, constants = start(SURFACES[surface], 0, periodic=periodic)
    quick, _ = start(SURFACES[surface], 0, periodic=periodic)
    banded = constants if band is None else constants._replace(band_rows=np.uint64(band))
    plain, samples = step_by_step(restless, constants, 4000), follow(quick, banded, 4000)
    assert np.isfinite(quick.blocks.t_det).any()  # something has happened
    assert_same_to_the_bit(restless.blocks, quick.blocks, MOTION)
    assert_same_to_the_bit(restless, quick, ("ledger",))
    assert_same_to_the_bit(plain, samples, Samples._fields)


@pytest.mark.parametrize("law", WEAKENING)
@pytest.mark.parametrize("surface", ["pillars", "random"])
def test_skipping_what_is_at_rest_changes_no_bit_under_weakening_friction(surface, law):
    restless, constants = start(SURFACES[surface], 0, material=WEAKENING[law])
    quick, _ = start(SURFACES[surface], 0, material=WEAKENING[law])
    step_by_step(restless, constants, 4000)
    follow(quick, constants, 4000)
    assert np.isfinite(restless.blocks.t_det).any()
    assert_same_to_the_bit(restless.blocks, quick.blocks, MOTION)
    assert_same_to_the_bit(restless, quick, ("ledger",))


def test_a_broken_spring_is_found_wherever_it_is():
    """Also where it is NaN."""
    for broken, row, column in product((np.nan, 1.0), (0, 6, 7, 11), (1, 6, 12)):
        state, constants = start(SURFACES["flat"], 0)
        state.blocks.ux.reshape(12, -1)[row, column] = broken
        constants = constants._replace(band_rows=np.uint64(2))
        done, y, x = advance(LEAPFROG, state, constants, 0, 10, 10, Samples.empty(1))
        assert done == 0
        assert abs(y - row) <= 1
        assert abs(x - (column - 1)) <= 1


def test_a_row_at_rest_is_skipped_until_a_block_may_detach():
    """Its blocks are at rest and free of force; only the slider loads them."""
    state, constants = start(SURFACES["flat"], 0, material=Material())
    follow(state, constants, EVERY)  # the blocks of this slow scene stay at rest for long
    rows, blocks = leapfrog.make_rows(SURFACES["flat"], False), state.blocks
    assert not any(field.any() for field in (blocks.ux, blocks.uy, blocks.vx, blocks.vy))
    pull = constants.springs.k_s * np.hypot(constants.slider_x, constants.slider_y)
    rows.sliding[:] = False
    band = band_from(np.uint64(0), constants)
    leapfrog._settle_rows(blocks, None, rows, band, Scratch.empty(), pull, 0)
    sure = rows.due[0]
    assert sure == pytest.approx(blocks.static[1:13].min() / pull, rel=1e-3)
    rows.due[:] = sure
    leapfrog.wake(rows, sure - 1, False)
    assert not rows.awake.any()
    leapfrog.wake(rows, sure, False)
    assert rows.awake[:12].all()


@pytest.mark.parametrize("surface", ["grooves", "random"])
def test_skipping_friction_in_rows_without_contact_changes_no_bit(surface, monkeypatch):
    """In the reference all rows are treated as in contact; blocks outside it have no friction.

    Sums over rows may be taken in another order and differ by rounding.
    """
    (short, constants), (full, _) = (start(SURFACES[surface], 2) for _ in range(2))
    quick, make = follow(short, constants, 4000), leapfrog.make_rows

    def in_contact(contact, periodic):
        rows = make(contact, periodic)
        assert not rows.in_contact.all()
        return rows._replace(in_contact=np.ones_like(rows.in_contact))

    monkeypatch.setattr(leapfrog, "make_rows", in_contact)
    plain = step_by_step(full, constants, 4000)
    assert np.isfinite(short.blocks.t_det).any()
    assert_same_to_the_bit(short.blocks, full.blocks, MOTION)
    np.testing.assert_array_equal(quick.switches, plain.switches)
    for one, other in zip((*quick[:2], short.ledger), (*plain[:2], full.ledger), strict=True):
        np.testing.assert_allclose(one, other, rtol=0, atol=1e-13 * np.abs(other).max())
