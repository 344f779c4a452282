"""Which realisations are suspect follows from their energy residuals."""

import pytest

from springblock.accuracy.residuals import suspects


def rows(errors, n_p=20):
    return [{"n_p": n_p, "seed": seed, "energy_error": e} for seed, e in enumerate(errors)]


def test_residuals_in_line_with_their_scene_raise_no_suspicion():
    assert suspects(rows([1e-5, -3e-5, 2e-5]) + rows([1e-4, 3e-4], n_p=6), ["n_p"]) == []


def test_a_residual_ten_times_that_of_its_scene_does():
    (row,) = suspects(rows([1e-5, -1e-5, 1e-5, 2e-5, 1.2e-4]) + rows([1.2e-4] * 3, n_p=6), ["n_p"])
    assert (row["n_p"], row["seed"]) == (20, 4)


@pytest.mark.parametrize("error", [6e-4, -6e-4, float("nan")])
def test_a_large_residual_or_none_does_even_where_all_are_alike(error):
    assert len(suspects(rows([error] * 3), ["n_p"])) == 3
