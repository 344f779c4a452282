"""Surfaces of the tables, by the parts of each table that are computed in one job."""

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


#: Surfaces of each part of each table.
TABLES: dict[str, dict[str, list[Scene]]] = {
    "mechanism": {str(n_p): [_pillars(n_p)] for n_p in _SIZES},
    "mechanism_damped": {
        name: [_pillars(n_p, gamma=gamma) for n_p in _SIZES]
        for name, gamma in (("damped", 1e7), ("overdamped", 4e7))  # 1/s
    },
}
