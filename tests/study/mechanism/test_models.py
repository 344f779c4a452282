"""Models of the onset of sliding: closed forms of few blocks, and the simulation as their limit."""

from types import SimpleNamespace

import numpy as np
import pytest

from springblock import Material, Pattern, Setup, Surface, simulate
from springblock.simulation.energy import elastic_energy
from springblock.study.mechanism.models import (
    MODELS,
    collective,
    independent,
    overshooting,
    quasi_static,
    sticking,
    stress_variation,
)
from springblock.theory.elasticity import Layer, lattice_stiffness

MATERIAL = Material()
ALL = pytest.mark.parametrize("model", MODELS.values(), ids=MODELS)


def test_energy_of_small_displacements_is_that_of_all_springs(rng):
    shape = (5, 7)
    u = 1e-6 * MATERIAL.spacing * rng.standard_normal((2, *shape))
    linear = 0.5 * u.ravel() @ lattice_stiffness(shape, MATERIAL) @ u.ravel()
    assert linear == pytest.approx(elastic_energy(u, np.zeros(2), MATERIAL), rel=1e-5)


def test_blocks_without_contact_are_in_equilibrium(rng):
    contact = Pattern.pillars(12, 3, 3).contact
    reduced = Layer(contact, MATERIAL)
    k, bound = contact.sum(), np.tile(contact.ravel(), 2)
    stiffness = lattice_stiffness(contact.shape, MATERIAL).toarray()
    slip, s = 1e-8 * rng.standard_normal(2 * k), 2e-7
    pulled = s * MATERIAL.k_s * np.repeat([1.0, 0.0], contact.size)
    u = np.zeros(bound.size)
    u[bound] = slip
    u[~bound] = np.linalg.solve(stiffness[~bound][:, ~bound], (pulled - stiffness @ u)[~bound])
    force = pulled - stiffness @ u
    assert force[~bound] == pytest.approx(0.0, abs=1e-12 * abs(force).max())
    assert force[bound] == pytest.approx(s * reduced.pull - reduced.stiffness @ slip)


@ALL
@pytest.mark.parametrize("n_blocks", [1, 4])
def test_like_blocks_on_a_flat_surface_let_go_together(model, n_blocks):
    """The stress is even: friction is mu_s F_n on each block until the first one lets go."""
    flat = Layer(np.ones((n_blocks, n_blocks), bool), MATERIAL)
    static, dynamic = np.full(n_blocks**2, 3.0), np.full(n_blocks**2, 2.0)
    curve = model(flat, static, dynamic)
    assert curve.force.max() == pytest.approx(static.sum())
    assert curve.slider[0] == pytest.approx(3.0 / MATERIAL.k_s)
    assert stress_variation(flat) == pytest.approx(0.0, abs=1e-12)


@ALL
def test_the_force_is_the_pull_of_the_slider_along_its_way(model):
    """Edges of pillars are also pulled sideways, by free blocks."""
    layer = Layer(Pattern.pillars(12, 3, 3).contact, MATERIAL)
    k = len(layer.stress)
    curve = model(layer, np.ones(k), np.full(k, 0.6))
    assert curve.force[0] == pytest.approx(curve.slider[0] * layer.pull[:k].sum())
    assert curve.force[0] < 0.999 * curve.slider[0] * layer.stress.sum()


@pytest.mark.parametrize(("n_p", "is_early"), [(3, True), (4, True), (8, False), (10, False)])
def test_under_stress_alone_small_pillars_peak_with_their_edges_and_larger_ones_after(
    n_p, is_early, rng
):
    """Before or after the slider has moved so far that a block under the mean stress detaches."""
    layer = Layer(Pattern.pillars(2 * n_p, n_p, n_p).contact, MATERIAL)
    curve = independent(layer, rng.normal(1.0, 0.1, n_p**2), np.full(n_p**2, 0.6))
    peak = curve.slider[curve.force.argmax()] * layer.stress.mean()
    assert peak < 0.95 if is_early else peak > 1.05


#: Stiffnesses of a spring between two blocks and of one to the slider.
K, K_S = MATERIAL.k_int, MATERIAL.k_s
ROW = Layer(np.ones((1, 2), bool), MATERIAL)


@pytest.mark.parametrize("second", [1.05, 1.9])
def test_two_blocks_bear_what_the_first_one_loses(second):
    """The first bears its mu_d F_n; K/(K + K_s) of what it loses goes to the second at once."""
    static, dynamic = np.array([1.0, second]), np.array([0.6, 0.5])
    curve = quasi_static(ROW, static, dynamic)
    handed_over = K / (K + K_S) * (1.0 - 0.6)
    # F_2 = s K_s + K u_1 with (K + K_s) u_1 = s K_s - mu_d F_n
    later = (second + K / (K + K_S) * 0.6) / (K_S * (1.0 + K / (K + K_S)))
    assert curve.slider == pytest.approx([1.0 / K_S, max(later, 1.0 / K_S)])
    assert curve.force == pytest.approx([2.0, 0.6 + max(second, 1.0 + handed_over)])


