"""Both integrators against an independent reference that locates every event."""

import numpy as np
import pytest

from springblock import Material, simulate
from springblock.accuracy.reference import solve
from springblock.accuracy.specimens import flat

STEPS = [2e-8, 1e-8, 5e-9, 2.5e-9]  #: s
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


def of_second_order(errors):
    """Whether an eighth of the step leaves a twentieth of the error: a 64th, with scatter.

    Where in its step each block stops is chance. First order would leave an eighth.
    """
    return errors[-1] < errors[0] / 20


def test_static_friction_converges(reference, runs):
    """The error is below what the slider adds within one step, K_s v h/F_n."""
    material = SCENE["material"]
    rise = material.k_s * material.slider_velocity / material.block_load
    errors = [abs(run.static_friction - reference.static_friction) for run in runs]
    assert all(error < rise * h for error, h in zip(errors, STEPS, strict=True))
    assert of_second_order(errors)


def test_detachment_times_converge(reference, runs):
    """Releases are placed within their steps: RMS within half a step, and soon far within."""
    errors = [np.sqrt(np.mean((run.t_det - reference.t_det) ** 2)) for run in runs]
    assert all(error < h / 2 for error, h in zip(errors, STEPS, strict=True))
    assert of_second_order(errors)


def test_force_curves_converge(reference, runs):
    """A slip at the frequency omega is wrong by a share (omega h)² of its drop, at most."""
    errors = [np.linalg.norm(run.force - reference.force) for run in runs]
    errors = np.divide(errors, np.linalg.norm(reference.force))
    assert (errors < (SCENE["material"].omega_min * np.array(STEPS)) ** 2).all()
    assert of_second_order(errors)


def test_blocks_let_go_in_the_order_of_the_reference(reference, runs):
    """But for pairs closer than a fifth of a step."""
    order = np.argsort(reference.t_det, axis=None)
    for run, h in zip(runs, STEPS, strict=True):
        assert np.diff(run.t_det.ravel()[order]).min() > -0.2 * h
