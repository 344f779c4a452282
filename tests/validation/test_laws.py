"""Friction that weakens, finer than in the table of cases.

A block under a slider lets go at mu_s F_n without a drop. While friction falls along its way s,

    m s" = K_s v t + (W - K_s) s,    W = (mu_s - mu_d) F_n/d_c,

which grows as sinh for W > K_s, as t³ for W = K_s, and swings about a steady creep for W < K_s.
"""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest

from springblock import Material, Setup, simulate
from springblock.accuracy.specimens import flat, uniform
from springblock.accuracy.stability.one_block import slip

FAST = Material(gamma=0.0, slider_velocity=5e-3)
MASS, K_S, LOAD, SPEED = FAST.mass, FAST.k_s, FAST.block_load, FAST.slider_velocity
OMEGA = FAST.omega_min
RELEASE = LOAD / (K_S * SPEED)
DROP = 0.4 * LOAD
#: d_c at which W is K_s, and a v_c like the speeds of a slip.
EVEN, MIDST = DROP / K_S, 0.1
SLIP = replace(FAST, law="slip_weakening", slip_distance=0.75 * EVEN)
VELOCITY = replace(FAST, law="velocity_weakening", speed_scale=MIDST)
LAWS = {"slip": SLIP, "velocity": VELOCITY}
#: A quarter of the step leaves a 16th of the error, but for terms of higher order.
COARSE, FINE = 5e-9, 1.25e-9
SECOND_ORDER = pytest.approx(16.0, rel=0.15)
SURFACE = flat(6, seed=6)  #: its blocks let go one after another


def pull(material, integrator, step, after, **options):
    """Pull one block until so long after its release, sampling every step."""
    setup = Setup(material, integrator, step, sample_interval=step)
    duration = math.ceil((RELEASE + after) / step) * step
    return simulate(uniform(1, 1.0, 0.6), setup, duration=duration, **options)


@pytest.mark.parametrize(
    ("material", "longest", "fastest"),
    [
        (replace(SLIP, slip_distance=EVEN / 8.0), 20.0, 9.0 * OMEGA**2),
        (SLIP, 20.0, 7.0 / 3.0 * OMEGA**2),
        (replace(SLIP, slip_distance=EVEN), 20.0, 2.0 * OMEGA**2),
        # creeps: seen before it comes to rest
        (replace(SLIP, slip_distance=2.0 * EVEN), 5.0 / math.sqrt(0.5), 1.5 * OMEGA**2),
        (VELOCITY, 5.5e-7 * OMEGA, (DROP / MIDST / MASS) ** 2),  # in the midst of the slip
    ],
    ids=["d_c/8", "3/4 d_c", "d_c", "2 d_c", "velocity"],
)
def test_a_slip_grows_as_friction_weakens_against_the_spring(
    material, longest, fastest, integrator
):
    """Of second order in h; the bound is the square of the fastest rate, W/m + omega² or more."""
    path, after = slip(material, 1.0, 0.6, longest)
    if material.law == "slip_weakening":  # until friction has weakened
        weak = 0.98 * material.slip_distance * K_S / LOAD
        times = np.linspace(0.0, after, 4001)
        after = times[np.searchsorted(path(times), min(weak, path(after)))]
    errors = []
    for step in (COARSE, FINE):
        run = pull(material, integrator, step, after / OMEGA)
        time, way = OMEGA * (run.time - RELEASE), (K_S * SPEED * run.time - run.force) / LOAD
        on = (time > 0.0) & (time <= after)
        errors.append(np.abs(way - path(time))[on].max() / path(after))
    assert errors[0] < fastest * COARSE**2
    assert errors[0] / errors[1] == SECOND_ORDER


def test_a_block_heals_as_it_comes_to_rest(integrator):
    """The next slip begins at mu_s F_n again, and takes as much from the spring."""
    run = pull(SLIP, integrator, 5e-9, 2.5 * RELEASE)
    slips = np.flatnonzero(run.switches)
    assert len(slips) >= 3
    rise, within = K_S * SPEED * 5e-9, 2.0 * (OMEGA * 5e-9) ** 2 * DROP
    np.testing.assert_allclose(run.force[slips - 1], LOAD, rtol=0, atol=2.0 * rise)
    lowest = [run.force[one:other].min() for one, other in itertools.pairwise(slips)]
    np.testing.assert_allclose(lowest, lowest[0], rtol=0, atol=2.0 * rise + within)
    assert lowest[0] > 0.2 * LOAD + DROP / 50.0  # without weakening it would fall to 2 mu_d - mu_s


def test_the_heat_of_a_slip_is_that_of_mu_d_and_half_the_drop_over_d_c(integrator):
    run = pull(SLIP, integrator, 2.5e-9, 1.5e-6)
    assert not run.velocity.any()
    heat = 0.6 * LOAD * run.displacement[0, 0, 0] + 0.5 * DROP * SLIP.slip_distance
    assert run.energy.friction == pytest.approx(heat, rel=(OMEGA * 2.5e-9) ** 2, abs=0)


@pytest.mark.parametrize(("law", "after"), [("coulomb", 2e-7), ("slip", 6e-7), ("velocity", 6e-7)])
@pytest.mark.parametrize("direction", ["y", 37.0, 180, 251.5])
def test_friction_is_the_same_in_all_directions(direction, integrator, law, after):
    """The slip along any heading is that along x; the block moves along the heading alone.

    Differences of a rounding have grown over some 1,300 steps, and in a slip that begins without a
    drop by a hundredfold.
    """
    material, rounding = LAWS.get(law, FAST), 1e-10 if law == "coulomb" else 1e-8
    along_x = pull(material, integrator, 1e-8, after)
    turned = pull(material, integrator, 1e-8, after, direction=direction)
    np.testing.assert_allclose(turned.force, along_x.force, rtol=0, atol=rounding * LOAD)
    ux, uy = turned.displacement[:, 0, 0]
    path = along_x.displacement[0, 0, 0]
    angle = np.radians(90.0 if direction == "y" else direction)
    assert path > 0.0
    assert np.cos(angle) * ux + np.sin(angle) * uy == pytest.approx(path, rel=rounding, abs=0)
    assert np.sin(angle) * ux - np.cos(angle) * uy == pytest.approx(0.0, abs=rounding * path)
