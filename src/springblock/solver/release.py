"""Release times within a step, which make both integrators second order across detachments.

A block at rest detaches where |F_mot| reaches F_c = max(mu_s, mu_d) F_n. If it does so between
steps k - 1 and k, linear interpolation of |F_mot| gives the release time t_det = (k - θ) h, with

    θ = (|F_k| - F_c)/(|F_k| - |F_k-1|)                                         (9)

(equation numbers are those of docs/model.md). Under the net force, which adds a velocity a per
step, the block has at step k the slip and the velocity

    s = (θ²/2) a,    v_k = θ a.                                                 (10)

F_k-1 is needed only for the few blocks that detach. It is reconstructed from the earlier
displacements of their neighbours, after the loop over all blocks.

The leapfrog conserves v_k-1/2·v_k+1/2/2 = v_k²/2 - a²/8, per mass, in place of v_k²/2, so that
friction dissipates a²/8 too little until the block stops. A release adds this energy to the
frictional heat, minus the energy K s²/2 that the displacement by s creates, with K = K_s + 3 K_int:

    Q = a²/8 - K s²/2.                                                          (11)

Near the stability limit Q would be comparable with the kinetic energy that the block attains. With
ε = (h/h_limit)², θ in (10) becomes θ_ε, and in the leapfrog slip and heat are smaller:

    θ_ε = θ + ε (1/2 - θ),    s = (θ_ε²/2 - ε/8) a,    Q = (1 - ε) a²/8 - K s²/2.  (12)

At ε = 1 both s and Q vanish, and the step is that of a plain leapfrog.

Under a weakening law the net force at the release is zero, and a is the increase of F_mot since
then: the slip is of third order in h and the velocity of second, for any θ.
"""

import math
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from springblock.solver.compilation import kernel
from springblock.solver.springs import Array, g


class Releases(NamedTuple):
    """Work arrays for the blocks that detach in one step, and for the neighbourhood of one."""

    row: NDArray[np.int64]  #: (N_y N_x,)
    x: NDArray[np.int64]  #: (N_y N_x,) column, from 1
    ax: Array  #: (N_y N_x,) velocity that the net force adds in one step
    ay: Array
    share: Array  #: (N_y N_x,) θ
    now: Array  #: (2, 5, 5) displacements at step k, [y, x]; NaN beyond the edges
    before: Array  #: (2, 3, 3) displacements of the inner blocks at step k - 1


def make_releases(blocks: int) -> Releases:
    """Return work arrays for this many blocks; pages never written to take no memory."""
    return Releases(
        np.empty(blocks, np.int64),
        np.empty(blocks, np.int64),
        np.empty(blocks),
        np.empty(blocks),
        np.empty(blocks),
        np.empty((2, 5, 5)),
        np.empty((2, 3, 3)),
    )


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
def _pull_of_opposite_pair(patch, y, x, j, i, kappa):
    """Force by the two neighbours at (y ± j, x ± i)."""
    ax, ay = _pull(patch, y, x, j, i, kappa)
    bx, by = _pull(patch, y, x, -j, -i, kappa)
    return ax + bx, ay + by


@kernel
def force_in_patch(patch, y, x, springs, slider):
    """F_mot of the block at (y, x) of a patch of displacements, under a slider at (x, y).

    The order of summation is invariant under reflections, as in `springs`.
    """
    east_x, east_y = _pull_of_opposite_pair(patch, y, x, 0, 1, springs.kappa)
    north_x, north_y = _pull_of_opposite_pair(patch, y, x, 1, 0, springs.kappa)
    ne_x, ne_y = _pull_of_opposite_pair(patch, y, x, 1, 1, springs.kappa)
    nw_x, nw_y = _pull_of_opposite_pair(patch, y, x, 1, -1, springs.kappa)
    fx = (east_x + north_x) + (ne_x + nw_x) + springs.k_s * (slider[0] - patch[0, y, x])
    fy = (east_y + north_y) + (ne_y + nw_y) + springs.k_s * (slider[1] - patch[1, y, x])
    return fx, fy


@njit(inline="always")
def effective_share(share, epsilon):
    """Return θ_ε of (12), which tends to 1/2 at the stability limit, ε = 1."""
    return share + epsilon * (0.5 - share)


@kernel
def release_share(released, threshold, springs, slider, slide):
    """Return θ of (9) for the central block; `slide` is the slider's displacement per step.

    NaN if the force exceeded the threshold one step earlier, too: the block was then sliding, and
    at rest for an instant only.
    """
    back = slider[0] - slide[0], slider[1] - slide[1]
    before = math.hypot(*force_in_patch(released.before, 1, 1, springs, back))
    if before > threshold:
        return np.nan
    now = math.hypot(*force_in_patch(released.now, 2, 2, springs, slider))
    return (now - threshold) / (now - before) if now > threshold else 0.0
