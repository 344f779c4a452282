"""Surfaces of the tables, by the parts of each table that are computed in one job."""

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from springblock.model.scene import Scene

_SIDE = 120  #: blocks along a side with grooves, or the nearest multiple of the period
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


def _grooves(n_p2: int, n_s2: int, n_p: int = 0, **varied: float) -> Scene:
    """Return pawls between grooves along x, on a pillar of n_p blocks or, 0, without pillars."""
    period = n_p2 + n_s2
    lengths: dict[str, Any] = {"n_blocks": period * round(_SIDE / period)}
    if n_p:
        apart = _SIDE // 2 if 2 * n_p <= _SIDE else _SIDE
        lengths = {"n_blocks": _SIDE, "n_p": n_p, "n_s": apart - n_p}
    return Scene(**lengths, n_p2=n_p2, n_s2=n_s2, varied=tuple(varied.items()))


def _both_ways(surfaces: Iterable[Scene]) -> list[Scene]:
    """Return each surface with grooves, sliding along them and across."""
    return [replace(each, direction=way) for each in surfaces for way in "xy"]


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
#: Surfaces of section 2 of `docs/beyond.md`, on which the prediction of two load peaks was chosen.
TRAINING = _both_ways(
    [_grooves(n_p2, 2) for n_p2 in (2, 4, 8, 10, 13, 18, 28)]
    + [_grooves(n_p2, 6) for n_p2 in (2, 4, 6, 9, 14, 24)]
)
#: Predictions for these surfaces were recorded in `tests/mechanism/predicted.csv` beforehand.
TEST = _both_ways(
    [_grooves(n_p2, 1) for n_p2 in (5, 7, 11)]
    + [_grooves(n_p2, 2) for n_p2 in (3, 5, 6, 7, 9, 12, 16)]
    + [_grooves(n_p2, 3) for n_p2 in (4, 5, 6, 7, 9, 12, 17)]
    + [_grooves(n_p2, 4) for n_p2 in (6, 8, 11, 16)]
    + [_grooves(n_p2, 6) for n_p2 in (5, 7, 8)]
    + [_grooves(n_p2, 30 - n_p, n_p) for n_p2, n_p in ((7, 27), (12, 27), (6, 26))]
    + [_grooves(n_p2, 60 - n_p, n_p) for n_p2, n_p in ((7, 57), (12, 57), (6, 56), (16, 56))]
    + [_grooves(n_p2, 2, mu_dynamic=mu) for mu in (0.5, 0.7) for n_p2 in (4, 8, 13, 18, 28)]
    + [_grooves(8, 2, 58, mu_dynamic=mu) for mu in (0.5, 0.7)]
    + [_grooves(n_p2, 2, mu_static_std=std) for std in (0.05, 0.2) for n_p2 in (8, 13)]
)
_JOBS = 4  #: for the surfaces with grooves

#: Surfaces of each part of each table.
TABLES: dict[str, dict[str, list[Scene]]] = {
    "mechanism": {
        str(n_p): [_pillars(n_p, n_p, 40)] for n_p in (2, 3, 4, 5, 6, 7, 8, 9, 10, 15, 20, 30)
    },
    "mechanism_variants": _VARIANTS,
    "mechanism_peaks": {f"peaks-{i}": [*TRAINING, *TEST][i::_JOBS] for i in range(_JOBS)},
    "mechanism_budget": {"budget": _both_ways([Scene(120, n_p=58, n_s=62, n_p2=8, n_s2=2)])},
}
