"""Linear elasticity of the layer, reduced to the blocks in contact.

For displacements u much smaller than l the forces on all blocks are s K_s e - K u, where s is the
displacement of the slider along the unit vector e and K the stiffness of all springs. Blocks
without contact are in equilibrium, which leaves for those in contact

    F_mot = s b - S u,    S = K_cc - K_cf K_ff⁻¹ K_fc,    b = K_s (e_c - K_cf K_ff⁻¹ e_f),

with the indices c for blocks in contact and f for the others: S is the Schur complement of K_ff.
"""

from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csc_array, eye_array
from scipy.sparse.linalg import SuperLU, splu

from springblock.model.material import Material
from springblock.model.numbers import Array

#: Half of the neighbours of a block, (y, x), and the stiffness of their springs over K_int.
SPRINGS = {(0, 1): 1.0, (1, 0): 1.0, (1, 1): 0.5, (1, -1): 0.5}


class Layer:
    """Elasticity of a layer, pulled along x, reduced to its k blocks in contact.

    `contact` is (N_y, N_x), with free edges. Vectors have the x components of all blocks, then the
    y components.
    """

    def __init__(self, contact: NDArray[np.bool_], material: Material) -> None:
        whole = lattice_stiffness(contact.shape, material)
        bound = np.tile(contact.ravel(), 2)
        load = material.k_s * np.repeat([1.0, 0.0], contact.size)
        self._held, self._load_held = whole[bound][:, bound], load[bound]
        self._free, self._load_free = whole[~bound][:, ~bound], load[~bound]
        self._coupling = whole[~bound][:, bound]

    @cached_property
    def stiffness(self) -> Array:
        """S, (2k, 2k) N/m."""
        reduced = self._held.toarray()
        edge = np.flatnonzero(np.diff(self._coupling.indptr))  # blocks beside one without contact
        near = self._coupling[:, edge]
        reduced[np.ix_(edge, edge)] -= near.T @ self._relaxed(near.toarray())
        return reduced

    @cached_property
    def pull(self) -> Array:
        """b, (2k,) N/m."""
        return self._load_held - self._coupling.T @ self._relaxed(self._load_free)

    @property
    def stress(self) -> Array:
        """Modulus of b on each block, (k,) N/m: the stress before any slip, over s."""
        return np.hypot(*self.pull.reshape(2, -1))

    def _relaxed(self, force: Array) -> Array:
        """Return the displacements of blocks without contact under forces on them."""
        return self._factorised.solve(force) if force.size else force

    @cached_property
    def _factorised(self) -> SuperLU:
        return splu(self._free)


def lattice_stiffness(shape: tuple[int, int], material: Material) -> csc_array:
    """Return K, (2 N_y N_x, 2 N_y N_x), N/m: x components row by row, then y components.

    A spring along the unit vector n between blocks i and j adds k n nᵀ (u_j - u_i) to the force
    on block i, to first order.
    """
    blocks = np.arange(np.prod(shape)).reshape(shape)
    y, x = np.indices(shape)
    total = material.k_s * eye_array(2 * blocks.size, format="csc")
    for (up, right), share in SPRINGS.items():
        along = np.array([right, up]) / np.hypot(right, up)
        inside = (y + up < shape[0]) & (x + right >= 0) & (x + right < shape[1])
        one = blocks[inside]
        other = np.roll(blocks, (-up, -right), axis=(0, 1))[inside]
        # (springs, 2 N_y N_x): the elongation of each spring
        rows = np.tile(np.arange(one.size), 4)
        columns = np.concatenate([other, other + blocks.size, one, one + blocks.size])
        values = np.repeat([*along, *-along], one.size)
        stretch = coo_array((values, (rows, columns)), (one.size, 2 * blocks.size)).tocsc()
        total = total + share * material.k_int * (stretch.T @ stretch)
    return csc_array(total)