def test_load_is_transferred_as_the_equilibrium_of_all_sliding_blocks_demands(rng):
    """S_AA u_A = s b_A - f_A, solved anew for each set A of sliding blocks."""
    layer = Layer(Pattern.pillars(8, 4, 4).contact, MATERIAL)
    k, stiffness = len(layer.stress), layer.stiffness
    static, dynamic = rng.uniform(0.8, 1.2, k), rng.uniform(0.5, 0.7, k)
    slides, s, found = np.zeros(k, bool), 0.0, []
    while not slides.all():
        a, friction = np.tile(slides, 2), np.r_[dynamic, 0.0 * dynamic]
        moved = np.zeros((2, 2 * k))  # u = s u_b - u_f, where blocks slide
        if slides.any():
            moved[:, a] = np.linalg.solve(stiffness[a][:, a], np.c_[layer.pull, friction][a]).T
        pull, push = layer.pull - stiffness @ moved[0], stiffness @ moved[1]
        rest = np.flatnonzero(~slides)
        (px, py), (qx, qy) = pull.reshape(2, k)[:, rest], push.reshape(2, k)[:, rest]
        square, half = px**2 + py**2, px * qx + py * qy
        left = qx**2 + qy**2 - static[rest] ** 2
        reached = np.maximum((np.sqrt(half**2 - square * left) - half) / square, s)
        s = reached.min()
        found.append((s, (s * px + qx).sum() + dynamic[slides].sum()))
        slides[rest[reached.argmin()]] = True
    curve = quasi_static(layer, static, dynamic)
    assert np.stack(curve, axis=1) == pytest.approx(np.array(found), rel=1e-9)


@pytest.mark.parametrize("second", [1.05, 1.3])
def test_blocks_of_an_avalanche_overshoot_together(second):
    """The second block joins where the first overloads it, and both are mirrored at mu_d F_n."""
    static, dynamic = np.array([1.0, second]), np.array([0.8, 0.7])
    curve = collective(ROW, static, dynamic)
    loaded = 1.0 + 2.0 * (1.0 - 0.8) * K / (K + K_S)  # of the second, by the first alone
    assert (loaded > second) == (second == 1.05)
    if loaded > second:
        assert len(curve.force) == 1
    else:
        rest = second - loaded
        assert curve.force[1] == pytest.approx(0.6 + loaded + 2.0 * rest)


@pytest.mark.parametrize(("model", "slip"), [(sticking, 1.0), (overshooting, 2.0)])
@pytest.mark.parametrize(("mu_d", "threshold"), [(0.8, 1.9), (0.3, 5.0)])
def test_a_block_that_sticks_again_rests_at_mu_d_or_as_far_below(model, slip, mu_d, threshold):
    """It slips by (mu_s - mu_d) F_n/(K + K_s), or twice that, and loads its neighbour by K of it.

    Where mu_s > 2 mu_d, a block that overshoots is pushed back afterwards.
    """
    static, dynamic = np.array([1.0, threshold]), np.array([mu_d, 1.5])
    curve = model(ROW, static, dynamic)
    left, loaded = 1.0 - slip * (1.0 - mu_d), 1.0 + slip * (1.0 - mu_d) * K / (K + K_S)
    until_again = 1.0 - left  # of the first, which feels K_s and a neighbour at rest
    until_second = threshold - loaded
    s = 1.0 + min(until_again, until_second)
    assert curve.slider[:2] * K_S == pytest.approx([1.0, s])
    assert curve.force[:2] == pytest.approx([2.0, left + loaded + 2.0 * (s - 1.0)])


def test_of_two_overloaded_blocks_that_with_the_largest_ratio_to_its_threshold_slips_first():
    """The first block loads the second and the third, and the fourth shows what is left."""
    coupling = np.diag([3.0, 3.0, 3.0, 1.0])
    coupling[:3, :3] -= np.array([[0.0, 1.0, 1.0], [1.0, 0.0, 0.5], [1.0, 0.5, 0.0]])
    pull = np.array([1.0, 1.0, 3.0, 1.0])
    four = SimpleNamespace(stiffness=np.kron(np.eye(2), coupling), pull=np.r_[pull, 0.0 * pull])
    curve = overshooting(four, np.array([1.0, 1.1, 3.05, 1.1]), np.array([0.7, 0.9, 2.8, 0.8]))
    force = np.array([1.0, 1.0, 3.0])
    for block, left in ((0, 0.4), (1, 0.7), (2, 2.55)):  # overloaded by 0.10 of 1.1, 0.15 of 3.05
        force -= coupling[:3, block] * (force[block] - left) / 3.0
    assert curve.force[1] == pytest.approx(force.sum() + 0.1 * pull[:3].sum() + 1.1)


@ALL
def test_a_block_weaker_at_rest_than_in_motion_lets_go_at_the_larger(model):
    one = Layer(np.ones((1, 1), bool), MATERIAL)
    curve = model(one, np.array([0.5]), np.array([0.7]))
    assert curve.force == pytest.approx([0.7])


def test_without_inertia_the_simulation_redistributes_quasi_statically():
    """Strong damping and a slow slider leave the simulation no inertia."""
    slow = Material(gamma=2e8, slider_velocity=5e-5)
    contact = Pattern.pillars(16, 4, 4).contact
    surface = Surface.draw(contact, seed=1, material=slow)
    load = slow.block_load * contact.size / contact.sum()
    coefficients = surface.mu_static, surface.mu_dynamic
    curve = quasi_static(Layer(contact, slow), *(load * mu[contact] for mu in coefficients))
    run = simulate(surface, Setup(slow))
    expected = curve.force.max() / (slow.block_load * contact.size)
    assert run.static_friction == pytest.approx(expected, rel=3e-3)
