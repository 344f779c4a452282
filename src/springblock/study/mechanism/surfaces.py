"""Surfaces of the tables, by their parts, each of which is computed by one job."""

from springblock.model.material import Material
from springblock.model.scene import Scene

_LEAST = 40  #: blocks along a side, or the next multiple of the period
_SIZES = (2, 3, 4, 5, 6, 7, 8, 9, 10, 15, 20, 30)  #: n_p


def _pillars(n_p: int, gamma: float = Material.gamma) -> Scene:
    """Return the smallest surface of whole pillars with n_s = n_p and `_LEAST` blocks or more.

    Surfaces are small since the cost of the models is cubic in the number of blocks.
    """
    period = 2 * n_p
    n_blocks = period * -(-_LEAST // period)
    return Scene(n_blocks, n_p=n_p, n_s=n_p, gamma=gamma)


#: Surfaces of each part of the tables.
PARTS: dict[str, list[Scene]] = {
    **{f"mechanism-{n_p}": [_pillars(n_p)] for n_p in _SIZES},
    "mechanism-damped": [_pillars(n_p, gamma=1e7) for n_p in _SIZES],
    "mechanism-overdamped": [_pillars(n_p, gamma=4e7) for n_p in _SIZES],
}
