"""Avalanches along an edge under Coulomb friction: a chain of thresholds.

A block that slips by s between neighbours at rest loses S_ii s and hands T_r S_ii s to the block r
further along the edge, with S of `springblock.theory.elasticity` and T_r = -S_(i,i+r)/S_ii:
T₁ ≈ K_int/(3 K_int + K_s) on edges along the sliding direction. The blocks of an edge are a chain
under a common load f, in normal forces F_n. A block detaches where f and what it has been handed
reach its strength mu_s. It overshoots, as without damping: from the load F it drops by
D = 2 (F - mu_d), rests, is as strong as before, and hands T_r D on to both sides. While f is
constant, the most overloaded block goes first. If its own motion is overdamped, a block drops to
mu_d instead, slides for good and passes on all later load.

If load is handed on to the next block of one side only, block i goes at the load

    L_i = clip(L_(i-1); mu_i - q, mu_i),    q = 2 (mu_s - mu_d) T₁,

so that (E[g(L_i) | L_(i-1) = x])' = g'(x) p(x) with p(x) = Phi(x + q) - Phi(x), where Phi is the
distribution of mu_s. Hence the distribution F of L and its correlation along the edge,

    F = Phi/(1 - p),    c(r) = ∫ W(x) p(x)^r dx / ∫ W(x) dx,    W(x) = ∫_x^∞ (y - <L>) dF(y),

which decays as max(p)^r: l_c ~ -1/ln erf[(mu_s - mu_d) T₁/(√2 sigma)].
"""

import math
from typing import NamedTuple

import numpy as np
from scipy.linalg import circulant
from scipy.special import ndtr

from springblock.model.asperities import draw_friction
from springblock.model.material import Material
from springblock.model.numbers import Array
from springblock.theory.elasticity import Layer

REACH = 4  #: blocks on each side to which load is handed on
_LENGTH = 31  #: blocks along the edge of the stripe from which T_r is taken
#: Least drop of a block over its strength, which blocks weaker at rest than in motion need.
_LEAST_DROP = 0.01
_POINTS, _TAIL = 4001, 9.0  #: of the integrals: points, and standard deviations beyond the mean


class Edge(NamedTuple):
    """Elasticity of a block on the edge of a stripe between others at rest."""

    transfer: Array  #: T_r, (REACH,)
    overload: float  #: its load before any slip, over that of a block far from edges
    stiffness: float  #: S_ii, N/m

    @classmethod
    def of(cls, material: Material, shape: str, width: int, gap: int) -> "Edge":
        """Return that of a stripe "along" or "across" the sliding direction; lengths in blocks."""
        stripe = np.pad(np.ones((width, _LENGTH), bool), ((gap, gap), (0, 0)))
        contact = stripe if shape == "along" else stripe.T
        layer, blocks = Layer(contact, material), np.arange(width * _LENGTH)
        row = blocks[:_LENGTH] if shape == "along" else blocks[::width]
        middle = row[_LENGTH // 2 :][: REACH + 1]
        line = layer.stiffness[middle[0], middle]
        return cls(-line[1:] / line[0], layer.stress[middle[0]] / material.k_s, line[0])

    def overdamps(self, material: Material) -> bool:
        """Return whether a block that slips between others at rest does not overshoot."""
        return material.gamma**2 * material.mass >= 4.0 * self.stiffness


def first_loads(transfer: Array, material: Material, shape: tuple[int, int], seed: int) -> Array:
    """Return the loads f/F_n at which blocks detach first, on closed chains of shape (k, n).

    Blocks of one chain that go in one avalanche have the same load.
    """
    static, dynamic = draw_friction(shape, seed, material)
    strength = np.maximum(static, dynamic)
    found, handed, load = np.full(shape, np.nan), np.zeros(shape), np.zeros(shape[0])
    chains = np.arange(shape[0])  # those with blocks that have never detached
    while chains.size:
        excess = load[chains, None] + (handed - strength)[chains]
        block = excess.argmax(axis=1)
        load[chains] -= np.minimum(excess.max(axis=1), 0.0)
        at = chains, block
        found[at] = np.fmin(found[at], load[chains])
        drop = 2.0 * (load[chains] + handed[at] - dynamic[at])
        drop = np.maximum(drop, _LEAST_DROP * strength[at])
        handed[at] -= drop
        for r, share in enumerate(transfer, 1):
            for other in (block - r, block + r):
                handed[chains, other % shape[1]] += share * drop
        chains = chains[np.isnan(found[chains]).any(axis=1)]
    return found


def damped_loads(transfer: Array, material: Material, shape: tuple[int, int], seed: int) -> Array:
    """Return the same where blocks that have detached slide at mu_d for good.

    In equilibrium F = f a + b - M d, from which drops d that give F = mu_d are eliminated.
    """
    static, dynamic = draw_friction(shape, seed, material)
    strength, rows = np.maximum(static, dynamic), np.arange(shape[0])
    found, load = np.full(shape, np.nan), np.zeros((shape[0], 1))
    between = np.zeros(shape[1] - 1 - 2 * len(transfer))
    line = np.r_[1.0, -transfer, between, -transfer[::-1]]
    matrix = np.tile(circulant(line), (shape[0], 1, 1))
    a, b = np.ones(shape), np.zeros(shape)
    for _ in range(shape[1]):
        held = np.isnan(found)
        reached = np.where(held, (strength - b) / np.where(held, a, 1.0), np.inf)
        at = rows, np.maximum(reached, load).argmin(axis=1)
        load = np.maximum(load, reached[at][:, None])
        found[at] = load[:, 0]
        column = matrix[rows, :, at[1]] / matrix[rows, at[1], at[1]][:, None]
        b -= column * (b[at] - dynamic[at])[:, None]
        a -= column * a[at][:, None]
        matrix -= column[:, :, None] * matrix[at][:, None, :]
    return found


def avalanche_length(material: Material, share: float) -> float:
    """Return l_c in blocks with T₁ = `share`; 0 without a drop."""
    drop = material.mu_static - material.mu_dynamic
    return decay_length(drop * share / (math.sqrt(2.0) * material.mu_static_std))


def decay_length(handed: float) -> float:
    """Return l_c in blocks by the load that is handed on, over √2 sigma; 0 without any."""
    return -1.0 / math.log1p(-math.erfc(handed)) if handed else 0.0


def one_sided_correlation(material: Material, share: float, r: Array) -> Array:
    """Return c(r), (r,), of the chain that hands T₁ = `share` on to one side; mu_s is normal."""
    mean, sigma = material.mu_static, material.mu_static_std
    q = 2.0 * (mean - material.mu_dynamic) * share
    x, step = np.linspace(mean - q - _TAIL * sigma, mean + _TAIL * sigma, _POINTS, retstep=True)
    weaker, stronger = ndtr((x - mean) / sigma), ndtr((mean - x - q) / sigma)
    apart = weaker + stronger  # 1 - p
    left = stronger / apart  # 1 - F
    beyond = step * np.cumsum(left[::-1])[::-1]  # ∫_x^∞ (1 - F) dy
    weight = (x - x[0] - beyond[0]) * left + beyond  # W, by parts
    return np.asarray((1.0 - apart) ** r[:, None] @ weight / weight.sum())
