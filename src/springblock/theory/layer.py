"""Shear-lag theory of a layer on pillars, under slip weakening without healing.

A layer of thickness l_z hangs on the slider, U, by springs k per area, and is held by friction tau:

    M u" + k (U - u) = tau,        lambda = sqrt(M/k),        k = K_s/l²,

with M = E l_z/(1 - nu²) along the sliding direction and M = G l_z across it. Under a pressure
sigma_n, friction falls from tau_s = mu_s sigma_n to tau_d = mu_d sigma_n over a slip d_c. With
lengths in lambda, stresses in Delta = tau_s - tau_d and displacements in Delta/k, the groups are

    a, b  pillar and gap,    m = tau_d/Delta,    kappa = k d_c/Delta,    p = k U/Delta - m.

The layer over a gap pulls on the edge of a pillar with T (p + m - u), T = tanh(b/2), before any
slip, too: slip begins at any load. It grows from both edges over a length s. The core, which
sticks, bears p + m; with y from its end,

    u" = u - p + max(1 - u/kappa, 0),    u = u' = 0 at y = 0,    u' = T (p + m - u) at y = s,

so that u = (1 - p) f with f = (1 - cos q y)/q², q² = 1/kappa - 1, until u = kappa, and
u = p + (u_0 - p) cosh z + u_0' sinh z beyond. The friction beyond that of sliding is, per pillar
and Delta, the mean `excess` of p over the core and of 1 - u/kappa over the weakening zone. A
sharp front, kappa << 1, is one with u = 0 and u' = sqrt(kappa): there M u'² is 2 Gamma, and the
fracture energy Gamma = Delta d_c/2.
"""

import cmath
import math
from dataclasses import dataclass, replace
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, minimize_scalar
from scipy.sparse import csc_array, diags_array, eye_array, kronsum
from scipy.sparse.linalg import spsolve

from springblock.model.material import Material
from springblock.model.numbers import Array
from springblock.simulation import resolution
from springblock.simulation.resolution import STIFFNESS

#: Strongly damped, without disorder and healing; sizes are those of the theory.
PLAIN = Material(
    gamma=1e6,
    mu_static_std=0.0,
    mu_dynamic_std=0.0,
    law="slip_weakening",
    slip_distance=1e-7,
    healing="none",
)
#: States of a stripe, and loads of a square, at which the force is computed.
_STATES, _LOADS = 200, 20
#: Values of mu_d and kappa for which the best width is shown.
MU_D = (0.1, 0.3, 0.6, 0.75, 0.9)
KAPPA = (0.1, 0.2, 0.35, 0.5, 0.8, 1.2, 2.0, 4.0)
_BEST = 3.0, 40.0  #: widths among which the best one is looked for
#: Decrease of slip, in Delta/k, that is rounding.
_SLACK = 1e-9


@dataclass(frozen=True)
class Groups:
    """Dimensionless groups of the theory."""

    decay: float  #: lambda, m
    residual: float  #: m
    kappa: float
    material: Material

    @classmethod
    def of(cls, material: Material, along: str, fraction: float) -> "Groups":
        """Return the groups of pillars with this contact fraction; `along` as in `STIFFNESS`."""
        return cls(
            math.sqrt(STIFFNESS[along]) * material.thickness,
            material.mu_dynamic / (material.mu_static - material.mu_dynamic),
            resolution.kappa(material, fraction),
            material,
        )

    @property
    def numbers(self) -> tuple[float, float]:
        """m and kappa, on which the excess depends."""
        return self.residual, self.kappa

    def friction(self, excess: float) -> float:
        """Return the coefficient of friction for an excess."""
        mu_s, mu_d = self.material.mu_static, self.material.mu_dynamic
        return mu_d + (mu_s - mu_d) * excess

    @property
    def process_zone(self) -> float:
        """Length of the weakening zone at p = 0, m; without bound from kappa = 1 on."""
        return resolution.process_zone(self.decay, self.kappa)


class Peak(NamedTuple):
    """Largest friction while a stripe is loaded."""

    excess: float
    slipped: float  #: s over lambda
    load: float  #: p
    stable: bool  #: whether the fronts still need more load to grow


