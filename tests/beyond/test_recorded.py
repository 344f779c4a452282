"""No answer and no value changes unnoticed on the made-up realisations.

`PYTHONPATH=tests python -m beyond.test_recorded` records them after an intended change.
"""

from pathlib import Path

import numpy as np

from beyond.made_up import grooves, lattices, sizes_and_distances
from beyond.test_scatter import scattered
from springblock.beyond.page import QUESTIONS

RECORDED = Path(__file__).with_name("answers.md")


def answers() -> str:
    """Answers to the questions, on ensembles of 10 to 25 realisations each."""
    made = {
        "lattice": lattices(lambda *_: 30.0, lambda x, l_z, s: 8.0 * l_z if s else 8.0 * x, 10),
        "peaks": grooves({"x": 0.95, "30": 0.97, "y": 0.92}, runs=10, scatter=0.01)
        | grooves({"x": 0.93, "y": 0.95}, 22, runs=10, scatter=0.01),
        "friction": sizes_and_distances(lambda n, r: 0.6 + 0.05 * np.log(n / 6.0) ** 2 - 0.1 * r),
        "scatter": scattered(lambda std: 0.2 / std),
    }
    texts = ("\n\n".join(QUESTIONS[name].answers(some)) for name, some in made.items())
    return "\n\n".join(texts) + "\n"


def test_answers_are_those_recorded(monkeypatch):
    monkeypatch.undo()  # as many resamples as usual
    assert answers() == RECORDED.read_text(encoding="utf-8")


if __name__ == "__main__":
    RECORDED.write_text(answers(), encoding="utf-8")
