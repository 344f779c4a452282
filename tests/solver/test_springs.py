"""Springs of the lattice against exact arithmetic, and their symmetries."""

import mpmath
import numpy as np
import pytest

from springblock.simulation.simulate import SimulationError
from springblock.solver.springs import Q_MAX, Q_MIN, SERIES_RANGE, g, series
from springs import spring_forces

EPS = np.finfo(float).eps
SERIES_ERROR = 1.7e-9  #: largest relative error of the polynomial
N = 5


@pytest.fixture(autouse=True)
def _forty_digits():
    with mpmath.workdps(40):
        yield


def exact_g(q):
    """g(q) = (1 - (1 + q)^(-1/2))/q."""
    q = mpmath.mpf(q)
    return (1 - 1 / mpmath.sqrt(1 + q)) / q


def exact_pull(d, e, k):
    """F = k (1 - L/r) (e + d), of a spring with rest vector e whose ends have moved d apart."""
    rest, now = mpmath.matrix(e), mpmath.matrix(e) + d
    return k * (1 - mpmath.norm(rest) / mpmath.norm(now)) * now


def exact_forces(u):
    """F_int/(K_int l), (2, N, N), pair by pair, rounded at the very end."""
    n = u.shape[-1]
    total = [[mpmath.matrix([0, 0]) for _ in range(n)] for _ in range(n)]
    for y, x in np.ndindex(n, n):
        for dx, dy in ((1, 0), (0, 1), (1, 1), (-1, 1)):
            if 0 <= x + dx < n and y + dy < n:
                here, there = (mpmath.matrix(u[:, b, a]) for a, b in ((x, y), (x + dx, y + dy)))
                k = mpmath.mpf(1) / (1 if dx * dy == 0 else 2)
                pull = exact_pull(there - here, [dx, dy], k)
                total[y][x] += pull
                total[y + dy][x + dx] -= pull
    return np.array([[[float(f[i]) for f in row] for row in total] for i in range(2)])


def test_the_series_is_as_good_as_it_says():
    q = np.linspace(-SERIES_RANGE, SERIES_RANGE, 101)[np.arange(101) != 50]
    polynomial = np.polynomial.polynomial.polyval(q, series())
    exact = np.array([float(exact_g(x)) for x in q])
    error = np.abs(polynomial / exact - 1.0)
    assert 0.5 * SERIES_ERROR < error.max() <= SERIES_ERROR


@pytest.mark.parametrize("q", [Q_MIN, -0.5, -SERIES_RANGE, 1e-300, SERIES_RANGE, 1.0, Q_MAX])
def test_the_closed_form_is_exact_to_rounding_at_any_strain(q):
    """1 + q loses up to 1/(1 + q) units in the last place; a root and two more operations."""
    exact = 0.5 if q == 1e-300 else float(exact_g(q))
    assert g(q) == pytest.approx(exact, rel=EPS * (3 + 1 / (1 + q)))


@pytest.mark.parametrize("amplitude", [1e-12, 1e-2, 0.2])
def test_forces_are_exact_to_the_rounding_of_differences(amplitude, rng):
    """Displacements of size a round by a·eps in each difference; eight springs meet in a block.

    The series adds its error to each of them. The error does not depend on the strain: 1 - L/r
    would have only four correct digits at a strain of 1e-12.
    """
    u = amplitude * rng.uniform(-1.0, 1.0, (2, N, N))
    each = 4 * EPS * amplitude + SERIES_ERROR * min(amplitude, SERIES_RANGE)
    np.testing.assert_allclose(spring_forces(u), exact_forces(u), rtol=0, atol=8 * each)


@pytest.mark.parametrize(
    ("spring", "swung", "pivot"),
    [("north", (0, 1), (1, 0)), ("north-east", (1, 1), (1, 0)), ("north-west", (0, 1), (0, 0))],
)
def test_one_spring_out_of_range_needs_the_closed_form(spring, swung, pivot):
    """One of four blocks rotates about another, which changes one spring from the first row.

    It also changes the eastern spring, the only one, from the second row.
    """
    arm = complex(*swung) - complex(*pivot)
    moved = arm * (np.exp(0.3j) - 1.0)
    u = np.zeros((2, 2, 2))
    u[:, swung[1], swung[0]] = moved.real, moved.imag
    np.testing.assert_allclose(
        spring_forces(u), exact_forces(u), rtol=0, atol=8 * EPS, err_msg=spring
    )


@pytest.mark.parametrize("angle", [1e-9, 1e-3, -0.5, np.pi])
def test_a_rotation_strains_nothing_beyond_rounding_and_a_translation_nothing(angle):
    """The springs are exact in the angle; linear ones would pull with angle²/2.

    Nor does anything break beyond the edges, where there are no springs.
    """
    shift = np.array([0.1, -7.3])[:, None, None]
    assert not spring_forces(np.broadcast_to(shift, (2, N, N))).any()
    x, y = np.meshgrid(np.arange(N), np.arange(N))
    cosine, sine = -2.0 * np.sin(angle / 2.0) ** 2, np.sin(angle)  # cos - 1, without cancellation
    u = np.stack([cosine * x - sine * y, sine * x + cosine * y])
    assert np.abs(spring_forces(u)).max() <= 8 * 4 * EPS * np.abs(u).max()


@pytest.mark.parametrize(
    ("where", "move", "found_at"),
    [
        # Blocks 2 to 4 of every row move away from block 1: its eastern spring breaks first.
        *(((slice(None), slice(2, N)), move, (0, 1)) for move in ((-0.501, 0.0), (np.nan, 0.0))),
        *(((slice(None), slice(2, N)), move, (0, 1)) for move in ((1.001, 0.0), (0.0, np.inf))),
        # A block at the edge in row 2 comes too near to just one neighbour:
        ((2, 0), (0.51, 0.0), (2, 0)),  # to the east,
        ((2, 0), (0.0, 0.51), (2, 0)),  # north,
        ((2, 0), (0.51, 0.51), (2, 0)),  # north-east,
        ((2, N - 1), (-0.51, 0.51), (2, N - 2)),  # and north-west
    ],
)
def test_a_broken_spring_is_found(where, move, found_at):
    u = np.zeros((2, N, N))
    u[0][where], u[1][where] = move
    y, x = found_at
    with pytest.raises(SimulationError, match=rf"a spring of block \({y}, {x}\) has collapsed"):
        spring_forces(u)
