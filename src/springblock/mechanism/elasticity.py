"""Linear elasticity of the layer, reduced to the blocks in contact.

For displacements u much smaller than l the forces on all blocks are s K_s e - K u, where s is the
displacement of the slider along the unit vector e and K the stiffness of all springs. Blocks
without contact are in equilibrium, which leaves for those in contact

    F_mot = s b - S u,    S = K_cc - K_cf K_ff⁻¹ K_fc,    b = K_s (e_c - K_cf K_ff⁻¹ e_f),

with the indices c for blocks in contact and f for the others: S is the Schur complement of K_ff.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csc_array, eye_array
from scipy.sparse.linalg import splu

from springblock.model.material import Material

Array = NDArray[np.float64]

#: Neighbours (y, x) whose springs a block counts as its own, and the stiffness of these over K_int.
SPRINGS = {(0, 1): 1.0, (1, 0): 1.0, (1, 1): 0.5, (1, -1): 0.5}


class Layer(NamedTuple):
    """Elasticity of the layer as its k blocks in contact feel it; components x, then y."""

    stiffness: Array  #: (2k, 2k) S, N/m
    pull: Array  #: (2k,) b, N per m that the slider moves along x


def layer(contact: NDArray[np.bool_], material: Material) -> Layer:
    """Reduce a layer with free edges to its blocks in `contact`, (N_y, N_x), pulled along x."""
    stiffness, bound = lattice_stiffness(contact.shape, material), np.tile(contact.ravel(), 2)
    reduced = stiffness[bound][:, bound].toarray()
    if not contact.all():
        coupling = stiffness[~bound][:, bound]
        edge = np.flatnonzero(np.diff(coupling.indptr))  # blocks beside one without contact
        near = coupling[:, edge]
        reduced[np.ix_(edge, edge)] -= near.T @ splu(stiffness[~bound][:, ~bound]).solve(
            near.toarray()
        )
    return Layer(reduced, pull(contact, material))


def pull(contact: NDArray[np.bool_], material: Material) -> Array:
    """Return b of a layer, (2k,) N/m: the stress on blocks in contact before any slip, over s."""
    stiffness, bound = lattice_stiffness(contact.shape, material), np.tile(contact.ravel(), 2)
    load = material.k_s * np.repeat([1.0, 0.0], contact.size)
    if contact.all():
        return load
    free = splu(stiffness[~bound][:, ~bound]).solve(load[~bound])
    return load[bound] - stiffness[bound][:, ~bound] @ free


def lattice_stiffness(shape: tuple[int, int], material: Material) -> csc_array:
    """Return K, (2 N_y N_x, 2 N_y N_x), N/m: x components row by row, then y components.

    A spring along the unit vector n between blocks i and j adds k n nᵀ (u_i - u_j) to the force
    on block i, to first order.
    """
    blocks = np.arange(np.prod(shape)).reshape(shape)
    total = material.k_s * eye_array(2 * blocks.size, format="csc")
    for (up, right), share in SPRINGS.items():
        along = np.array([right, up]) / np.hypot(right, up)
        one = blocks[: shape[0] - up, max(-right, 0) : shape[1] - max(right, 0)].ravel()
        other = blocks[up:, max(right, 0) : shape[1] + min(right, 0)].ravel()
        # (springs, 2 N_y N_x): the elongation of each spring
        rows = np.tile(np.arange(one.size), 4)
        columns = np.concatenate([other, other + blocks.size, one, one + blocks.size])
        values = np.repeat([*along, *-along], one.size)
        stretch = coo_array((values, (rows, columns)), (one.size, 2 * blocks.size)).tocsc()
        total = total + share * material.k_int * (stretch.T @ stretch)
    return csc_array(total)
