"""Both integrators against an independent reference that locates every event."""

import numpy as np
import pytest

from springblock import Material, simulate
from springblock.accuracy.reference import solve
from springblock.accuracy.surfaces import flat

STEPS = [2e-8, 1e-8, 5e-9]  #: s
#: Six by six blocks that let go one after another within 1 µs. The slider is ten times as fast
#: as the paper's, which shortens the wait before and changes little else: it still moves a
#: hundred times slower than a block that slips.
SCENE = {"material": Material(slider_velocity=5e-3), "duration": 1.194e-5, "sample_interval": 2e-8}
SURFACE = flat(6, seed=6)


@pytest.fixture(scope="module")
def reference():
    return solve(*SURFACE, **SCENE)


@pytest.fixture(scope="module", params=["leapfrog", "rk4"])
def runs(request):
    """One run for each of the steps."""
    return [simulate(*SURFACE, **SCENE, integrator=request.param, step=h) for h in STEPS]


def test_the_reference_lets_every_block_go_and_keeps_its_energy(reference):
    assert np.isfinite(reference.t_det).all()
    assert np.ptp(reference.t_det) > 40 * max(STEPS)
    assert abs(reference.relative_residual) < 1e-9  # of steps accurate to 1e-10


def halves(errors):
    """Whether a quarter of the step leaves at most half of the error: first order, with scatter.

    Where in its step each block lets go and stops is chance.
    """
    return errors[-1] < errors[0] / 2


def test_static_friction_converges(reference, runs):
    """The error is below what the slider adds within one step, K_s v h/F_n."""
    material = SCENE["material"]
    rise = material.k_s * material.slider_velocity / material.block_load
    errors = [abs(run.static_friction - reference.static_friction) for run in runs]
    assert all(error < rise * h for error, h in zip(errors, STEPS, strict=True))
    assert halves(errors)


def test_detachment_times_converge(reference, runs):
    """A release falls on a step boundary, and so did those that led to it: RMS within two steps."""
    errors = [np.sqrt(np.mean((run.t_det - reference.t_det) ** 2)) for run in runs]
    assert all(error < 2 * h for error, h in zip(errors, STEPS, strict=True))
    assert halves(errors)


def test_force_curves_converge(reference, runs):
    """Shifted by h, a slip at the frequency omega is wrong by a share omega h of its drop."""
    errors = [np.linalg.norm(run.force - reference.force) for run in runs]
    errors = np.divide(errors, np.linalg.norm(reference.force))
    assert (errors < SCENE["material"].omega_min * np.array(STEPS)).all()
    assert halves(errors)


def test_blocks_let_go_in_the_order_of_the_reference(reference, runs):
    """But for pairs closer than two steps."""
    order = np.argsort(reference.t_det, axis=None)
    for run, h in zip(runs, STEPS, strict=True):
        assert np.diff(run.t_det.ravel()[order]).min() > -2 * h
