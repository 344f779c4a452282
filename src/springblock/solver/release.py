"""Releases within a step, which makes both integrators second order across detachments.

A block at rest whose |F_mot| is beyond F_c = max(mu_s, mu_d) F_n at step k, and was not one step
before, has let go a share θ of a step before step k,

    θ = (|F_k| - F_c) / (|F_k| - |F_k-1|).

It has moved since: with a for the velocity that the net force adds in one step, it has slipped by
θ² a/2 at step k, with a velocity of θ a. Only the few blocks that let go need F_k-1. It follows
from where their neighbours have been, afterwards and outside the loops over all blocks.

The leapfrog conserves v_k-1/2 · v_k+1/2 / 2 in place of v_k²/2, which is a²/8 less once a block is
accelerated; friction will take that energy, and not the true one, until the block stops. A start is
therefore credited with a²/8 as heat, less what the placement itself creates: the kinetic energy
θ² a²/2, beyond the work of the net force along the slip.

Near the stability limit a²/8 would be much. With ε = (h/h_limit)² the motion starts nearer to the
middle of the step, at θ + ε (1/2 - θ), and the slip is less by ε a/8: at the limit the block starts
from where it rests with a velocity of a half step, and the credit is zero. t_det keeps θ.

Where friction weakens as a block moves, it lets go without a drop: a is what F_mot has risen by
since then. Its slip is of third order in h and its velocity of second, whatever share that was.
"""

import math
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from springblock.solver.compilation import kernel
from springblock.solver.springs import Array, g


class Released(NamedTuple):
    """Room for the blocks that let go in one step, and for the surroundings of one of them."""

    row: NDArray[np.int64]  #: (N_y N_x,)
    x: NDArray[np.int64]  #: (N_y N_x,) column, from 1
    ax: Array  #: (N_y N_x,) velocity that the net force adds to each in one step
    ay: Array
    share: Array  #: (N_y N_x,) θ
    now: Array  #: (2, 5, 5) displacements at step k, [y, x]; NaN beyond the edges
    before: Array  #: (2, 3, 3) of the middle at step k - 1


def room(blocks: int) -> Released:
    """Return work arrays for this many blocks; untouched, they take no memory."""
    return Released(
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
    """Pull on the block at (y, x) of a patch by its neighbour at (y + j, x + i)."""
    dx, dy = patch[0, y + j, x + i] - patch[0, y, x], patch[1, y + j, x + i] - patch[1, y, x]
    if np.isnan(dx):
        return 0.0, 0.0
    rest2 = float(i * i + j * j)
    q = (2.0 * (i * dx + j * dy) + (dx * dx + dy * dy)) / rest2
    p = kappa / rest2 * q * g(q)
    return p * (i + dx), p * (j + dy)


@njit(inline="always")
def _pull_of_pair(patch, y, x, j, i, kappa):
    """Pull by two neighbours on opposite sides."""
    ax, ay = _pull(patch, y, x, j, i, kappa)
    bx, by = _pull(patch, y, x, -j, -i, kappa)
    return ax + bx, ay + by


@kernel
def force_in(patch, y, x, springs, slider):
    """F_mot of the block at (y, x) of a patch of displacements.

    The order of sums is the same seen from any side, as in `springs`.
    """
    east_x, east_y = _pull_of_pair(patch, y, x, 0, 1, springs.kappa)
    north_x, north_y = _pull_of_pair(patch, y, x, 1, 0, springs.kappa)
    ne_x, ne_y = _pull_of_pair(patch, y, x, 1, 1, springs.kappa)
    nw_x, nw_y = _pull_of_pair(patch, y, x, 1, -1, springs.kappa)
    fx = (east_x + north_x) + (ne_x + nw_x) + springs.k_s * (slider[0] - patch[0, y, x])
    fy = (east_y + north_y) + (ne_y + nw_y) + springs.k_s * (slider[1] - patch[1, y, x])
    return fx, fy


@njit(inline="always")
def placed(share, epsilon):
    """Return θ of the motion, which goes to 1/2 at the stability limit, ε = 1."""
    return share + epsilon * (0.5 - share)


@kernel
def share_of_step(released, threshold, springs, slider, slide):
    """Return θ of the block in the middle; `slide` is how far the slider goes in a step.

    NaN for a block that felt more than its threshold one step before: it was moving then, and has
    come to rest for an instant only.
    """
    back = slider[0] - slide[0], slider[1] - slide[1]
    before = math.hypot(*force_in(released.before, 1, 1, springs, back))
    if before > threshold:
        return np.nan
    now = math.hypot(*force_in(released.now, 2, 2, springs, slider))
    return (now - threshold) / (now - before) if now > threshold else 0.0
