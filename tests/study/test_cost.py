"""Requests to a queue: enough for the largest surface, and little for a small one."""

from dataclasses import replace

import pytest

from springblock import Material, Surface, simulate
from springblock.model.scene import Scene
from springblock.simulation.setup import Setup
from springblock.study.cost import cpu_seconds, memory, minutes


def test_a_run_takes_until_the_slider_springs_carry_the_whole_threshold():
    """K_s v t = mu_s P l²; pillars on a quarter of a surface carry four times as much."""
    paper, flat = Material(), Scene(12)
    time = paper.mu_static * paper.pressure * paper.spacing**2 / (paper.k_s * paper.slider_velocity)
    alone, pillars = (cpu_seconds(scene) for scene in (flat, Scene(12, 3, 3)))
    assert alone == pytest.approx(cpu_seconds(replace(flat, duration=time)))
    assert pillars == pytest.approx(4.0 * alone)
    assert minutes(Scene(480, 20, 20), 20) > minutes(Scene(480, 20, 20), 1) > minutes(flat, 1)


@pytest.mark.parametrize("scene", [Scene(12), Scene(12, 3, 3), Scene(24, 10, 14, 2, 2)])
def test_a_run_ends_about_when_its_surface_is_loaded(scene):
    run = simulate(Surface.draw(scene.contact, seed=0))
    assert 0.2 < run.time[-1] / Setup().loading_time(scene.contact, Material().mu_static) < 1.4


@pytest.mark.parametrize(
    ("n_blocks", "realisations", "measured"), [(240, 1, 261), (240, 10, 305), (480, 1, 329)]
)
def test_memory_is_what_was_measured_with_a_margin(n_blocks, realisations, measured):
    """The largest resident set of a batch on pillars, MB."""
    assert 1.1 * measured < memory(Scene(n_blocks, 10, 10), realisations) < 2.0 * measured
