"""The lattice is an isotropic elastic sheet: E, nu = 1/3 and G = 3/8 E in plane stress.

Stress is force per area through a cut. At a uniform strain the springs to the left of a cut pull
those to its right with the sum of F_int over all blocks on the left. A free edge lacks half of
its diagonals, so that a sheet of N rows carries a little less than N rows of the bulk; the
difference between N + 1 and N rows is exactly one row of the bulk.
"""

import numpy as np
import pytest

from springblock import Material
from springblock.accuracy.kernels import spring_forces

PAPER = Material()
NU = 1.0 / 3.0
TINY = 1e-9  #: strain; the springs are linear up to it


def pull_through_cut(strain, n):
    """Force (2,), N, through a cut across the x axis of n x n blocks, strained uniformly."""
    x, y = np.meshgrid(np.arange(n), np.arange(n))
    u = np.einsum("ij,jyx->iyx", strain, np.stack([x, y]))
    unit = PAPER.k_int * PAPER.spacing
    return unit * spring_forces(u)[:, :, : n // 2].sum(axis=(1, 2))


def traction(strain):
    """sigma_xx and sigma_xy in Pa, of the bulk."""
    row = pull_through_cut(strain, 9) - pull_through_cut(strain, 8)
    return row / (PAPER.spacing * PAPER.thickness)


def plane_stress(strain):
    """Hooke's law of an isotropic sheet with E and nu = 1/3: its row sigma_xx, sigma_xy."""
    (xx, xy), (_, yy) = strain
    modulus = PAPER.youngs_modulus
    return np.array([modulus / (1 - NU**2) * (xx + NU * yy), modulus / (1 + NU) * xy])


def test_uniaxial_stress_gives_youngs_modulus_and_poissons_ratio():
    """Stretched by e along x and shrunk by e/3 along y, the sheet carries E e, and along x only."""
    stretched = TINY * np.diag([1.0, -NU])
    turned = stretched[::-1, ::-1]
    stress = PAPER.youngs_modulus * TINY
    # second order in the strain, and the rounding of a difference of sums of 40 forces
    np.testing.assert_allclose(traction(stretched), [stress, 0.0], rtol=0, atol=1e-8 * stress)
    np.testing.assert_allclose(traction(turned), [0.0, 0.0], rtol=0, atol=1e-8 * stress)


def test_shear_modulus_is_three_eighths_of_youngs():
    """Simple shear u_x = gamma y: half of it strain, half of it rotation without effect."""
    sheared = TINY * np.array([[0.0, 1.0], [0.0, 0.0]])
    stress = 3.0 / 8.0 * PAPER.youngs_modulus * TINY
    np.testing.assert_allclose(traction(sheared), [0.0, stress], rtol=0, atol=1e-8 * stress)


@pytest.mark.parametrize("angle", [0.0, 20.0, 45.0, 70.0])
@pytest.mark.parametrize("principal", [(1.0, 0.0), (1.0, 1.0), (1.0, -1.0)])
def test_the_sheet_is_isotropic(angle, principal):
    """Hooke's law holds whichever way the principal strains are turned."""
    cosine, sine = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    turn = np.array([[cosine, -sine], [sine, cosine]])
    strain = TINY * turn @ np.diag(principal) @ turn.T
    scale = PAPER.youngs_modulus * TINY
    np.testing.assert_allclose(traction(strain), plane_stress(strain), rtol=0, atol=1e-8 * scale)
