"""Figures 1, 4 and 8 draw the springs of the energy and the mask of the solver."""

import numpy as np
import pytest

from springblock import Material, Pattern
from springblock.simulation.energy import elastic_energy
from springblock.study.paper.surfaces import mesh
from study.paper.test_results import draw

PILLARS = Pattern.pillars(24, 4, 4)
GROOVED = Pattern.pillars(48, 10, 14).grooved(4, 2, along="x")
SPLIT = Pattern.pillars(48, 10, 14).grooved(4, 2, along="y")

DRAWINGS = {
    "figure_1": lambda: draw("figure_1"),
    "figure_4": lambda: draw("figure_4", PILLARS),
    "figure_8": lambda: draw("figure_8", GROOVED),
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

    drawn = {ends: stiffness for stiffness in (0.5, 1.0) for ends in mesh(n, stiffness)}
    blocks = [(x, y) for y in range(n) for x in range(n)]
    for i, a in enumerate(blocks):
        for b in blocks[i + 1 :]:
            towards = np.subtract(b, a) / np.hypot(*np.subtract(b, a))
            coupling = energy((*a, towards), (*b, towards)) - energy((*a, towards))
            coupling -= energy((*b, towards))
            stiffness = -coupling / nudge**2 / material.k_int
            expected = drawn.get((a, b), drawn.get((b, a), 0.0))
            assert stiffness == pytest.approx(expected, rel=1e-4, abs=1e-4)


@pytest.mark.parametrize(
    ("figure", "pattern", "portion"),
    [
        ("figure_4", PILLARS, 24),
        ("figure_4", Pattern.pillars(48, 12, 4), 48),
        ("figure_8", GROOVED, 48),
        ("figure_8", SPLIT, 48),
    ],
)
def test_pillars_are_those_of_the_mask(figure, pattern, portion):
    surface, pillar = draw(figure, pattern).axes
    np.testing.assert_array_equal(
        surface.images[0].get_array(), pattern.contact[:portion, :portion]
    )
    y, x = pattern.origins[0]
    size = pattern.levels[0].size
    np.testing.assert_array_equal(
        pillar.images[0].get_array(), pattern.contact[y : y + size, x : x + size]
    )
