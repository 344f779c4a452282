"""The page has every question, answered or not."""

import pytest

from beyond.made_up import lean
from springblock.beyond import friction, lattice, scatter
from springblock.beyond.page import QUESTIONS, page
from springblock.io.records import by_scene
from springblock.model.scene import Scene


def test_questions_without_realisations_say_what_they_need():
    assert page({}).count("**Not answered**: this needs the group") == len(QUESTIONS)


@pytest.mark.parametrize(
    "surfaces",
    [
        friction.friction_map,
        lattice.by_lattice,
        scatter.by_scatter,
    ],
)
def test_grooves_without_pillars_are_neither_pillars_nor_flat(surfaces):
    scenes = [Scene(n, n_p2=8, n_s2=2) for n in (20, 40, 60)]
    assert not surfaces({scene: lean(scene, 0.7, runs=10) for scene in scenes})


def test_realisations_are_sorted_by_scene():
    first, second = Scene(10), Scene(20)
    mixed = [*lean(first, 0.7), *lean(second, 0.8), *lean(first, 0.6)]
    mixed += lean(Scene(10, edges="periodic"), 0.9)  # which the paper could not have
    assert {scene: len(runs) for scene, runs in by_scene(mixed).items()} == {first: 10, second: 5}
