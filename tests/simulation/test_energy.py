"""The energy ledger: conservation of energy, term by term."""

import math
from dataclasses import replace

import mpmath
import numpy as np
import pytest

from specimens import uniform
from springblock import Material, Setup, Surface, simulate
from springblock.simulation.energy import Energy, elastic_energy
from springblock.solver.integrators import INTEGRATORS

PAPER = Material()


def exact_energy(u, slider, periodic):
    """Sum of k (r - L)²/2 over all springs, in J, in forty digits; the slider's springs too."""
    n, length = u.shape[-1], mpmath.mpf(PAPER.spacing)
    with mpmath.workdps(40):
        total = mpmath.mpf(0)
        for y, x in np.ndindex(n, n):
            here = mpmath.matrix(u[:, y, x])
            hung = mpmath.norm(mpmath.matrix(slider) - here)
            total += PAPER.k_s * hung**2 / 2
            for dx, dy, share in ((1, 0, 1), (0, 1, 1), (1, 1, 2), (-1, 1, 2)):
                if periodic or (0 <= x + dx < n and y + dy < n):
                    rest = length * mpmath.matrix([dx, dy])
                    now = rest + mpmath.matrix(u[:, (y + dy) % n, (x + dx) % n]) - here
                    stretch = mpmath.norm(now) - mpmath.norm(rest)
                    total += PAPER.k_int / share * stretch**2 / 2
        return float(total)


@pytest.mark.parametrize("strain", [1e-9, 1e-2, 0.2])
@pytest.mark.parametrize("periodic", [False, True])
def test_elastic_energy_keeps_its_digits_at_any_strain(strain, periodic, rng):
    """At a strain of 1e-9, r - L from square roots would keep seven digits of sixteen.

    What is left is the rounding of differences, relative to the larger displacement: a few eps.
    """
    u = strain * PAPER.spacing * rng.uniform(-1.0, 1.0, (2, 4, 4))
    slider = strain * PAPER.spacing * np.array([1.0, -0.5])
    exact = exact_energy(u, slider, periodic)
    assert elastic_energy(u, slider, PAPER, periodic) == pytest.approx(exact, rel=4e-15, abs=0)


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("gamma", [0.0, 5e5])
def test_without_friction_the_ledger_closes_to_second_order(integrator, gamma):
    """The slider's work is summed by the trapezoidal rule: halving h quarters the residual."""
    corner = np.arange(36).reshape(6, 6) == 0  # in contact, and held: all motion is smooth
    nailed = Surface(corner, mu_static=1e9, mu_dynamic=0.0)
    setup = Setup(Material(gamma=gamma), integrator, sample_interval=4e-8)
    setups = [replace(setup, step=step) for step in (2e-8, 1e-8, 5e-9)]
    runs = [simulate(nailed, each, duration=8e-6) for each in setups]
    residuals = [run.energy.relative_residual for run in runs]
    assert abs(residuals[0]) < (PAPER.omega_max * 2e-8) ** 2
    ratios = np.divide(residuals[:-1], residuals[1:])
    assert ratios == pytest.approx([4.0, 4.0], rel=0.1)


def test_without_work_there_is_no_relative_residual():
    assert math.isnan(Energy(0.0, 0.0, 0.0, 0.0, 0.0).relative_residual)
    assert Energy(1.0, 0.25, 0.25, 0.25, 0.0).relative_residual == 0.25


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_during_sliding_the_ledger_closes_to_second_order(integrator):
    """Half a period of the slip lasts 4e-7 s; it is interrupted after about half of that.

    The frictional heat includes the last half step, without which the order would be one.
    """
    coarse, fine = (
        simulate(uniform(1, 1.0, 0.6), Setup(PAPER, integrator, step), duration=1.336e-4)
        for step in (2e-8, 5e-9)
    )
    assert np.hypot(*fine.velocity[:, 0, 0]) > 0.1
    assert abs(coarse.energy.relative_residual) < (PAPER.omega_min * 2e-8) ** 2
    assert abs(fine.energy.relative_residual) < abs(coarse.energy.relative_residual) / 15


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_friction_turns_force_times_path_into_heat(integrator):
    """One block that slides and stops: mu_d F_n times its path, to second order in omega h."""
    step = 5e-9
    run = simulate(uniform(1, 1.0, 0.6), Setup(PAPER, integrator, step), duration=1.35e-4)
    path = run.displacement[0, 0, 0]
    assert run.velocity[0, 0, 0] == 0.0
    assert path > 0.0
    heat = 0.6 * PAPER.block_load * path
    assert run.energy.friction == pytest.approx(heat, rel=(PAPER.omega_min * step) ** 2, abs=0)
    assert run.energy.kinetic == 0.0


def test_damping_turns_a_slow_drift_into_heat():
    """An overdamped block, gamma >> omega, follows the slider with v (1 - exp(-t/tau)).

    tau = gamma/omega², and gamma m ∫v² dt = gamma m v² (t - 3/2 tau), to order (omega/gamma)².
    """
    syrup, time = Material(gamma=1e8), 1e-4
    run = simulate(uniform(1, 0.0, 0.0), Setup(syrup), duration=time)
    tau = syrup.gamma / syrup.omega_min**2
    heat = syrup.gamma * syrup.mass * syrup.slider_velocity**2 * (time - 1.5 * tau)
    assert run.energy.viscous == pytest.approx(
        heat, rel=(syrup.omega_min / syrup.gamma) ** 2, abs=0
    )


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_surface_at_rest_stores_all_work_in_its_springs(integrator):
    """W = K_s (v t)²/2 per block."""
    run = simulate(uniform(4, 1.0, 0.6), Setup(PAPER, integrator), duration=1e-4)
    work = 16 * 0.5 * PAPER.k_s * (PAPER.slider_velocity * 1e-4) ** 2
    assert run.energy.work_in == pytest.approx(work, rel=1e-12, abs=0)
    assert run.energy.elastic == pytest.approx(work, rel=1e-12, abs=0)
    assert run.energy.kinetic == run.energy.friction == run.energy.viscous == 0.0
