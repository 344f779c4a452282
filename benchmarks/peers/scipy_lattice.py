"""The frictionless lattice for SciPy's integrators: a right-hand side in NumPy.

As one would write it with arrays: each kind of spring is a difference of two shifted views, and its
pull is added at both ends. Friction is left out, for no smooth integrator can step across it.
"""

import numpy as np
from scipy.integrate import DOP853

from springblock import Material

#: A step of this length is the study's default; displacements are in l, times in these.
UNIT = 1e-8
#: Error that DOP853 accepts per step, relative to the size of the fields.
RTOL = 1e-6

_ALL, _FIRST, _LAST = slice(None), slice(None, -1), slice(1, None)
#: (dx, dy), where the springs begin and where they end, as [y, x]
_SPRINGS = (
    ((1, 0), (_ALL, _FIRST), (_ALL, _LAST)),
    ((0, 1), (_FIRST, _ALL), (_LAST, _ALL)),
    ((1, 1), (_FIRST, _FIRST), (_LAST, _LAST)),
    ((-1, 1), (_FIRST, _LAST), (_LAST, _FIRST)),
)


class ScipyLattice:
    """N x N blocks followed by DOP853, pulled along x."""

    def __init__(self, velocity: np.ndarray, material: Material | None = None) -> None:
        """Start without strain, with `velocity` (2, N, N) in l per UNIT."""
        m = material or Material()
        self._shape = velocity.shape
        self._stiffness = m.k_int * UNIT**2 / m.mass
        self._k_s = m.k_s * UNIT**2 / m.mass
        self._gamma = m.gamma * UNIT
        self._slider = np.array([m.slider_velocity * UNIT / m.spacing, 0.0])[:, None, None]
        start = np.concatenate([np.zeros(velocity.size), velocity.ravel()])
        scale = float(np.abs(velocity).std())
        self._end = 0.0
        self._solver = DOP853(self.rate, 0.0, start, np.inf, rtol=RTOL, atol=RTOL * scale)

    def rate(self, t: float, state: np.ndarray) -> np.ndarray:
        """Time derivative of displacement and velocity, one after the other."""
        u, v = state.reshape(2, *self._shape)
        acceleration = self._k_s * (self._slider * t - u) - self._gamma * v
        for (dx, dy), begin, end in _SPRINGS:
            rest = np.hypot(dx, dy)
            ex, ey = u[(_ALL, *end)] - u[(_ALL, *begin)]
            ex += dx
            ey += dy
            pull = self._stiffness / rest**2 * (1.0 - rest / np.sqrt(ex * ex + ey * ey))
            force = np.stack([pull * ex, pull * ey])
            acceleration[(_ALL, *begin)] += force
            acceleration[(_ALL, *end)] -= force
        return np.concatenate([v.ravel(), acceleration.ravel()])

    def advance(self, steps: int) -> None:
        """Go on by so many UNIT, and to the end of the step of DOP853's own choice there."""
        self._end += steps
        while self._solver.t < self._end:
            self._solver.step()
