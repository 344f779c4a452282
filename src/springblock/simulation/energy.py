"""Energy balance of a run."""

import math
from dataclasses import dataclass

import numpy as np

from springblock.model.material import Material
from springblock.model.numbers import Array


@dataclass(frozen=True)
class Energy:
    """Work, energies and heat at the end of a run, in J; (14) of docs/model.md."""

    work_in: float  #: work done by the slider
    elastic: float  #: energy of all springs
    kinetic: float
    friction: float  #: frictional heat
    viscous: float  #: heat of damping

    @property
    def relative_residual(self) -> float:
        """Residual of the balance, as a share of `work_in`; NaN without work."""
        if self.work_in == 0.0:
            return math.nan
        spent = self.elastic + self.kinetic + self.friction + self.viscous
        return (self.work_in - spent) / self.work_in


def _stretch_squared(apart: Array, rest_x: float, rest_y: float) -> Array:
    """(r - L)² of springs with rest vector (rest_x, rest_y) and relative displacement `apart`."""
    rest2 = rest_x**2 + rest_y**2
    q = (2.0 * (rest_x * apart[0] + rest_y * apart[1]) + apart[0] ** 2 + apart[1] ** 2) / rest2
    return rest2 * (q / (1.0 + np.sqrt(1.0 + q))) ** 2  # r - L without cancellation


def elastic_energy(
    displacement: Array, slider: Array, material: Material, periodic: bool = False
) -> float:
    """Energy of all springs, J, for displacements (2, N_y, N_x) and that of the slider, (2,), in m.

    On a periodic surface this includes the springs across the edges.
    """
    length, k_int = material.spacing, material.k_int
    d, every = displacement, slice(None)
    if periodic:  # append images of the first row and column, without the springs between them
        d, every = np.pad(d, ((0, 0), (0, 1), (0, 1)), mode="wrap"), slice(-1)
    springs = (
        (k_int, d[:, every, 1:] - d[:, every, :-1], length, 0.0),
        (k_int, d[:, 1:, every] - d[:, :-1, every], 0.0, length),
        (k_int / 2.0, d[:, 1:, 1:] - d[:, :-1, :-1], length, length),
        (k_int / 2.0, d[:, 1:, :-1] - d[:, :-1, 1:], -length, length),
    )
    internal = sum(
        0.5 * k * float(np.sum(_stretch_squared(apart, *rest))) for k, apart, *rest in springs
    )
    hung = 0.5 * material.k_s * float(np.sum((slider[:, None, None] - displacement) ** 2))
    return internal + hung
