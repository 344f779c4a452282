"""The page on the mechanism says what the table holds."""

import pytest

from springblock.mechanism.page import page

#: Static friction by n_p: of independent blocks, with load transfer, with overshoot, and simulated.
FRICTION = {2: (0.9, 0.8, 0.75, 0.752), 6: (0.7, 0.65, 0.6, 0.601), 20: (0.6, 0.7, 0.65, 0.6)}
UNEVEN = {2: 0.0, 6: 0.3, 20: 0.2}


@pytest.fixture(scope="module")
def written() -> str:
    names = ("independent", "quasi_static", "overshooting", "simulation")
    rows = [
        {"n_p": n_p, "n_blocks": 40, "seed": seed, "stress_variation": UNEVEN[n_p]}
        | {name: value + 0.001 * seed for name, value in zip(names, values, strict=True)}
        for n_p, values in FRICTION.items()
        for seed in (-1, 0, 1)
    ]
    return page(rows)


def test_the_first_sentences_give_minimum_and_agreement(written):
    assert "lowest on pillars of 20 blocks" in written
    assert "agrees with the full simulation to\n0.3% up to n_p = 6 and to 8.3%" in written
    assert "0.30, at n_p = 6" in written


def test_each_model_has_its_minimum(written):
    assert (
        "lowest at n_p = 20 (stress alone), n_p = 6 (load transfer), n_p = 6 (overshoot), "
        "n_p = 20 (full model)"
    ) in written


def test_steps_are_paired_by_seed(written):
    """What all models share from seed to seed leaves no interval of their differences."""
    line = next(line for line in written.split("What each step")[1].splitlines() if "| 6 " in line)
    assert line == "| 6 | -8.3 [-8.3, -8.3] | -8.3 [-8.3, -8.3] | 0.2 [0.2, 0.2] |"
