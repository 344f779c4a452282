"""Laws of friction, one block and one step at a time."""

import numpy as np
import pytest
from numba import njit
from scipy.integrate import quad

from springblock import Material
from springblock.model.material import LAWS
from springblock.solver import laws
from springblock.solver.friction import slow_down
from springblock.solver.laws import SlipWeakening, VelocityWeakening, law_of

STATIC, DYNAMIC = 1.0, 0.6
DROP = STATIC - DYNAMIC
SCALES = [1e-3, 0.1, 0.2, 1.0, 100.0]


@njit
def resistance(law, way, speed, share, static=STATIC, dynamic=DYNAMIC):
    return laws.resistance(law, way, speed, share, static, dynamic)


@njit
def heat(law, way, further):
    return laws.heat(law, way, further, STATIC, DYNAMIC)


@njit(error_model="numpy")
def after(law, w, v, f):
    """Velocity that friction leaves of w; the ways of two blocks are kept in between."""
    return slow_down(law, 1, w[0], w[1], v[0], v[1], f[0], f[1], STATIC, DYNAMIC)


def slip(d_c, *ways):
    return SlipWeakening(np.array(ways or (0.0, 0.0)), 1.0 / d_c)


def test_there_is_a_law_for_each_name():
    """In units of l and of l per step."""
    for name, constant in LAWS.items():
        material = Material(law=name, **({constant: 2e-6} if constant else {}))
        law = law_of(material, 1e-8, lambda: np.zeros(3))
        kind = {"coulomb": type(None), "slip_weakening": SlipWeakening}
        assert isinstance(law, kind.get(name, VelocityWeakening))
    assert law.scale == pytest.approx(2e-6 * 1e-8 / 1e-5, rel=1e-15)


@pytest.mark.parametrize("law", [None, slip(0.5, 0.1, 0.2), VelocityWeakening(0.2)])
def test_python_and_compiled_callers_get_the_same(law):
    """Each law is chosen by its type, in its own way."""
    for way, speed, share in ((0.0, 0.3, -0.5), (0.1, 0.3, 0.0), (9.0, 0.01, -0.5)):
        plain = laws.resistance(law, way, speed, share, STATIC, DYNAMIC)
        assert plain == pytest.approx(resistance(law, way, speed, share), rel=1e-15)
        plain = laws.heat(law, way, speed, STATIC, DYNAMIC)
        assert plain == pytest.approx(heat(law, way, speed), rel=1e-15)
    assert laws.way_of(law, 1) == (law.way[1] if isinstance(law, SlipWeakening) else 0.0)
    laws.keep_way(law, 1, 0.7)
    assert laws.way_of(law, 1) == (0.7 if isinstance(law, SlipWeakening) else 0.0)


def test_friction_falls_linearly_along_the_way():
    law = slip(0.5)
    found = [resistance(law, way, 0.0, 0.0) for way in (0.0, 0.125, 0.25, 0.5, 9.0)]
    assert found == pytest.approx([1.0, 0.9, 0.8, 0.6, 0.6], rel=1e-15)


def test_friction_falls_with_speed_to_half_its_drop_at_the_scale():
    law = VelocityWeakening(0.2)
    found = [resistance(law, 0.0, speed, 0.0) for speed in (0.0, 0.2, 0.6, 1e12)]
    assert found == pytest.approx([1.0, 0.8, 0.7, 0.6], rel=1e-11)


@pytest.mark.parametrize("law", [slip(0.5), VelocityWeakening(0.2)])
def test_nothing_weakens_where_mu_s_is_below_mu_d(law):
    assert resistance(law, 0.1, 0.1, 0.0, static=0.3) == DYNAMIC


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("share", [-0.5, 0.5])
def test_friction_is_that_at_the_mean_speed_which_it_takes_part_in(scale, share):
    """V = speed + share T(V), to rounding."""
    law = VelocityWeakening(scale)
    for speed in (0.55, 0.7, 3.0):
        taken = resistance(law, 0.0, speed, share)
        mean = speed + share * taken
        assert taken == pytest.approx(DYNAMIC + DROP / (1.0 + mean / scale), rel=1e-13)


def test_of_two_speeds_the_larger_is_taken():
    """T falls faster than 2 V rises: V = 0 would do as well, for a force at the threshold."""
    taken = resistance(VelocityWeakening(0.05), 0.0, 0.5 * STATIC, -0.5)
    assert 0.5 * (STATIC - taken) == pytest.approx(DROP / 2.0 - 0.05, rel=1e-13)


def test_a_block_stops_where_no_speed_will_do():
    assert resistance(VelocityWeakening(0.05), 0.0, 0.4, -0.5) == np.inf
    assert after(VelocityWeakening(0.05), (0.5, 0.0), (0.3, 0.0), (0.2, 0.0))[:2] == (0.0, 0.0)


@pytest.mark.parametrize("way", [0.0, 0.2, 0.45, 0.7])
@pytest.mark.parametrize("further", [1e-9, 0.1, 0.6])
def test_heat_is_the_integral_of_friction_along_the_way(way, further):
    law = slip(0.5)
    exact, _ = quad(lambda s: resistance(law, s, 0.0, 0.0), way, way + further, points=[0.5])
    assert heat(law, way, further) == pytest.approx(exact, rel=1e-12)
    assert heat(slip(1e100), way, further) == pytest.approx(STATIC * further, rel=1e-12)


@pytest.mark.parametrize("law", [slip(0.5), VelocityWeakening(0.3), slip(1e-3)])
@pytest.mark.parametrize("force", [0.0, 0.7, 1.0 - 1e-15])
def test_every_law_holds_a_block_up_to_its_static_threshold(law, force):
    f = (0.8 * force, -0.6 * force)
    assert after(law, f, (0.0, 0.0), f)[:2] == (0.0, 0.0)


@pytest.mark.parametrize("law", [slip(0.5), VelocityWeakening(0.3)])
def test_beyond_it_a_block_leaves_gently(law):
    f = (0.8 + 8e-9, -0.6 - 6e-9)
    speed = np.hypot(*after(law, f, (0.0, 0.0), f)[:2])
    assert 1e-8 <= speed * (1.0 + 1e-6) <= 4e-8


@pytest.mark.parametrize("law", [slip(1e-2), VelocityWeakening(1e-100)])
def test_where_friction_weakens_within_a_step_it_leaves_with_the_whole_drop(law):
    """As under Coulomb's law, to the bit."""
    f = (0.8 + 8e-9, -0.6 - 6e-9)
    assert after(law, f, (0.0, 0.0), f)[:2] == after(None, f, (0.0, 0.0), f)[:2]


def test_the_way_is_kept_until_the_block_stops_and_heals():
    law = slip(0.5, 0.0, 0.1)
    x, y, *_ = after(law, (1.2, 1.6), (0.6, 0.8), (0.0, 0.0))
    assert np.hypot(x, y) == pytest.approx(2.0 - 0.92, rel=1e-14)
    np.testing.assert_allclose(law.way, [0.0, 0.1 + 1.08], rtol=1e-14)
    after(law, (0.3, 0.4), (0.6, 0.8), (0.0, 0.0))
    assert not law.way.any()
    assert resistance(law, law.way[1], 0.0, 0.0) == STATIC