def stripe(width: float, gap: float, residual: float, kappa: float) -> Peak:
    """Return the peak of a cohesive stripe; lengths in lambda.

    Fronts grow from the edges until the load has a maximum, where the rest slips at once.
    """
    zone = _Weakening(kappa)
    pull = math.tanh(gap / 2.0)
    lengths = width / 2.0 * np.arange(1, _STATES + 1) / _STATES
    loads = np.array([_load(zone, s, residual, pull) for s in lengths])
    last = int(np.argmax(np.diff(loads, append=-np.inf) < 0.0))

    def excess(s: float) -> float:
        p = _load(zone, s, residual, pull)
        end = min(s, zone.length(p))
        return (p * (width / 2.0 - s) + end - (1.0 - p) / kappa * zone.area(end)) * 2.0 / width

    forces = np.array([excess(s) for s in lengths[: last + 1]])
    best = int(np.argmax(forces))
    if best == last:
        return Peak(float(forces[last]), float(lengths[last]), float(loads[last]), False)
    bounds = lengths[max(best - 1, 0)], lengths[best + 1]
    s = float(minimize_scalar(lambda s: -excess(s), bounds=bounds, method="bounded").x)
    return Peak(excess(s), s, _load(zone, s, residual, pull), True)


class _Weakening(NamedTuple):
    """Solution f of f" = 1 - q² f from f = f' = 0."""

    kappa: float

    @property
    def wave(self) -> complex:
        return complex(1.0 / self.kappa - 1.0 or 1e-12) ** 0.5

    def f(self, y: float) -> float:
        return (2.0 * (cmath.sin(self.wave * y / 2.0) / self.wave) ** 2).real

    def slope(self, y: float) -> float:
        return (cmath.sin(self.wave * y) / self.wave).real

    def area(self, y: float) -> float:
        return ((y - cmath.sin(self.wave * y) / self.wave) / self.wave**2).real

    def length(self, p: float) -> float:
        """Return y where (1 - p) f is kappa; infinite if it never is."""
        if p >= 1.0:
            return math.inf
        half = complex(self.kappa / (1.0 - p) / 2.0) ** 0.5 * self.wave
        y = 2.0 * cmath.asin(half) / self.wave
        return y.real if abs(y.imag) < 1e-9 * abs(y) else math.inf


def _load(zone: _Weakening, s: float, residual: float, pull: float) -> float:
    """Return p for fronts at s, from the condition on u at the edge.

    It is linear in p where the whole slip zone weakens, and solved by a root elsewhere.
    """
    rise = zone.slope(s) + pull * zone.f(s)
    within = (rise - pull * residual) / (rise + pull)
    if s <= zone.length(within):
        return within

    def unbalanced(p: float) -> float:
        y = min(s, zone.length(p))
        u, slope, z = (1.0 - p) * zone.f(y), (1.0 - p) * zone.slope(y), s - y
        edge = p + (u - p) * math.cosh(z) + slope * math.sinh(z) if z else u
        bend = (u - p) * math.sinh(z) + slope * math.cosh(z)
        return bend - pull * (p + residual - edge)

    return float(brentq(unbalanced, -residual, 1.0, xtol=1e-14))


def best_width(residual: float, kappa: float) -> float:
    """Return the width over lambda of stripes with the lowest friction, with b = a."""

    def excess(log_width: float) -> float:
        width = math.exp(log_width)
        return stripe(width, width, residual, kappa).excess

    found = minimize_scalar(excess, bounds=np.log(_BEST), method="bounded", options={"xatol": 0.01})
    return math.exp(found.x)


@cache
def best_widths() -> Array:
    """Return `best_width` for mu_s = 1, `MU_D` and `KAPPA`, (mu_d, kappa)."""
    return np.array([[best_width(mu / (1.0 - mu), kappa) for kappa in KAPPA] for mu in MU_D])


