"""Friction that weakens, finer than in the table of cases.

A block under a slider detaches at mu_s F_n without a drop of friction. While friction falls with
its slip s,

    m s" = K_s v t + (W - K_s) s,    W = (mu_s - mu_d) F_n/d_c,

which grows as sinh for W > K_s, as t³ for W = K_s, and swings about a steady creep for W < K_s.
"""

import math
from dataclasses import replace

import numpy as np
import pytest

from specimens import uniform
from springblock import Material, Setup, simulate
from springblock.study.accuracy.stability.one_block import slip

FAST = Material(gamma=0.0, slider_velocity=5e-3)
MASS, K_S, LOAD, SPEED = FAST.mass, FAST.k_s, FAST.block_load, FAST.slider_velocity
OMEGA = FAST.omega_min
RELEASE = LOAD / (K_S * SPEED)
DROP = 0.4 * LOAD
#: d_c at which W is K_s, and a v_c like the speeds of a slip.
EVEN, MIDST = DROP / K_S, 0.1
SLIP = replace(FAST, law="slip_weakening", slip_distance=0.75 * EVEN)
VELOCITY = replace(FAST, law="velocity_weakening", speed_scale=MIDST)
#: A quarter of the step leaves a 16th of the error, but for terms of higher order.
COARSE, FINE = 5e-9, 1.25e-9
SECOND_ORDER = pytest.approx(16.0, rel=0.15)


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
        setup = Setup(material, integrator, step, sample_interval=step)
        duration = math.ceil((RELEASE + after / OMEGA) / step) * step
        run = simulate(uniform(1, 1.0, 0.6), setup, duration=duration)
        time, way = OMEGA * (run.time - RELEASE), (K_S * SPEED * run.time - run.force) / LOAD
        on = (time > 0.0) & (time <= after)
        errors.append(np.abs(way - path(time))[on].max() / path(after))
    assert errors[0] < fastest * COARSE**2
    assert errors[0] / errors[1] == SECOND_ORDER


@pytest.mark.parametrize(("healing", "left"), [("instant", 1.0), ("none", 0.6)])
def test_a_block_that_has_stopped_detaches_at_the_strength_that_it_has_left(healing, left):
    """It slips further than d_c; the bound is the slider's pull between two samples."""
    setup = Setup(replace(SLIP, healing=healing), step=COARSE, sample_interval=COARSE)
    run = simulate(uniform(1, 1.0, 0.6), setup, duration=3.0 * RELEASE)
    first, second = np.flatnonzero(run.switches)[:2]
    assert not run.switches[first + 1 : second].any()
    assert run.force[second] / LOAD == pytest.approx(left, abs=2.0 * SPEED * COARSE * K_S / LOAD)
    assert abs(run.energy.relative_residual) < 1e-4
