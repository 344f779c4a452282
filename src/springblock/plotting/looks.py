"""Colours, markers and names of surfaces and sliding directions, the same in all figures."""

from collections.abc import Iterable
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import LinearSegmentedColormap

from springblock.plotting.style import BLACK, BLUE, GREEN, VERMILION, Look

Key = tuple[int, int, str]  #: n_p, n_p2 and sliding direction: what tells the main surfaces apart

#: Integrators by name. Symbols of Runge-Kutta are open, as some cover those of the leapfrog.
METHODS: dict[str, Look] = {
    "leapfrog": {"label": "leapfrog", "color": BLUE, "marker": "o"},
    "rk4": {"label": "Runge–Kutta", "color": VERMILION, "marker": "s"}
    | {"markersize": 3.8, "markerfacecolor": "none"},
}
_DIRECTIONS = {"x": BLUE, "y": VERMILION}
_STRIPS: dict[str, Look] = {"x": {"marker": "*", "markersize": 4.5}, "y": {"marker": "h"}}
#: By n_p.
_MARKERS = {2: "v", 3: "<", 4: ">", 5: "p", 6: "^", 7: "d", 8: "8", 9: "h"}
_MARKERS |= {10: "s", 20: "D", 30: "P", 60: "X"}
_LARGEST = 60  #: n_p at the light end of the colours, and two at the dark one
#: Ordered for all colour vision, up to a green whose contrast with white is 2.7; yellow fades.
_SHADES = LinearSegmentedColormap.from_list(
    "shades", colormaps["viridis"](np.linspace(0.0, 0.64, 33))
)


def shades(values: Iterable[float]) -> dict[float, Any]:
    """A colour for each value, from dark for the smallest to light."""
    ordered = sorted(set(values))
    return dict(zip(ordered, map(tuple, _SHADES(np.linspace(0.0, 1.0, len(ordered)))), strict=True))


def pillar_look(n_p: int) -> Look:
    """Colour and marker of pillars of a size; 0 is a flat surface."""
    if not n_p:
        return {"color": BLACK, "marker": "o"}
    place = np.log(n_p / 2.0) / np.log(_LARGEST / 2.0)
    return {"color": _SHADES(place), "marker": _MARKERS.get(n_p, "o")}


def pillar_name(n_p: int) -> str:
    """Name of pillars of a size."""
    return f"$n_p$ = {n_p}" if n_p else "flat"


def direction_color(direction: str) -> str:
    """Colour of what goes along x, along y, or askew."""
    return _DIRECTIONS.get(direction, GREEN)


def direction_name(direction: str) -> str:
    """Name a sliding direction on grooves that run along x."""
    named = {"x": "along grooves", "y": "across grooves"}
    return named.get(direction, f"at {direction}° to grooves")


def surface_look(key: Key) -> tuple[str, Look]:
    """Name, colour and marker of a surface."""
    n_p, n_p2, direction = key
    if n_p2:
        look = {"color": direction_color(direction), **_STRIPS.get(direction, {"marker": "d"})}
        return direction_name(direction), look
    return pillar_name(n_p), pillar_look(n_p)


def in_order(keys: Iterable[Key]) -> list[Key]:
    """The flat surface, pillars by their size, grooved ones."""
    return sorted(keys, key=lambda key: (key[1] > 0, key))
