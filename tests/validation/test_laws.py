"""Friction that weakens: one block in closed form, and surfaces by two integrators.

A block under a slider lets go at mu_s F_n without a drop. While friction falls along its way s,

    m s" = K_s v t + (W - K_s) s,    W = (mu_s - mu_d) F_n/d_c,

which grows as sinh for W > K_s, as t³ for W = K_s, and swings about a steady creep for W < K_s.
"""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from springblock import Material, Pattern, compute_prelude, simulate
from springblock.accuracy import reference
from springblock.accuracy.specimens import drawn, flat, uniform
from springblock.solver import INTEGRATORS
from springblock.solver.lattice import Samples, prepare

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


def pull(material, integrator, step, after, n=1, **options):
    """Pull blocks alike until so long after their release, sampling every step."""
    how = {"material": material, "integrator": integrator, "step": step, "sample_interval": step}
    duration = math.ceil((RELEASE + after) / step) * step
    return simulate(*uniform(n, 1.0, 0.6), **how, duration=duration, **options)


def way(run):
    """Way of the one block, m, over the time after its release, s."""
    time = run.time - RELEASE
    return time, SPEED * run.time - run.force / K_S


def way_while_weakening(distance, t):
    k = math.sqrt(abs(DROP / distance - K_S) / MASS)
    if math.isclose(distance, EVEN):
        return K_S * SPEED * t**3 / (6.0 * MASS)
    grown = np.sinh(k * t) - k * t if distance < EVEN else k * t - np.sin(k * t)
    return K_S * SPEED / (MASS * k**3) * grown


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("share", [0.125, 0.75, 1.0, 2.0])
def test_a_slip_grows_as_friction_weakens_against_the_spring(share, integrator):
    """Up to d_c or, where it creeps, to before it comes to rest: to second order in h."""
    distance = share * EVEN
    material = replace(SLIP, slip_distance=distance)
    longest = 5.0 / OMEGA / math.sqrt(0.5) if share > 1.0 else 20.0 / OMEGA
    far = 0.98 * min(distance, way_while_weakening(distance, longest))
    after = brentq(lambda t: way_while_weakening(distance, t) - far, 0.0, longest)
    errors = []
    for step in (COARSE, FINE):
        t, found = way(pull(material, integrator, step, after))
        exact = way_while_weakening(distance, np.maximum(t, 0.0))
        errors.append(np.abs(found - exact)[(t > 0.0) & (t <= after)].max() / far)
    assert errors[0] < (DROP / distance / MASS + OMEGA**2) * COARSE**2
    assert errors[0] / errors[1] == SECOND_ORDER


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_slip_follows_velocity_weakening_as_an_independent_solver_does(integrator):
    def motion(t, state):
        friction = 0.6 * LOAD + DROP / (1.0 + max(state[1], 0.0) / MIDST)
        return state[1], (K_S * (SPEED * t - state[0]) + LOAD - friction) / MASS

    after = 5.5e-7  # in the midst of the slip
    accuracy = {"rtol": 1e-12, "atol": 1e-20, "first_step": 1e-12}
    exact = solve_ivp(motion, (0.0, after), (0.0, 0.0), "DOP853", dense_output=True, **accuracy)
    errors = []
    for step in (COARSE, FINE):
        t, found = way(pull(VELOCITY, integrator, step, after))
        on = (t > 0.0) & (t <= after)
        errors.append(np.abs(found[on] - exact.sol(t[on])[0]).max() / found.max())
    assert exact.y[1].max() > MIDST / 2.0
    assert errors[0] < (DROP / MIDST / MASS * COARSE) ** 2
    assert errors[0] / errors[1] == SECOND_ORDER


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("scale", [1e-5, 0.2, 1.0])
def test_steady_sliding_takes_the_force_of_its_speed(scale, integrator):
    """Damping holds it steady: mu(v) F_n + gamma m v, to rounding."""
    gamma = 2.0 * OMEGA
    material = replace(VELOCITY, gamma=gamma, speed_scale=scale)
    run = pull(material, integrator, 1e-8, 1e-5)
    force = 0.6 * LOAD + DROP / (1.0 + SPEED / scale) + gamma * MASS * SPEED
    assert run.force[-1] == pytest.approx(force, rel=1e-11, abs=0)


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("step", [2.0e-8, 1.9e-8, 1.7e-8])
def test_the_way_of_the_first_slip_is_the_displacement(step, integrator):
    """Wherever in its step the release was placed: friction has weakened as far as that."""
    method, steps = INTEGRATORS[integrator], math.ceil(RELEASE / step) + 1
    state, constants = prepare(*uniform(1, 1.0, 0.6), SLIP, (0.6, 0.8), method, step)
    for first, more in ((0, steps), (steps, 1), (steps + 1, 5)):
        method.advance(state, constants, first, more, more, Samples.empty(1))
        moved = np.hypot(state.blocks.ux[1], state.blocks.uy[1])
        assert moved > 0.0
        assert state.law.way[1] == pytest.approx(moved, rel=1e-9, abs=0)


@pytest.mark.parametrize("law", LAWS)
def test_on_a_periodic_surface_a_law_knows_no_place(law):
    """Rolled coefficients roll the detachments, to the bit."""
    contact, *mu = flat(6, seed=6)
    how = {"material": LAWS[law], "periodic": True, "duration": 2e-5}
    run = simulate(contact, *mu, **how)
    rolled = simulate(contact, *(np.roll(field, (2, 3), (0, 1)) for field in mu), **how)
    assert np.isfinite(run.t_det).all()
    np.testing.assert_array_equal(rolled.t_det, np.roll(run.t_det, (2, 3), (0, 1)))


