"""Preludes are valid for all seeds, and results are the same to the bit."""

import numpy as np
import pytest

from specimens import bits, drawn
from springblock import Material, Pattern, Prelude, Setup, Surface, compute_prelude, simulate
from springblock.simulation.motion import Motion
from springblock.simulation.prelude import HOLDING
from springblock.solver.integrators import INTEGRATORS
from springblock.solver.springs import Grid

PILLARS = Pattern.pillars(12, 4, 2)


@pytest.fixture(scope="module")
def prelude():
    return compute_prelude(PILLARS.contact)


def skipped(prelude, surface):
    """Sample intervals that a run skips."""
    motion = Motion(surface, Setup(), "x")
    prelude.start(motion, latest=np.inf)
    return motion.samples


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_run_from_the_prelude_is_the_run_from_zero(integrator):
    """Also on several bands of rows; `validation/test_properties.py` has all smaller surfaces."""
    contact = Pattern.pillars(48, 10, 14).contact
    assert Grid.of(contact.shape).band_rows < len(contact)
    setup, scene = Setup(Material(slider_velocity=5e-3), integrator), Surface.draw(contact, seed=1)
    prelude = compute_prelude(contact, setup, 30.0)
    assert prelude.samples.max() > 0
    assert bits(simulate(scene, setup, 30.0, prelude=prelude)) == bits(simulate(scene, setup, 30.0))


def test_a_weak_block_makes_a_run_start_from_an_earlier_state(prelude):
    scene = drawn(PILLARS, seed=1)
    scene.mu_static[2, 2], scene.mu_dynamic[2, 2] = 0.1, 0.05
    assert bits(simulate(scene, prelude=prelude)) == bits(simulate(scene))


def test_a_snapshot_may_be_taken_where_the_prelude_ends(prelude):
    scene = drawn(PILLARS, seed=1)
    how = {"duration": 1.6e-4, "snapshot_times": [skipped(prelude, scene) * 2e-7]}
    assert bits(simulate(scene, prelude=prelude, **how)) == bits(simulate(scene, **how))


def test_a_prelude_stores_six_states_and_is_read_back_to_the_bit(tmp_path):
    contact = Pattern.pillars(24, 4, 2).contact
    fast = Material(slider_velocity=5e-3)  # soon over
    prelude = compute_prelude(contact, Setup(fast, sample_interval=2e-8))
    assert len(prelude.samples) == len(HOLDING) == 6
    assert (np.diff(prelude.samples) > 0).all()
    prelude.save(tmp_path / "prelude.npz")
    stored = Prelude.read(tmp_path / "prelude.npz")
    assert vars(stored).keys() == vars(prelude).keys()
    for name, value in vars(prelude).items():
        np.testing.assert_array_equal(getattr(stored, name), value)
    (tmp_path / "prelude.npz").write_bytes(b"text")
    with pytest.raises(ValueError, match=r"prelude.npz is not a prelude, or damaged"):
        Prelude.read(tmp_path / "prelude.npz")


@pytest.mark.parametrize(
    "change",
    [
        {"pattern": Pattern.flat(12)},
        {"pattern": Pattern.pillars(24, 4, 2, n_rows=6)},  # as many blocks, in another shape
        {"periodic": True},
        {"direction": "y"},
        {"setup": Setup(integrator="rk4")},
        {"setup": Setup(step=1e-8)},
        {"setup": Setup(sample_interval=4e-7)},
        {"setup": Setup(Material(gamma=0.0))},
    ],
)
def test_a_prelude_of_another_scene_is_refused(prelude, change):
    scene = {"pattern": PILLARS, "periodic": False, **change}
    contact = scene.pop("pattern").contact
    surface = Surface.draw(contact, 1, periodic=scene.pop("periodic"))
    with pytest.raises(ValueError, match="prelude belongs to another scene"):
        simulate(surface, prelude=prelude, **scene)


@pytest.mark.parametrize(
    ("pattern", "material"),
    [
        (Pattern.flat(1), Material()),
        (PILLARS, Material(pressure=5e7, slider_velocity=0.5)),
    ],
)
def test_a_prelude_ends_with_few_blocks_or_a_broken_spring(pattern, material):
    prelude = compute_prelude(pattern.contact, Setup(material))
    assert len(prelude.samples) == len(prelude.fields) == len(prelude.peak) >= 1


@pytest.mark.parametrize(("kind", "length"), [("normal", 0.0), ("uniform", 0.0), ("weibull", 2e-5)])
def test_each_state_is_valid_for_its_share_of_seeds(kind, length):
    """With correlated thresholds a state is valid for more seeds than its share."""
    material = Material(mu_static_std=0.25, distribution=kind, correlation_length=length)
    setup, seeds = Setup(material, sample_interval=4e-8), 200  # often looked at
    prelude = compute_prelude(PILLARS.contact, setup)
    surfaces = [drawn(PILLARS, seed, material) for seed in range(seeds)]
    start = np.array([skipped(prelude, surface) for surface in surfaces])
    for samples, share in zip(prelude.samples, HOLDING, strict=True):
        assert np.mean(start >= samples) > share - 4.0 * np.sqrt(share * (1.0 - share) / seeds)


def test_known_thresholds_leave_only_the_last_valid_state():
    known = drawn(PILLARS, seed=3)
    prelude = compute_prelude(PILLARS.contact, mu_static=known.mu_static)
    assert len(prelude.samples) == 1
    plain = simulate(known)
    assert 0.8 * plain.t_first < prelude.samples[0] * 2e-7 < plain.t_first
    assert bits(simulate(known, prelude=prelude)) == bits(plain)
