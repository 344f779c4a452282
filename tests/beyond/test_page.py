"""The page has every question, answered or not."""

from beyond.made_up import lean
from springblock.beyond import QUESTIONS
from springblock.beyond.page import page
from springblock.beyond.question import by_scene
from springblock.scene import Scene


def test_questions_without_realisations_say_what_they_need():
    text = page(QUESTIONS, {})
    assert text.count("**Not answered**: this needs the group") == len(QUESTIONS)
    assert all(f"## {i}. {each.title}\n" in text for i, each in enumerate(QUESTIONS, 1))


def test_lines_fit_a_screen_but_for_tables_and_answers():
    assert all(len(line) <= 100 for line in page(QUESTIONS, {}).splitlines())


def test_realisations_are_sorted_by_scene():
    first, second = Scene(10), Scene(20)
    mixed = [*lean(first, 0.7), *lean(second, 0.8), *lean(first, 0.6)]
    found = by_scene(mixed)
    assert list(found) == [first, second]
    assert [len(runs) for runs in found.values()] == [10, 5]
