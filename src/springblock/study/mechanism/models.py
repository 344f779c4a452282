"""Models of the onset of sliding, from independent blocks to avalanches with inertia.

A block in contact detaches where the modulus of F_mot exceeds mu_s F_n, or mu_d F_n if this is
larger, as in the simulation. The models differ in what follows:

independent    The block carries mu_d F_n from then on; the others are unaffected.
quasi_static   The block carries mu_d F_n from then on, and the others take up the load that it has
               lost: the layer is always in equilibrium, as without inertia or with strong damping.
sticking       The block slips between neighbours at rest until its force is mu_d F_n, and sticks
               again, as strong as before. Slips follow one another, the most overloaded block
               first, while the slider does not move, until no block exceeds its threshold.
overshooting   The same, but the block slips as without damping, until its force is as far below
               mu_d F_n as it was above, (2 mu_d - mu_s) F_n.
collective     All blocks of an avalanche slip at once between the others at rest, until the force
               on each is as far below mu_d F_n as it was above, and stick again. An avalanche grows
               by the blocks that this overloads. Energy is conserved, as without damping.

The friction force is the component of F_mot along x, the direction of the slider; the friction of
sliding blocks acts along x.
"""

from typing import NamedTuple

import numpy as np

from springblock.model.numbers import Array
from springblock.theory.elasticity import Layer

#: Least stress drop of a block that sticks again over its strength; without a drop it would detach
#: at once.
_LEAST_DROP = 0.01
#: Relative excess of a force over the strength that is rounding.
_SLACK = 1e-9


class Curve(NamedTuple):
    """Force and displacement of the slider just before each detachment, or each avalanche."""

    slider: Array  #: (n,) m
    force: Array  #: (n,) N


def stress_variation(layer: Layer) -> float:
    """Return standard deviation over mean of |F_mot| on the blocks in contact before any slip."""
    return float(layer.stress.std() / layer.stress.mean())


def independent(layer: Layer, static: Array, dynamic: Array) -> Curve:
    """Detach independent blocks; `static` and `dynamic` are mu_s F_n and mu_d F_n, (k,) N."""
    slider = np.maximum(static, dynamic) / layer.stress
    order = np.argsort(slider)
    slider, x, dynamic = slider[order], layer.pull[order], dynamic[order]  # along x
    attached = np.cumsum(x[::-1])[::-1]  # pull on blocks at rest
    return Curve(slider, slider * attached + np.cumsum(dynamic) - dynamic)


def quasi_static(layer: Layer, static: Array, dynamic: Array) -> Curve:
    """Detach blocks one by one in equilibrium, until all slide.

    With A for the components of sliding blocks and f for friction, S_AA u_A = s b_A - f_A. The
    Cholesky factor L of S_AA grows by two rows with each block; the rows of L⁻¹ S_A, kept for all
    blocks, give the forces on the blocks at rest:

        F_mot = s (b - S_A^T S_AA⁻¹ b_A) + S_A^T S_AA⁻¹ f_A.
    """
    k = len(static)
    strength, dynamic = np.maximum(static, dynamic), dynamic.copy()
    # block by block, x then y; blocks at rest come first, and change places as they detach
    stiffness = layer.stiffness.reshape(2, k, 2, k).transpose(1, 0, 3, 2).reshape(2 * k, 2 * k)
    pull = layer.pull.reshape(2, k).T.ravel()  # F_mot = s pull + push
    load, push = pull.copy(), np.zeros(2 * k)
    rows = np.zeros((2 * k, 2 * k))  # of L⁻¹ S_A
    pulled, pushed = np.zeros(2 * k), np.zeros(2 * k)  # L⁻¹ b_A and L⁻¹ f_A
    s, found = 0.0, []
    for held in range(k, 0, -1):
        both = np.stack([pull, push])[:, : 2 * held].reshape(2, held, 2).transpose(0, 2, 1)
        reached = _slider_at(strength[:held], both[0].ravel(), both[1].ravel(), s)
        block, last = int(np.argmin(reached)), held - 1
        s = float(reached[block])
        force = (s * pull + push)[: 2 * held : 2].sum()
        found.append((s, force + dynamic[held:].sum()))
        n, old, new = 2 * (k - held), slice(2 * block, 2 * block + 2), slice(2 * last, 2 * held)
        for values in (strength, dynamic):
            values[[block, last]] = values[[last, block]]
        for matrix in (load, pull, push, stiffness, stiffness.T, rows[:n].T):
            matrix[old], matrix[new] = matrix[new].copy(), matrix[old].copy()
        for row, resistance in ((new.start, dynamic[last]), (new.start + 1, 0.0)):
            own = rows[:n, row].copy()
            line = stiffness[row, : 2 * held] - own @ rows[:n, : 2 * held]
            pivot = np.sqrt(line[row])
            pulled[n] = (load[row] - own @ pulled[:n]) / pivot
            pushed[n] = (resistance - own @ pushed[:n]) / pivot
            rows[n, : 2 * held] = line / pivot
            pull[: 2 * held] -= rows[n, : 2 * held] * pulled[n]
            push[: 2 * held] += rows[n, : 2 * held] * pushed[n]
            n += 1
    return Curve(*np.array(found).T)


