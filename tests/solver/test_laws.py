"""Laws of friction, one block and one step at a time."""

import numpy as np
import pytest
from numba import njit

from springblock import Material, Setup, Surface, simulate, specification
from springblock.model.law import LawFile
from springblock.model.material import LAWS
from springblock.solver import laws
from springblock.solver.friction import apply_friction
from springblock.solver.laws import SlipWeakening, VelocityWeakening, from_file

STATIC, DYNAMIC = 1.0, 0.6
DROP = STATIC - DYNAMIC


@njit
def resistance(law, b, speed, slope):
    return laws.resistance(law, laws.state_now(law, b), speed, slope, STATIC, DYNAMIC)


@njit(error_model="numpy")  # as in the integrators: dividing by zero is no error there
def after(law, w, v, f):
    """Velocity after a step with friction, from trial velocity w, previous v, and F_mot = f."""
    return apply_friction(law, 1, w[0], w[1], v[0], v[1], f[0], f[1], STATIC, DYNAMIC)[:2]


def slip(d_c, *slips):
    """Slip weakening of two blocks, or of one for each of these slips."""
    law = SlipWeakening.of(len(slips) or 2, d_c)
    law.slip[: len(slips)] = slips
    return law


@pytest.mark.parametrize(
    ("law", "speeds", "expected"),
    [
        (slip(0.5, 0.0, 0.125, 0.25, 0.5, 9.0), [0.0] * 5, [1.0, 0.9, 0.8, 0.6, 0.6]),
        (VelocityWeakening(0.2), (0.0, 0.2, 0.6, 1e12), [1.0, 0.8, 0.7, 0.6]),
    ],
)
def test_friction_falls_linearly_with_slip_or_by_half_its_drop_at_a_speed(law, speeds, expected):
    found = [resistance(law, b, v, 0.0) for b, v in enumerate(speeds)]
    assert found == pytest.approx(expected, rel=1e-11)


@pytest.mark.parametrize("scale", [1e-3, 0.2, 100.0])
@pytest.mark.parametrize("slope", [-0.5, 0.5])
def test_friction_is_that_at_the_mean_speed_which_depends_on_it(scale, slope):
    """V = speed + slope T(V), to rounding."""
    law = VelocityWeakening(scale)
    for speed in (0.55, 0.7, 3.0):
        taken = resistance(law, 0, speed, slope)
        mean = speed + slope * taken
        assert taken == pytest.approx(DYNAMIC + DROP / (1.0 + mean / scale), rel=1e-13)


@pytest.mark.parametrize("scale", [0.05, 100.0])
def test_a_file_of_velocity_weakening_is_the_built_in_law(scale, tmp_path):
    """They agree on V, to the tolerance of an iteration; the slowest blocks stop, with V = 0."""
    file = tmp_path / "velocity.py"
    file.write_text(
        f"def friction(mu_static, mu_dynamic, speed):\n"
        f"    return mu_dynamic + (mu_static - mu_dynamic) / (1.0 + speed / {scale})\n"
    )
    own = from_file(LawFile.read(file), np.ones(2, bool), 1.0, 1.0, 1.0)
    for speed in np.linspace(0.0, 2.0, 40):
        found, exact = (
            max(speed - 0.5 * resistance(law, 1, speed, -0.5), 0.0)
            for law in (own, VelocityWeakening(scale))
        )
        assert found == pytest.approx(exact, rel=1e-12)
    surface = Surface([[True]], 1.0, 0.6)
    problem = specification.Problem(surface, Setup(Material(law=file)), "x")
    assert problem.after({}, np.ones((1, 1))) == {}  # it has no state


@pytest.mark.parametrize("scale", [0.01, 0.3, 10.0])
def test_friction_that_increases_with_speed_is_found_however_steep_it_is(scale, tmp_path):
    """V = speed - T/2 for T = mu_d (1 + V/scale); without a solution the block stops."""
    file = tmp_path / "strengthening.py"
    file.write_text(
        f"def friction(mu_dynamic, speed):\n    return mu_dynamic * (1.0 + speed / {scale})\n"
    )
    law = from_file(LawFile.read(file), np.ones(2, bool), 1.0, 1.0, 1.0)
    for speed in (0.31, 0.5, 2.0):
        mean = (speed - 0.5 * DYNAMIC) / (1.0 + 0.5 * DYNAMIC / scale)
        expected = DYNAMIC * (1.0 + mean / scale)
        assert resistance(law, 1, speed, -0.5) == pytest.approx(expected, rel=1e-10)
    assert resistance(law, 1, 0.29, -0.5) == np.inf


def test_of_two_solutions_the_larger_speed_holds_and_without_one_the_block_stops():
    """T falls faster than 2 V rises: for a force at the threshold, V = 0 is a solution, too."""
    law = VelocityWeakening(0.05)
    taken = resistance(law, 0, 0.5 * STATIC, -0.5)
    assert 0.5 * (STATIC - taken) == pytest.approx(DROP / 2.0 - 0.05, rel=1e-13)
    assert resistance(law, 0, 0.4, -0.5) == np.inf
    assert after(law, (0.5, 0.0), (0.3, 0.0), (0.2, 0.0)) == (0.0, 0.0)


@pytest.mark.parametrize("law", [slip(0.5), VelocityWeakening(0.3)])
def test_just_beyond_the_threshold_a_block_starts_slowly(law):
    """From rest, under a force at an angle."""
    f = (0.8 * (1.0 + 1e-8), -0.6 * (1.0 + 1e-8))
    assert 1e-8 <= np.hypot(*after(law, f, (0.0, 0.0), f)) * (1.0 + 1e-6) <= 4e-8


@pytest.mark.parametrize("law", ["slip_weakening", "velocity_weakening"])
def test_in_the_limit_of_its_constant_a_run_is_that_of_coulombs_law_to_the_bit(law):
    surface = Surface.draw(np.ones((3, 3), bool), seed=1)
    weakening, coulomb = (
        simulate(surface, Setup(material))
        for material in (Material(**{"law": law, LAWS[law]: 1e-300}), Material())
    )
    assert np.array_equal(weakening.t_det, coulomb.t_det)
    assert np.array_equal(weakening.force, coulomb.force)
