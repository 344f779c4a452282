"""The page has every question, answered or not."""

import pytest

from beyond.made_up import lean
from springblock.beyond import clusters, friction, lattice, scatter, variance
from springblock.beyond.page import QUESTIONS, page
from springblock.beyond.question import by_scene
from springblock.model.scene import Scene


def test_questions_without_realisations_say_what_they_need():
    text = page({})
    assert text.count("**Not answered**: this needs the group") == len(QUESTIONS)
    assert all(f"## {i}. " in text for i in range(1, len(QUESTIONS) + 1))


@pytest.mark.parametrize(
    "surfaces", [friction.friction_map, lattice.by_lattice, scatter.by_scatter]
)
def test_grooves_without_pillars_are_no_pillars(surfaces):
    grooved = Scene(120, n_p2=8, n_s2=2)
    assert not surfaces({grooved: lean(grooved, 0.7, runs=10)})


def test_grooves_without_pillars_are_no_flat_surface():
    made = {(scene := Scene(n, n_p2=8, n_s2=2)): lean(scene, 0.7) for n in (20, 40, 60)}
    assert not variance.by_pattern(made)
    assert not clusters.surfaces(made)


def test_realisations_are_sorted_by_scene():
    first, second = Scene(10), Scene(20)
    mixed = [*lean(first, 0.7), *lean(second, 0.8), *lean(first, 0.6)]
    mixed += lean(Scene(10, edges="periodic"), 0.9)  # which the paper could not have
    found = by_scene(mixed)
    assert list(found) == [first, second]
    assert [len(runs) for runs in found.values()] == [10, 5]
