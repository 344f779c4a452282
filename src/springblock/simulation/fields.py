"""Fields of all blocks at chosen times of a run."""

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from springblock.model.numbers import Array


class BlockState(IntEnum):
    """State of a block at one instant."""

    FREE = 0  #: not in contact with the substrate
    STUCK = 1  #: in contact and at rest
    SLIDING = 2  #: in contact and moving


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Fields:
    """Fields of a run in SI units; vectors are (k, 2, N_y, N_x), [time, component, y, x]."""

    time: Array  #: (k,) s
    displacement: Array  #: m, from the position without strain
    velocity: Array  #: m/s
    #: Pa, shear stress of the blocks on the substrate: F_mot/l² of a block at rest, the friction
    #: force over l² of one that slides, along its velocity; 0 without contact.
    stress: Array
    contact: NDArray[np.bool_]  #: (N_y, N_x) blocks in contact with the substrate
    spacing: float  #: l, m

    @property
    def slip(self) -> Array:
        """Distance of blocks in contact from their initial positions, (k, N_y, N_x) m.

        Zero until the first detachment; NaN without contact.
        """
        return np.where(self.contact, _magnitude(self.displacement), np.nan)

    @property
    def shear_stress(self) -> Array:
        """Magnitude of the stress, (k, N_y, N_x) Pa; NaN without contact."""
        return np.where(self.contact, _magnitude(self.stress), np.nan)

    @property
    def state(self) -> NDArray[np.int8]:
        """`BlockState` of each block, (k, N_y, N_x)."""
        moving = self.velocity.any(axis=1)
        in_contact = np.where(moving, BlockState.SLIDING, BlockState.STUCK)
        return np.where(self.contact, in_contact, BlockState.FREE).astype(np.int8)


def _magnitude(vectors: Array) -> Array:
    return np.hypot(vectors[:, 0], vectors[:, 1])
