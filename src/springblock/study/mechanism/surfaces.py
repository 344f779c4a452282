"""Surfaces of the tables, by their parts, each of which is computed by one job."""

import math
from typing import Any

from springblock.model.material import Material
from springblock.model.scene import Scene
from springblock.theory.layer import with_springs

_LEAST = 40  #: blocks along a side, or the next multiple of the period
_SIZES = (2, 3, 4, 5, 6, 7, 8, 9, 10, 15, 20, 30)  #: n_p
_USUAL = _SIZES[1:9]  #: among which friction is lowest with half and twice K_s


def _pillars(n_p: int, **constants: Any) -> Scene:
    """Return the smallest surface of whole pillars with n_s = n_p and `_LEAST` blocks or more.

    Surfaces are small since the cost of the models is cubic in the number of blocks.
    """
    period = 2 * n_p
    n_blocks = period * -(-_LEAST // period)
    return Scene(n_blocks, n_p=n_p, n_s=n_p, **constants)


def _springs(factor: float) -> dict[str, float]:
    """Return the constants that differ where K_s is multiplied by a factor."""
    material = with_springs(Material(), math.sqrt(factor))
    return {name: getattr(material, name) for name in ("youngs_modulus", "density", "thickness")}


#: Surfaces of each part of the tables.
PARTS: dict[str, list[Scene]] = {
    **{f"mechanism-{n_p}": [_pillars(n_p)] for n_p in _SIZES},
    "mechanism-damped": [_pillars(n_p, gamma=1e7) for n_p in _SIZES],
    "mechanism-overdamped": [_pillars(n_p, gamma=4e7) for n_p in _SIZES],
    "mechanism-soft": [_pillars(n_p, **_springs(0.5)) for n_p in _USUAL],
    "mechanism-grooves": [Scene(_LEAST, n_p2=8, n_s2=2)],
    "mechanism-stiff": [_pillars(n_p, **_springs(2.0)) for n_p in _USUAL],
}