@pytest.mark.parametrize("integrator", INTEGRATORS)
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


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_the_heat_of_a_slip_is_that_of_mu_d_and_half_the_drop_over_d_c(integrator):
    run = pull(SLIP, integrator, 2.5e-9, 1.5e-6)
    assert not run.velocity.any()
    heat = 0.6 * LOAD * run.displacement[0, 0, 0] + 0.5 * DROP * SLIP.slip_distance
    assert run.energy.friction == pytest.approx(heat, rel=(OMEGA * 2.5e-9) ** 2, abs=0)


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("law", LAWS)
def test_the_ledger_closes_to_second_order_as_friction_weakens(law, integrator):
    coarse, fine = (
        abs(pull(LAWS[law], integrator, step, 5.5e-7).energy.relative_residual)
        for step in (COARSE, FINE)
    )
    assert coarse < (OMEGA * COARSE) ** 2
    assert coarse / fine > 14.0


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("direction", ["y", 37.0, 251.5])
def test_weakening_friction_is_the_same_in_all_directions(direction, integrator, law):
    """What rounding leaves has grown in a slip that begins without a drop."""
    along_x = pull(LAWS[law], integrator, 1e-8, 6e-7)
    turned = pull(LAWS[law], integrator, 1e-8, 6e-7, direction=direction)
    assert along_x.displacement.any()
    np.testing.assert_allclose(turned.force, along_x.force, rtol=0, atol=1e-8 * LOAD)


#: Six by six blocks that let go one after another, as in `test_convergence`.
SURFACE = flat(6, seed=6)
SCENE = {"sample_interval": 2e-8, "duration": 1.5e-5}


@pytest.mark.parametrize("law", LAWS)
def test_both_integrators_converge_to_one_answer_on_a_surface(law):
    """Every block has let go: t_det agrees to a share of a step that falls with the step."""
    material, apart = replace(LAWS[law], gamma=5e3), []
    for step in (5e-9, 1.25e-9):
        one, other = (
            simulate(*SURFACE, material, integrator=integrator, step=step, **SCENE)
            for integrator in INTEGRATORS
        )
        assert np.isfinite(one.t_det).all()
        apart.append(np.sqrt(np.mean((one.t_det - other.t_det) ** 2)))
        assert abs(one.energy.relative_residual) < (OMEGA * step) ** 2
        assert abs(other.energy.relative_residual) < (OMEGA * step) ** 2
    assert apart[0] < COARSE / 2.0
    assert apart[1] < apart[0] / 8.0


@pytest.mark.parametrize(
    "limit",
    [
        {"law": "slip_weakening", "slip_distance": 1e-300},
        {"law": "slip_weakening", "slip_distance": 1e-11},
        {"law": "velocity_weakening", "speed_scale": 1e-300},
    ],
)
def test_friction_that_weakens_at_once_is_coulombs_to_the_bit(limit):
    runs = [simulate(*SURFACE, material) for material in (FAST, replace(FAST, **limit))]
    np.testing.assert_array_equal(runs[0].force, runs[1].force)
    np.testing.assert_array_equal(runs[0].t_det, runs[1].t_det)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_friction_that_never_weakens_is_one_coefficient(integrator):
    """Both laws then have mu = mu_s for good."""
    laws = ({"law": "slip_weakening", "slip_distance": 1e300},)
    laws += ({"law": "velocity_weakening", "speed_scale": 1e300},)
    runs = [
        simulate(*SURFACE, replace(FAST, **law), integrator=integrator, duration=2e-5)
        for law in laws
    ]
    np.testing.assert_array_equal(runs[0].t_det, runs[1].t_det)
    contact, mu_static, _ = SURFACE
    plain = simulate(contact, mu_static, mu_static, FAST, duration=2e-5)
    assert runs[0].static_friction == pytest.approx(plain.static_friction, rel=1e-4)


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("law", LAWS)
def test_before_the_first_detachment_no_law_matters(law, integrator):
    """A run from a prelude is the run from zero, to the bit, and so is its first detachment.

    But for what its neighbours have moved within that step, as Runge-Kutta sees them.
    """
    pillars, material = Pattern.pillars(12, 4, 2), replace(LAWS[law], gamma=5e3)
    scene, how = drawn(pillars, 1), {"material": material, "integrator": integrator}
    prelude = compute_prelude(pillars.contact, **how)
    assert prelude.samples.max() > 0
    run, short = simulate(*scene, **how), simulate(*scene, **how, prelude=prelude)
    np.testing.assert_array_equal(run.force, short.force)
    np.testing.assert_array_equal(run.t_det, short.t_det)
    plain = simulate(*scene, material=replace(FAST, gamma=5e3), integrator=integrator)
    slack = {"leapfrog": 0.0, "rk4": (OMEGA * 2e-8) ** 2 * 2e-8}[integrator]
    assert run.t_first == pytest.approx(plain.t_first, rel=0, abs=slack)


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("law", LAWS)
def test_a_block_that_is_held_does_not_move_by_one_bit(law, integrator):
    contact, mu_static, mu_dynamic = uniform(3, 1.0, 0.6)
    mu_static[1, 1] = 1e9
    how = {"material": LAWS[law], "integrator": integrator, "duration": 5e-5}
    run = simulate(contact, mu_static, mu_dynamic, **how)
    assert np.count_nonzero(np.isfinite(run.t_det)) == 8
    assert not run.displacement[:, 1, 1].any()


def test_the_reference_solution_refuses_other_laws():
    with pytest.raises(ValueError, match="law must be coulomb for the reference solution, not sl"):
        reference.solve(*SURFACE, SLIP)
