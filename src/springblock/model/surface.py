"""Surface of one realisation: the blocks in contact and their friction coefficients."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from springblock.model.asperities import DRAWN, draw_friction
from springblock.model.material import Material
from springblock.model.notebook import Shown, in_words
from springblock.model.numbers import Array, as_array
from springblock.model.pattern import MAX_BLOCKS, Pattern
from springblock.model.texture import Texture

#: Least number of blocks per side with periodic edges: with fewer, a block would be its own
#: neighbour, or a neighbour of another one twice.
_SHORTEST_PERIOD = 3


class Surface(Shown):
    """Blocks in contact with the substrate, and their friction coefficients.

    Parameters
    ----------
    contact : Pattern, or (N_y, N_x) bool, or 0 and 1, [y, x]
        Blocks in contact with the substrate. Masked entries are not.
    mu_static, mu_dynamic : (N_y, N_x) float, or one number for all blocks
        Microscopic friction coefficients; values outside the contact are ignored. Those of blocks
        in contact must not be masked.
    periodic : bool
        Whether springs join opposite edges, which are free otherwise. Periodic surfaces
        have 3 blocks a side or more.

    Raises
    ------
    TypeError, ValueError
        If a shape, type or value is not valid, with the reason.
    """

    def __init__(
        self,
        contact: Pattern | ArrayLike,
        mu_static: ArrayLike,
        mu_dynamic: ArrayLike,
        periodic: bool = False,
    ) -> None:
        mask = as_mask(contact)
        if not isinstance(periodic, bool):
            raise TypeError(f"periodic must be True or False, not {periodic!r}")
        if periodic and min(mask.shape) < _SHORTEST_PERIOD:
            raise ValueError(
                f"contact has the shape {mask.shape}; with periodic edges each side must have at "
                f"least {_SHORTEST_PERIOD} blocks"
            )
        self.contact = mask
        self.mu_static = as_coefficients("mu_static", mu_static, mask)  #: (N_y, N_x), 0 elsewhere
        self.mu_dynamic = as_coefficients("mu_dynamic", mu_dynamic, mask)
        self.periodic = periodic
        self.drawn_with: Material | None = None  #: None if the coefficients were given

    @classmethod
    def draw(
        cls,
        contact: Pattern | ArrayLike,
        seed: int,
        material: Material | None = None,
        periodic: bool = False,
    ) -> "Surface":
        """Return a surface with random coefficients, see `draw_friction`.

        Simulations with other coefficients in their material are refused.
        """
        mask = as_mask(contact)
        surface = cls(mask, *draw_friction(mask.shape, seed, material, periodic), periodic)
        surface.drawn_with = material or Material()
        return surface

    def check_material(self, material: Material) -> None:
        """Refuse a material with which other coefficients would be drawn."""
        drawn = self.drawn_with or material
        for name in (*DRAWN, *(["spacing"] if drawn.correlation_length else [])):
            was, now = getattr(drawn, name), getattr(material, name)
            if was != now:
                raise ValueError(
                    f"the surface was drawn with {name} = {was!r}, but the setup has {now!r}; "
                    "draw the surface with the material of the setup"
                )

    @property
    def strongest(self) -> float:
        """Largest coefficient at which a block detaches."""
        return float(np.maximum(self.mu_static, self.mu_dynamic).max())

    def __repr__(self) -> str:
        static, dynamic = (mu[self.contact].mean() for mu in (self.mu_static, self.mu_dynamic))
        return f"<{in_words(self.contact)}, mean coefficients {static:.3f} and {dynamic:.3f}>"


def as_mask(contact: Pattern | ArrayLike) -> NDArray[np.bool_]:
    """Return a copy of contact as bool, (N_y, N_x), converted from 0 and 1 if necessary.

    Masks of more than `MAX_BLOCKS` blocks a side, or without a block in contact, are refused.
    """
    given = contact.contact if isinstance(contact, Pattern | Texture) else contact
    mask = np.array(as_array("contact", given).filled(0))
    if mask.dtype != np.bool_:
        if mask.dtype.kind not in "iu":
            raise TypeError(f"contact must be an array of bool, or of 0 and 1, not of {mask.dtype}")
        other = mask[(mask != 0) & (mask != 1)]
        if other.size:
            raise ValueError(f"contact must hold bool, or 0 and 1, not {other[0]}")
        mask = mask.astype(bool)
    if mask.ndim != 2:
        raise ValueError(f"contact must have the shape (N_y, N_x), not {mask.shape}")
    if max(mask.shape) > MAX_BLOCKS:
        raise ValueError(
            f"contact has the shape {mask.shape}; a side may have at most {MAX_BLOCKS} blocks"
        )
    if not mask.any():
        raise ValueError("contact is False everywhere; at least one block must be in contact")
    return mask


def as_coefficients(name: str, values: Any, mask: NDArray[np.bool_]) -> Array:
    """Return coefficients as float, (N_y, N_x), 0 outside the mask; refuse invalid ones by name."""
    given = as_array(name, values)
    if given.dtype.kind not in "iuf":
        raise TypeError(f"{name} must be an array of real numbers, not of {given.dtype}")
    mu = np.where(np.ma.getmaskarray(given), np.nan, given.data).astype(float)
    if mu.ndim == 0:
        mu = np.broadcast_to(mu, mask.shape)
    if mu.shape != mask.shape:
        raise ValueError(
            f"{name} must have the shape (N_y, N_x) = {mask.shape} of the surface, not {mu.shape}"
        )
    in_contact = mu[mask]
    if not (np.isfinite(in_contact) & (in_contact >= 0.0)).all():
        raise ValueError(
            f"{name} must be finite and not negative, and not masked, on all blocks in contact"
        )
    return np.where(mask, mu, 0.0)
