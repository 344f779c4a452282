"""What jobs ask a queue for: enough for the largest surface, and little for a small one."""

import pytest

from springblock import Material, draw_friction, simulate
from springblock.model.scene import Scene
from springblock.simulation.setup import Setup
from springblock.study.cost import cpu_seconds, loading_time, memory, minutes

#: N, realisations of a batch on pillars, and the largest resident set of its job, MB.
MEASURED = [(240, 1, 261), (240, 10, 305), (480, 1, 329)]


def test_a_flat_surface_is_loaded_when_the_slider_springs_carry_the_whole_threshold():
    """K_s v t = mu_s P l²."""
    paper = Material()
    time = paper.mu_static * paper.pressure * paper.spacing**2 / (paper.k_s * paper.slider_velocity)
    assert loading_time(Scene(12), Setup()) == pytest.approx(time)


def test_pillars_on_a_quarter_of_the_surface_are_loaded_for_four_times_as_long():
    """All blocks are pulled, and a quarter of them carries the whole normal force."""
    ratio = loading_time(Scene(12, 3, 3), Setup()) / loading_time(Scene(12), Setup())
    assert ratio == pytest.approx(4.0)


@pytest.mark.parametrize("scene", [Scene(12), Scene(12, 3, 3), Scene(24, 10, 14, 2, 2)])
def test_a_run_ends_about_when_its_surface_is_loaded(scene):
    run = simulate(scene.contact, *draw_friction(scene.shape, seed=0))
    assert 0.2 < run.time[-1] / loading_time(scene, Setup()) < 1.4


def test_more_is_asked_for_with_more_to_do():
    """N, realisations, a smaller step and four force evaluations a step."""
    large = Scene(240, 20, 20)
    asked = minutes(large, Setup(), None, 10)
    assert asked > minutes(Scene(120, 20, 20), Setup(), None, 10)
    assert asked > minutes(large, Setup(), None, 1)
    assert minutes(large, Setup(step=1e-8), None, 10) > asked
    assert minutes(large, Setup(integrator="rk4"), None, 10) > asked
    once, twice = (cpu_seconds(large, Setup(), duration) for duration in (1e-4, 2e-4))
    assert twice == pytest.approx(2.0 * once)


def test_a_small_surface_asks_for_a_minute_and_the_largest_for_its_hours():
    assert minutes(Scene(12, 3, 3), Setup(), None, 10) == 1
    largest = Scene(4000, 20, 20)
    hours = 10 * cpu_seconds(largest, Setup(), None) / 3600.0
    assert 5.0 < hours < minutes(largest, Setup(), None, 10) / 60.0 < 24.0


@pytest.mark.parametrize(("n_blocks", "realisations", "measured"), MEASURED)
def test_memory_is_what_was_measured_with_a_margin(n_blocks, realisations, measured):
    assert 1.1 * measured < memory(Scene(n_blocks, 10, 10), realisations) < 2.0 * measured
