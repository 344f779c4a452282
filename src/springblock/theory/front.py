"""Passage of a slip front at a depth below an edge, under slip weakening with disorder.

First-order perturbation of `springblock.theory.layer`, in its units: x runs inwards from the
edge of a stripe, z along the edge, lengths are in lambda_n across the edge (lambda_t along it). At
the load P = k U/Delta the front is at s, and slip is u(x). Under disorder dtau(x) e^(iqz) of the
strength tau_s and the friction tau_d, slip changes by du, and in the zone that has slipped

    du" - (1 + q² lambda_t² - w) du = dtau,    w = 1/kappa where u < kappa, else 0,
    dtau = dtau_s (1 - u/kappa)₊ + dtau_d min(u/kappa, 1),
    du' = m tanh(m b/2) du at the edge, m² = 1 + q² lambda_t²;    du = 0 at the front.

What is ahead of the front is pinned: the front shifts by ds = -du'(s)/u"(s), and the load at which
it passes s by dP = -ds dP/ds. By reciprocity du'(s) = ∫ phi_q dtau dx over the zone, where phi_q
solves the homogeneous equation with phi_q(s) = 1: about exp[-(s - x) sqrt(1 - w + q² lambda_t²)].
A front averages the disorder behind it over a width lambda_t (s - x). Under normal disorder with
the autocorrelation exp(-r²/xi²),

    c(r) = ∫ cos(qr) C(q) dq / ∫ C(q) dq,    C(q) = √pi xi exp(-q² xi²/4)
           · Σ ∫∫ phi_q(x) phi_q(x') a(x) a(x') exp(-(x - x')²/xi²) dx dx',

the sum over tau_s and tau_d, where a is the factor of dtau times the standard deviation.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from springblock.model.material import Material
from springblock.model.numbers import Array
from springblock.simulation.resolution import STIFFNESS
from springblock.theory.layer import Groups, _load, _Weakening

_NODES = 64  #: of Gauss's quadrature over the zone that has slipped
_WAVES, _HIGHEST = 400, 12.0  #: wave numbers q of integrals, and the largest, over 1/xi
_STEP = 1e-4  #: of s, in lambda_n, for dP/ds


@dataclass(frozen=True)
class Front:
    """Front at a depth below the edge of a stripe; lengths in lambda_n."""

    groups: Groups
    depth: float  #: s
    gap: float  #: b
    along: float  #: lambda_t

    @classmethod
    def of(cls, material: Material, shape: str, depth: float, width: float, gap: float) -> "Front":
        """Return that on a stripe "along" or "across" the sliding direction; lengths in m."""
        normal, other = ("y", "x") if shape == "along" else ("x", "y")
        groups = Groups.of(material, normal, width / (width + gap))
        ratio = math.sqrt(STIFFNESS[other] / STIFFNESS[normal])
        return cls(groups, depth / groups.decay, gap / groups.decay, ratio)

    @cached_property
    def _zone(self) -> _Weakening:
        return _Weakening(self.groups.kappa)

    def _load_at(self, s: float) -> float:
        return _load(self._zone, s, self.groups.residual, math.tanh(self.gap / 2.0))

    @cached_property
    def load(self) -> float:
        """P - m at which the front passes without disorder."""
        return self._load_at(self.depth)

    @cached_property
    def weakening(self) -> float:
        """Length of the zone that weakens, behind the front."""
        return min(self.depth, self._zone.length(self.load))

    def factors(self, x: Array) -> Array:
        """Return those of dtau_s and dtau_d in dtau, (2, x)."""
        y = np.minimum(self.depth - x, self.weakening)  # beyond it u > kappa
        slip = (1.0 - self.load) * np.array([self._zone.f(each) for each in y])
        weakened = np.minimum(slip / self.groups.kappa, 1.0)
        return np.stack([1.0 - weakened, weakened])

    def influence(self, q: Array, x: Array) -> Array:
        """Return phi_q(x), (q, x)."""
        m = np.sqrt(1.0 + (self.along * q[:, None]) ** 2).astype(complex)
        weak = np.sqrt(m**2 - 1.0 / self.groups.kappa)
        edge, start = m * np.tanh(m * self.gap / 2.0), self.depth - self.weakening

        def within(x: Array) -> Array:
            z, y = np.minimum(x, start), np.maximum(x - start, 0.0)
            value = np.cosh(m * z) + edge / m * np.sinh(m * z)
            slope = m * np.sinh(m * z) + edge * np.cosh(m * z)
            return value * np.cosh(weak * y) + slope / weak * np.sinh(weak * y)

        return np.real(within(x) / within(np.array([self.depth])))

    @cached_property
    def shift(self) -> float:
        """-dP/du'(s), by the shift of the front, where u" = 1 - P + m."""
        more, less = (self._load_at(self.depth + step) for step in (_STEP, -_STEP))
        return (more - less) / (2.0 * _STEP) / (1.0 - self.load)

    @cached_property
    def spectrum(self) -> tuple[Array, Array]:
        """Wave numbers q and C(q), (n,) each, for the disorder of the material."""
        material = self.groups.material
        xi = material.correlation_length / self.groups.decay
        std = np.array([material.mu_static_std, material.mu_dynamic_std])
        std /= material.mu_static - material.mu_dynamic
        node, weight = np.polynomial.legendre.leggauss(_NODES)
        x, weight = (node + 1.0) / 2.0 * self.depth, weight / 2.0 * self.depth
        q, alike = np.linspace(0.0, _HIGHEST / xi, _WAVES), np.exp(-(((x[:, None] - x) / xi) ** 2))
        felt = self.influence(q, x) * weight * (std[:, None] * self.factors(x))[:, None]
        power = np.einsum("kqi,ij,kqj->q", felt, alike, felt)
        return q, power * math.sqrt(math.pi) * xi * np.exp(-((q * xi / 2.0) ** 2))

    @property
    def scatter(self) -> float:
        """Standard deviation of the load of passage over its mean."""
        q, power = self.spectrum
        mean = self.load + self.groups.residual
        return self.shift * math.sqrt(np.trapezoid(power, q) / math.pi) / mean

    def correlation(self, r: Array) -> Array:
        """Return c(r) of the load of passage along the edge, (r,), for r in m."""
        q, power = self.spectrum
        waves = np.cos(np.asarray(r)[:, None] / self.groups.decay * q)
        return np.asarray(np.trapezoid(waves * power, q) / np.trapezoid(power, q))
