"""Avalanches along an edge: what the chain of thresholds gives, and its exact solution."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.linalg import circulant

from springblock import Material
from springblock.model.asperities import draw_friction
from springblock.study.mechanism.models import quasi_static
from springblock.theory.chain import (
    Edge,
    avalanche_length,
    damped_loads,
    first_loads,
    one_sided_correlation,
)
from springblock.theory.correlation import EdgeCorrelation, reach

MATERIAL = Material()
EDGES = {shape: Edge.of(MATERIAL, shape, 10, 10) for shape in ("along", "across")}
NEAR = np.array([1, 2, 3, 6])


def correlation(transfer, material=MATERIAL, samples=20, loads=first_loads):
    """Of chains of 120 blocks."""
    chains = [loads(transfer, material, (30, 120), seed) for seed in range(samples)]
    return EdgeCorrelation(np.stack(chains)[:, :, None])


def test_a_block_hands_on_a_quarter_along_sliding_and_little_across():
    """Along it axial springs to both neighbours carry the force, and diagonal ones half of it."""
    along, across = (EDGES[shape].transfer for shape in ("along", "across"))
    whole = MATERIAL.k_int / (3.0 * MATERIAL.k_int + MATERIAL.k_s)
    assert along[0] == pytest.approx(whole, rel=0.05)
    assert (along[0], across[0]) == pytest.approx((0.259, 0.043), abs=5e-4)
    assert np.abs(along[1:3]) == pytest.approx(1.2e-3, abs=1e-4)
    assert np.abs(across[1:]).max() < 3.1e-3


def test_edges_across_sliding_bear_more():
    """As the stress of the layer over the gap is carried by them alone."""
    assert EDGES["along"].overload == pytest.approx(1.366, abs=1e-3)
    assert EDGES["across"].overload == pytest.approx(1.823, abs=1e-3)


def test_only_strong_damping_prevents_overshoot():
    """A block that slips alone has a frequency of 1.6e7 1/s."""
    edge = EDGES["along"]
    assert not edge.overdamps(Material(gamma=1e7))
    assert edge.overdamps(Material(gamma=4e7))


@pytest.mark.parametrize(("sigma", "share"), [(0.1, 0.259), (0.1, 0.043), (0.03, 0.1)])
def test_the_exact_solution_is_that_of_the_recursion(sigma, share, rng):
    """L_i = clip(L_(i-1); mu_i - q, mu_i), on 2000 chains of 1000 blocks."""
    material = Material(mu_static_std=sigma)
    strength = rng.normal(1.0, sigma, (1000, 2000))
    handed = 2.0 * (1.0 - material.mu_dynamic) * share
    loads = np.empty_like(strength)
    loads[0] = strength[0]
    for i in range(1, len(loads)):
        loads[i] = np.clip(loads[i - 1], strength[i] - handed, strength[i])
    loads = loads[100:] - loads[100:].mean()
    found = [(loads[:-r] * loads[r:]).mean() / (loads**2).mean() for r in NEAR]
    assert one_sided_correlation(material, share, NEAR) == pytest.approx(np.array(found), abs=4e-3)


def test_far_blocks_are_correlated_over_the_length_of_an_avalanche():
    """c(r) decays as erf[(mu_s - mu_d) T₁/(√2 sigma)]^r, up to a power of r."""
    far = np.array([400, 401])
    c = one_sided_correlation(MATERIAL, 0.259, far)
    assert -1.0 / np.log(c[1] / c[0]) == pytest.approx(avalanche_length(MATERIAL, 0.259), rel=5e-3)
    assert avalanche_length(MATERIAL, EDGES["along"].transfer[0]) == pytest.approx(2.8, abs=0.05)


@pytest.mark.parametrize("share", [0.0, 0.259])
def test_without_a_drop_nothing_is_correlated(share):
    level = Material(mu_dynamic=MATERIAL.mu_static if share else 0.6)
    assert avalanche_length(level, share) == 0.0
    assert one_sided_correlation(level, share, NEAR) == pytest.approx(0.0, abs=1e-12)


def test_large_drops_make_one_avalanche_of_all_blocks():
    """Where q is much more than the scatter."""
    narrow = Material(mu_static_std=0.01)
    assert one_sided_correlation(narrow, 0.3, NEAR).min() > 0.999
    loads = first_loads(EDGES["along"].transfer, narrow, (10, 120), 0)
    assert (np.ptp(loads, axis=1) == 0.0).mean() >= 0.9


def test_the_papers_edges():
    """Along sliding c(1), c(2), c(3), c(6) and the share of neighbours in one avalanche, too."""
    along, across = (correlation(EDGES[shape].transfer, samples=40) for shape in EDGES)
    assert along.mean[NEAR] == pytest.approx([0.602, 0.436, 0.338, 0.180], abs=0.015)
    assert along.length().fitted.mean == pytest.approx(2.7, abs=0.15)
    together = along.times == np.roll(along.times, 1, axis=-1)
    assert together.mean() == pytest.approx(0.784, abs=0.01)
    assert along.times.mean() / EDGES["along"].overload == pytest.approx(0.641, abs=2e-3)
    assert across.mean[1] == pytest.approx(0.114, abs=0.01)
    assert across.times.mean() / EDGES["across"].overload == pytest.approx(0.533, abs=1e-3)


def test_less_scatter_lengthens_avalanches_and_strong_damping_shortens_them():
    transfer = EDGES["along"].transfer
    paper = correlation(transfer).length().fitted.mean
    even = correlation(transfer, Material(mu_static_std=0.05)).length().fitted.mean
    damped = correlation(transfer, samples=5, loads=damped_loads).length().fitted.mean
    assert damped < paper < 10.0 < even


def test_under_strong_damping_the_chain_is_the_quasi_static_model():
    """On the stiffness of the chain, blocks go at the same loads."""
    n, transfer = 30, np.array([0.2, 0.01])
    line = np.r_[1.0, -transfer, np.zeros(n - 5), -transfer[::-1]]
    layer = SimpleNamespace(
        stiffness=np.kron(np.eye(2), circulant(line)), pull=np.repeat([1.0, 0.0], n)
    )
    static, dynamic = (mu[0] for mu in draw_friction((1, n), 3, MATERIAL))
    found = np.sort(damped_loads(transfer, MATERIAL, (1, n), 3)[0])
    assert found == pytest.approx(quasi_static(layer, static, dynamic).slider)


def test_correlation_along_closed_edges_is_that_of_all_blocks(rng):
    """Of noise averaged over two neighbours, 1/2 at r = 1 and 0 beyond."""
    noise = rng.standard_normal((40, 10, 1, 60))
    found = EdgeCorrelation(3.0 + noise + np.roll(noise, 1, axis=-1))
    assert found.mean[:4] == pytest.approx([1.0, 0.5, 0.0, 0.0], abs=0.02)


def test_the_reach_of_a_correlation_is_where_it_is_one_over_e():
    r = np.linspace(0.0, 10.0, 1001)
    assert reach(r, np.exp(-r / 3.0)) == pytest.approx(3.0, abs=1e-3)
    assert np.isnan(reach(r, np.exp(-r / 30.0)))
