"""Several cores give the same bits as one."""

from dataclasses import replace

import numpy as np
import pytest

from springblock import Material, Pattern, Setup, Surface, compute_prelude, draw_friction, simulate
from springblock.solver.integrators import LEAPFROG
from springblock.solver.lattice import Samples, prepare
from springblock.solver.loop import advance

SURFACES = {
    "flat": Pattern.flat(30).contact,
    "pillared": Pattern.pillars(30, 10, 5).contact,
    "grooved": Pattern.pillars(30, 28, 2).grooved(8, 2).contact,
    "small": Pattern.flat(3).contact,
    "oblong": Pattern.pillars(30, 10, 5).contact[:, :11],
}
FAST = Material(slider_velocity=0.05)  # blocks detach, stop and detach again within µs
STEPS, EVERY = 400, 10


def start(name, band_rows, periodic=False):
    contact, step = SURFACES[name], 2e-8
    coefficients = (mu[:, : contact.shape[1]] for mu in draw_friction(len(contact), seed=0))
    surface, heading = (
        Surface(contact, *coefficients, periodic=periodic),
        (np.cos(0.3), np.sin(0.3)),
    )
    state, constants = prepare(surface, FAST, heading, LEAPFROG, step)
    return state, constants._replace(band_rows=np.uint64(band_rows))


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("name", SURFACES)
@pytest.mark.parametrize(("band_rows", "cores"), [(1, 3), (2, 2), (2, 40), (7, 1), (7, 3)])
def test_every_bit_is_as_on_one_core(name, periodic, band_rows, cores):
    """With one, two or more bands per share."""
    alone, together = (start(name, band_rows, periodic=periodic) for _ in range(2))
    samples, others = (Samples.empty(STEPS // EVERY) for _ in range(2))
    assert advance(LEAPFROG, *alone, 0, STEPS, EVERY, samples) == (STEPS, -1, -1)
    assert advance(LEAPFROG, *together, 0, STEPS, EVERY, others, cores) == (STEPS, -1, -1)
    for one, other in zip(
        (*alone[0].blocks, alone[0].ledger, *samples),
        (*together[0].blocks, together[0].ledger, *others),
        strict=True,
    ):
        np.testing.assert_array_equal(one, other)
    first = np.isfinite(alone[0].blocks.t_det).sum()
    assert samples.switches.sum() > first > 0  # some detach again


def test_every_bit_is_as_on_one_core_under_weakening_friction():
    """Each core updates the slip of its own blocks."""
    weakening = replace(FAST, law="slip_weakening", slip_distance=2e-8)
    surface = Surface.draw(SURFACES["pillared"], seed=0)
    one, other = (simulate(surface, Setup(weakening), duration=6e-6, cores=k) for k in (1, 2))
    assert one.switches.sum() > 100
    for name in ("force", "t_det", "switches", "displacement", "velocity"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name))


@pytest.mark.parametrize("column", [1, 6])
@pytest.mark.parametrize(("row", "cores"), [(0, 2), (6, 1), (7, 3), (29, 2)])
def test_a_broken_spring_is_found_wherever_it_is(row, cores, column):
    """In the first band of a share, in its last one, and between them."""
    state, constants = start("flat", 2)
    state.blocks.ux.reshape(30, -1)[row, column] = np.nan
    done, y, x = advance(LEAPFROG, state, constants, 0, 10, 10, Samples.empty(1), cores)
    assert done == 0
    assert abs(y - row) <= 1
    assert x == max(column - 2, 0)  # its western neighbour tears, too, and comes first


def test_a_prelude_and_a_run_from_it_are_the_same_on_several_cores():
    pattern = Pattern.pillars(60, 20, 10)
    surface = Surface.draw(pattern.contact, seed=1)
    preludes = [compute_prelude(pattern.contact, cores=cores) for cores in (1, 2)]
    np.testing.assert_array_equal(*(prelude.peak for prelude in preludes))
    alone, together = (
        simulate(surface, cores=cores, prelude=preludes[0], duration=1.5e-4) for cores in (1, 2)
    )
    np.testing.assert_array_equal(alone.t_det, together.t_det)
    np.testing.assert_array_equal(alone.force, together.force)
    assert alone.energy == together.energy


@pytest.mark.parametrize(
    ("cores", "integrator", "sentence"),
    [
        (0, "leapfrog", "cores must be at least 1, not 0"),
        (2.0, "leapfrog", "cores must be a whole number, not 2.0"),
        (True, "leapfrog", "cores must be a whole number, not True"),
        (2, "rk4", "cores must be 1 with rk4, not 2"),
    ],
)
def test_cores_that_cannot_be_used_are_refused(cores, integrator, sentence):
    surface = Surface(np.ones((4, 4), bool), 1.0, 1.0)
    with pytest.raises((TypeError, ValueError), match=sentence):
        simulate(surface, Setup(integrator=integrator), cores=cores)
