"""The substrate: Amontons-Coulomb friction with a static threshold, in one step of time.

While a block is at rest, friction balances F_mot = F_int + F_s up to mu_s F_n; beyond, the block
detaches, and mu_d F_n opposes its velocity until it comes to rest and sticks again (section 2 of
the paper). Other laws put something else in the place of mu_d F_n, see `laws`.
"""

import math

from numba import njit

from springblock.solver.inverse_root import inverse_root
from springblock.solver.laws import keep, resistance, share_of_end, state_of


@njit(inline="always")
def slow_down(law, b, wx, wy, vx, vy, fx, fy, static, dynamic):
    """Apply the Coulomb step to block `b`, with the resistance given by its friction law."""
    state, forwards = state_of(law, b), wx * vx + wy * vy > 0.0
    end = share_of_end(law, state, math.sqrt(vx * vx + vy * vy), static, dynamic)
    start = 1.0 - end if forwards else 0.0
    mean_x, mean_y = start * vx + end * wx, start * vy + end * wy
    speed = math.sqrt(mean_x * mean_x + mean_y * mean_y)
    friction = resistance(law, state, speed, -end, static, dynamic)
    new_x, new_y, slides, along = coulomb(wx, wy, vx, vy, fx, fy, static, friction)
    moved = math.sqrt(new_x * new_x + new_y * new_y)
    keep(law, b, state, moved, slides)
    return new_x, new_y, slides, along


@njit(inline="always")
def coulomb(wx, wy, vx, vy, fx, fy, static, dynamic):
    """Return the velocity that friction leaves, whether the block slides, and w·v.

    w is the velocity after a step under all forces but friction, v the one before, and f the
    velocity that F_mot alone would add; `static` and `dynamic` are what mu_s F_n and mu_d F_n
    would take away. Two cases end in rest:

    - friction at mu_d F_n takes away all of w (Moreau's step, exact for a block that stops);
    - w points back from v, or v is zero: the block is at rest at an instant of this step, and
      static friction holds it if F_mot is within mu_s F_n.

    Otherwise friction opposes the mean velocity of the step, of which v + w has the direction:
    along w alone, a block that turns aside would feel it a half step early. A block that turns
    back and is not held has no mean to speak of; friction opposes w.

    A block at rest therefore needs more than both coefficients to move: one with
    mu_s < mu_d lets go at mu_d, and only once.
    """
    along = wx * vx + wy * vy
    held = (along <= 0.0) & (fx * fx + fy * fy <= static * static)
    mean_x, mean_y = (wx + vx, wy + vy) if along > 0.0 else (wx, wy)
    lost = dynamic * inverse_root(mean_x * mean_x + mean_y * mean_y)
    slides = (wx * wx + wy * wy > dynamic * dynamic) & (not held)
    new_x, new_y = wx - lost * mean_x, wy - lost * mean_y
    return (new_x if slides else 0.0), (new_y if slides else 0.0), slides, along