def sticking(layer: Layer, static: Array, dynamic: Array) -> Curve:
    """Let blocks slip to their dynamic friction and stick again."""
    return _stick_slip(layer, np.maximum(static, dynamic), dynamic)


def overshooting(layer: Layer, static: Array, dynamic: Array) -> Curve:
    """Let blocks overshoot their dynamic friction and stick again."""
    strength = np.maximum(static, dynamic)
    return _stick_slip(layer, strength, 2.0 * dynamic - strength)


def collective(layer: Layer, static: Array, dynamic: Array) -> Curve:
    """Let the blocks of an avalanche overshoot their dynamic friction together."""
    k, strength = len(static), np.maximum(static, dynamic)
    held = np.minimum(dynamic, (1.0 - _LEAST_DROP) * strength)
    force, slipped, s = np.zeros((2, k)), np.zeros(k, bool), 0.0
    pull, found = layer.pull.reshape(2, k), []
    while not slipped.all():
        reached = _slider_at(strength, layer.pull, force.ravel() - s * layer.pull, s)
        begins = int(np.argmin(reached))
        force += (reached[begins] - s) * pull
        s = reached[begins]
        found.append((s, force[0].sum()))
        slips, overloaded, after = np.zeros(k, bool), np.arange(k) == begins, force
        while overloaded.any():
            slips |= overloaded
            both = np.tile(slips, 2)
            drop = 2.0 * force[:, slips] * (1.0 - held[slips] / np.hypot(*force[:, slips]))
            slip = np.linalg.solve(layer.stiffness[np.ix_(both, both)], drop.ravel())
            after = force - (layer.stiffness[:, both] @ slip).reshape(2, k)
            overloaded = ~slips & (np.hypot(*after) > (1.0 + _SLACK) * strength)
        force, slipped = after, slipped | slips
    return Curve(*np.array(found).T)


#: The models by name, each with one effect more than the one before.
MODELS = {model.__name__: model for model in (independent, quasi_static, sticking, overshooting)}


def _stick_slip(layer: Layer, strength: Array, left: Array) -> Curve:
    """Let blocks slip until the force on them is `left`, (k,) N, until each has detached once."""
    k, left = len(strength), np.minimum(left, (1.0 - _LEAST_DROP) * strength)
    pairs = layer.stiffness.reshape(2, k, 2, k)[:, range(k), :, range(k)]
    compliance = np.linalg.inv(pairs)  # (k, 2, 2) of each block between others at rest
    force, slipped, s = np.zeros((2, k)), np.zeros(k, bool), 0.0
    pull = layer.pull.reshape(2, k)
    found = []
    while not slipped.all():
        reached = _slider_at(strength, layer.pull, force.ravel() - s * layer.pull, s)
        block = int(np.argmin(reached))
        force += (reached[block] - s) * pull
        s = reached[block]
        found.append((s, force[0].sum()))
        overload = np.inf
        while overload > 1.0 + _SLACK:
            slipped[block] = True
            drop = force[:, block] * (1.0 - left[block] / np.hypot(*force[:, block]))
            slip = compliance[block] @ drop
            force -= (slip @ layer.stiffness[[block, block + k]]).reshape(2, k)
            overloads = np.hypot(*force) / strength
            block = int(np.argmax(overloads))
            overload = overloads[block]
    return Curve(*np.array(found).T)


def _slider_at(strength: Array, pull: Array, push: Array, s: float) -> Array:
    """Slider's displacement, at least s, at which |s pull + push| of each block is its strength."""
    (ax, ay), (bx, by) = pull.reshape(2, -1), push.reshape(2, -1)
    square, half, rest = ax**2 + ay**2, ax * bx + ay * by, bx**2 + by**2 - strength**2
    root = np.sqrt(np.maximum(half**2 - square * rest, 0.0))
    return np.maximum((root - half) / square, s)
