"""Release times within a step, which make both integrators second order across detachments.

A block at rest detaches at t_det = (k - θ) h, when |F_mot| reaches F_c = max(mu_s, mu_d) F_n
between steps k - 1 and k. If the net force adds a velocity a per step, then at step k, by (9) of
docs/model.md and (10) to (12) of docs/speed.md, which has the reason for Q,

    θ = (|F_k| - F_c)/(|F_k| - |F_k-1|),    θ_ε = θ + ε (1/2 - θ),
    slip s = (θ_ε²/2 - ε/8) a,    velocity θ_ε a,    heat Q = (1 - ε) a²/8 - (K_s + 3 K_int) s²/2.

Here h and m are 1, and ε is (h/h_limit)² without damping. Q is the energy that the leapfrog would
not dissipate otherwise; in `rk4` it is zero, and s has no term in ε. F_k-1, the force one step
earlier, is needed only for the few blocks that detach, and is reconstructed after the loop over all
blocks from the earlier displacements of their neighbours.

Under a weakening law the net force at the release is zero, and a is the increase of F_mot since
then: the slip is of third order in h and the velocity of second, for any θ.
"""

import math
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from springblock.model.numbers import Array
from springblock.solver.compilation import kernel
from springblock.solver.springs import g


class Releases(NamedTuple):
    """Work arrays for the blocks that detach in one step, and for the neighbourhood of one."""

    row: NDArray[np.int64]  #: (N_y N_x,)
    x: NDArray[np.int64]  #: (N_y N_x,) column, from 1
    ax: Array  #: (N_y N_x,) velocity that the net force adds in one step
    ay: Array
    theta: Array  #: (N_y N_x,) θ
    now: Array  #: (2, 5, 5) displacements at step k, [y, x]; NaN beyond the edges
    before: Array  #: (2, 3, 3) displacements of the inner blocks at step k - 1


def make_releases(blocks: int) -> Releases:
    """Return work arrays for this many blocks, which take memory only when written to."""
    row, x = np.empty((2, blocks), np.int64)
    ax, ay, theta = np.empty((3, blocks))
    return Releases(row, x, ax, ay, theta, np.empty((2, 5, 5)), np.empty((2, 3, 3)))


@njit(inline="always")
def _pull(patch, y, x, j, i, kappa):
    """Force on the block at (y, x) of a patch by its neighbour at (y + j, x + i); 0 without one."""
    dx, dy = patch[0, y + j, x + i] - patch[0, y, x], patch[1, y + j, x + i] - patch[1, y, x]
    if np.isnan(dx):
        return 0.0, 0.0
    rest2 = float(i * i + j * j)
    q = (2.0 * (i * dx + j * dy) + (dx * dx + dy * dy)) / rest2
    p = kappa / rest2 * q * g(q)
    return p * (i + dx), p * (j + dy)


@njit(inline="always")
def _pull_of_pair(patch, y, x, j, i, kappa):
    """Force by the two neighbours at (y ± j, x ± i)."""
    ax, ay = _pull(patch, y, x, j, i, kappa)
    bx, by = _pull(patch, y, x, -j, -i, kappa)
    return ax + bx, ay + by


@kernel
def force_in_patch(patch, y, x, springs, slider):
    """F_mot of the block at (y, x) of a patch of displacements, for a displacement of the `slider`.

    The order of summation is invariant under reflections, as in `springs`.
    """
    east_x, east_y = _pull_of_pair(patch, y, x, 0, 1, springs.kappa)
    north_x, north_y = _pull_of_pair(patch, y, x, 1, 0, springs.kappa)
    ne_x, ne_y = _pull_of_pair(patch, y, x, 1, 1, springs.kappa)
    nw_x, nw_y = _pull_of_pair(patch, y, x, 1, -1, springs.kappa)
    fx = (east_x + north_x) + (ne_x + nw_x) + springs.k_s * (slider[0] - patch[0, y, x])
    fy = (east_y + north_y) + (ne_y + nw_y) + springs.k_s * (slider[1] - patch[1, y, x])
    return fx, fy


@kernel
def release_theta(released, threshold, springs, slider, slide):
    """Return θ of (9) for the central block; `slide` is the slider's displacement per step.

    NaN if the force exceeded the threshold one step earlier, too: the block was then sliding, and
    at rest for an instant only.
    """
    back = slider[0] - slide[0], slider[1] - slide[1]
    before = math.hypot(*force_in_patch(released.before, 1, 1, springs, back))
    if before > threshold:
        return np.nan
    now = math.hypot(*force_in_patch(released.now, 2, 2, springs, slider))
    return (now - threshold) / (now - before) if now > threshold else 0.0  # rounding
