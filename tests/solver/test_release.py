"""Release times within a step; the forces behind them are tested in `test_specification.py`."""

import pytest

from springblock import Material, Surface
from springblock.solver.integrators import LEAPFROG
from springblock.solver.lattice import Samples, prepare, unpadded
from springblock.solver.loop import advance
from springblock.solver.release import make_releases, release_theta
from springblock.solver.springs import Springs


@pytest.mark.parametrize("theta", [0.0, 0.1, 0.5, 1.0])
def test_theta_is_where_a_linear_rise_reaches_the_threshold(theta):
    """The slider is at 1 now and was at 0.9; the block has not moved."""
    released = make_releases(1)
    released.now[:], released.before[:] = 0.0, 0.0
    alone = Springs.of(0.0, 1.0)  # coupled only to the slider, by a spring of stiffness one
    found = release_theta(released, 1.0 - 0.1 * theta, alone, (1.0, 0.0), (0.1, 0.0))
    assert found == pytest.approx(theta, abs=1e-14)


def test_a_block_that_reverses_within_a_step_detaches_anew_but_not_from_rest():
    """Its spring, stretched by 1e-3 l, turns it against a friction a third as strong."""
    surface = Surface([[True]], 0.1, 0.05)
    state, constants = prepare(surface, Material(), (1.0, 0.0), LEAPFROG, 2e-8)
    x, _, speed, _ = (unpadded(field, constants.grid) for field in state.blocks[:4])
    x[:], speed[:] = -1e-3, -1e-9
    samples = Samples.empty(1)
    advance(LEAPFROG, state, constants, 0, 1, 1, samples)
    assert speed[0, 0] > 0.0
    assert samples.switches.tolist() == [1]
    assert state.blocks.t_det.min() == 0.0  # the step, and no moment within it
