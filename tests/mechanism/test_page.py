"""The page on the mechanism says what the table holds."""

import pandas as pd
import pytest

from mechanism.chapter import budget, peaks, rows, variants
from springblock.mechanism.page import page


@pytest.fixture(scope="module")
def written() -> str:
    return page(*map(pd.DataFrame, (rows(), variants(), peaks(), budget())))


def test_the_first_sentences_give_minimum_and_agreement(written):
    assert "lowest on pillars of 20 blocks" in written
    said = " ".join(written.split())
    assert "agrees with the full simulation to 0.3% up to n_p = 6 and to 8.3%" in said
    assert "0.30, at n_p = 6" in written


def test_each_model_has_its_minimum(written):
    assert (
        "lowest at n_p = 20 (stress alone), n_p = 6 (load transfer), n_p = 6 (overshoot), "
        "n_p = 20 (full model)"
    ) in written


def test_steps_are_paired_by_seed(written):
    """What all models share from seed to seed leaves no interval of their differences."""
    line = next(
        line
        for line in written.split("## The effect of each step")[1].splitlines()
        if "| 6 " in line
    )
    assert line == "| 6 | -8.3 [-8.3, -8.3] | -8.3 [-8.3, -8.3] | 0.2 [0.2, 0.2] |"


def test_a_variant_says_which_step_brings_the_minimum(written):
    """On the thin layer the full model is lowest at 20 blocks, and only stress alone is there."""
    assert "| l_z = 5 µm | 2, 6, 20 | 6 (0.30) | 20 | 6 | 6 | 20 (or 6) |" in written
    said = " ".join(written.split())
    assert "µm**: friction is lowest at n_p = 20, the largest computed; none of the simpler" in said
    assert "changes friction by 16.7 [16.6, 16.7] %, overshoot by -7.1 [-" in said
    assert "lies 2.4 [2.4, 2.4] % below the last of them" in said  # mean of -0.3, -0.2 and 7.7 %
    assert "Friction is 0.800 [0.798, 0.802] with stress alone" in written


def test_predictions_are_counted_as_they_came_out(written):
    """Surfaces that the prediction was chosen on do not count."""
    assert "| the paper's, along | 1 | 1 | 0 | 0 |" in written
    assert "| the paper's, across | 0 | 0 | 1 | 1 |" in written
    assert "| all | 1 | 2 | 1 | 2 |" in written
    said = " ".join(written.split())
    assert "right in 3 [4] of 6 cases**" in said
    assert "right in 2 [2] of 4 cases, and in 2 of the 2 misses 1 % lies within" in said
    assert "with other coefficients it is right in 1 [2] of 2 cases" in said
    assert "two are measured for pawls of 7 blocks, one for pawls of 12" in said
    assert "| 0 | 2 | 8 |  |" not in written


def test_forces_on_edges_and_core_are_those_of_one_block(written):
    """Edges are a quarter of the blocks: 0.2 of the normal force is 0.8 F_n on each."""
    assert "| along | full model | 0.80 [" in written
    assert "| 300 [300, 300] | 0.40 [" in written
    assert "| 0.80 [0.80, 0.80] | 420 [420, 420] |" in written
