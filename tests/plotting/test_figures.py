"""The figures draw without a warning, from the data they are given, and always the same."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.figure import Figure
from numpy.typing import NDArray

from springblock import Material, Pattern
from springblock.io.records import Record
from springblock.model.scene import Scene
from springblock.plotting.paper_results import figure_2, figure_3
from springblock.plotting.paper_surfaces import figure_1, figure_4, figure_8, mesh
from springblock.simulation.energy import elastic_energy
from springblock.simulation.run import percent

PILLARS = Pattern.pillars(24, 4, 4)
GROOVED = Pattern.pillars(48, 10, 14).grooved(4, 2, along="x")
SPLIT = Pattern.pillars(48, 10, 14).grooved(4, 2, along="y")


def made(seed: int, samples: int = 700, contact: NDArray[np.bool_] | None = None) -> Record:
    """A force that rises to 110 µs and falls, and blocks that let go a little later."""
    contact = np.ones((20, 20), bool) if contact is None else contact
    rng = np.random.default_rng(seed)
    time = 2e-7 * np.arange(samples)
    t_det = np.where(contact, rng.normal(112e-6, 3e-6, contact.shape), np.nan)
    edges = np.append(-1.0, time)
    detachments = np.histogram(t_det[contact], edges)[0]
    force = 1e-3 * np.minimum(time / 110e-6, 1.0) - 4e-4 * (time > 110e-6)
    return Record(
        scene=Scene(len(contact)),
        seed=seed,
        time=time,
        force=force + 1e-7 * rng.standard_normal(samples),
        normal_force=1.3e-3,
        detachments=detachments,
        switches=detachments + (time > 120e-6),
        t_det=t_det,
        contact=np.isfinite(t_det),
    )


DRAWINGS: dict[str, Callable[[], Figure]] = {
    "figure_1": figure_1,
    "figure_2": lambda: figure_2([made(seed) for seed in range(4)]),
    "figure_3": lambda: figure_3([made(0)]),
    "figure_4": lambda: figure_4(PILLARS),
    "figure_8": lambda: figure_8(GROOVED),
}


def test_figure_1_draws_the_springs_of_the_energy():
    """Two blocks share a term of the elastic energy exactly where a spring is drawn."""
    n, material = 3, Material()
    nudge = 1e-6 * material.spacing

    def energy(*moves: tuple[int, int, tuple[float, float]]) -> float:
        displacement = np.zeros((2, n, n))
        for x, y, (along_x, along_y) in moves:
            displacement[:, y, x] = nudge * along_x, nudge * along_y
        return elastic_energy(displacement, np.zeros(2), material)

    drawn = {(s.start, s.end): s.stiffness for s in mesh(n)}
    blocks = [(x, y) for y in range(n) for x in range(n)]
    for i, a in enumerate(blocks):
        for b in blocks[i + 1 :]:
            towards = np.subtract(b, a) / np.hypot(*np.subtract(b, a))
            coupling = energy((*a, towards), (*b, towards)) - energy((*a, towards))
            coupling -= energy((*b, towards))
            stiffness = -coupling / nudge**2 / material.k_int
            expected = drawn.get((a, b), drawn.get((b, a), 0.0))
            assert stiffness == pytest.approx(expected, rel=1e-4, abs=1e-4)


def test_figure_2_shows_the_run_in_front_of_the_others():
    runs = [made(0), made(1, samples=690), made(2)]
    force, blocks = (figure_2(runs).axes[i] for i in (0, 2))
    lines = {line.get_label(): line for line in force.get_lines()}
    np.testing.assert_allclose(lines["one run"].get_ydata(), runs[0].force / 1.3e-3)
    others = (runs[1].force + runs[2].force[:690]) / 2.6e-3
    np.testing.assert_allclose(lines["their mean"].get_ydata(), others)
    all_switches, first = blocks.patches[:2]
    np.testing.assert_allclose(all_switches.get_data().values, runs[0].switches[1:] / 4.0)
    np.testing.assert_allclose(first.get_data().values, runs[0].detachments[1:] / 4.0)
    assert blocks.get_ylim()[0] < percent(runs[0], np.array([1]))[0]  # one block is visible


def test_figure_2_marks_both_times():
    run = made(0)
    for ax in figure_2([run]).axes:
        upright = {
            line.get_linestyle(): line.get_xdata()[0]
            for line in ax.get_lines()
            if len(line.get_xdata()) == 2
        }
        assert upright == {":": pytest.approx(110.0), "-": pytest.approx(1e6 * run.t_avg)}


def test_figure_2_refuses_runs_sampled_differently():
    odd = replace(made(1), time=2.0 * made(1).time)
    with pytest.raises(ValueError, match="sample interval"):
        figure_2([made(0), made(2), odd])


@pytest.mark.parametrize("pattern", [None, PILLARS])
def test_figure_3_maps_t_det_over_t_max(pattern):
    run = made(0, contact=None if pattern is None else pattern.contact)
    ax = figure_3([run]).axes[0]
    image = ax.images[0]
    shown = np.ma.filled(image.get_array(), np.nan)
    np.testing.assert_array_equal(shown, run.t_det / run.t_max)
    assert image.norm(1.0) == pytest.approx(0.5)
    blue, red = image.cmap(0.2), image.cmap(0.8)
    assert blue[2] > blue[0]
    assert red[0] > red[2]
    assert (ax.get_legend() is None) == (pattern is None)


@pytest.mark.parametrize(
    ("draw", "pattern", "portion"),
    [
        (figure_4, PILLARS, 24),
        (figure_4, Pattern.pillars(48, 12, 4), 48),
        (figure_8, GROOVED, 48),
        (figure_8, SPLIT, 48),
    ],
)
def test_pillars_are_those_of_the_mask(draw, pattern, portion):
    surface, pillar = draw(pattern).axes
    np.testing.assert_array_equal(
        surface.images[0].get_array(), pattern.contact[:portion, :portion]
    )
    y, x = pattern.origins[0]
    size = pattern.levels[0].size
    np.testing.assert_array_equal(
        pillar.images[0].get_array(), pattern.contact[y : y + size, x : x + size]
    )
    assert surface.get_ylim() == (-0.5, portion - 0.5)  # dimensions do not stretch the panel


def test_patterns_without_what_is_shown_are_refused():
    with pytest.raises(ValueError, match="no pillar"):
        figure_4(Pattern.flat(8))
    with pytest.raises(ValueError, match="no second level"):
        figure_8(PILLARS)
