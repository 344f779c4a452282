"""A prediction of two load peaks on pawls and grooves, from elasticity and friction alone.

Endless grooves have a period of n_p2 rows of blocks in contact and n_s2 rows without. The two outer
rows in contact, the edges, carry more than the others, the core. Forces are in units of F_n on a
block in contact, and s is the position of the slider at which the stress on edges would be s
without slip:

    mean      R, the mean stress over that on edges: the load is R s before any slip.
    lost      G, the load lost per block in contact if each edge block carries 1 less.
    shared    J, the share of the loss of an edge block that other blocks of its edge take up.
    next_to   c, the stress on the rows next to the edges over that on edges.
    handed_on T, the load that these rows gain if each edge block carries 1 less.

An edge block detaches at mu_s, normal with the standard deviation w, and loses D = mu_s - mu_d.
When the share p(z), normal, of edge blocks has detached, the others carry s + J D p = mu_s + w z:

    load(z) = R s - G D p = R (mu_s + w z) - (J R + G) D p(z):

linear in p, which is exact for the load when all edge blocks have detached, and for the stress when
few have. The load has a maximum and a minimum where p'(z) = R w / ((J R + G) D), thus only if

    h = (J R + G) D / (R w) > sqrt(2 pi):

the edges detach faster than the slider loads the blocks at rest. The load falls by at most G D. For
a second peak the core must then carry more than at this minimum: the rows next to the edges reach
mu_s where c s + T (s - mu_d) = mu_s, and there the load is R s - G (s - mu_d).
"""

from typing import NamedTuple

import numpy as np
from scipy.special import ndtr

from springblock.mechanism.elasticity import Layer
from springblock.model.material import Material

#: Two load peaks are predicted for prominences beyond this, in percent. Prominences of 1 % are
#: measured where 0.2 to 0.4 % are predicted, on the surfaces of `docs/beyond.md`, section 2.
TWO_PEAKS = 0.25
_ALONG = 16  #: blocks along the grooves of a layer with periodic edges


class Pawl(NamedTuple):
    """Elasticity of one period of pawl and groove; R, G, J, c and T of the module's docstring."""

    mean: float
    lost: float
    shared: float
    next_to: float
    handed_on: float


def pawl(n_p2: int, n_s2: int, across: bool, material: Material) -> Pawl:
    """Return the elasticity of pawls of `n_p2` >= 2 rows, sliding along or `across` grooves."""
    contact = np.zeros((n_p2 + n_s2, _ALONG), bool)
    contact[:n_p2] = True
    k = n_p2 * _ALONG
    own = slice(k, 2 * k) if across else slice(k)  # components in the direction of sliding
    stiffness = Layer(contact, material, periodic=True).stiffness[own, own]
    blocks = stiffness.reshape(n_p2, _ALONG, n_p2, _ALONG)
    rows = blocks[:, 0].sum(axis=2)  # of rows that move as a whole
    stress, edges = rows.sum(axis=1), [0, n_p2 - 1]  # as if all rows moved by -s
    slip = np.linalg.solve(rows[np.ix_(edges, edges)], np.ones(2))
    change = -rows[:, edges] @ slip
    return Pawl(
        mean=float(stress.mean() / stress[0]),
        lost=float(-change.mean()),
        shared=float(1.0 - rows[0, 0] / blocks[0, 0, 0, 0]),
        next_to=float(stress[1] / stress[0]),
        handed_on=float(change[1]),
    )


def prominence(n_p2: int, n_s2: int, across: bool, material: Material) -> float:
    """Return the predicted prominence of the lesser load peak in percent of the first peak."""
    if n_p2 < 3:  # no core
        return 0.0
    of = pawl(n_p2, n_s2, across, material)
    mu_s, mu_d, scatter = material.mu_static, material.mu_dynamic, material.mu_static_std
    peak = of.mean * mu_s
    fall = of.mean * _fall((of.shared + of.lost / of.mean) * (mu_s - mu_d), scatter)
    fall = min(fall, of.lost * (mu_s - mu_d))
    slider = (mu_s + of.handed_on * mu_d) / (of.next_to + of.handed_on)
    second = of.mean * slider - of.lost * (slider - mu_d)
    return 100.0 * max(min(fall, second - (peak - fall)), 0.0) / peak


def _fall(drop: float, scatter: float) -> float:
    """Fall of w z - drop p(z) from its maximum to its minimum; 0 if it has none."""
    least = np.sqrt(2.0 * np.pi) * scatter
    if drop <= least or scatter == 0.0:
        return max(drop - least, 0.0)
    z = np.sqrt(2.0 * np.log(drop / least))
    return float(drop * (2.0 * ndtr(z) - 1.0) - 2.0 * scatter * z)