def sharp_minimum(residual: float, kappa: float) -> tuple[float, float]:
    """Return the width of lowest friction over lambda, and its excess, with b = a.

    a* = 2 (x + 1/(x - 1)) and excess sqrt(kappa)/x where x exp(-x)/(x - 1) = sqrt(kappa)/m; x is
    the length of the fronts at the peak, and a* is stationary, 6, at x = 2.
    """
    ratio = math.sqrt(kappa) / residual
    x = float(brentq(lambda x: x * math.exp(-x) - ratio * (x - 1.0), 1.0 + 1e-12, 700.0))
    return 2.0 * (x + 1.0 / (x - 1.0)), math.sqrt(kappa) / x


class Slip(NamedTuple):
    """Slip of a cell, flat (N_y N_x,)."""

    u: Array
    slides: NDArray[np.bool_]


class Cell:
    """Periodic cell of pillars that is its own mirror image at all edges, in blocks.

    The scalar problem: the displacement along the sliding direction, with one M along it and
    another across. `drop` is tau_s - tau_d on each block, (N_y, N_x), over its mean Delta.
    """

    def __init__(self, contact: NDArray[np.bool_], thickness: float, drop: Array | float) -> None:
        """Take the blocks in contact, (N_y, N_x), and l_z in blocks."""
        y, x = map(_second_difference, contact.shape)
        y, x = STIFFNESS["y"] * thickness**2 * y, STIFFNESS["x"] * thickness**2 * x
        self.contact, self.drop = contact.ravel(), np.broadcast_to(drop, contact.shape).ravel()
        self.matrix = csc_array(kronsum(x, y) + eye_array(contact.size))

    def excess(self, residual: float, kappa: float) -> float:
        """Return the largest mean of (tau - tau_d)/Delta on blocks in contact as the load grows.

        The load is k U/Delta. Finer loads follow around that of the largest, from the state before.
        """
        n, best = len(self.contact), 0.0
        start, low, step = Slip(np.zeros(n), np.zeros(n, bool)), 0.0, (1.0 + residual) / _LOADS
        for _ in range(3):
            state, before, peak = start, start, low
            for load in low + step * np.arange(1, 2 * _LOADS):
                settled = self.settle(state, load, residual, kappa)
                if settled is None:
                    break
                stress = (load - self.matrix @ settled.u)[self.contact].mean()
                if stress - residual > best:
                    best, start, low = stress - residual, before, peak
                before, state, peak = state, settled, load - step
            step /= 10.0
        return float(best)

    def settle(self, slip: Slip, load: float, residual: float, kappa: float) -> Slip | None:
        """Return the slip under a larger load; None where fronts do not stop before all slides."""
        slides, weak = slip.slides.copy(), slip.u >= kappa
        while True:
            free = ~self.contact | slides
            softening = np.where(slides & ~weak, self.drop / kappa, 0.0)
            friction = np.where(slides, residual + ~weak * self.drop, 0.0)
            stiffness = (self.matrix - diags_array(softening))[free][:, free]
            u = np.zeros(len(free))
            u[free] = spsolve(csc_array(stiffness), (load - friction)[free], "MMD_AT_PLUS_A")
            if (u < slip.u - _SLACK).any() or slides[self.contact].all():
                return None
            if ((u >= kappa) & slides != weak & slides).any():
                weak = u >= kappa
                continue
            overloaded = self.contact & ~slides & (load - self.matrix @ u > residual + self.drop)
            if not overloaded.any():
                return Slip(u, slides)
            slides |= overloaded


def with_springs(material: Material, root: float) -> Material:
    """Return a material with K_s = 3/4 E l²/l_z multiplied by root², and the same K_int and m."""
    thickness, density = material.thickness / root, material.density * root
    modulus = material.youngs_modulus * root
    return replace(material, thickness=thickness, density=density, youngs_modulus=modulus)


def _second_difference(n: int) -> csc_array:
    """Return minus the second difference of n values with a mirror at both ends, (n, n)."""
    second = diags_array([-1.0, 2.0, -1.0], offsets=[-1, 0, 1], shape=(n, n)).tolil()
    second[0, 0] -= 1.0
    second[n - 1, n - 1] -= 1.0
    return csc_array(second)
