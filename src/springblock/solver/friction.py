"""Amontons-Coulomb friction with a static threshold, integrated over one time step.

While a block is stuck, friction balances F_mot = F_int + F_s up to the threshold mu_s F_n, or
mu_d F_n if that is larger.
Beyond it the block detaches, and mu_d F_n opposes its velocity until it comes to rest and sticks
again (section 2 of the paper). Other laws replace mu_d F_n, see `laws`.
"""

import math

import numpy as np
from numba import njit

from springblock.solver.laws import end_weight, resistance, state_now, store_state, strength_of


@njit(inline="always")
def apply_friction(law, b, wx, wy, vx, vy, fx, fy, static, dynamic):
    """Return the velocity of block `b` after a step with friction, whether it slides, and w·v.

    w is the trial velocity, after a step under all forces but friction, v the velocity before the
    step, and f the velocity that F_mot alone would add in one step, in l per step; `static` and
    `dynamic` are the velocities that mu_s F_n and mu_d F_n would remove. A block that slides has,
    by (7) of docs/model.md,

        v⁺ = w - T (v + w)/|v + w|:

    friction opposes the mean velocity, which is parallel to v + w. T is given by the law at the
    speed |(1 - β) v + β w| - β T with the law's weight β, or at |β w| - β T if the block reverses.
    The block is at rest after the step in two cases:

    - |w| ≤ T: friction can remove all of w (Moreau's step, with the exact velocity of a stop);
    - w·v ≤ 0 and |F_mot| ≤ mu_s F_n (without healing, the strength it has left): the block
      reverses, or was at rest, and static friction holds it. If w·v ≤ 0 and it is not held,
      friction opposes w: v⁺ = w - T w/|w|.

    A block at rest therefore moves only under a force beyond both mu_s F_n and mu_d F_n; if
    mu_s < mu_d, its only threshold is mu_d F_n.
    """
    w_dot_v = wx * vx + wy * vy
    forwards = w_dot_v > 0.0
    state = state_now(law, b)
    weight = end_weight(law, state, math.sqrt(vx * vx + vy * vy), static, dynamic)
    start = 1.0 - weight if forwards else 0.0
    at_x, at_y = start * vx + weight * wx, start * vy + weight * wy
    speed = math.sqrt(at_x * at_x + at_y * at_y)
    friction = resistance(law, state, speed, -weight, static, dynamic)
    strength = strength_of(law, state, static, dynamic)
    held = (w_dot_v <= 0.0) & (fx * fx + fy * fy <= strength * strength)
    mean_x, mean_y = (wx + vx, wy + vy) if forwards else (wx, wy)
    lost = friction / np.sqrt(mean_x * mean_x + mean_y * mean_y)  # NaN or infinite at rest
    slides = (wx * wx + wy * wy > friction * friction) & (not held)
    new_x, new_y = wx - lost * mean_x, wy - lost * mean_y
    new_x, new_y = new_x if slides else 0.0, new_y if slides else 0.0
    store_state(law, b, state, math.sqrt(new_x * new_x + new_y * new_y), slides)
    return new_x, new_y, slides, w_dot_v
