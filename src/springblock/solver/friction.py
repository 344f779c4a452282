"""The substrate: Amontons-Coulomb friction with a static threshold, in one step of time.

While a block is at rest, friction balances F_mot = F_int + F_s up to mu_s F_n; beyond, the block
detaches, and mu_d F_n opposes its velocity until it comes to rest and sticks again (section 2 of
the paper).
"""

import math

from numba import njit


@njit(inline="always")
def coulomb(wx, wy, vx, vy, fx, fy, static, dynamic):
    """Return the share of the trial velocity w that friction leaves, and whether the block slides.

    The share is 0 for a block at rest; w·v and w² are returned as well, for the balance of energy.
    w is the velocity after a step under all forces but friction, v the one before, and f the
    velocity that F_mot alone would add; `static` and `dynamic` are what mu_s F_n and mu_d F_n
    would take away. Two cases end in rest:

    - friction at mu_d F_n takes away all of w (Moreau's step, exact for a block that stops);
    - w points back from v, or v is zero: the block is at rest at an instant of this step, and
      static friction holds it if F_mot is within mu_s F_n.

    A block at rest therefore needs more than both coefficients to move: one with
    mu_s < mu_d lets go at mu_d, once, without a flicker.
    """
    speed2, along = wx * wx + wy * wy, wx * vx + wy * vy
    held = (along <= 0.0) & (fx * fx + fy * fy <= static * static)
    left = 1.0 - dynamic / math.sqrt(speed2)
    slides = (left > 0.0) & (not held)  # False for the NaN of a block without load at rest
    return (left if slides else 0.0), slides, along, speed2
