"""Skipping rows and blocks at rest, and friction outside the contact, changes no bit."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from springblock import Material, Pattern, Surface
from springblock.solver.integrators import LEAPFROG
from springblock.solver.lattice import Samples, prepare
from springblock.solver.loop import advance

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


def start(contact, material=FAST, periodic=False):
    surface = Surface.draw(contact, seed=0, periodic=periodic)
    return prepare(surface, material, (0.8, 0.6), LEAPFROG, STEP)


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


LAWS = {
    "coulomb": FAST,
    "slip": replace(FAST, law="slip_weakening", slip_distance=2e-8),
    "no healing": replace(FAST, law="slip_weakening", slip_distance=2e-8, healing="none"),
    "velocity": replace(FAST, law="velocity_weakening", speed_scale=0.1),
}


@pytest.mark.parametrize(
    ("surface", "law", "periodic", "band"),
    [
        *product(SURFACES, ["coulomb"], [False], [None]),
        *product(SURFACES, ["coulomb"], [True], [2]),
        *product(["random"], LAWS, [False], [None]),
    ],
)
def test_skipping_what_is_at_rest_changes_no_bit(surface, law, periodic, band):
    """Results do not depend on the rows per band, either; None is the default, all rows."""
    (restless, constants), (quick, _) = (
        start(SURFACES[surface], LAWS[law], periodic) for _ in range(2)
    )
    banded = constants if band is None else constants._replace(band_rows=np.uint64(band))
    plain, samples = step_by_step(restless, constants, 4000), Samples.empty(4000 // EVERY)
    assert advance(LEAPFROG, quick, banded, 0, 4000, EVERY, samples)[0] == 4000
    assert np.isfinite(quick.blocks.t_det).any()  # something has happened
    assert_same_to_the_bit(restless.blocks, quick.blocks, ("ux", "uy", "vx", "vy", "t_det"))
    assert_same_to_the_bit(restless, quick, ("ledger",))
    assert_same_to_the_bit(plain, samples, Samples._fields)


def test_a_broken_spring_is_found_wherever_it_is():
    """Also where it is NaN."""
    for broken, row, column in product((np.nan, 1.0), (0, 6, 7, 11), (1, 6, 12)):
        state, constants = start(SURFACES["flat"])
        state.blocks.ux.reshape(12, -1)[row, column] = broken
        constants = constants._replace(band_rows=np.uint64(2))
        done, y, x = advance(LEAPFROG, state, constants, 0, 10, 10, Samples.empty(1))
        assert done == 0
        assert abs(y - row) <= 1
        assert abs(x - (column - 1)) <= 1
