"""Static friction of stripes and square pillars by the theory of a layer, in seconds.

For slip weakening without healing, or with strong damping; without disorder, whose mean effect is
small where coefficients are correlated over less than a pillar. `docs/continuum.md` compares it
with simulations on stripes from 3 lambda and squares from 4 l_z on.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize_scalar

from springblock.model.material import Material
from springblock.simulation.resolution import coarsest
from springblock.theory.layer import Cell, Groups, stripe

SHAPES = ("across", "along", "square")  #: stripes across and along the sliding direction; pillars
_PER_LAYER, _LEAST = 4, 6  #: points per l_z, and least number in half of a pillar or gap
_RANGE = 2.0, 30.0  #: widths over l_z among which the best is looked for
_LEAST_OF_LAYER, _MOST_OF_LAYER = 0.1, 50.0  #: thicknesses, of a pillar or gap
_CLOSE = 0.03  #: of the best width, relative


class Prediction(NamedTuple):
    """What the theory says of one pattern."""

    width: float  #: m, of a stripe or pillar
    static_friction: float
    decay: float  #: lambda behind its edges, m; on squares the smaller one
    kappa: float  #: d_c over the slip at which the springs of the layer bear the drop of friction
    slipped: float  #: m, length that has slipped behind each edge at the peak; NaN for squares
    spacing: float  #: m, the coarsest lattice that resolves it


def predict(material: Material, shape: str, width: float, gap: float) -> Prediction:
    """Return the static friction of stripes or pillars of a width and the gaps between them, m.

    Raises
    ------
    ValueError
        If the law is not slip weakening, friction does not fall, the shape is unknown, or a length
        is not 0.1 to 50 thicknesses of the layer.
    """
    if shape not in SHAPES:
        raise ValueError(f"shape must be one of {', '.join(SHAPES)}, not {shape!r}")
    if material.law != "slip_weakening" or not material.mu_static > material.mu_dynamic:
        raise ValueError("the theory needs the law slip_weakening, and mu_static above mu_dynamic")
    for name, length in (("width", width), ("gap", gap)):
        if not _LEAST_OF_LAYER <= length / material.thickness <= _MOST_OF_LAYER:
            raise ValueError(
                f"{name} = {length:g} m must be {_LEAST_OF_LAYER} to {_MOST_OF_LAYER:g} times "
                f"thickness = {material.thickness:g} m; lengths are in m"
            )
    share = width / (width + gap)
    fraction = share**2 if shape == "square" else share
    groups = Groups.of(material, "x" if shape == "across" else "y", fraction)
    if shape == "square":
        excess, slipped = _square(width, gap, material.thickness, groups), np.nan
    else:
        peak = stripe(width / groups.decay, gap / groups.decay, *groups.numbers)
        excess, slipped = peak.excess, peak.slipped * groups.decay
    finest = coarsest(material, groups.decay, fraction)
    told = groups.friction(excess), groups.decay, groups.kappa, slipped
    return Prediction(width, *told, finest)


def _square(width: float, gap: float, thickness: float, groups: Groups) -> float:
    """Return the excess of square pillars, on a quarter of a periodic cell."""
    halves = np.array([width, gap]) / 2.0
    spacing = min(thickness / _PER_LAYER, halves.min() / _LEAST)
    pillar, ditch = np.rint(halves / spacing).astype(int)
    inside = np.arange(pillar + ditch) < pillar
    return Cell(np.outer(inside, inside), thickness / spacing, 1.0).excess(*groups.numbers)


def predictions(
    material: Material, shape: str, widths: Sequence[float], ratio: float = 1.0
) -> list[Prediction]:
    """Return those of several widths, m, with gaps in proportion."""
    return [predict(material, shape, width, ratio * width) for width in widths]


def best(material: Material, shape: str, ratio: float = 1.0) -> Prediction:
    """Return the width of lowest static friction, with gaps `ratio` times as wide.

    Between 2 and 30 l_z, or as far as the gaps may be wide; at an end of these, friction has no
    minimum between them.
    """
    least, most = _LEAST_OF_LAYER / min(1.0, ratio), _MOST_OF_LAYER / max(1.0, ratio)
    low, high = np.log(np.clip(_RANGE, least, most) * material.thickness)

    def friction(log: float) -> float:
        width = float(np.exp(log))
        return predict(material, shape, width, ratio * width).static_friction

    found = minimize_scalar(
        friction, bounds=(low, high), method="bounded", options={"xatol": _CLOSE}
    )
    width = float(np.exp(found.x))
    return predict(material, shape, width, ratio * width)
