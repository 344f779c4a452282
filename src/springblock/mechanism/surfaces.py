"""Surfaces of the tables, by the parts of each table that are computed in one job."""

from collections.abc import Iterable

from springblock.model.scene import Scene

_LEAST = 30  #: blocks along a side of the variants, or the next multiple of the period
_SIZES = (2, 4, 6, 8, 10, 15)  #: n_p with another scatter


def _pillars(n_p: int, n_s: int, least: int, **varied: float) -> Scene:
    """Return the smallest surface of whole pillars with `least` blocks along a side or more.

    Surfaces are small since the cost of the models is cubic in the number of blocks.
    """
    period = n_p + n_s
    return Scene(period * -(-least // period), n_p=n_p, n_s=n_s, varied=tuple(varied.items()))


def _even(sizes: Iterable[int], **varied: float) -> list[Scene]:
    """Return pillars of each size with n_s = n_p."""
    return [_pillars(n_p, n_p, _LEAST, **varied) for n_p in sizes]


#: Gaps of half a pillar and of two, thinner and thicker layers, other scatter of mu_s.
_VARIANTS = {
    "flat": [Scene(20)],
    "half": [_pillars(n_p, n_p // 2, _LEAST) for n_p in (2, 4, 6, 8, 10, 16)],
    "double": [_pillars(n_p, 2 * n_p, _LEAST) for n_p in (2, 3, 4, 6, 8, 10)],
    "thickness-5": _even((2, 3, 4, 5, 6, 8, 10, 15), thickness=1e-6 * 5),
    "thickness-20": _even((4, 6, 8, 10, 15, 20), thickness=1e-6 * 20),
    "thickness-40": _even((6, 10, 15, 20, 30), thickness=1e-6 * 40),
    **{f"scatter-{std:g}": _even(_SIZES, mu_static_std=std) for std in (0.0, 0.2, 0.3)},
}
#: Surfaces of each part of each table.
TABLES: dict[str, dict[str, list[Scene]]] = {
    "mechanism": {
        str(n_p): [_pillars(n_p, n_p, 40)] for n_p in (2, 3, 4, 5, 6, 7, 8, 9, 10, 15, 20, 30)
    },
    "mechanism_variants": _VARIANTS,
}
