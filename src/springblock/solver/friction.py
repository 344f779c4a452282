"""Amontons-Coulomb friction with a static threshold, integrated over one time step.

While a block is stuck, friction balances F_mot = F_int + F_s up to the threshold mu_s F_n, or
mu_d F_n if that is larger.
Beyond it the block detaches, and mu_d F_n opposes its velocity until it comes to rest and sticks
again (section 2 of the paper). Other laws replace mu_d F_n, see `laws`.
"""

import math

from numba import njit

from springblock.solver.inverse_root import inverse_root
from springblock.solver.laws import resistance, share_of_end, state_of, store_state


@njit(inline="always")
def apply_friction(law, b, wx, wy, vx, vy, fx, fy, static, dynamic):
    """Advance block `b` by one step with friction.

    The law is evaluated at the mean velocity (1 - θ) v + θ w, with θ = `end`, or at θ w if the
    block reverses; `coulomb` then applies the friction that it gives. Velocities are in l per step.
    """
    state, forwards = state_of(law, b), wx * vx + wy * vy > 0.0
    end = share_of_end(law, state, math.sqrt(vx * vx + vy * vy), static, dynamic)
    start = 1.0 - end if forwards else 0.0
    mean_x, mean_y = start * vx + end * wx, start * vy + end * wy
    speed = math.sqrt(mean_x * mean_x + mean_y * mean_y)
    friction = resistance(law, state, speed, -end, static, dynamic)
    new_x, new_y, slides, w_dot_v = coulomb(wx, wy, vx, vy, fx, fy, static, friction)
    slip_rate = math.sqrt(new_x * new_x + new_y * new_y)
    store_state(law, b, state, slip_rate, slides)
    return new_x, new_y, slides, w_dot_v


@njit(inline="always")
def coulomb(wx, wy, vx, vy, fx, fy, static, dynamic):
    """Return the velocity after a step with friction, whether the block slides, and w·v.

    w is the trial velocity, after a step under all forces but friction, v the velocity before the
    step, and f the velocity that F_mot alone would add in one step; `static` and `dynamic` are the
    velocities that mu_s F_n and friction would remove. A block that slides has, by (7) of
    docs/model.md,

        v⁺ = w - T (v + w)/|v + w|,    T = `dynamic`:

    friction opposes the mean velocity, which is parallel to v + w. The block is at rest after the
    step in two cases:

    - |w| ≤ T: friction can remove all of w (Moreau's step, exact for a block that stops);
    - w·v ≤ 0 and |F_mot| ≤ mu_s F_n: the block reverses, or was at rest, and static friction holds
      it. If w·v ≤ 0 and it is not held, friction opposes w: v⁺ = w - T w/|w|.

    A block at rest therefore moves only under a force beyond both mu_s F_n and mu_d F_n; if
    mu_s < mu_d, its only threshold is mu_d F_n.
    """
    w_dot_v = wx * vx + wy * vy
    held = (w_dot_v <= 0.0) & (fx * fx + fy * fy <= static * static)
    mean_x, mean_y = (wx + vx, wy + vy) if w_dot_v > 0.0 else (wx, wy)
    lost = dynamic * inverse_root(mean_x * mean_x + mean_y * mean_y)
    slides = (wx * wx + wy * wy > dynamic * dynamic) & (not held)
    new_x, new_y = wx - lost * mean_x, wy - lost * mean_y
    return (new_x if slides else 0.0), (new_y if slides else 0.0), slides, w_dot_v
