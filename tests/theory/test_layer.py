"""The theory of the continuum against its limits; lengths in lambda, stresses in Delta."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar

from springblock import Material
from springblock.theory.layer import Cell, Groups, Peak, Slip, best_width, sharp_minimum, stripe

RESIDUAL = 1.5  #: mu_d/(mu_s - mu_d) of the paper


def sharp(width, residual, kappa):
    """Peak with sharp fronts and wide gaps.

    p = sqrt(kappa) - m exp(-s) while s grows, which is always stable. The excess p c + sqrt(kappa)
    of a core of half-width c = a/2 - s is largest where m exp(-s) (1 + c) = sqrt(kappa).
    """
    front = math.sqrt(kappa)

    def rise(s):
        return residual * math.exp(-s) * (1.0 + width / 2.0 - s) - front

    s = brentq(rise, 0.0, width / 2.0) if rise(width / 2.0) < 0.0 else width / 2.0
    p = front - residual * math.exp(-s)
    excess = (p * (width / 2.0 - s) + front) * 2.0 / width
    return Peak(excess, s, p, True)


def test_the_groups_are_those_of_the_papers_layer():
    """M = 9/8 E l_z along and 3/8 E l_z across it, k = 3/4 E/l_z, sigma_n = 2 P."""
    material = Material(law="slip_weakening", slip_distance=1e-7)
    for along, ratio in (("x", 1.5), ("y", 0.5)):
        groups = Groups.of(material, along, 0.5)
        assert groups.decay == pytest.approx(math.sqrt(ratio) * 1e-5)
        assert groups.residual == pytest.approx(RESIDUAL)
        assert groups.kappa == pytest.approx(0.75e12 * 1e-7 / 0.4e5)
        assert groups.friction(0.5) == pytest.approx(0.8)


@pytest.mark.parametrize("kappa", [1e-3, 1e-2, 0.1])
@pytest.mark.parametrize("width", [9.0, 14.0])
def test_a_short_process_zone_is_a_sharp_front(width, kappa):
    """The weakening zone is of length sqrt(kappa), and its energy differs by a share of kappa."""
    one, other = stripe(width, 40.0, RESIDUAL, kappa), sharp(width, RESIDUAL, kappa)
    assert one.stable
    assert one.excess == pytest.approx(other.excess, rel=0.5 * kappa)
    assert one.slipped - math.sqrt(kappa) < other.slipped < one.slipped + math.sqrt(kappa)


@pytest.mark.parametrize("kappa", [0.1, 1.0, 4.0])
def test_a_narrow_pillar_slips_as_a_whole_at_its_static_friction(kappa):
    """Its edges are nearly as far loaded as its core: the excess is 1 up to a share of a."""
    peak = stripe(0.01, 0.01, RESIDUAL, kappa)
    assert not peak.stable
    assert 1.0 - 0.01 < peak.excess <= 1.0


def test_the_minimum_with_sharp_fronts_is_that_of_the_closed_form():
    for kappa in (1e-3, 0.1, 1.0):
        width, excess = sharp_minimum(RESIDUAL, kappa)
        found = minimize_scalar(lambda a, k=kappa: sharp(a, RESIDUAL, k).excess, bounds=(3, 30))
        assert found.x == pytest.approx(width, rel=1e-3)
        assert found.fun == pytest.approx(excess, rel=1e-6)


def test_the_width_of_lowest_friction_is_stationary_at_six_decay_lengths():
    """Where fronts of two decay lengths are the longest stable ones: x = 2."""
    kappa = (2.0 * math.exp(-2.0) * RESIDUAL) ** 2
    assert sharp_minimum(RESIDUAL, kappa)[0] == pytest.approx(6.0)
    for factor in (0.9, 1.1):
        assert sharp_minimum(RESIDUAL, factor * kappa)[0] == pytest.approx(6.0, abs=0.01)
    beside = [stripe(a, a, RESIDUAL, kappa).excess for a in (5.0, 6.0, 7.2)]
    assert min(beside) == beside[1]  # also with cohesive fronts


@pytest.mark.parametrize(("mu_d", "kappa", "width"), [(0.3, 0.5, 10.9), (0.6, 2.0, 6.6)])
def test_the_width_of_lowest_friction_is_that_of_the_theory(mu_d, kappa, width):
    residual = mu_d / (1.0 - mu_d)
    assert best_width(residual, kappa) == pytest.approx(width, abs=0.15)
    excess = [stripe(a, a, residual, kappa).excess for a in (0.8 * width, width, 1.25 * width)]
    assert min(excess) == excess[1]


def quarter(pillar, gap, thickness, drop=1.0):
    """Cell of half a pillar and half a gap a side."""
    inside = np.arange(pillar + gap) < pillar
    return Cell(np.outer(inside, inside), thickness, drop)


def test_a_row_of_a_cell_is_a_stripe():
    """On a lattice of lambda/16, whose error is of second order."""
    inside = np.arange(96) < 48
    cell = Cell(inside[None], 16.0 / 1.5**0.5, 1.0)
    assert cell.excess(RESIDUAL, 0.9) == pytest.approx(
        stripe(6.0, 6.0, RESIDUAL, 0.9).excess, abs=2e-3
    )


def test_work_is_stored_or_dissipated_on_a_square():
    """In Delta²/k per area: by the trapezoidal rule, whose error is that of the square of steps."""
    kappa, square = 0.9, quarter(8, 8, 4.0, drop=np.linspace(0.8, 1.2, 16))
    whole = len(square.contact)
    state, heat = Slip(np.zeros(whole), np.zeros(whole, bool)), 0.0
    forces, stresses = [0.0], [np.zeros(whole)]
    for load in 0.02 * np.arange(1, 126):
        now = square.settle(state, load, RESIDUAL, kappa)
        if now is None:
            break
        stress = load - square.matrix @ now.u
        slid = now.u - state.u
        heat += 0.5 * ((stress + stresses[-1]) * slid)[square.contact].sum()
        forces.append(stress.sum())
        stresses.append(stress)
        state = now
    assert state.slides.any()
    load = 0.02 * (len(forces) - 1)
    work = 0.02 * (sum(forces) - 0.5 * forces[-1])
    # 1/2 k (U - u)² + 1/2 M u'²
    stored = 0.5 * (state.u @ (square.matrix @ state.u) - 2.0 * load * state.u.sum())
    stored += 0.5 * whole * load**2
    assert work == pytest.approx(stored + heat, rel=1e-3)


def test_friction_of_a_square_is_highest_where_it_is_narrow_and_lowest_at_some_layers():
    values = [quarter(n, n, 2.0).excess(RESIDUAL, 0.94) for n in (2, 6, 20)]
    assert values[1] < values[2] < values[0] < 1.0
